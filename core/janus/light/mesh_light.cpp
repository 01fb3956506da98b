// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/light/mesh_light.h"

#include "janus/geometry/mesh.h"
#include "janus/math/frame.h"
#include "janus/math/warp.h"

namespace janus {

MeshLight::MeshLight(const Accel& accel, const Surfaces& surfaces, const Shape& shape,
                     const Instance& instance, uint32_t index, const MeshLight* at_rest)
    : accel_(accel), surfaces_(surfaces), instance_(index), slot_(shape.primitives(), kDark) {
  name = instance.names->name;
  light_group = instance.names->light_group;
  visibility = instance.visibility;
  holdout = instance.holdout;
  set_links(instance.emitter);
  if (const Mesh* mesh = shape.mesh()) {
    add_triangles(*mesh, instance, at_rest);
  }
}

void MeshLight::add_triangles(const Mesh& mesh, const Instance& instance,
                              const MeshLight* at_rest) {
  const mat3 linear(instance.to_world);
  std::vector<float> weights;
  for (uint32_t i = 0; i < slot_.size(); ++i) {
    const Mesh::Triangle& t = mesh.triangles()[i];
    const Program& program = surfaces_.program(instance.material(t.material));
    if (!program.emits() || !program.sample_emission) {
      continue;
    }
    const vec3 v0 = linear * mesh.positions()[t.v[0]];
    const vec3 v1 = linear * mesh.positions()[t.v[1]];
    const vec3 v2 = linear * mesh.positions()[t.v[2]];
    const float area = 0.5f * glm::length(cross(v1 - v0, v2 - v0));
    if (!(area > 0.0f)) {
      continue;
    }
    const Rgb radiance = !program.varying_emission ? program.emission
                         : at_rest                 ? at_rest->known_radiance(i)
                                                   : mean_radiance(i);
    const float weight = area * luminance(radiance);
    if (!(weight > 0.0f)) {
      continue;
    }
    const SurfaceInteraction surface = accel_.surface_point(instance_, i, vec2(1.0f / 3.0f));
    const bool asks = program.varying_emission && program.by_path;
    by_path = by_path || asks;
    slot_[i] = static_cast<uint32_t>(triangles_.size());
    triangles_.push_back(
        {radiance, program.varying_emission, asks, surface.ng, surface.offset, 1.0f / area, {}, i});
    weights.push_back(asks ? 0.0f : weight);
    power_ += 2.0f * kPi * weights.back();
  }
  by_power_ = DiscreteDistribution(weights);
  for (size_t i = 0; i < triangles_.size() && !by_power_.empty(); ++i) {
    // Either side, by the cosine.
    triangles_[i].density = {0.5f * kInvPi * by_power_.pmf(i) * triangles_[i].pdf_area, false};
  }
}

Rgb MeshLight::mean_radiance(uint32_t primitive) const {
  constexpr int kSide = 4;  // the triangle in 16 alike, each looked at in its middle
  Rgb sum(0.0f);
  ShadingResult shading;
  int k = 0;
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < 2 * (kSide - i) - 1; ++j, ++k) {
      const float third = j % 2 ? 2.0f / 3.0f : 1.0f / 3.0f;
      const vec2 b((static_cast<float>(i) + third) / kSide,
                   (static_cast<float>(j / 2) + third) / kSide);
      const SurfaceInteraction hit = accel_.surface_point(instance_, primitive, b);
      // From all around and at every slant, by the cosine.
      const vec2 u((static_cast<float>(k) + 0.5f) / (kSide * kSide),
                   glm::fract(0.618034f * static_cast<float>(k)));
      for (const float side : {1.0f, -1.0f}) {
        const Frame frame(side * hit.ng);
        surfaces_.shade(hit, frame.to_world(square_to_cosine_hemisphere(u)), shading,
                        usual_path(k % kUsualPaths, 1.0f));
        sum += shading.emission;
      }
    }
  }
  return sum / (2.0f * kSide * kSide);
}

Rgb MeshLight::varying_radiance(const Triangle& triangle, vec2 barycentric, vec3 view,
                                const PathSoFar& path) const {
  ShadingResult shading;
  surfaces_.shade(accel_.surface_point(instance_, triangle.primitive, barycentric), view, shading,
                  path);
  return shading.emission;
}

void MeshLight::shine_on(const PathSoFar& path, uint32_t primitive,
                         IlluminationSample& sample) const {
  const Triangle& triangle = this->triangle(primitive);
  if (triangle.by_path) {
    sample.radiance = varying_radiance(triangle, sample.barycentric, -sample.wi, path);
  }
}

std::vector<Emitter> MeshLight::emitters() const {
  std::vector<Emitter> result(slot_.size());
  for (const Triangle& triangle : triangles_) {
    Emitter& e = result[triangle.primitive];
    e.strength = luminance(triangle.radiance) / triangle.pdf_area;
    for (const vec2 b : {vec2(0, 0), vec2(1, 0), vec2(0, 1)}) {
      e.bounds.extend(accel_.position(instance_, triangle.primitive, b));
    }
    e.axis = triangle.ng;
    e.theta_o = 0.0f;
    e.two_sided = true;
  }
  return result;
}

std::optional<EmissionSample> MeshLight::sample_emission(vec2 u_position, vec2 u_direction) const {
  std::optional<EmissionSample> sample;
  if (by_power_.empty()) {
    return sample;
  }
  const bool front = u_direction.x < 0.5f;
  u_direction.x =
      std::min(front ? 2.0f * u_direction.x : 2.0f * u_direction.x - 1.0f, 0x1.fffffep-1f);
  const Triangle& triangle = triangles_[by_power_.sample(u_position.x, &u_position.x)];
  const vec2 b = square_to_triangle(u_position);
  const vec3 p = accel_.position(instance_, triangle.primitive, b);
  const vec3 n = front ? triangle.ng : -triangle.ng;
  const vec3 direction = Frame(n).to_world(square_to_cosine_hemisphere(u_direction));
  sample.emplace();
  sample->origin = offset_origin(p, triangle.ng, triangle.offset, direction);
  sample->direction = direction;
  sample->weight = radiance(triangle, b, direction) / triangle.density.value;
  sample->density = triangle.density;
  sample->normal = n;
  sample->pdf_area = triangle.pdf_area;
  sample->primitive = triangle.primitive;
  return sample;
}

std::optional<IlluminationSample> MeshLight::sample_illumination(vec3 receiver, uint32_t primitive,
                                                                 vec2 u) const {
  std::optional<IlluminationSample> sample;
  const Triangle& triangle = this->triangle(primitive);
  const vec2 b = square_to_triangle(u);
  const vec3 p = accel_.position(instance_, primitive, b);
  const vec3 target = offset_origin(p, triangle.ng, triangle.offset, receiver - p);
  const vec3 d = target - receiver;
  const float d2 = length2(d);
  if (d2 == 0.0f) {
    return sample;
  }
  const vec3 wi = d / std::sqrt(d2);
  const float cos_light = std::abs(dot(wi, triangle.ng));
  if (cos_light == 0.0f) {
    return sample;
  }
  sample.emplace();
  sample->wi = wi;
  sample->target = target;
  sample->distance2 = d2;
  sample->radiance = triangle.by_path ? Rgb(0.0f) : radiance(triangle, b, -wi);
  sample->barycentric = b;
  sample->pdf_solid = triangle.pdf_area * d2 / cos_light;
  sample->emission = triangle.density;
  return sample;
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
  const float d2 = length2(hit.p - origin);
  const float cos_light = std::abs(dot(direction, hit.ng));
  LightHit found{std::sqrt(d2), radiance, 0.0f, {}, d2, hit.primitive};
  if (slot_[hit.primitive] != kDark && cos_light > 0.0f) {
    const Triangle& triangle = this->triangle(hit.primitive);
    found.pdf_illumination = triangle.pdf_area * d2 / cos_light;
    found.emission = triangle.density;
  }
  return found;
}

}  // namespace janus
