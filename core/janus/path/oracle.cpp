// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/path/oracle.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace janus {

namespace {

// What the definition needs of a scattering vertex.
struct Scattering {
  vec3 p, ng;
  const PathVertex* vertex;
  bool delta = false;                                     // as sampled; joins make it false
  double discrete_radiance = 0, discrete_importance = 0;  // of the delta event
};

// A finished path with z_1 ... z_{k-1}, and its ends as densities.
struct FullPath {
  std::vector<Scattering> interior;  // z_1 first
  double joint = 0;                  // J
  double pdf_nee = 0;                // pN
  CameraEnd camera;
  vec3 to_light{};  // unit, from z_1 to z_0
  bool hittable = false;

  int k() const { return static_cast<int>(interior.size()) + 1; }
  const Scattering& z(int i) const { return interior[i - 1]; }

  vec3 wi(int i) const { return i == 1 ? to_light : normalize(z(i - 1).p - z(i).p); }
  vec3 wo(int i) const { return normalize((i == k() - 1 ? camera.lens : z(i + 1).p) - z(i).p); }
  double pdf(int i, TransportMode mode) const {
    if (z(i).delta) {
      return mode == TransportMode::Radiance ? z(i).discrete_radiance : z(i).discrete_importance;
    }
    return z(i).vertex->bsdf().pdf_solid(wo(i), wi(i), mode);
  }
  // |cos| at `at` over the squared distance to `from`.
  double geometry(vec3 at, vec3 ng, vec3 from) const {
    const vec3 d = from - at;
    return std::abs(dot(ng, normalize(d))) / static_cast<double>(length2(d));
  }
  double pr(int i) const {  // density of z_i from the camera side
    if (i == k() - 1) {
      return camera_density(camera.density, std::abs(dot(z(i).ng, wo(i))),
                            length2(camera.lens - z(i).p));
    }
    const double solid = pdf(i + 1, TransportMode::Radiance);
    return i == 0 ? solid : solid * geometry(z(i).p, z(i).ng, z(i + 1).p);
  }
  double pf(int i) const {  // density of z_i, i >= 2, from the light side
    return pdf(i - 1, TransportMode::Importance) * geometry(z(i).p, z(i).ng, z(i - 1).p);
  }
  double shortest_edge2() const {  // between scattering vertices, squared
    double shortest = std::numeric_limits<double>::infinity();
    for (int i = 2; i < k(); ++i) {
      shortest = std::min<double>(shortest, length2(z(i).p - z(i - 1).p));
    }
    return shortest;
  }
  bool allowed(int s) const {
    if (s == 0) {
      return hittable;
    }
    if (s == 1) {
      return !z(1).delta;
    }
    if (z(s - 1).vertex->bsdf().one_way()) {
      return false;  // no walk from a light ends there
    }
    if (s == k()) {
      return !z(k() - 1).delta;
    }
    return !z(s - 1).delta && !z(s).delta;
  }
  double density(int s) const {
    double product = s == 0 ? pr(0) : s == 1 ? pdf_nee : joint;
    for (int i = 2; i < s; ++i) {
      product *= pf(i);
    }
    for (int i = std::max(s, 1); i < k(); ++i) {
      product *= pr(i);
    }
    return product;
  }
  double count(int s, const SampleCounts& n) const {
    return s == 0 ? n.hit : s == 1 ? n.nee : s == k() ? n.splat : n.connection;
  }
  // Of both walks arriving at z_i, i >= 2, per area of the neighbourhood that counts as z_i.
  double merge_density(int i) const { return density(i) * pf(i); }
  double weight(int s, Heuristic heuristic, const SampleCounts& counts) const {
    const double exponent = heuristic == Heuristic::Power ? 2.0 : 1.0;
    double total = 0.0, own = 0.0;
    for (int i = 0; i <= k(); ++i) {
      if (!allowed(i)) {
        continue;
      }
      const double term = std::pow(count(i, counts) * density(i), exponent);
      total += term;
      own = i == s ? term : own;
    }
    for (int i = 2; i < k() && counts.merge > 0.0f; ++i) {
      total += z(i).delta || z(i).vertex->bsdf().one_way()
                   ? 0.0
                   : std::pow(counts.merge * merge_density(i), exponent);
    }
    return total > 0.0 ? own / total : 0.0;
  }
};

Scattering scattering(const PathVertex& v) { return {v.hit.p, v.hit.ng, &v}; }

void set_delta(Scattering& s, const Departure& left, TransportMode walk) {
  const bool radiance = walk == TransportMode::Radiance;
  s.delta = left.delta;
  s.discrete_radiance = radiance ? left.pdf_solid : left.pdf_reverse;
  s.discrete_importance = radiance ? left.pdf_reverse : left.pdf_solid;
}

// z_1 ... z_i from the light walk, then z_{i+1} ... from the camera walk (its last vertex first).
// The vertices at which the walks end were left by no event: they are joined.
FullPath join(const std::vector<PathVertex>& light, int i, const std::vector<PathVertex>& camera,
              int j) {
  FullPath path;
  for (int n = 0; n < i; ++n) {
    path.interior.push_back(scattering(light[n]));
    if (n + 1 < i) {
      set_delta(path.interior.back(), light[n + 1].previous, TransportMode::Importance);
    }
  }
  for (int n = j - 1; n >= 0; --n) {
    path.interior.push_back(scattering(camera[n]));
    if (n + 1 < j) {
      set_delta(path.interior.back(), camera[n + 1].previous, TransportMode::Radiance);
    }
  }
  return path;
}

void set_light(FullPath& path, const LightEnd& end) {
  path.joint = end.joint;
  path.pdf_nee = end.pdf_nee;
  path.hittable = end.hittable;
  path.to_light = end.wi;
}

}  // namespace

WeightCheck check_weights(const Scene& scene, const Camera& camera, vec2 raster,
                          Heuristic heuristic, const SampleCounts& counts,
                          const WalkSettings& settings, uint32_t seed, uint64_t index) {
  const Mis mis(heuristic, counts);
  WeightCheck check;
  Counters counters;
  const double shortest = 1e-3 * scene.accel->bounds().radius();
  const auto compare = [&](FullPath& path, int s, float weight) {
    // Positions are rounded: the direction of a very short edge is not known to four digits.
    if (path.shortest_edge2() < shortest * shortest) {
      ++check.degenerate;
      return;
    }
    const double error = std::abs(weight - path.weight(s, heuristic, counts));
    check.max_error = std::max(check.max_error, error);
    check.sum_error += error;
    check.inaccurate += error > 1e-4;
    ++check.paths;
    ++check.by_class[s < 2 ? s : s == path.k() ? 3 : 2];
  };

  std::vector<PathVertex> light, camera_vertices;
  if (scene.light_sampler.emits()) {
    Sampler sampler(seed, Stream::Light, 0, index);
    trace_light_subpath(
        scene, mis, settings, sampler, counters, [&](const PathVertex& v, Sampler& walk_sampler) {
          light.push_back(v);
          if (counts.splat == 0.0f) {
            return;
          }
          const vec2 u_lens = walk_sampler.next_2d();
          if (const auto splat = connect_to_camera(v, camera, u_lens, kInfinity, mis, settings)) {
            FullPath path = join(light, v.edges, {}, 0);
            set_light(path, light[0].light_end);
            path.camera = splat->end;
            compare(path, v.edges + 1, splat->connection.weight.value);
          }
        });
  }

  Sampler sampler(seed, Stream::Camera, index, 0);
  const auto on_light = [&](const LightFound& found) {
    if (found.edges < 2 || counts.hit == 0.0f) {
      return;
    }
    FullPath path = join({}, 0, camera_vertices, found.edges - 1);
    set_delta(path.interior.front(), found.previous, TransportMode::Radiance);
    set_light(path, found.end);
    path.camera = camera_vertices[0].camera_end;
    compare(path, 0, found.weight.value);
  };
  const auto on_vertex = [&](const PathVertex& v, Sampler& walk_sampler) {
    camera_vertices.push_back(v);
    const int j = static_cast<int>(camera_vertices.size());
    if (counts.nee > 0.0f && scene.light_sampler.illuminates()) {
      if (const auto nee = connect_to_light(scene, v, mis, settings, walk_sampler)) {
        FullPath path = join({}, 0, camera_vertices, j);
        set_light(path, nee->end);
        path.camera = camera_vertices[0].camera_end;
        compare(path, 1, nee->connection.weight.value);
      }
    }
    for (int i = 1; i <= static_cast<int>(light.size()) && counts.connection > 0.0f; ++i) {
      const PathVertex& l = light[i - 1];
      if (const auto connection = connect_vertices(LightVertex(l), l.bsdf(), v, mis, settings, 1.0f,
                                                   Roulette(), walk_sampler, counters)) {
        FullPath path = join(light, i, camera_vertices, j);
        set_light(path, light[0].light_end);
        path.camera = camera_vertices[0].camera_end;
        compare(path, i + 1, connection->weight.value);
      }
    }
  };
  trace_camera_subpath(scene, camera, raster, mis, settings, sampler, counters, on_light,
                       on_vertex);
  return check;
}

}  // namespace janus
