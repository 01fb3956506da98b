// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/path/oracle.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace janus {

namespace {

// What the definition needs of a scattering vertex: as it stands for what is on the light's side
// and on the camera's side, which differ where light goes below a surface.
struct Scattering {
  const PathVertex *light, *camera;
  bool delta = false;                                     // as sampled; joins make it false
  double discrete_radiance = 0, discrete_importance = 0;  // of the delta event
  bool by_path = false;  // light walks do not come over the segment on its camera side
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

  vec3 entry(int i) const { return z(i).camera->hit.p; }
  vec3 exit(int i) const { return z(i).light->hit.p; }
  bool below(int i) const { return z(i).light != z(i).camera; }
  vec3 wi(int i) const { return i == 1 ? to_light : normalize(entry(i - 1) - exit(i)); }
  vec3 wo(int i) const { return normalize((i == k() - 1 ? camera.lens : exit(i + 1)) - entry(i)); }
  double pdf(int i, TransportMode mode) const {
    if (z(i).delta) {
      return mode == TransportMode::Radiance ? z(i).discrete_radiance : z(i).discrete_importance;
    }
    if (below(i)) {
      const bool radiance = mode == TransportMode::Radiance;
      const PathVertex& end = radiance ? *z(i).light : *z(i).camera;
      return radiance ? end.bsdf().pdf_solid(end.back, wi(i), mode)
                      : end.bsdf().pdf_solid(wo(i), end.back, mode);
    }
    return z(i).light->bsdf().pdf_solid(wo(i), wi(i), mode);
  }
  // Of going below at z_i, and coming up where the other end is: of light walks relative to those
  // of the camera, whose density but for the direction at the entry is the unit.
  double light_below(int i) const {
    const PathVertex& end = *z(i).light;
    return passage(i).light_over_camera == 0.0
               ? 0.0
               : end.bsdf().pdf_solid(end.back, wi(i), TransportMode::Importance) *
                     passage(i).light_over_camera;
  }
  double camera_below(int i) const {
    const PathVertex& end = *z(i).camera;
    return passage(i).light_over_camera == 0.0
               ? 1.0
               : end.bsdf().pdf_solid(wo(i), end.back, TransportMode::Radiance);
  }
  const Passage& passage(int i) const { return z(i).light->passage; }
  // |cos| at `at` over the squared distance to `from`.
  double geometry(const SurfaceInteraction& at, vec3 from) const {
    const vec3 d = from - at.p;
    return std::abs(dot(at.ng, normalize(d))) / static_cast<double>(length2(d));
  }
  double pr(int i) const {  // density of z_i from the camera side
    double solid = 0.0;
    if (i == k() - 1) {
      solid = camera_density(camera.density, std::abs(dot(z(i).camera->hit.ng, wo(i))),
                             length2(camera.lens - entry(i)));
    } else {
      solid = pdf(i + 1, TransportMode::Radiance);
      solid *= i == 0 ? 1.0 : geometry(z(i).camera->hit, exit(i + 1));
    }
    return i > 0 && below(i) ? solid * camera_below(i) : solid;
  }
  double arrival(int i) const {  // density of z_i, i >= 2, from the light side, or of its exit
    return pdf(i - 1, TransportMode::Importance) * geometry(z(i).light->hit, entry(i - 1));
  }
  double pf(int i) const { return below(i) ? arrival(i) * light_below(i) : arrival(i); }
  double shortest_edge2() const {  // between scattering vertices, squared
    double shortest = std::numeric_limits<double>::infinity();
    for (int i = 2; i < k(); ++i) {
      shortest = std::min<double>(shortest, length2(exit(i) - entry(i - 1)));
    }
    return shortest;
  }
  bool one_way(int i) const { return z(i).light->shading.bsdf.one_way(); }
  // Can a light walk come to z_i?
  bool from_light(int i) const {
    for (int j = 1; j < i; ++j) {
      if (one_way(j) || z(j).by_path) {
        return false;
      }
    }
    return !one_way(i);
  }
  bool allowed(int s) const {
    if (s == 0) {
      return hittable;
    }
    if (s == 1) {
      return !z(1).delta;
    }
    if (!from_light(s - 1)) {
      return false;
    }
    if (s == k()) {
      return !z(k() - 1).delta;
    }
    return !z(s - 1).delta && !z(s).delta;
  }
  double density(int s) const {
    double product = s == 0 ? pr(0) : s == 1 ? pdf_nee : joint;
    product *= s > 1 && below(1) ? light_below(1) : 1.0;
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
  double merge_density(int i) const { return density(i) * arrival(i); }
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
      total +=
          z(i).delta || !from_light(i) ? 0.0 : std::pow(counts.merge * merge_density(i), exponent);
    }
    return total > 0.0 ? own / total : 0.0;
  }
};

void set_delta(Scattering& s, const Departure& left, TransportMode walk) {
  const bool radiance = walk == TransportMode::Radiance;
  s.delta = left.delta;
  s.discrete_radiance = radiance ? left.pdf_solid : left.pdf_reverse;
  s.discrete_importance = radiance ? left.pdf_reverse : left.pdf_solid;
}

// What a walk has seen, from its start. Where it has been below a surface, two in a row are one
// vertex.
struct Visits {
  std::vector<PathVertex> all;
  // The first ends of those vertices, as the opposite walk comes up there.
  std::vector<PathVertex> first_ends;

  bool came_up(size_t n) const { return n > 0 && all[n].edges == all[n - 1].edges; }

  void add(const PathVertex& v, TransportMode mode) {
    all.push_back(v);
    first_ends.push_back(v);
    if (came_up(all.size() - 1)) {
      PathVertex& first = first_ends[all.size() - 2];
      const bool camera = mode == TransportMode::Radiance;
      first.shading.bsdf.set_kind(camera ? VertexKind::SubsurfaceEntry
                                         : VertexKind::SubsurfaceExit);
      for (Lobe& lobe : first.shading.bsdf.lobes()) {
        if (camera && lobe.type == LobeType::Subsurface) {
          lobe.edge = v.passage.below;
        }
      }
      first.passage = v.passage;
    }
  }

  // The vertices of the first `count` visits. The last is joined: it was left by no event.
  std::vector<Scattering> vertices(size_t count, TransportMode mode) const {
    std::vector<Scattering> result;
    for (size_t n = 0; n < count; ++n) {
      Scattering& s = result.emplace_back(Scattering{&all[n], &all[n]});
      if (n + 1 < count && came_up(n + 1)) {
        (mode == TransportMode::Radiance ? s.camera : s.light) = &first_ends[n];
        (mode == TransportMode::Radiance ? s.light : s.camera) = &all[++n];
      }
      if (n + 1 < count) {
        set_delta(s, all[n + 1].previous, mode);
      }
    }
    return result;
  }
};

// z_1 ... from the first visits of the light walk, then those of the camera walk, whose last vertex
// comes first. `by_path`: of the segment between the two.
FullPath join(const Visits& light, size_t i, const Visits& camera, size_t j, bool by_path = false) {
  FullPath path;
  path.interior = light.vertices(i, TransportMode::Importance);
  if (!path.interior.empty()) {
    path.interior.back().by_path = by_path;
  }
  const auto seen = camera.vertices(j, TransportMode::Radiance);
  path.interior.insert(path.interior.end(), seen.rbegin(), seen.rend());
  for (Scattering& s : std::span(path.interior).subspan(path.interior.size() - seen.size())) {
    s.by_path = s.camera->by_path;
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

  Visits light, seen;
  if (scene.light_sampler.emits()) {
    Sampler sampler(seed, Stream::Light, 0, index);
    trace_light_subpath(
        scene, mis, settings, sampler, counters, [&](const PathVertex& v, Sampler& walk_sampler) {
          light.add(v, TransportMode::Importance);
          if (counts.splat == 0.0f) {
            return;
          }
          const vec2 u_lens = walk_sampler.next_2d();
          if (const auto splat = connect_to_camera(v, camera, u_lens, kInfinity, mis, settings)) {
            FullPath path = join(light, light.all.size(), {}, 0);
            set_light(path, light.all[0].light_end);
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
    FullPath path = join({}, 0, seen, seen.all.size());
    set_delta(path.interior.front(), found.previous, TransportMode::Radiance);
    set_light(path, found.end);
    path.camera = seen.all[0].camera_end;
    compare(path, 0, found.weight.value);
  };
  const auto on_vertex = [&](const PathVertex& v, Sampler& walk_sampler) {
    seen.add(v, TransportMode::Radiance);
    const size_t j = seen.all.size();
    if (counts.nee > 0.0f && scene.light_sampler.illuminates()) {
      if (const auto nee = connect_to_light(scene, v, mis, settings, walk_sampler)) {
        FullPath path = join({}, 0, seen, j);
        set_light(path, nee->end);
        path.camera = seen.all[0].camera_end;
        compare(path, 1, nee->connection.weight.value);
      }
    }
    for (size_t i = 1; i <= light.all.size() && counts.connection > 0.0f; ++i) {
      const PathVertex& l = light.all[i - 1];
      if (const auto connection =
              connect_vertices(scene, LightVertex(l), l.bsdf(), v, mis, settings, 1.0f, Roulette(),
                               walk_sampler, counters)) {
        FullPath path = join(light, i, seen, j, connection->by_path);
        set_light(path, light.all[0].light_end);
        path.camera = seen.all[0].camera_end;
        compare(path, l.edges + 1, connection->weight.value);
      }
    }
  };
  trace_camera_subpath(scene, camera, raster, mis, settings, sampler, counters, on_light,
                       on_vertex);
  return check;
}

}  // namespace janus
