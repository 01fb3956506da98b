// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/light/mesh_light.h"

#include "janus/math/frame.h"
#include "janus/math/warp.h"

namespace janus {

MeshLight::MeshLight(const Accel& accel, const Mesh& mesh, const Instance& instance, uint32_t index,
                     std::vector<Rgb> radiance)
    : accel_(accel), instance_(index), radiance_(std::move(radiance)) {
  name = instance.name;
  const mat3 linear(instance.to_world);
  std::vector<float> areas, weights;
  for (size_t i = 0; i < mesh.triangles().size(); ++i) {
    const Mesh::Triangle& t = mesh.triangles()[i];
    const vec3 v0 = linear * mesh.positions()[t.v[0]];
    const vec3 v1 = linear * mesh.positions()[t.v[1]];
    const vec3 v2 = linear * mesh.positions()[t.v[2]];
    areas.push_back(0.5f * glm::length(cross(v1 - v0, v2 - v0)));
    weights.push_back(areas.back() * luminance(radiance_[i]));
    power_ += 2.0f * kPi * weights.back();
  }
  triangles_ = DiscreteDistribution(weights);
  pdf_area_.resize(areas.size(), 0.0f);
  for (size_t i = 0; i < areas.size() && !triangles_.empty(); ++i) {
    pdf_area_[i] = weights[i] > 0.0f ? 1.0f / areas[i] : 0.0f;
  }
}

MeshLight::Point MeshLight::point(uint32_t triangle, vec2 u) const {
  return {accel_.surface_point(instance_, triangle, square_to_triangle(u)), pdf_area_[triangle]};
}

std::vector<Emitter> MeshLight::emitters() const {
  std::vector<Emitter> result(pdf_area_.size());
  for (size_t i = 0; i < result.size(); ++i) {
    if (!(pdf_area_[i] > 0.0f)) {
      continue;
    }
    Emitter& e = result[i];
    e.strength = luminance(radiance_[i]) / pdf_area_[i];
    for (const vec2 b : {vec2(0, 0), vec2(1, 0), vec2(0, 1)}) {
      const auto surface = accel_.surface_point(instance_, static_cast<uint32_t>(i), b);
      e.bounds.extend(surface.p);
      e.axis = surface.ng;
    }
    e.theta_o = 0.0f;
    e.two_sided = true;
  }
  return result;
}

std::optional<EmissionSample> MeshLight::sample_emission(vec2 u_position, vec2 u_direction) const {
  if (triangles_.empty()) {
    return std::nullopt;
  }
  const bool front = u_direction.x < 0.5f;
  u_direction.x =
      std::min(front ? 2.0f * u_direction.x : 2.0f * u_direction.x - 1.0f, 0x1.fffffep-1f);
  const auto triangle = static_cast<uint32_t>(triangles_.sample(u_position.x, &u_position.x));
  const Point point = this->point(triangle, u_position);
  const vec3 n = front ? point.surface.ng : -point.surface.ng;
  const vec3 direction = Frame(n).to_world(square_to_cosine_hemisphere(u_direction));
  const RayDensity density = ray_density(triangle);
  return EmissionSample{
      offset_origin(point.surface.p, point.surface.ng, point.surface.offset, direction),
      direction,
      radiance_[triangle] / density.value,
      density,
      n,
      point.pdf_area,
      triangle};
}

std::optional<IlluminationSample> MeshLight::sample_illumination(vec3 receiver, uint32_t primitive,
                                                                 vec2 u) const {
  const Point point = this->point(primitive, u);
  const vec3 target = offset_origin(point.surface.p, point.surface.ng, point.surface.offset,
                                    receiver - point.surface.p);
  const vec3 d = target - receiver;
  const float d2 = length2(d);
  if (d2 == 0.0f) {
    return std::nullopt;
  }
  const vec3 wi = d / std::sqrt(d2);
  const float cos_light = std::abs(dot(wi, point.surface.ng));
  if (cos_light == 0.0f) {
    return std::nullopt;
  }
  return IlluminationSample{wi,
                            target,
                            d2,
                            radiance_[primitive],
                            point.pdf_area * d2 / cos_light,
                            ray_density(primitive)};
}

float MeshLight::pdf_illumination(const EmissionSample& sample, vec3 endpoint,
                                  vec3 receiver) const {
  const vec3 d = receiver - endpoint;
  const float d2 = length2(d);
  const float cos_light = std::abs(dot(d, sample.normal)) / std::sqrt(d2);
  return cos_light > 0.0f ? sample.pdf_area * d2 / cos_light : 0.0f;
}

LightHit MeshLight::at(const SurfaceInteraction& hit, vec3 origin, vec3 direction,
                       Rgb radiance) const {
  const float pdf_area = pdf_area_[hit.primitive];
  const float d2 = length2(hit.p - origin);
  const float cos_light = std::abs(dot(direction, hit.ng));
  const float pdf = cos_light > 0.0f ? pdf_area * d2 / cos_light : 0.0f;
  return {std::sqrt(d2), radiance, pdf, ray_density(hit.primitive), d2, hit.primitive};
}

}  // namespace janus
