// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a hit to what the surface does there: runs the programs of the scene's materials.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "janus/geometry/instance.h"
#include "janus/geometry/interaction.h"
#include "janus/shading/program.h"

namespace janus {

// How far apart the samples of a picture are where they meet a surface: Cycles' bump looks as far.
struct PixelFootprint {
  vec3 eye = vec3(0.0f);
  float angle = 0.0f;  // metres per metre of distance to the eye
  float width = 0.0f;  // and metres at any distance
};

// Copies share the programs, and may see other objects.
class Surfaces {
 public:
  // A program of a material and its pass index; its number.
  uint32_t add_program(Program program, const std::string& material, float material_index = 0.0f);
  const Program& program(uint32_t surface) const { return *surfaces_[surface].program; }
  // What the AOV Output nodes of a program's tree write where the camera sees it. To be added
  // before the program is bound.
  void add_aovs(uint32_t surface, Program aovs);
  // Programs, the default surface included, and those of AOVs not.
  size_t size() const { return shared_->programs.size() - shared_->aov_programs; }
  // What passes of data tell apart: the material of a surface, as a number in material_names(), and
  // its pass index.
  uint32_t material(uint32_t surface) const { return surfaces_[surface].material; }
  float material_index(uint32_t surface) const { return surfaces_[surface].material_index; }
  const std::vector<std::string>& material_names() const { return shared_->material_names; }
  // Can some surface reflect or refract without blur?
  bool any_delta() const { return shared_->any_delta; }
  // The number of a program's surface on a shape, which has attributes for it or not, in an
  // instance with attributes of its `own`. The shape must stay where it is from then on.
  uint32_t bind(uint32_t program, const Shape& shape, const std::map<std::string, vec4>& own = {});

  // The instances that hits speak of, in their order.
  void set_objects(const ShapeList& shapes, const std::vector<Instance>& instances,
                   const CameraView& camera, const PixelFootprint& footprint);

  // Shades a hit that is seen from the unit direction `view`, at the end of `path`.
  void shade(const SurfaceInteraction& hit, vec3 view, ShadingResult& result,
             const PathSoFar& path = {}) const {
    const Program& program = *surfaces_[hit.material].program;
    if (program.constant()) {
      program.place(hit.ns, result);
      result.bsdf.set_kind(surfaces_[hit.material].kind);
    } else {
      program.run(point(hit, view, path), result);
      finish(program, hit, result);
    }
  }
  // And keeps what another view needs.
  void shade(const SurfaceInteraction& hit, vec3 view, ShadingResult& result, Reshading& reshading,
             const PathSoFar& path = {}) const {
    const Program& program = *surfaces_[hit.material].program;
    if (program.dependence == Dependence::None) {
      reshading.program = nullptr;
      shade(hit, view, result, path);
    } else {
      reshading.program = &program;
      reshading.point = point(hit, view, path);
      reshading.run(result);
      finish(program, hit, result);
    }
  }
  ShadingPoint point(const SurfaceInteraction& hit, vec3 view, const PathSoFar& path = {}) const;

  // Calls write(aov, color, value) for what AOV Output nodes write there.
  template <class Write>
  void write_aovs(SurfaceInteraction hit, vec3 view, const PathSoFar& path, Write&& write) const {
    hit.material = surfaces_[hit.material].aovs;
    if (hit.material != 0) {
      program(hit.material).run_aovs(point(hit, view, path), write);
    }
  }

 private:
  // What the surface itself adds to what its program says.
  void finish(const Program& program, const SurfaceInteraction& hit, ShadingResult& result) const {
    result.bsdf.set_kind(surfaces_[hit.material].kind);
    if (program.by_path) [[unlikely]] {
      result.bsdf.set_by_path();
    }
  }

  struct Surface {
    const Program* program;
    const AttributeDesc* const* attributes;
    float material_index;
    uint32_t material;
    // VertexKind::OneWay where the program asks for the path, or where light goes through the
    // inside of what is round in an event of the surface, where the camera sees it.
    VertexKind kind;
    uint32_t aovs = 0;  // the surface whose program writes AOVs; 0, the default surface: none
  };
  struct Shared {
    std::vector<std::unique_ptr<const Program>> programs;
    std::vector<std::string> material_names;
    std::vector<std::unique_ptr<const AttributeDesc*[]>> attributes;
    // By program, shape, what it reads of the instance, and its AOVs.
    std::map<std::tuple<uint32_t, const Shape*, std::vector<float>, uint32_t>, uint32_t> bound;
    std::vector<std::unique_ptr<const AttributeDesc>> own;  // of instances
    bool any_delta = false;
    size_t aov_programs = 0;
  };
  std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
  std::vector<Surface> surfaces_;  // those of add_program(), then those of bind()
  std::vector<ObjectData> objects_;
  std::vector<const Shape*> shapes_;  // by instance
  PixelFootprint footprint_;
};

}  // namespace janus
