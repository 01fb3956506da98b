// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/geometry/accel.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <cstdlib>

#include "janus/util/error.h"

namespace janus {

namespace {

// Embree reports errors to a callback; the first one is kept and thrown when the build ends.
struct BuildState {
  const CancelToken* cancel = nullptr;
  std::string error;
};

void on_error(void* user, RTCError code, const char* message) {
  auto* state = static_cast<BuildState*>(user);
  if (code != RTC_ERROR_CANCELLED && state->error.empty()) {
    state->error = message ? message : "unknown error";
  }
}

bool on_progress(void* user, double /*fraction*/) {
  return !static_cast<BuildState*>(user)->cancel->cancelled();
}

RTCRayHit to_embree(const Ray& ray) {
  RTCRayHit query{};
  query.ray.org_x = ray.origin.x;
  query.ray.org_y = ray.origin.y;
  query.ray.org_z = ray.origin.z;
  query.ray.dir_x = ray.direction.x;
  query.ray.dir_y = ray.direction.y;
  query.ray.dir_z = ray.direction.z;
  query.ray.tnear = 0.0f;
  query.ray.tfar = ray.t_max;
  query.ray.mask = ~0U;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

}  // namespace

struct Accel::Impl {
  RTCDevice device = nullptr;
  RTCScene top = nullptr;
  std::vector<RTCScene> bottom;  // by mesh; null where no instance needs it
  BuildState state;

  ~Impl() {
    if (top) {
      rtcReleaseScene(top);
    }
    for (RTCScene scene : bottom) {
      if (scene) {
        rtcReleaseScene(scene);
      }
    }
    if (device) {
      rtcReleaseDevice(device);
    }
  }

  void commit(RTCScene scene) {
    rtcSetSceneProgressMonitorFunction(scene, on_progress, &state);
    rtcCommitScene(scene);
    rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
    state.cancel->throw_if_cancelled();
    if (!state.error.empty()) {
      throw Error("building the ray acceleration structure failed: " + state.error);
    }
  }
};

Accel::Accel(const std::vector<Mesh>& meshes, const std::vector<Instance>& instances,
             const CancelToken& cancel)
    : impl_(std::make_unique<Impl>()), meshes_(meshes), instances_(instances) {
  impl_->state.cancel = &cancel;
  // Lets a thread sanitizer run keep Embree's own threads out of the picture.
  impl_->device = rtcNewDevice(std::getenv("JANUS_EMBREE_CONFIG"));
  if (!impl_->device) {
    throw Error("Embree could not be started (error " +
                std::to_string(static_cast<int>(rtcGetDeviceError(nullptr))) + ")");
  }
  rtcSetDeviceErrorFunction(impl_->device, on_error, &impl_->state);

  impl_->bottom.resize(meshes.size(), nullptr);
  impl_->top = rtcNewScene(impl_->device);
  rtcSetSceneFlags(impl_->top, RTC_SCENE_FLAG_ROBUST);
  for (size_t i = 0; i < instances.size(); ++i) {
    const Instance& instance = instances[i];
    const Mesh& mesh = meshes[instance.mesh];
    if (mesh.triangles().empty()) {
      continue;
    }
    RTCScene& bottom = impl_->bottom[instance.mesh];
    if (!bottom) {
      bottom = rtcNewScene(impl_->device);
      rtcSetSceneFlags(bottom, RTC_SCENE_FLAG_ROBUST);
      RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
      rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                 mesh.positions().data(), 0, sizeof(vec3),
                                 mesh.positions().size() - 1);
      rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                 mesh.triangles().data(), 0, sizeof(Mesh::Triangle),
                                 mesh.triangles().size());
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(bottom, geometry);
      rtcReleaseGeometry(geometry);
      impl_->commit(bottom);
    }
    RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, bottom);
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &instance.to_world);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(impl_->top, geometry, static_cast<unsigned>(i));
    rtcReleaseGeometry(geometry);
    if (i % 1024 == 0) {
      cancel.throw_if_cancelled();
    }
  }
  impl_->commit(impl_->top);

  RTCBounds b;
  rtcGetSceneBounds(impl_->top, &b);
  if (b.lower_x <= b.upper_x) {
    bounds_.extend(vec3(b.lower_x, b.lower_y, b.lower_z));
    bounds_.extend(vec3(b.upper_x, b.upper_y, b.upper_z));
  }
}

Accel::~Accel() = default;

std::optional<SurfaceInteraction> Accel::intersect(const Ray& ray) const {
  RTCRayHit query = to_embree(ray);
#if RTC_VERSION_MAJOR >= 4
  rtcIntersect1(impl_->top, &query, nullptr);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(impl_->top, &context, &query);
#endif
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
    return std::nullopt;
  }
  return surface_point(query.hit.instID[0], query.hit.primID, vec2(query.hit.u, query.hit.v));
}

bool Accel::occluded(vec3 a, vec3 b) const {
  const vec3 d = b - a;
  RTCRay query = to_embree(Ray{a, d, 1.0f}).ray;
#if RTC_VERSION_MAJOR >= 4
  rtcOccluded1(impl_->top, &query, nullptr);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(impl_->top, &context, &query);
#endif
  return query.tfar < 0.0f;
}

SurfaceInteraction Accel::surface_point(uint32_t instance_index, uint32_t primitive, vec2 b) const {
  const Instance& instance = instances_[instance_index];
  const Mesh& mesh = meshes_[instance.mesh];
  const Mesh::Triangle& triangle = mesh.triangles()[primitive];
  const mat3 linear(instance.to_world);
  const vec3 translation(instance.to_world[3]);
  const vec3 v0 = mesh.positions()[triangle.v[0]];
  const vec3 v1 = mesh.positions()[triangle.v[1]];
  const vec3 v2 = mesh.positions()[triangle.v[2]];
  const float b0 = 1.0f - b.x - b.y;

  SurfaceInteraction hit;
  hit.instance = instance_index;
  hit.primitive = primitive;
  hit.material = instance.material(triangle.material);
  // From the barycentric coordinates, not along the ray: the error does not grow with distance.
  hit.p = linear * (b0 * v0 + b.x * v1 + b.y * v2) + translation;
  hit.ng = normalize(instance.normal_to_world * cross(v1 - v0, v2 - v0));
  hit.ns = hit.ng;
  if (mesh.smooth()) {
    const vec3 n = b0 * mesh.normal(triangle.corner[0]) + b.x * mesh.normal(triangle.corner[1]) +
                   b.y * mesh.normal(triangle.corner[2]);
    const vec3 ns = instance.normal_to_world * n;
    const float length = glm::length(ns);
    // Flat faces of a smooth mesh carry the face normal in every corner; take Ng itself there.
    if (length > 0.0f && std::isfinite(length)) {
      const vec3 unit = ns / length;
      hit.ns = dot(unit, hit.ng) > 1.0f - 1e-7f ? hit.ng : unit;
    }
  }
  // Bounds the rounding of the point, of the transform and of Embree's edge tests, all of which
  // scale with the coordinates of the whole triangle rather than of the point.
  const vec3 w0 = linear * v0, w1 = linear * v1, w2 = linear * v2;
  const vec3 extent = glm::max(glm::max(glm::abs(w0), glm::abs(w1)), glm::abs(w2));
  hit.offset = 0x1p-21f * max_component(glm::max(extent, glm::abs(translation)));
  return hit;
}

std::string Accel::embree_version() { return RTC_VERSION_STRING; }

}  // namespace janus
