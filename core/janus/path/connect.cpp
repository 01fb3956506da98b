// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/path/connect.h"

namespace janus {

std::optional<LightConnection> connect_to_light(const Scene& scene, const PathVertex& v,
                                                const Mis& mis, Sampler& sampler) {
  const float u_light = sampler.next_1d();
  const vec2 u = sampler.next_2d();
  const BsdfView bsdf = v.bsdf();
  const LightChoice choice =
      scene.light_sampler.sample_illumination(receiver(v.hit, bsdf, v.back), u_light);
  const Light& light = *scene.lights[choice.light];
  const auto sample = light.sample_illumination(v.hit.p, choice.primitive, u);
  if (!sample) {
    return std::nullopt;
  }
  const vec3 wo = v.back, wi = sample->wi;
  const Rgb f = bsdf.eval(wo, wi, TransportMode::Radiance);
  if (is_black(f)) {
    return std::nullopt;
  }
  const float pdf_nee = choice.pmf * sample->pdf_solid;
  const float pdf_hit = light.hittable() ? bsdf.pdf_solid(wo, wi, TransportMode::Radiance) : 0.0f;
  const float joint =
      scene.light_sampler.pmf_emission(choice.light) *
      emission_density(sample->emission, std::abs(dot(wi, v.hit.ng)), sample->distance2);
  const float weight = mis.weight_nee(pdf_nee, pdf_hit, joint, v.mis,
                                      bsdf.pdf_solid(wo, wi, TransportMode::Importance));
  return LightConnection{{v.beta * f * sample->radiance / pdf_nee, weight,
                          offset_origin(v.hit.p, v.hit.ng, v.hit.offset, wi), sample->target},
                         {joint, pdf_nee, light.hittable(), wi}};
}

std::optional<Connection> connect_vertices(const LightVertex& l, BsdfView light_bsdf,
                                           const PathVertex& c, const Mis& mis) {
  const vec3 d = l.p - c.hit.p;
  const float d2 = length2(d);
  if (!(d2 > 0.0f)) {
    return std::nullopt;
  }
  const vec3 wi = d / std::sqrt(d2), wo = c.back;
  const BsdfView camera_bsdf = c.bsdf();
  const Rgb f_camera = camera_bsdf.eval(wo, wi, TransportMode::Radiance);
  if (is_black(f_camera)) {
    return std::nullopt;
  }
  const Rgb f_light = light_bsdf.eval(-wi, l.wi, TransportMode::Importance);
  if (is_black(f_light)) {
    return std::nullopt;
  }
  const float pdf_area_light =
      camera_bsdf.pdf_solid(wo, wi, TransportMode::Radiance) * std::abs(dot(wi, l.ng)) / d2;
  const float pdf_area_camera =
      light_bsdf.pdf_solid(-wi, l.wi, TransportMode::Importance) * std::abs(dot(wi, c.hit.ng)) / d2;
  const float weight = mis.weight_connection(
      l.mis, pdf_area_light, light_bsdf.pdf_solid(-wi, l.wi, TransportMode::Radiance), c.mis,
      pdf_area_camera, camera_bsdf.pdf_solid(wo, wi, TransportMode::Importance));
  return Connection{c.beta * f_camera * f_light * l.beta / d2, weight,
                    offset_origin(c.hit.p, c.hit.ng, c.hit.offset, wi),
                    offset_origin(l.p, l.ng, l.offset, -wi)};
}

std::optional<CameraSplat> connect_to_camera(const PathVertex& v, const Camera& camera, vec2 u_lens,
                                             float margin, const Mis& mis) {
  const auto to_camera = camera.connect(v.hit.p, u_lens, margin);
  if (!to_camera) {
    return std::nullopt;
  }
  const BsdfView bsdf = v.bsdf();
  const vec3 wo = to_camera->wo, wi = v.back;
  const Rgb f = bsdf.eval(wo, wi, TransportMode::Importance);
  if (is_black(f)) {
    return std::nullopt;
  }
  const float importance = to_camera->importance();
  const float weight = mis.weight_splat(v.mis, importance * std::abs(dot(wo, v.hit.ng)),
                                        bsdf.pdf_solid(wo, wi, TransportMode::Radiance));
  return CameraSplat{{v.beta * f * (importance / to_camera->pmf), weight,
                      offset_origin(v.hit.p, v.hit.ng, v.hit.offset, wo), to_camera->target},
                     to_camera->raster};
}

}  // namespace janus
