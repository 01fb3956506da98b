// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/shading_point.h"

#include <cmath>

#include "janus/scene/panorama.h"

namespace janus {

namespace {

vec4 element(const AttributeDesc& attribute, uint32_t index) {
  vec4 value(0.0f, 0.0f, 0.0f, 1.0f);
  const float* first = attribute.values.data() + size_t{index} * attribute.channels;
  for (int i = 0; i < attribute.channels; ++i) {
    value[i] = first[i];
  }
  if (attribute.channels == 1) {
    value.y = value.z = value.x;
  }
  return value;
}

}  // namespace

vec3 CameraView::window(vec3 p, bool direction) const {
  const vec3 at = direction ? mat3(from_world) * p : vec3(from_world * vec4(p, 1.0f));
  vec2 place(at);
  if (type == CameraType::Perspective) {
    place = at.z != 0.0f ? place / at.z : vec2(0.0f);
  } else if (is_panorama(type)) {
    const bool ball = type == CameraType::MirrorBall;  // with axes of its own: see view_of()
    const dvec3 d = ball ? dvec3(at.x, at.z, at.y) : dvec3(-at.y, at.z, -at.x);
    place = vec2(window_place(type, fisheye, d));
  }
  return {(place.x - left) / (right - left), (place.y - bottom) / (top - bottom), 0.0f};
}

vec3 ShadingPoint::step(int axis) const {
  const vec3 a = ng.x != ng.y || ng.x != ng.z ? vec3(ng.z - ng.y, ng.x - ng.z, ng.y - ng.x)
                                              : vec3(ng.z - ng.y, ng.x + ng.z, -ng.y - ng.x);
  const vec3 tangent = normalize(a);
  return footprint * (axis == 0 ? tangent : cross(facing(ng), tangent));
}

ShadingPoint ShadingPoint::shifted(int axis, float width) const {
  ShadingPoint result = *this;
  const vec3 d = width * step(axis);
  result.p += facing(d);  // from behind, Cycles' attributes go the other way than its positions
  // The barycentric coordinates of d: least squares in the basis of the edges.
  const float uu = dot(edge_u, edge_u), uv = dot(edge_u, edge_v), vv = dot(edge_v, edge_v);
  const float det = uu * vv - uv * uv;
  if (det != 0.0f) {
    const float du = dot(d, edge_u), dv = dot(d, edge_v);
    result.barycentric += vec2(vv * du - uv * dv, uu * dv - uv * du) / det;
  }
  const vec2 b = result.barycentric;
  result.object_normal =
      (1.0f - b.x - b.y) * corner_normals[0] + b.x * corner_normals[1] + b.y * corner_normals[2];
  result.moved = true;
  return result;
}

vec4 ShadingPoint::attribute(uint32_t slot) const {
  const AttributeDesc* found = attributes ? attributes[slot] : nullptr;
  if (!found) {
    return vec4(0.0f, 0.0f, 0.0f, 1.0f);
  }
  if (found->domain == AttributeDomain::Mesh) {
    return element(*found, 0);
  }
  if (found->domain == AttributeDomain::Face) {
    return element(*found, triangle.face);
  }
  const uint32_t* at =
      found->domain == AttributeDomain::Point ? triangle.vertices : triangle.corners;
  const float u = barycentric.x, v = barycentric.y;
  return (1.0f - u - v) * element(*found, at[0]) + u * element(*found, at[1]) +
         v * element(*found, at[2]);
}

float ShadingPoint::attribute_factor(uint32_t slot) const {
  const vec4 value = attribute(slot);
  const bool pair = attributes && attributes[slot] && attributes[slot]->channels == 2;
  return pair ? value.x : average(vec3(value));
}

}  // namespace janus
