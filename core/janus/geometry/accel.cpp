// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/geometry/accel.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <memory>

#include "janus/geometry/embree_device.h"
#include "janus/geometry/mesh.h"
#include "janus/geometry/reach.h"
#include "janus/geometry/round_shape.h"

namespace janus {

namespace {

// Refuses hits of what is round from within.
void refuse_inside(const RTCFilterFunctionNArguments* args) {
  for (unsigned i = 0; i < args->N; ++i) {
    const float facing =
        RTCRayN_dir_x(args->ray, args->N, i) * RTCHitN_Ng_x(args->hit, args->N, i) +
        RTCRayN_dir_y(args->ray, args->N, i) * RTCHitN_Ng_y(args->hit, args->N, i) +
        RTCRayN_dir_z(args->ray, args->N, i) * RTCHitN_Ng_z(args->hit, args->N, i);
    if (args->valid[i] != 0 && facing > 0.0f) {
      args->valid[i] = 0;
    }
  }
}

// The hierarchy of a shape, which it keeps: its buffers are the shape's.
class ShapeAccel {
 public:
  ShapeAccel(std::shared_ptr<Device> device, std::shared_ptr<const Shape> shape,
             const CancelToken& cancel)
      : device_(std::move(device)), shape_(std::move(shape)), scene_(device_->new_scene()) {
    if (const Mesh* mesh = shape_->mesh()) {
      attach(geometry_of(*mesh));
    } else {
      attach(geometry_of(*shape_->round()));
      if (!shape_->round()->disks().empty()) {
        attach(disks_of(*shape_->round()));
      }
    }
    try {
      device_->commit(scene_, cancel);
    } catch (...) {
      rtcReleaseScene(scene_);
      throw;
    }
  }
  ~ShapeAccel() { rtcReleaseScene(scene_); }
  ShapeAccel(const ShapeAccel&) = delete;
  ShapeAccel& operator=(const ShapeAccel&) = delete;

  RTCScene scene() const { return scene_; }

 private:
  void attach(RTCGeometry geometry) {
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
  }

  RTCGeometry geometry_of(const Mesh& mesh) const {
    RTCGeometry geometry = rtcNewGeometry(device_->handle(), RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               mesh.positions().data(), 0, sizeof(vec3),
                               mesh.positions().size() - 1);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               mesh.triangles().data(), 0, sizeof(Mesh::Triangle),
                               mesh.triangles().size());
    return geometry;
  }

  RTCGeometry geometry_of(const RoundShape& shape) const {
    using Kind = RoundShape::Kind;
    const RTCGeometryType type =
        shape.kind() == Kind::Smooth     ? RTC_GEOMETRY_TYPE_ROUND_CATMULL_ROM_CURVE
        : shape.kind() == Kind::Straight ? RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE
                                         : RTC_GEOMETRY_TYPE_SPHERE_POINT;
    RTCGeometry geometry = rtcNewGeometry(device_->handle(), type);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
                               shape.controls().data(), 0, sizeof(vec4), shape.controls().size());
    if (shape.curves()) {
      rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT,
                                 &shape.pieces().data()->control, 0, sizeof(RoundShape::Piece),
                                 shape.pieces().size());
    }
    see_from_outside(geometry);
    return geometry;
  }

  RTCGeometry disks_of(const RoundShape& shape) const {
    RTCGeometry geometry = rtcNewGeometry(device_->handle(), RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
                               shape.disk_places().data(), 0, sizeof(vec4), shape.disks().size());
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_NORMAL, 0, RTC_FORMAT_FLOAT3,
                               shape.disk_normals().data(), 0, sizeof(vec3), shape.disks().size());
    see_from_outside(geometry);
    return geometry;
  }

  static void see_from_outside(RTCGeometry geometry) {
    rtcSetGeometryIntersectFilterFunction(geometry, refuse_inside);
    rtcSetGeometryOccludedFilterFunction(geometry, refuse_inside);
  }

  std::shared_ptr<Device> device_;
  std::shared_ptr<const Shape> shape_;
  RTCScene scene_;
};

RTCRayHit to_embree(const Ray& ray) {
  RTCRayHit query{};
  query.ray.org_x = ray.origin.x;
  query.ray.org_y = ray.origin.y;
  query.ray.org_z = ray.origin.z;
  query.ray.dir_x = ray.direction.x;
  query.ray.dir_y = ray.direction.y;
  query.ray.dir_z = ray.direction.z;
  // Not 0: Embree counts a hit at tnear, and a ray may start exactly in the plane of its surface.
  query.ray.tnear = std::numeric_limits<float>::min();
  query.ray.tfar = ray.t_max;
  query.ray.mask = ~0U;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

// The instances that some type of ray meets. Top levels of their own rather than ray masks: Embree
// 3 is usually built without those, and a mask is tested late.
struct View {
  RTCScene all = nullptr;
  RTCScene opaque = nullptr, transparent = nullptr;  // by Instance::opaque; null if all are opaque
};

}  // namespace

struct Accel::Impl {
  std::shared_ptr<Device> device;
  View everything;
  std::array<View, kRayTypes> own;  // of a type that is the first to meet just these instances
  std::array<const View*, kRayTypes> view;                           // by type
  std::map<const Shape*, std::shared_ptr<const ShapeAccel>> bottom;  // of those that are needed
  std::vector<RTCScene> bottom_of;  // by Instance::shape; null: not needed
  float farthest = kFarthest;       // that rays may be, so that they are not beyond in an instance

  // Held for the end, as scenes need some memory to be released.
  std::unique_ptr<std::byte[]> reserve = std::make_unique_for_overwrite<std::byte[]>(kToEnd);

  ~Impl() {
    reserve.reset();
    for_each_scene([](RTCScene scene) { rtcReleaseScene(scene); });
  }

  // Calls f for the top levels that there are.
  template <class F>
  void for_each_scene(F&& f) {
    const auto parts = [&](const View& v) {
      for (RTCScene scene : {v.all, v.opaque, v.transparent}) {
        if (scene) {
          f(scene);
        }
      }
    };
    parts(everything);
    std::ranges::for_each(own, parts);
  }

  const View& of(RayType type) const { return *view[static_cast<int>(type)]; }

  static bool trace(RTCScene scene, RTCRayHit& query) {
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(scene, &query, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene, &context, &query);
#endif
    return query.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  }

  bool intersect(const std::vector<Placement>& placements, RTCScene scene, const Ray& ray,
                 SurfaceInteraction& hit) const {
    RTCRayHit query = to_embree(ray);
    if (!traceable(ray, farthest) || !trace(scene, query)) {
      return false;
    }
    hit.instance = query.hit.instID[0];
    const Placement& placement = placements[hit.instance];
    if (placement.round()) [[unlikely]] {
      placement.round_point(placement.round_primitive(query.hit.geomID, query.hit.primID),
                            query.hit.u, vec3(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z),
                            ray.origin + query.ray.tfar * ray.direction, hit);
    } else {
      placement.surface_point(query.hit.primID, vec2(query.hit.u, query.hit.v), hit);
    }
    return true;
  }

  bool occluded(RTCScene scene, vec3 a, vec3 b) const {
    const Ray ray{a, b - a, kShadowReach};
    if (!traceable(ray, farthest)) [[unlikely]] {
      return true;
    }
    RTCRay query = to_embree(ray).ray;
#if RTC_VERSION_MAJOR >= 4
    rtcOccluded1(scene, &query, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene, &context, &query);
#endif
    return query.tfar < 0.0f;
  }
};

Accel::Accel(const ShapeList& shapes, const std::vector<Instance>& instances,
             const CancelToken& cancel, const Accel* previous)
    : impl_(std::make_unique<Impl>()), instances_(instances) {
  impl_->device = previous ? previous->impl_->device : std::make_shared<Device>();
  const bool opaque = std::ranges::all_of(instances, [](const auto& i) { return i.opaque; });
  const auto start = [&](View& view) {
    view.all = impl_->device->new_scene();
    if (!opaque) {
      view.opaque = impl_->device->new_scene();
      view.transparent = impl_->device->new_scene();
    }
  };
  start(impl_->everything);
  // Empty, so that from here on this thread has what it takes to release one that fails.
  impl_->device->commit(impl_->everything.all, cancel);
  const auto first = first_alike(instances);
  for (int type = 0; type < kRayTypes; ++type) {
    impl_->view[type] = first[type] == kRayTypes ? &impl_->everything : &impl_->own[first[type]];
    if (first[type] == type) {
      start(impl_->own[type]);
    }
  }
  placements_.reserve(instances.size());
  impl_->bottom_of.resize(shapes.size(), nullptr);
  for (size_t i = 0; i < instances.size(); ++i) {
    const Instance& instance = instances[i];
    const std::shared_ptr<const Shape>& shape = shapes[instance.shape];
    placements_.emplace_back(*shape, instance);
    const float reach = reach_beside(instance.to_world);
    if (shape->primitives() == 0 || !(reach > 0.0f)) {
      continue;
    }
    impl_->farthest = std::min(impl_->farthest, reach);
    std::shared_ptr<const ShapeAccel>& bottom = impl_->bottom[shape.get()];
    if (!bottom && previous) {
      const auto known = previous->impl_->bottom.find(shape.get());
      bottom = known == previous->impl_->bottom.end() ? nullptr : known->second;
    }
    if (!bottom) {
      bottom = std::make_shared<ShapeAccel>(impl_->device, shape, cancel);
      ++built_;
    }
    impl_->bottom_of[instance.shape] = bottom->scene();
    RTCGeometry geometry = rtcNewGeometry(impl_->device->handle(), RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, bottom->scene());
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &instance.to_world);
    rtcCommitGeometry(geometry);
    const auto attach = [&](const View& view) {
      rtcAttachGeometryByID(view.all, geometry, static_cast<unsigned>(i));
      if (!opaque) {
        rtcAttachGeometryByID(instance.opaque ? view.opaque : view.transparent, geometry,
                              static_cast<unsigned>(i));
      }
    };
    attach(impl_->everything);
    for (int type = 0; type < kRayTypes; ++type) {
      if (first[type] == type && contains(instance.visibility, static_cast<RayType>(type))) {
        attach(impl_->own[type]);
      }
    }
    rtcReleaseGeometry(geometry);
    if (i % 1024 == 0) {
      cancel.throw_if_cancelled();
    }
  }
  impl_->for_each_scene([&](RTCScene scene) { impl_->device->commit(scene, cancel); });

  RTCBounds b;
  rtcGetSceneBounds(impl_->everything.all, &b);
  if (b.lower_x <= b.upper_x) {
    bounds_.extend(vec3(b.lower_x, b.lower_y, b.lower_z));
    bounds_.extend(vec3(b.upper_x, b.upper_y, b.upper_z));
  }
}

Accel::~Accel() = default;

bool Accel::intersect(const Ray& ray, RayType type, SurfaceInteraction& hit) const {
  return impl_->intersect(placements_, impl_->of(type).all, ray, hit);
}

bool Accel::intersect_any(const Ray& ray, SurfaceInteraction& hit) const {
  return impl_->intersect(placements_, impl_->everything.all, ray, hit);
}

bool Accel::alike(RayType a, RayType b) const { return &impl_->of(a) == &impl_->of(b); }

bool Accel::occluded(vec3 a, vec3 b, RayType type) const {
  return impl_->occluded(impl_->of(type).all, a, b);
}

bool Accel::occluded_opaque(vec3 a, vec3 b, RayType type) const {
  const View& view = impl_->of(type);
  return impl_->occluded(view.transparent ? view.opaque : view.all, a, b);
}

bool Accel::intersect_transparent(const Ray& ray, RayType type, SurfaceInteraction& hit) const {
  const View& view = impl_->of(type);
  return view.transparent && impl_->intersect(placements_, view.transparent, ray, hit);
}

SurfaceInteraction Accel::surface_point(uint32_t instance, uint32_t primitive, vec2 b) const {
  SurfaceInteraction point;
  placements_[instance].surface_point(primitive, b, point);
  point.instance = instance;
  return point;
}

Accel::InstanceRays::InstanceRays(const Accel& accel, uint32_t instance)
    : accel_(accel),
      instance_(instance),
      to_object_(glm::inverse(accel.instances_[instance].to_world)) {}

bool Accel::InstanceRays::intersect(const Ray& ray, SurfaceInteraction& hit) const {
  // Of a direction that is not unit, so that distances are those of the world.
  const Ray local{vec3(to_object_ * vec4(ray.origin, 1.0f)), mat3(to_object_) * ray.direction,
                  ray.t_max};
  RTCRayHit query = to_embree(local);
  const Placement& placement = accel_.placements_[instance_];
  const RTCScene scene = accel_.impl_->bottom_of[accel_.instances_[instance_].shape];
  if (!scene || placement.round() || !traceable(local, kFarthest) || !Impl::trace(scene, query)) {
    return false;
  }
  placement.surface_point(query.hit.primID, vec2(query.hit.u, query.hit.v), hit);
  hit.instance = instance_;
  return true;
}

size_t Accel::bytes() const { return impl_->device->bytes(); }

std::string Accel::embree_version() { return RTC_VERSION_STRING; }

}  // namespace janus
