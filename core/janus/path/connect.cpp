// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/path/connect.h"

#include "janus/path/clear_view.h"

namespace janus {

LightVertex::LightVertex(const PathVertex& v)
    : p(v.hit.p),
      ng(v.hit.ng),
      ns(v.shading.ns),
      offset(v.hit.offset),
      wi(v.back),
      beta(v.beta),
      mis(v.mis),
      bound(max_component(v.beta) * v.bsdf().peak()),
      instance(v.hit.instance),
      first_state(0),
      pixel(v.pixel),
      first_lobe(0),
      reshading(-1),
      edges(static_cast<uint16_t>(v.edges)),
      crossings(static_cast<uint16_t>(v.crossings)),
      max_edges(static_cast<uint16_t>(v.max_edges)),
      bounces(v.bounces),
      state_count(0),
      lobe_count(0),
      transmits(v.bsdf().transmits()),
      hidden(v.hidden),
      held(v.held),
      entry(v.shading.bsdf.kind() == VertexKind::SubsurfaceEntry),
      labels(v.possible_labels(false) & (v.edges == 1 ? v.source : kLabels)),
      seen_by(v.visibility & kLabels) {}

namespace {

// Where what lies on a connection may depend on the path, it is looked at before the weight.
Scene::Passed look_ahead(const Scene& scene, const PathRules& rules, Connection& c) {
  const int left = rules.max_crossings - c.crossings;
  const Scene::Passed passed =
      left < 0 ? Scene::Passed{Rgb(0.0f)} : scene.pass(c.from, c.to, c.type, left, c.path);
  c.through = passed.through;
  c.by_path = passed.by_path;
  return passed;
}

}  // namespace

std::optional<LightConnection> connect_to_light(const Scene& scene, const PathVertex& v,
                                                const Mis& mis, const PathRules& rules,
                                                Sampler& sampler, UnreadVertices* unread) {
  std::optional<LightConnection> joined;
  const float u_light = sampler.next_1d();
  const vec2 u = sampler.next_2d();
  const BsdfView bsdf = v.bsdf();
  const Receiver target = scene.receiver(v.hit, bsdf.transmits(), v.back);
  const LightChoice choice = scene.light_sampler.sample_illumination(target, u_light);
  const Light& light = *scene.lights[choice.light];
  auto sample = light.sample_illumination(v.hit.p, choice.primitive, u);
  if (!sample || v.edges + 1 > light.max_edges || !target.lit_by(light)) {
    return joined;
  }
  const vec3 wi = sample->wi;
  const BsdfEval e = bsdf.evaluate(v.back, wi, TransportMode::Radiance);
  if (is_black(e.f)) {
    return joined;
  }
  Rgb f = e.f;
  if (rules.ray_types) {
    const bool transmitted = dot(v.back, v.hit.ng) * dot(wi, v.hit.ng) < 0.0f;
    f *= lit_share(e.f, e.diffuse, transmitted, light.visibility);
    if (is_black(f)) {
      return joined;
    }
  }
  if (rules.clear_views() && v.clear && hidden_in_clear_view(light, rules)) {
    f *= 1.0f - clear_share(rules, bsdf, v.back, wi);
  }
  const float pdf_nee = choice.pmf * sample->pdf_solid;
  const float pdf_hit = light.hittable() ? e.pdf_radiance : 0.0f;
  float joint = scene.light_sampler.pmf_emission(choice.light) *
                emission_density(sample->emission, std::abs(dot(wi, v.hit.ng)), sample->distance2);
  joined.emplace();
  joined->connection.from = offset_origin(v.hit.p, v.hit.ng, v.hit.offset, wi);
  joined->connection.to = sample->target;
  joined->connection.type = light.shadow_ray;
  joined->connection.crossings = v.crossings;
  if (rules.by_path) [[unlikely]] {
    const bool transmitted = dot(v.back, v.hit.ng) * dot(wi, v.hit.ng) < 0.0f;
    const RayType label = LabelShares::joined(e, transmitted).draw(sampler);
    joined->connection.path = v.path_beyond(label).looking(label);
    const Scene::Passed passed = look_ahead(scene, rules, joined->connection);
    joint = passed.by_path ? 0.0f : joint;
    if (light.by_path) {
      const float length = std::sqrt(sample->distance2);
      light.shine_on(joined->connection.path.after(passed.crossings, length), choice.primitive,
                     *sample);
    }
  }
  joined->connection.value = v.beta * f * sample->radiance / pdf_nee;
  joined->connection.weight = mis.weight_nee(pdf_nee, pdf_hit, joint, v.mis, e.pdf_importance);
  joined->end = {joint, pdf_nee, light.hittable(), wi};
  if (unread) {
    const bool transmitted = dot(v.back, v.hit.ng) * dot(wi, v.hit.ng) < 0.0f;
    ScatterShares shares = ScatterShares::joined(e, transmitted);
    shares = rules.ray_types ? shares.lit(light.visibility) : shares;
    unread->set({v.hit.instance, shares});
  }
  joined->light = choice.light;
  return joined;
}

std::optional<Connection> connect_vertices(const Scene& scene, const LightVertex& l,
                                           BsdfView light_bsdf, const PathVertex& c, const Mis& mis,
                                           const PathRules& rules, float scale,
                                           const Roulette& roulette, Sampler& sampler,
                                           Counters& counters, UnreadVertices* unread) {
  std::optional<Connection> joined;
  const vec3 d = l.p - c.hit.p;
  const float d2 = length2(d);
  if (!(d2 > 0.0f)) {
    return joined;
  }
  const vec3 wi = d / std::sqrt(d2), wo = c.back;
  const BsdfView camera_bsdf = c.bsdf();
  const float cos_camera = dot(wi, c.hit.ng), cos_light = -dot(wi, l.ng);
  // Both ends must scatter to the side where the other end is.
  if ((cos_camera * dot(wo, c.hit.ng) <= 0.0f && !camera_bsdf.transmits()) ||
      (cos_light * dot(l.wi, l.ng) <= 0.0f && !l.transmits)) {
    return joined;
  }
  ++counters.connections_facing;
  scale /= d2;
  const float bound = max_component(c.beta) * camera_bsdf.peak() * l.bound *
                      std::abs(cos_camera * cos_light) * scale;
  float made_up = 1.0f;
  if (!roulette.survives(bound, sampler, made_up)) {
    return joined;
  }
  const BsdfEval at_camera = camera_bsdf.evaluate(wo, wi, TransportMode::Radiance);
  if (is_black(at_camera.f)) {
    return joined;
  }
  const BsdfEval at_light = light_bsdf.evaluate(-wi, l.wi, TransportMode::Importance);
  if (is_black(at_light.f)) {
    return joined;
  }
  RayType type = RayType::Diffuse;
  Rgb lit(1.0f);
  const bool transmitted_light = cos_light * dot(l.wi, l.ng) < 0.0f;
  const bool transmitted_camera = cos_camera * dot(wo, c.hit.ng) < 0.0f;
  const bool labelled = rules.ray_types || rules.by_path;
  if (labelled || rules.caps_bind(l.edges + c.edges + 1)) {
    const BounceCounts bounces = l.bounces + c.bounces;
    auto camera_label = LabelShares::joined(at_camera, transmitted_camera);
    auto light_label = LabelShares::joined(at_light, transmitted_light);
    if (labelled) {
      camera_label = camera_label.within(l.seen_by);
      const float sum = camera_label.sum();
      if (sum == 0.0f) {
        return joined;
      }
      type = camera_label.draw(sampler);
      camera_label = LabelShares::only(type);
      scale *= sum;
      if (l.edges == 1) {
        lit = lit_share(at_light.f, at_light.diffuse, transmitted_light, l.labels);
        if (is_black(lit)) {
          return joined;
        }
      } else {
        light_label = light_label.within(l.labels);
      }
    }
    const float share = l.edges == 1 ? rules.caps.share(bounces, camera_label)
                                     : rules.caps.share(bounces, camera_label, light_label);
    if (share == 0.0f) {
      return joined;
    }
    scale *= share;
  }
  if (rules.clear_views() && c.clear && (l.held || l.hidden)) {
    const float at_light_clear = l.held ? 1.0f : clear_share(rules, light_bsdf, -wi, l.wi);
    scale *= 1.0f - at_light_clear * clear_share(rules, camera_bsdf, wo, wi);
  }
  ++counters.connections_evaluated;
  const float pdf_area_light = at_camera.pdf_radiance * std::abs(cos_light) / d2;
  const float pdf_area_camera = at_light.pdf_importance * std::abs(cos_camera) / d2;
  joined.emplace();
  joined->value = c.beta * at_camera.f * at_light.f * l.beta * lit * scale;
  joined->from = offset_origin(c.hit.p, c.hit.ng, c.hit.offset, wi);
  joined->to = offset_origin(l.p, l.ng, l.offset, -wi);
  joined->type = type;
  joined->crossings = c.crossings + l.crossings;
  joined->made_up = made_up;
  if (rules.by_path) [[unlikely]] {
    joined->path = c.path_beyond(type);
    look_ahead(scene, rules, *joined);
  }
  static constexpr MisState kNothing;
  const MisState& beyond = joined->by_path ? kNothing : c.mis;
  joined->weight = mis.weight_connection(l.mis, pdf_area_light, at_light.pdf_radiance, beyond,
                                         pdf_area_camera, at_camera.pdf_importance);
  if (unread) {
    UnreadVertex first{l.instance, ScatterShares::joined(at_light, transmitted_light)};
    UnreadVertex second{c.hit.instance, ScatterShares::joined(at_camera, transmitted_camera)};
    if (rules.ray_types) {
      second.shares = second.shares.labelled(type);
      first.shares = l.edges == 1 ? first.shares.lit(l.labels) : first.shares.within(l.labels);
    }
    unread->set(first, second);
  }
  return joined;
}

std::optional<Merge> merge_vertices(const LightVertex& l, const PathVertex& c, const Mis& mis,
                                    const PathRules& rules, float scale, UnreadVertices* unread) {
  constexpr float kSameSurface = 0.7f;  // cosine between the normals
  std::optional<Merge> merged;
  const int edges = l.edges + c.edges;
  if (l.entry || edges > l.max_edges || l.crossings + c.crossings > rules.max_crossings ||
      dot(l.ng, c.hit.ng) < kSameSurface || c.shading.bsdf.one_way()) {
    return merged;
  }
  const BsdfView bsdf = c.bsdf();
  const float cos_light = dot(l.wi, c.hit.ng);
  const BsdfEval e = bsdf.evaluate(c.back, l.wi, TransportMode::Radiance);
  if (is_black(e.f)) {
    return merged;
  }
  const bool transmitted = cos_light * dot(c.back, c.hit.ng) < 0.0f;
  if (rules.ray_types || rules.caps_bind(edges)) {
    auto label = LabelShares::joined(e, transmitted);
    if (rules.ray_types) {
      label = label.within(l.labels);
    }
    scale *= rules.caps.share(l.bounces + c.bounces, label);
  }
  if (rules.clear_views() && c.clear && l.hidden) {
    scale *= 1.0f - clear_share(rules, bsdf, c.back, l.wi);
  }
  // The light path's throughput is flux, which the surface's area shares: f without its cosine.
  merged.emplace();
  merged->value = c.beta * e.f * l.beta * (scale / std::abs(cos_light));
  merged->weight = mis.weight_merge(l.mis, e.pdf_radiance, c.mis, e.pdf_importance);
  if (unread) {
    const auto shares = ScatterShares::joined(e, transmitted);
    unread->set({c.hit.instance, rules.ray_types ? shares.within(l.labels) : shares});
  }
  return merged;
}

std::optional<CameraSplat> connect_to_camera(const PathVertex& v, const Camera& camera, vec2 u_lens,
                                             float margin, const Mis& mis, const PathRules& rules,
                                             UnreadVertices* unread) {
  std::optional<CameraSplat> splat;
  if (!contains(v.visibility, RayType::Camera) || v.edges + 1 > v.max_edges || v.held) {
    return splat;
  }
  const auto to_camera = camera.connect(v.hit.p, u_lens, margin);
  if (!to_camera) {
    return splat;
  }
  const BsdfView bsdf = v.bsdf();
  const vec3 wo = to_camera->wo;
  const BsdfEval e = bsdf.evaluate(wo, v.back, TransportMode::Importance);
  if (is_black(e.f)) {
    return splat;
  }
  Rgb share(1.0f);
  const bool transmitted = dot(wo, v.hit.ng) * dot(v.back, v.hit.ng) < 0.0f;
  if (v.edges > 1 && (rules.ray_types || rules.caps_bind(v.edges + 1))) {
    const auto label = LabelShares::joined(e, transmitted).within(v.possible_labels(false));
    share = Rgb(rules.caps.share(v.bounces, label));
  } else if (rules.ray_types) {
    share = v.possible_labels(false) ? lit_share(e.f, e.diffuse, transmitted, v.source) : Rgb(0.0f);
  }
  if (rules.clear_views() && v.hidden) {
    share *= 1.0f - clear_share(rules, bsdf, wo, v.back);
  }
  if (is_black(share)) {
    return splat;
  }
  const float importance = to_camera->importance();
  splat.emplace();
  Connection& joined = splat->connection;
  joined.value = v.beta * e.f * share * (importance / to_camera->pmf);
  joined.weight = mis.weight_splat(v.mis, importance * std::abs(dot(wo, v.hit.ng)), e.pdf_radiance);
  joined.from = offset_origin(v.hit.p, v.hit.ng, v.hit.offset, wo);
  joined.to = to_camera->target;
  joined.type = RayType::Camera;
  joined.camera = Scene::End::B;
  joined.crossings = v.crossings;
  splat->raster = to_camera->raster;
  splat->end = {v.hit.p + std::sqrt(to_camera->distance2) * wo, to_camera->density};
  if (unread) {
    auto shares = ScatterShares::joined(e, transmitted);
    if (rules.ray_types) {
      shares = v.edges == 1 ? shares.lit(v.source) : shares.within(v.possible_labels(false));
    }
    unread->set({v.hit.instance, shares});
  }
  return splat;
}

}  // namespace janus
