// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/camera/types.h"

namespace janus {

namespace {

// A thin lens, or a pinhole. All rays of a film position meet on the plane of focus.
class PerspectiveCamera final : public Camera {
 public:
  PerspectiveCamera(const CameraDesc& desc, int width, int height)
      : pose_(desc),
        window_(desc, width, height),
        aperture_(desc),
        focus_(std::max(desc.focus_distance, kMinFocus)),
        near_(desc.clip_start),
        far_(desc.clip_end) {}

  CameraRay sample_ray(vec2 raster, vec2 u_lens) const override {
    const vec3 chief(window_.from_raster(raster), -1.0f);
    const float chief_length = glm::length(chief);
    vec3 lens(0.0f), local = chief / chief_length;
    if (!aperture_.pinhole()) {
      lens = vec3(aperture_.sample(u_lens), 0.0f);
      local = normalize(focus_ * chief - lens);
    }
    const vec3 direction = pose_.rotation * local;
    const vec3 world_lens = pose_.to_world(lens);
    // Clipping planes are perpendicular to the view axis for the chief ray, the one through the
    // centre of the lens; other rays are as long, as in Cycles.
    return {Ray{world_lens + near_ * chief_length * direction, direction,
                (far_ - near_) * chief_length},
            world_lens,
            {pdf_solid(-local.z), true}};
  }

  std::optional<CameraConnection> connect(vec3 p, vec2 u_lens, float margin) const override {
    std::optional<CameraConnection> to_camera;
    const vec3 local = pose_.to_local(p);
    const float depth = -local.z;
    if (!(depth > 0.0f)) {
      return to_camera;
    }
    vec2 lens(0.0f), chief = vec2(local) / depth;
    if (!aperture_.pinhole()) {
      lens = aperture_.sample(u_lens);
      chief = lens / focus_ + (vec2(local) - lens) / depth;
    }
    const vec2 raster = window_.to_raster(chief);
    if (!window_.contains(raster, margin)) {
      return to_camera;
    }
    const float chief_length = std::sqrt(1.0f + dot(chief, chief));
    const vec3 world_lens = pose_.to_world(vec3(lens, 0.0f));
    const vec3 to_lens = world_lens - p;
    const float d2 = length2(to_lens);
    const float distance = std::sqrt(d2);
    if (!(distance > near_ * chief_length && distance < far_ * chief_length)) {
      return to_camera;
    }
    const vec3 wo = to_lens / distance;
    to_camera.emplace();
    to_camera->raster = raster;
    to_camera->wo = wo;
    to_camera->target = world_lens - near_ * chief_length * wo;
    to_camera->distance2 = d2;
    to_camera->density = {pdf_solid(depth / distance), true};
    return to_camera;
  }

  bool hittable() const override { return !aperture_.pinhole(); }

  // W_e is what sample_ray() draws: a lens point by its area, a film position by solid angle.
  std::optional<LensHit> hit_lens(const Ray& ray, float t_begin, float t_end,
                                  float margin) const override {
    const vec3 origin = pose_.to_local(ray.origin);
    const vec3 d = glm::transpose(pose_.rotation) * ray.direction;
    if (!(d.z > 0.0f) || aperture_.pinhole()) {  // lit from behind, it sees nothing
      return std::nullopt;
    }
    const float t = -origin.z / d.z;
    if (!(t > t_begin && t < t_end)) {
      return std::nullopt;
    }
    const vec2 lens = vec2(origin) + t * vec2(d);
    const vec2 chief = lens / focus_ - vec2(d) / d.z;
    const float chief_length = std::sqrt(1.0f + dot(chief, chief));
    const vec2 raster = window_.to_raster(chief);
    if (!aperture_.contains(lens) || !window_.contains(raster, margin) ||
        !(t > near_ * chief_length && t < far_ * chief_length)) {
      return std::nullopt;
    }
    return LensHit{raster, pdf_solid(d.z) / (aperture_.area() * d.z),
                   ray.origin + t * ray.direction};
  }

 private:
  // One film position per pixel: on the plane of focus (as on any), a pixel has the area of its
  // window times the squared distance of the plane; seen from the lens point under cos^3.
  float pdf_solid(float cos_axis) const {
    return 1.0f / (window_.pixel_area() * cos_axis * cos_axis * cos_axis);
  }

  Pose pose_;
  Window window_;
  Aperture aperture_;
  float focus_, near_, far_;
};

}  // namespace

std::unique_ptr<Camera> make_perspective(const CameraDesc& desc, int width, int height) {
  return std::make_unique<PerspectiveCamera>(desc, width, height);
}

}  // namespace janus
