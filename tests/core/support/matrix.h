// SPDX-License-Identifier: GPL-3.0-or-later
//
// The factors light x closure x camera: what each level puts into one and the same small set, and a
// covering set of their combinations.
#pragma once

#include <array>
#include <functional>
#include <set>

#include "support/scene_kit.h"

namespace janus::test {

struct LightLevel {
  std::string name;
  std::function<void(SceneKit&)> add;
  bool delta = false;  // a point or one direction: no ray hits it
};

struct ClosureLevel {
  std::string name;
  NodeGraph graph;
  bool delta = false;   // some of its light is scattered into single directions
  bool peaked = false;  // nearly so: lt sees it by a few bright samples
  bool smooth = false;  // shading normals
};

struct CameraLevel {
  std::string name;
  std::function<void(CameraDesc&)> change;
};

// One level of each factor.
struct Combination {
  std::array<size_t, 3> level;
  bool operator==(const Combination&) const = default;
};

inline NodeGraph principled(std::map<std::string, NodeInput> inputs) {
  return single("BSDF_PRINCIPLED", std::move(inputs));
}

inline std::vector<LightLevel> light_levels() {
  static const vec3 from(0.8f, -0.9f, 1.4f), to(0.0f, 0.0f, -0.2f);
  const auto lamp = [](LightDesc desc) {
    return [desc](SceneKit& kit) { kit.light("lamp", desc); };
  };
  LightDesc ellipse = area_light(from, to, 0.9f, 40, 1.8f);
  ellipse.shape = AreaShape::Ellipse;
  ellipse.size_y = 0.6f;
  // Grey, brighter above, with a bright spot of four pixels.
  Image sky(16, 8, 3);
  for (int y = 0; y < sky.height; ++y) {
    for (int x = 0; x < sky.width; ++x) {
      const bool spot = (y == 5 || y == 6) && (x == 8 || x == 9);
      for (int c = 0; c < 3; ++c) {
        sky.pixels[3 * (y * sky.width + x) + c] = spot ? 9.0f : (y > 3 ? 0.5f : 0.2f) + 0.1f * c;
      }
    }
  }
  return {
      {"point", lamp(point_light(from, 40)), true},
      {"point_soft", lamp(point_light(from, 40, 0.35f))},
      {"point_sphere", lamp(point_light(from, 40, 0.35f, false))},
      {"spot", lamp(spot_light(from, to, 60, 1.1f, 0.3f)), true},
      {"spot_radius", lamp(spot_light(from, to, 60, 1.1f, 0.3f, 0.3f))},
      {"sun", lamp(sun_light(from, 2, 0)), true},
      {"sun_angle", lamp(sun_light(from, 2, 0.7f))},
      {"area", lamp(area_light(from, to, 0.8f, 40))},
      {"ellipse_spread", lamp(ellipse)},
      {"mesh",
       [](SceneKit& kit) {
         kit.add("lamp", plane(0.8f, 0.6f), emission(Rgb(1, 0.9f, 0.8f), 10), look_at(from, to));
       }},
      {"world", [](SceneKit& kit) { kit.world(Rgb(0.5f, 0.7f, 1)); }},
      {"world_image", [sky](SceneKit& kit) { kit.world(sky); }},
  };
}

inline std::vector<ClosureLevel> closure_levels() {
  const vec4 color(0.8f, 0.7f, 0.5f, 1), white(0.95f, 0.95f, 0.95f, 1);
  const auto microfacet = [](const char* type, vec4 c, float roughness, const char* kind,
                             float ior = 0) {
    NodeGraph graph = single(type, {{"Color", c}, {"Roughness", roughness}});
    if (ior > 0) {
      graph.nodes.front().inputs["IOR"] = ior;
    }
    graph.nodes.front().properties = {{"distribution", std::string(kind)}};
    return graph;
  };
  return {
      {"diffuse", diffuse(Rgb(0.8f, 0.7f, 0.5f))},
      {"oren_nayar", single("BSDF_DIFFUSE", {{"Color", color}, {"Roughness", 0.7f}})},
      {"glossy", microfacet("BSDF_GLOSSY", color, 0.3f, "GGX"), false, true},
      {"glossy_multiscatter", microfacet("BSDF_GLOSSY", color, 0.6f, "MULTI_GGX")},
      {"glossy_smooth", mirror(Rgb(0.8f, 0.7f, 0.5f)), true},
      {"glass_smooth", glass(Rgb(0.95f), 1.5f), true},
      {"glass_rough", microfacet("BSDF_GLASS", white, 0.3f, "MULTI_GGX", 1.5f), false, true},
      {"refraction_rough", microfacet("BSDF_REFRACTION", white, 0.4f, "GGX", 1.4f), false, true},
      {"translucent", single("BSDF_TRANSLUCENT", {{"Color", color}})},
      {"transparent_mix", combine("MIX_SHADER", diffuse(Rgb(0.8f, 0.4f, 0.3f)),
                                  single("BSDF_TRANSPARENT", {{"Color", vec4(0.6f, 0.9f, 1, 1)}}))},
      {"plastic", principled({{"Base Color", color}, {"Roughness", 0.35f}})},
      {"metal", principled({{"Base Color", color}, {"Roughness", 0.4f}, {"Metallic", 1.0f}})},
      {"transmission",
       principled({{"Base Color", color}, {"Roughness", 0.45f}, {"Transmission Weight", 0.5f}})},
      {"alpha", principled({{"Base Color", color}, {"Roughness", 0.5f}, {"Alpha", 0.6f}})},
      {"emissive", principled({{"Base Color", color},
                               {"Roughness", 0.5f},
                               {"Emission Color", vec4(1, 0.6f, 0.3f, 1)},
                               {"Emission Strength", 0.5f}})},
      {"thin_wall", principled({{"Base Color", color},
                                {"Thin Wall", 1.0f},
                                {"Transmission Weight", 0.6f},
                                {"Subsurface Weight", 0.7f},
                                {"Roughness", 0.6f}})},
      {"sheen", single("BSDF_SHEEN", {{"Color", color}, {"Roughness", 0.5f}})},
      {"toon", single("BSDF_TOON", {{"Color", color}, {"Size", 0.8f}, {"Smooth", 0.2f}}), false,
       true},
      {"brushed", single("BSDF_METALLIC", {{"Roughness", 0.6f}, {"Anisotropy", 0.6f}})},
      {"covered", principled({{"Base Color", color},
                              {"Coat Weight", 0.8f},
                              {"Coat Roughness", 0.4f},
                              {"Coat Tint", vec4(0.6f, 0.8f, 0.9f, 1)},
                              {"Sheen Weight", 0.5f}})},
      {"subsurface", subsurface(Rgb(0.8f, 0.7f, 0.5f))},
      {"delta_and_rough",
       combine("MIX_SHADER", diffuse(Rgb(0.8f, 0.4f, 0.3f)), glass(Rgb(0.95f), 1.4f), 0.4f), true},
      {"smooth_normals", diffuse(Rgb(0.8f, 0.7f, 0.5f)), false, false, true},
  };
}

inline std::vector<CameraLevel> camera_levels() {
  return {
      {"perspective", [](CameraDesc&) {}},
      {"lens",
       [](CameraDesc& c) {
         c.aperture_radius = 0.2f;
         c.focus_distance = 2.2f;
         c.aperture_blades = 5;
       }},
      {"orthographic",
       [](CameraDesc& c) {
         c.type = CameraType::Orthographic;
         c.left = c.bottom = -0.7f;
         c.right = c.top = 0.7f;
       }},
      {"panorama",
       [](CameraDesc& c) {
         c.type = CameraType::Equirectangular;
         c.transform = look_at({0.1f, -1.3f, 0.5f}, {0, 0, 0});
         c.left = -0.7f, c.right = 0.7f;
         c.bottom = -0.6f, c.top = 0.5f;
       }},
  };
}

// A polyhedron with the closure over a floor, before two walls. It fills a third of the frame, so
// that an error of its closure shows in the mean; no light is in the frame.
inline SceneKit stage(const LightLevel& light, const ClosureLevel& closure,
                      const CameraLevel& camera) {
  SceneKit kit;
  kit.add("floor", plane(2.6f, 2.6f), diffuse(Rgb(0.5f, 0.55f, 0.6f)), translation({0, 0, -0.55f}));
  kit.add("back", plane(2.6f, 2), diffuse(Rgb(0.6f, 0.4f, 0.4f)),
          translation({0, 1.3f, 0.45f}) * rotation({1, 0, 0}, 0.5f * kPi));
  kit.add("side", plane(2, 2.6f), diffuse(Rgb(0.4f, 0.6f, 0.4f)),
          translation({-1.3f, 0, 0.45f}) * rotation({0, 1, 0}, 0.5f * kPi));
  kit.add("ball", ball(0.45f, 10, closure.smooth), closure.graph, rotation({1, 2, 0}, 0.4f));
  light.add(kit);
  CameraDesc desc;
  desc.name = "Camera";
  desc.transform = look_at({0, -2.6f, 1}, {0, 0, -0.1f});
  desc.left = desc.bottom = -0.25f;
  desc.right = desc.top = 0.25f;
  desc.clip_start = 0.01f;
  camera.change(desc);
  kit.builder.set_camera(desc);
  return kit;
}

inline std::vector<Combination> full_product(const std::array<size_t, 3>& sizes) {
  std::vector<Combination> all;
  for (size_t i = 0; i < sizes[0] * sizes[1] * sizes[2]; ++i) {
    all.push_back({{i % sizes[0], i / sizes[0] % sizes[1], i / sizes[0] / sizes[1]}});
  }
  return all;
}

// A pair of levels of two factors.
struct LevelPair {
  size_t factor_a, level_a, factor_b, level_b;
  auto operator<=>(const LevelPair&) const = default;
};

inline std::set<LevelPair> pairs(const std::vector<Combination>& combinations) {
  std::set<LevelPair> out;
  for (const auto& [level] : combinations) {
    for (size_t a = 0; a < 3; ++a) {
      for (size_t b = a + 1; b < 3; ++b) {
        out.insert({a, level[a], b, level[b]});
      }
    }
  }
  return out;
}

// Every pair of levels of two factors at least once: greedily, the combination with the most new
// pairs next. Ties go to the first in an order that mixes the levels.
inline std::vector<Combination> covering_set(const std::array<size_t, 3>& sizes) {
  const std::vector<Combination> all = full_product(sizes);
  std::set<LevelPair> missing = pairs(all);
  std::vector<Combination> chosen;
  size_t start = 0;
  while (!missing.empty()) {
    size_t best = 0, best_gain = 0;
    for (size_t i = 0; i < all.size(); ++i) {
      const size_t candidate = (start + i) % all.size();
      size_t gain = 0;
      for (const LevelPair& pair : pairs({all[candidate]})) {
        gain += missing.count(pair);
      }
      if (gain > best_gain) {
        best = candidate;
        best_gain = gain;
      }
    }
    for (const LevelPair& pair : pairs({all[best]})) {
      missing.erase(pair);
    }
    chosen.push_back(all[best]);
    start = best + all.size() / 3;
  }
  return chosen;
}

}  // namespace janus::test
