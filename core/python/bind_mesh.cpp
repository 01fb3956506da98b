// SPDX-License-Identifier: GPL-3.0-or-later
#include "bind_arrays.h"
#include "janus/geometry/derived.h"
#include "janus/render/builder.h"

namespace janus::python {

namespace {

using namespace py::literals;

constexpr EnumName<AttributeDomain> kDomains[] = {{"MESH", AttributeDomain::Mesh},
                                                  {"POINT", AttributeDomain::Point},
                                                  {"CORNER", AttributeDomain::Corner},
                                                  {"FACE", AttributeDomain::Face}};

std::string to_text(Key key, const py::object& value) {
  if (!py::isinstance<py::str>(value)) {
    throw SceneError(key, "attributes", "key and domain must be strings");
  }
  return value.cast<std::string>();
}

// {"key", "domain", "values": float[N] or [N, C]}; or {"key"} alone, of what the core computes
AttributeDesc to_attribute(Key key, const py::handle& item) {
  const auto dict =
      py::isinstance<py::dict>(item) ? py::reinterpret_borrow<py::dict>(item) : py::dict();
  AttributeDesc attribute;
  if (dict.contains("key")) {
    attribute.key = to_text(key, dict["key"]);
    if (is_derived(attribute) && !dict.contains("values")) {
      return attribute;
    }
  }
  if (!dict.contains("key") || !dict.contains("domain") || !dict.contains("values")) {
    throw SceneError(key, "attributes", "each must have key, domain and values");
  }
  attribute.domain = from_name(kDomains, to_text(key, dict["domain"]), "domain");
  const py::array a = to_array(dict["values"]);
  const std::string path = "attributes[" + attribute.key + "]";
  const auto values = py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(a);
  if (!values || a.ndim() < 1 || a.ndim() > 2) {
    PyErr_Clear();
    throw SceneError(key, path, "must hold numbers, float[N] or float[N, C]");
  }
  attribute.channels = a.ndim() == 2 ? static_cast<int>(a.shape(1)) : 1;
  attribute.values.assign(values.data(), values.data() + values.size());
  return attribute;
}

void set_mesh(SceneBuilder& self, Key key, std::string name, const py::object& positions,
              const py::object& triangles, const py::object& corner_vertices,
              const py::object& vertex_normals, const py::object& corner_normals,
              const py::object& material_indices, const py::object& faces,
              const py::list& attributes, const py::object& edges) {
  MeshDesc desc;
  desc.name = std::move(name);
  desc.positions = to_vectors(key, "positions", to_array(positions));
  desc.triangles = to_indices<glm::uvec3>(key, "triangles", to_array(triangles), 3);
  if (const auto a = optional_array(corner_vertices)) {
    desc.corner_vertices = to_indices<uint32_t>(key, "corner_vertices", *a, 0);
  }
  if (const auto a = optional_array(vertex_normals)) {
    desc.vertex_normals = to_vectors(key, "vertex_normals", *a);
  }
  if (const auto a = optional_array(corner_normals)) {
    desc.corner_normals = to_vectors(key, "corner_normals", *a);
  }
  if (const auto a = optional_array(material_indices)) {
    desc.material_indices = to_indices<uint32_t>(key, "material_indices", *a, 0);
  }
  if (const auto a = optional_array(faces)) {
    desc.faces = to_indices<uint32_t>(key, "faces", *a, 0);
  }
  for (const py::handle item : attributes) {
    desc.attributes.push_back(to_attribute(key, item));
  }
  if (const auto a = optional_array(edges)) {
    desc.edges = to_indices<glm::uvec2>(key, "edges", *a, 2);
  }
  self.set_mesh(key, std::move(desc));
}

RoundDesc to_round(Key key, std::string name, const py::object& positions, const py::object& radii,
                   const py::object& material_indices, const py::list& attributes) {
  RoundDesc desc;
  desc.name = std::move(name);
  desc.positions = to_vectors(key, "positions", to_array(positions));
  desc.radii = to_numbers(key, "radii", to_array(radii));
  if (const auto a = optional_array(material_indices)) {
    desc.material_indices = to_indices<uint32_t>(key, "material_indices", *a, 0);
  }
  for (const py::handle item : attributes) {
    desc.attributes.push_back(to_attribute(key, item));
  }
  return desc;
}

void set_curves(SceneBuilder& self, Key key, std::string name, const py::object& positions,
                const py::object& radii, const py::object& curves, bool straight,
                const py::object& material_indices, const py::list& attributes) {
  RoundDesc desc = to_round(key, std::move(name), positions, radii, material_indices, attributes);
  desc.curves = to_indices<uint32_t>(key, "curves", to_array(curves), 0);
  if (desc.curves.empty()) {
    throw SceneError(key, "curves", "must rise from 0 to the number of positions");
  }
  desc.straight = straight;
  self.set_round(key, std::move(desc));
}

void set_points(SceneBuilder& self, Key key, std::string name, const py::object& positions,
                const py::object& radii, const py::list& attributes) {
  self.set_round(key, to_round(key, std::move(name), positions, radii, py::none(), attributes));
}

}  // namespace

void bind_mesh(py::class_<SceneBuilder>& builder) {
  builder.def(
      "set_mesh", &set_mesh, "key"_a, py::kw_only(), "name"_a, "positions"_a, "triangles"_a,
      "corner_vertices"_a = py::none(), "vertex_normals"_a = py::none(),
      "corner_normals"_a = py::none(), "material_indices"_a = py::none(), "faces"_a = py::none(),
      "attributes"_a = py::list(), "edges"_a = py::none(),
      "positions float[N,3]; triangles int[M,3], indices of corners; corner_vertices int[C], "
      "vertex of each corner (None: corners are vertices); vertex_normals float[N,3] or "
      "corner_normals float[C,3] (neither: flat); material_indices int[M], slot per triangle "
      "(None: slot 0); faces int[M], face of each triangle (None: each is one); attributes: "
      "dicts of key (as set_material() says it), domain (MESH, POINT, CORNER, FACE) and "
      "values float[N] or [N, 1 to 4]; 'pointiness' (which needs 'normal') and "
      "'random_per_island' may come without, and are computed from edges int[E,2]. Arrays are "
      "copied.");
  builder.def(
      "set_curves", &set_curves, "key"_a, py::kw_only(), "name"_a, "positions"_a, "radii"_a,
      "curves"_a, "straight"_a = false, "material_indices"_a = py::none(),
      "attributes"_a = py::list(),
      "Hair: tubes along curves, smooth (Catmull-Rom) or straight between their keys, under a key "
      "among those of meshes. positions float[N,3] and radii float[N] of the keys; curves "
      "int[M+1]: "
      "where each begins, and where the last one ends; material_indices int[M]; attributes as a "
      "mesh's, of points and, as FACE, of curves. Only seen from outside.");
  builder.def("set_points", &set_points, "key"_a, py::kw_only(), "name"_a, "positions"_a, "radii"_a,
              "attributes"_a = py::list(), "A point cloud: balls, likewise; attributes of points.");
}

}  // namespace janus::python
