// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/render/scene.h"

#include "janus/scene/panorama.h"

namespace janus {

// The camera looks along +z in Cycles; panoramas look along +x, with +z up; the mirror ball along
// -y, with +z up and +x to the right.
CameraView view_of(const CameraDesc& camera) {
  mat4 turn(1.0f);
  turn[2][2] = -1.0f;
  if (camera.type == CameraType::MirrorBall) {
    turn = mat4(0.0f);
    turn[0][0] = turn[1][2] = turn[2][1] = turn[3][3] = 1.0f;
  } else if (is_panorama(camera.type)) {
    turn = mat4(0.0f);
    turn[0][1] = turn[2][0] = -1.0f;
    turn[1][2] = turn[3][3] = 1.0f;
  }
  const mat4 from_world = turn * glm::inverse(camera.transform);
  const vec2 shift = camera.shift * vec2(camera.right - camera.left, camera.top - camera.bottom);
  return {camera.type,
          from_world,
          glm::inverse(from_world),
          camera.left - shift.x,
          camera.right - shift.x,
          camera.bottom - shift.y,
          camera.top - shift.y,
          camera.fisheye};
}

void Scene::place_objects() {
  const float pixel =
      pixel_scale(camera.type, camera.fisheye) *
      (camera.pixel_size > 0.0f ? camera.pixel_size : 1e-3f * (camera.top - camera.bottom));
  const bool parallel = camera.type == CameraType::Orthographic;
  surfaces.set_objects(
      shapes, instances, view_of(camera),
      {vec3(camera.transform[3]), parallel ? 0.0f : pixel, parallel ? pixel : 0.0f});
}

Rgb Scene::transmittance_through(vec3 a, vec3 b, RayType type, int max_crossings,
                                 End camera) const {
  if (accel->occluded_opaque(a, b, type)) {
    return Rgb(0.0f);
  }
  const float length = glm::length(b - a);
  const vec3 d = (b - a) / length;
  // What `b` lies on is no crossing: the ray ends before it, as in Accel::occluded().
  const float rest = (1.0f - Accel::kShadowReach) * length;
  Rgb result(1.0f);
  Ray ray{a, d, length - rest};
  SurfaceInteraction hit;
  for (int crossings = 0;; ++crossings) {
    if (!accel->intersect_transparent(ray, type, hit)) {
      return result;
    }
    const ShadingResult shading = shade(hit, camera == End::A ? -d : d);
    result *= shading.transparency;
    if (is_black(result) || crossings >= max_crossings || shading.bsdf.by_path()) {
      return Rgb(0.0f);
    }
    ray.origin = offset_origin(hit.p, hit.ng, hit.offset, d);
    ray.t_max = dot(b - ray.origin, d) - rest;
    if (!(ray.t_max > 0.0f)) {
      return result;
    }
  }
}

Scene::Passed Scene::pass(vec3 camera, vec3 light, RayType type, int max_crossings,
                          const PathSoFar& path) const {
  Passed passed;
  if (accel->occluded_opaque(camera, light, type)) {
    passed.through = Rgb(0.0f);
    return passed;
  }
  const float length = glm::length(light - camera);
  const vec3 d = (light - camera) / length;
  const float rest = (1.0f - Accel::kShadowReach) * length;
  Ray ray{camera, d, length - rest};
  SurfaceInteraction hit;
  while (ray.t_max > 0.0f && accel->intersect_transparent(ray, type, hit)) {
    const float t = glm::length(hit.p - camera);
    const ShadingResult shading = shade(hit, -d, path.after(passed.crossings, t));
    passed.through *= shading.transparency;
    passed.by_path = passed.by_path || shading.bsdf.by_path();
    if (is_black(passed.through) || passed.crossings >= max_crossings) {
      passed.through = Rgb(0.0f);
      return passed;
    }
    ++passed.crossings;
    ray.origin = offset_origin(hit.p, hit.ng, hit.offset, d);
    ray.t_max = dot(light - ray.origin, d) - rest;
  }
  return passed;
}

std::optional<vec3> Scene::find_passed_catcher(vec3 a, vec3 b) const {
  const float length = glm::length(b - a);
  const vec3 d = (b - a) / length;
  const float rest = (1.0f - Accel::kShadowReach) * length;
  Ray ray{a, d, length - rest};
  SurfaceInteraction hit;
  while (ray.t_max > 0.0f && accel->intersect_transparent(ray, RayType::Camera, hit)) {
    if (instances[hit.instance].catcher) {
      return offset_origin(hit.p, hit.ng, hit.offset, -d);
    }
    ray.origin = offset_origin(hit.p, hit.ng, hit.offset, d);
    ray.t_max = dot(b - ray.origin, d) - rest;
  }
  return std::nullopt;
}

}  // namespace janus
