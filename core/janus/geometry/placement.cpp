// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far a ray must start off the surface: far enough that no rounding puts the triangle in front
// of it, and no farther, so that a floor of a kilometre still shows the contact shadow of a
// millimetre. The bounds are those of forward error analysis (Higham 2002, 3.1; Pharr et al.,
// Physically Based Rendering, 6.8), taken per axis and then along the normal: a plane that follows
// the axes has hardly any error, however large it is.
#include "janus/geometry/placement.h"

#include <algorithm>

namespace janus {

namespace {

// Twice the unit roundoff. A proof would ask for the length of the longest chain of operations
// (about five); roundings hardly ever add up, and the tests find no hit with half of this.
constexpr float kGamma = 0x1p-23f;

mat3 absolute(const mat3& m) { return mat3(glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])); }

// The products in the cofactors and in the determinant with all signs lost: what bounds the
// rounding of an inverse by cofactors.
struct UnsignedInverse {
  mat3 cofactors;
  float determinant;
};

UnsignedInverse unsigned_inverse(const mat3& m) {
  const mat3 a = absolute(m);
  const auto cross = [](vec3 x, vec3 y) {
    return vec3(x.y * y.z + x.z * y.y, x.z * y.x + x.x * y.z, x.x * y.y + x.y * y.x);
  };
  const mat3 rows(cross(a[1], a[2]), cross(a[2], a[0]), cross(a[0], a[1]));
  return {glm::transpose(rows), dot(a[0], rows[0])};
}

}  // namespace

Placement::Placement(const Shape& shape, const Instance& instance)
    : linear_(instance.to_world),
      translation_(instance.to_world[3]),
      normal_(instance.normal_to_world),
      round_(shape.round()),
      instance_(&instance) {
  if (const Mesh* mesh = shape.mesh()) {
    triangles_ = mesh->triangles().data();
    positions_ = mesh->positions().data();
    normals_ = mesh->smooth() ? mesh->normals().data() : nullptr;
  }
  bound_rounding();
}

void Placement::bound_rounding() {
  // A ray that leaves the world point M p + t goes back to object space by the inverse W of M.
  const float determinant = std::abs(glm::determinant(linear_));
  const UnsignedInverse error = unsigned_inverse(linear_);
  forward_ = absolute(linear_);
  const mat3 inverse = absolute(glm::inverse(linear_));
  back_ = (inverse + error.cofactors / determinant) * forward_;
  back_translation_ = 2.0f * (inverse * glm::abs(translation_));
  determinant_error_ = error.determinant / determinant;
}

void Placement::surface_point(uint32_t primitive, vec2 b, SurfaceInteraction& hit) const {
  const Mesh::Triangle& triangle = triangles_[primitive];
  const vec3 v0 = positions_[triangle.v[0]];
  const vec3 v1 = positions_[triangle.v[1]];
  const vec3 v2 = positions_[triangle.v[2]];
  const float b0 = 1.0f - b.x - b.y;

  hit.primitive = primitive;
  hit.barycentric = b;
  hit.material = instance_->material(triangle.material);
  hit.p = position(primitive, b);
  const vec3 object_normal = cross(v1 - v0, v2 - v0);
  const vec3 world_normal = normal_ * object_normal;
  const float length = glm::length(world_normal);
  hit.ng = world_normal / length;
  hit.ns = hit.ng;
  if (normals_) {
    const vec3 n = b0 * normals_[triangle.normal[0]] + b.x * normals_[triangle.normal[1]] +
                   b.y * normals_[triangle.normal[2]];
    const vec3 ns = normal_ * n;
    const float ns_length = glm::length(ns);
    // Flat faces of a smooth mesh carry the face normal in every corner; take Ng itself there.
    if (ns_length > 0.0f && std::isfinite(ns_length)) {
      const vec3 unit = ns / ns_length;
      hit.ns = dot(unit, hit.ng) > 1.0f - 1e-7f ? hit.ng : unit;
    }
  }

  const vec3 largest = glm::max(glm::max(glm::abs(v0), glm::abs(v1)), glm::abs(v2));
  const float to_world = dot(glm::abs(hit.ng), forward_ * largest + glm::abs(translation_));
  // In object space, back from the world: first the ray's origin, then the triangle test on
  // vertices relative to it, that is the distance N . (v0 - o) with its own rounding and that of N.
  const vec3 n = glm::abs(object_normal);
  const vec3 extent = glm::max(glm::max(v0, v1), v2) - glm::min(glm::min(v0, v1), v2);
  // The plane of a sliver is known badly; still no ray starts farther off it than it is wide.
  const float tilt = std::min(6.0f * kGamma * (extent.x * extent.y * extent.z),
                              sqr(max_component(n)) / max_component(extent));
  // A plane through the origin along the axes has no error at all, but a ray that starts on a
  // triangle meets it: the last term keeps off it.
  const float object = dot(n, back_ * largest + back_translation_ + extent) +
                       determinant_error_ * std::abs(dot(object_normal, v0)) +
                       0x1p-13f * max_component(n) * max_component(extent);
  hit.offset = kGamma * (to_world + object / length) + tilt / length;
}

void Placement::round_point(uint32_t primitive, float u, vec3 object_normal, vec3 near,
                            SurfaceInteraction& hit) const {
  const RoundShape::Place place = round_->place(primitive, u);
  vec3 normal = normalize(object_normal), outward = normal;
  vec3 p = place.center;
  const float along2 = length2(place.along);
  if (along2 > 0.0f && round_->kind() == RoundShape::Kind::Smooth) {
    // Where a tube grows thinner its normal leans along it, but the point is straight beside `u`.
    // (A straight one is what a ball sweeps.) Smooth ones are met by iteration, which leaves the
    // normal less exact than the ray: at grazing angles that would be seen in densities.
    const vec3 off = glm::inverse(linear_) * (near - linear_ * place.center - translation_);
    const vec3 across = off - (dot(off, place.along) / along2) * place.along;
    const vec3 along = place.along / std::sqrt(along2);
    const float lean = dot(normal, along);
    if (length2(across) > 0.0f) {
      outward = normalize(across);
      normal = std::sqrt(std::max(0.0f, 1.0f - lean * lean)) * outward + lean * along;
    }
  }
  if (round_->kind() == RoundShape::Kind::Smooth && along2 == 0.0f) {  // a disk
    const vec3 off = glm::inverse(linear_) * (near - linear_ * place.center - translation_);
    p += off - dot(off, normal) * normal;
  } else {
    p += place.radius * outward;
  }
  hit.primitive = primitive;
  hit.barycentric = vec2(u, 0.0f);
  hit.material = instance_->material(round_->material(primitive));
  hit.p = linear_ * p + translation_;
  hit.ng = normalize(normal_ * normal);
  hit.ns = normalize(normal_ * outward);
  // Outward no ray meets the surface again, whatever the rounding, as it is not seen from within;
  // inward this is far enough, and much less than the thickness.
  constexpr float kShare = 1e-4f, kRoundings = 4.0f;
  const float coordinates =
      dot(glm::abs(hit.ng),
          forward_ * (glm::abs(place.center) + place.radius) + glm::abs(translation_));
  hit.offset =
      kRoundings * kGamma * coordinates + kShare * place.radius * glm::length(linear_ * outward);
}

}  // namespace janus
