// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/geometry/surfaces.h"

#include <algorithm>

#include "janus/geometry/mesh.h"
#include "janus/geometry/round_shape.h"

namespace janus {

uint32_t Surfaces::add_program(Program program, const std::string& material, float material_index) {
  shared_->any_delta = shared_->any_delta || !program.constant() ||
                       std::any_of(program.lobes.begin(), program.lobes.end(), is_delta);
  shared_->programs.push_back(std::make_unique<const Program>(std::move(program)));
  if (shared_->material_names.empty() || shared_->material_names.back() != material) {
    shared_->material_names.push_back(material);
  }
  surfaces_.push_back({shared_->programs.back().get(), nullptr, material_index,
                       static_cast<uint32_t>(shared_->material_names.size() - 1),
                       VertexKind::Surface});
  return static_cast<uint32_t>(surfaces_.size() - 1);
}

void Surfaces::add_aovs(uint32_t surface, Program aovs) {
  shared_->programs.push_back(std::make_unique<const Program>(std::move(aovs)));
  ++shared_->aov_programs;
  surfaces_[surface].aovs = static_cast<uint32_t>(surfaces_.size());
  surfaces_.push_back({shared_->programs.back().get(), nullptr, material_index(surface),
                       material(surface), VertexKind::Surface});
}

uint32_t Surfaces::bind(uint32_t surface, const Shape& shape,
                        const std::map<std::string, vec4>& own) {
  const Program& program = *surfaces_[surface].program;
  const VertexKind kind = program.by_path || program.fibers || (shape.round() && program.transmits)
                              ? VertexKind::OneWay
                              : VertexKind::Surface;
  uint32_t aovs = surfaces_[surface].aovs;
  if (aovs != 0) {
    aovs = bind(aovs, shape, own);
  }
  if (program.attributes.empty() && kind == surfaces_[surface].kind &&
      aovs == surfaces_[surface].aovs) {
    return surface;
  }
  std::vector<float> read;
  for (const std::string& key : program.attributes) {
    if (const auto found = own.find(key); found != own.end()) {
      read.insert(read.end(), &found->second.x, &found->second.x + 4);
    }
  }
  const auto [entry, fresh] =
      shared_->bound.try_emplace({surface, &shape, std::move(read), aovs}, 0);
  if (fresh) {
    auto slots = std::make_unique<const AttributeDesc*[]>(program.attributes.size());
    const auto find = [&](const std::string& key) {
      const auto found = own.find(key);
      if (found == own.end()) {
        return shape.attribute(key);
      }
      const float* first = &found->second.x;
      shared_->own.push_back(std::make_unique<const AttributeDesc>(
          AttributeDesc{key, AttributeDomain::Mesh, 4, {first, first + 4}}));
      return shared_->own.back().get();
    };
    std::transform(program.attributes.begin(), program.attributes.end(), slots.get(), find);
    entry->second = static_cast<uint32_t>(surfaces_.size());
    surfaces_.push_back(
        {&program, slots.get(), material_index(surface), material(surface), kind, aovs});
    shared_->attributes.push_back(std::move(slots));
  }
  return entry->second;
}

void Surfaces::set_objects(const ShapeList& shapes, const std::vector<Instance>& instances,
                           const CameraView& camera, const PixelFootprint& footprint) {
  footprint_ = footprint;
  const bool needed = std::any_of(shared_->programs.begin(), shared_->programs.end(),
                                  [](const auto& p) { return !p->constant() || !p->aovs.empty(); });
  if (!needed) {
    return;
  }
  objects_.clear();
  shapes_.clear();
  const auto view = std::make_shared<const CameraView>(camera);
  for (const Instance& instance : instances) {
    ObjectData data;
    data.to_world = instance.to_world;
    data.to_object = glm::inverse(instance.to_world);
    data.normal_to_world = instance.normal_to_world;
    data.camera = view;
    data.location = vec3(instance.to_world[3]);
    data.color = instance.color;
    data.object_index = instance.object_index;
    data.random = instance.random;
    objects_.push_back(data);
    shapes_.push_back(shapes[instance.shape].get());
  }
}

ShadingPoint Surfaces::point(const SurfaceInteraction& hit, vec3 view,
                             const PathSoFar& path) const {
  const Surface& surface = surfaces_[hit.material];
  const Shape& shape = *shapes_[hit.instance];
  ShadingPoint point{};
  point.p = hit.p;
  point.ng = hit.ng;
  point.ns = hit.ns;
  point.view = view;
  point.path = path;
  point.barycentric = hit.barycentric;
  point.triangle = shape.indices(hit.primitive);
  point.object = &objects_[hit.instance];
  point.attributes = surface.attributes;
  point.material_index = surface.material_index;
  const Program& program = *surface.program;
  const Mesh* mesh = shape.mesh();
  const mat3 linear(point.object->to_world);
  if (!mesh) {
    const RoundShape::Place place = shape.round()->place(hit.primitive, hit.barycentric.x);
    point.on_curve = shape.round()->curves();
    point.on_ball = !point.on_curve;
    point.edge_u = linear * place.along;
    if (point.on_ball) {
      point.edge_v = vec3(point.object->to_world * vec4(place.center, 1.0f));
    }
  } else if (program.edges) {
    const auto vertex = [&](int k) { return mesh->positions()[point.triangle.vertices[k]]; };
    point.edge_u = linear * (vertex(1) - vertex(0));
    point.edge_v = linear * (vertex(2) - vertex(0));
  }
  if (program.edges) {
    point.footprint = footprint_.width + footprint_.angle * glm::length(hit.p - footprint_.eye);
    if (mesh) {
      mesh->corner_normals(hit.primitive, point.corner_normals);
    }
  }
  if (program.tangents) {
    point.object_normal = mesh ? mesh->interpolated_normal(hit.primitive, hit.barycentric)
                               : glm::transpose(linear) * hit.ns;
  }
  return point;
}

}  // namespace janus
