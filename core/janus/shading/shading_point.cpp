// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/shading_point.h"

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

vec3 ShadingPoint::step(int axis) const {
  const vec3 a = ng.x != ng.y || ng.x != ng.z ? vec3(ng.z - ng.y, ng.x - ng.z, ng.y - ng.x)
                                              : vec3(ng.z - ng.y, ng.x + ng.z, -ng.y - ng.x);
  const vec3 tangent = normalize(a);
  return footprint * (axis == 0 ? tangent : cross(facing(ng), tangent));
}

ShadingPoint ShadingPoint::shifted(int axis) const {
  ShadingPoint result = *this;
  const vec3 d = step(axis);
  result.p += d;
  // The barycentric coordinates of d: least squares in the basis of the edges.
  const float uu = dot(edge_u, edge_u), uv = dot(edge_u, edge_v), vv = dot(edge_v, edge_v);
  const float det = uu * vv - uv * uv;
  if (det != 0.0f) {
    const float du = dot(d, edge_u), dv = dot(d, edge_v);
    result.barycentric += vec2(vv * du - uv * dv, uu * dv - uv * du) / det;
  }
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

}  // namespace janus
