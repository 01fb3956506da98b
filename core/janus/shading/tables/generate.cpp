// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes the albedo tables of shading/albedo.cpp; a program of its own that the build runs once.
// Their definitions and grids are those of Cycles (table axes, clamps, ranges), because Cycles'
// multiscatter closures are *defined* by linear interpolation in such tables; the numbers are our
// own, by deterministic quadrature over the distribution of visible normals.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace {

constexpr double kPi = 3.14159265358979323846;

struct Vec {
  double x, y, z;
};
double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec normalize(Vec v) {
  const double s = 1.0 / std::sqrt(dot(v, v));
  return {v.x * s, v.y * s, v.z * s};
}

// (cos, sin) of (i + 1/2) pi / n, n a power of two. By square roots and products alone, so that
// every C library gives the same tables.
std::vector<std::array<double, 2>> half_circle(int n) {
  double c = 0.0, s = 1.0;  // pi / 2
  for (int steps = 1; steps < n; steps *= 2) {
    const double half = std::sqrt(0.5 * (1.0 + c));
    s /= 2.0 * half;
    c = half;
  }
  std::vector<std::array<double, 2>> out;
  double x = c, y = s;
  const double cos2 = c * c - s * s, sin2 = 2.0 * s * c;
  for (int i = 0; i < n; ++i) {
    out.push_back({x, y});
    const double next = x * cos2 - y * sin2;
    y = x * sin2 + y * cos2;
    x = next;
  }
  return out;
}

double fresnel(double cos_i, double eta) {
  const double sin2 = (1.0 - cos_i * cos_i) / (eta * eta);
  if (sin2 >= 1.0) {
    return 1.0;
  }
  const double cos_t = std::sqrt(1.0 - sin2);
  const double p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const double s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return 0.5 * (p * p + s * s);
}

double lambda(double alpha2, double cos) {
  return 0.5 * (std::sqrt(1.0 + alpha2 * std::max(0.0, 1.0 / (cos * cos) - 1.0)) - 1.0);
}

// Midpoints of [0,1] crowded towards both ends (t^2 (3 - 2t)), where integrands have square roots.
struct Node {
  double x, weight;
};
std::vector<Node> nodes(int n) {
  std::vector<Node> out;
  for (int i = 0; i < n; ++i) {
    const double t = (i + 0.5) / n;
    out.push_back({t * t * (3.0 - 2.0 * t), 6.0 * t * (1.0 - t) / n});
  }
  double sum = 0.0;
  for (const Node& node : out) {
    sum += node.weight;
  }
  for (Node& node : out) {
    node.weight /= sum;
  }
  return out;
}

// Mean of `value`(cos(h, w), wh, h) over the visible GGX normals h of direction w = (x, 0, mu)
// (spherical caps: Dupuy & Benyoub 2023).
template <class Value>
double over_normals(double alpha, double mu, int n, Value&& value) {
  const Vec w{std::sqrt(std::max(0.0, 1.0 - mu * mu)), 0.0, mu};
  const Vec standard = normalize({alpha * w.x, 0.0, w.z});
  const auto circle = half_circle(n / 2);
  double sum = 0.0;
  for (const Node& node : nodes(n)) {
    const double z = (1.0 - node.x) * (1.0 + standard.z) - standard.z;
    const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
    for (const auto& [c, s] : circle) {
      const Vec h = normalize({alpha * (r * c + standard.x), alpha * r * s, z + standard.z});
      sum += node.weight * value(w, h);
    }
  }
  return sum / circle.size();
}

// Below it Cycles takes a surface for smooth.
bool smooth(double alpha) { return alpha * alpha <= 2e-10; }

// Albedo of the single-scattering reflection without Fresnel term, from direction cosine mu.
double reflection_albedo(double rough, double mu, int n) {
  const double alpha = rough * rough, alpha2 = alpha * alpha;
  if (smooth(alpha)) {
    return 1.0;
  }
  const double from = lambda(alpha2, mu);
  return over_normals(alpha, mu, n, [&](Vec w, Vec h) {
    const double to = 2.0 * dot(w, h) * h.z - w.z;
    return to > 0.0 ? (1.0 + from) / (1.0 + from + lambda(alpha2, to)) : 0.0;
  });
}

// Albedo of reflection and refraction together at a dielectric. As in Cycles' tables, a refraction
// counts even where it stays above the horizon (which scattering then refuses), and an index of 1
// refracts straight on, without masking.
double glass_albedo(double rough, double mu, double eta, int n) {
  const double alpha = rough * rough, alpha2 = alpha * alpha;
  if (smooth(alpha)) {
    return 1.0;
  }
  const double from = lambda(alpha2, mu);
  return over_normals(alpha, mu, n, [&](Vec w, Vec h) {
    const double cos = dot(w, h), f = fresnel(cos, eta);
    double sum = 0.0;
    if (const double to = 2.0 * cos * h.z - w.z; to > 0.0) {
      sum += f * (1.0 + from) / (1.0 + from + lambda(alpha2, to));
    }
    if (f < 1.0) {
      const double cos_t = std::sqrt(1.0 - (1.0 - cos * cos) / (eta * eta));
      const double to = std::abs(w.z / eta - (cos / eta - cos_t) * h.z);
      const bool straight = std::abs(eta - 1.0) < 1e-4;
      sum += (1.0 - f) * (straight ? 1.0 : (1.0 + from) / (1.0 + from + lambda(alpha2, to)));
    }
    return sum;
  });
}

// Where the mean Fresnel term of the visible normals stands between F0 (0) and 1 (1); that of one
// facet is at `position(cos)`.
template <class Position>
double mean_position(double rough, double mu, int n, Position&& position) {
  const double alpha = rough * rough;
  if (smooth(alpha)) {
    return position(mu);
  }
  return over_normals(alpha, mu, n, [&](Vec w, Vec h) {
    const double cos = dot(w, h);
    return 2.0 * cos * h.z - w.z > 0.0 ? position(cos) : 0.0;
  });
}

double fresnel_position(double rough, double mu, double eta, int n) {
  const double f0 = (eta - 1.0) / (eta + 1.0) * ((eta - 1.0) / (eta + 1.0));
  return mean_position(rough, mu, n, [&](double cos) {
    return std::clamp((fresnel(cos, eta) - f0) / (1.0 - f0), 0.0, 1.0);
  });
}

template <class Albedo>
double average_albedo(int n, Albedo&& albedo) {
  double sum = 0.0;
  for (const Node& node : nodes(n)) {
    sum += 2.0 * node.weight * node.x * albedo(node.x);
  }
  return sum;
}

double axis(int i, int size, double last) { return std::clamp(i / (size - 1.0), 1e-4, last); }

// The index of refraction at z = F0^(1/4): most of the table for indices from 1 to 2. A float, as
// it is in a renderer: the first one is 1.
double index_at(int i, int size) {
  const double z = axis(i, size, 0.99);
  return static_cast<float>((1.0 + z * z) / (1.0 - z * z));
}

class Writer {
 public:
  explicit Writer(std::FILE* file) : file_(file) {}

  // value(rough, mu or z, ior) over the grid, the first axis running fastest.
  template <class Value>
  void table(const char* name, int nx, int ny, int nz, Value&& value) {
    std::fprintf(file_, "constexpr float %s[%d] = {", name, nx * ny * nz);
    for (int i = 0; i < nx * ny * nz; ++i) {
      const double v = value(i % nx, i / nx % ny, i / (nx * ny));
      // Rounded, so that the last bits of a compiler's arithmetic do not show.
      std::fprintf(file_, "%s%.7ff,", i % 8 ? " " : "\n  ", std::clamp(v, 0.0, 1.0));
    }
    std::fprintf(file_, "\n};\n");
  }

 private:
  std::FILE* file_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: janus_tables FILE\n");
    return 2;
  }
  std::FILE* file = std::fopen(argv[1], "w");
  if (!file) {
    std::perror(argv[1]);
    return 1;
  }
  Writer writer(file);
  constexpr int kFine = 32, kCoarse = 16;
  const auto rough = [](int i, int size) { return axis(i, size, 1.0); };
  writer.table("kReflection", kFine, kFine, 1, [&](int x, int y, int) {
    return reflection_albedo(rough(x, kFine), rough(y, kFine), 128);
  });
  writer.table("kReflectionAverage", kFine, 1, 1, [&](int x, int, int) {
    return average_albedo(64,
                          [&](double mu) { return reflection_albedo(rough(x, kFine), mu, 128); });
  });
  for (const bool inside : {false, true}) {
    const auto eta = [inside](int z) {
      const double ior = index_at(z, kCoarse);
      return inside ? 1.0 / ior : ior;
    };
    writer.table(inside ? "kGlassInside" : "kGlassOutside", kCoarse, kCoarse, kCoarse,
                 [&](int x, int y, int z) {
                   return glass_albedo(rough(x, kCoarse), rough(y, kCoarse), eta(z),
                                       inside ? 128 : 64);
                 });
    writer.table(inside ? "kGlassInsideAverage" : "kGlassOutsideAverage", kCoarse, kCoarse, 1,
                 [&](int x, int z, int) {
                   return average_albedo(32, [&](double mu) {
                     return glass_albedo(rough(x, kCoarse), mu, eta(z), 64);
                   });
                 });
  }
  writer.table("kFresnelPosition", kCoarse, kCoarse, kCoarse, [&](int x, int y, int z) {
    return fresnel_position(rough(x, kCoarse), rough(y, kCoarse), index_at(z, kCoarse), 128);
  });
  writer.table("kSchlickPosition", kCoarse, kCoarse, 1, [&](int x, int y, int) {
    return mean_position(rough(x, kCoarse), rough(y, kCoarse), 128,
                         [](double cos) { return std::pow(1.0 - cos, 5.0); });
  });
  return std::fclose(file) == 0 ? 0 : 1;
}
