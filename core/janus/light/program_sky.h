// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surroundings as the program of a world's node tree says them, and their importance sampling:
// the sky by a grid, suns by cones.
#pragma once

#include "janus/light/environment_map.h"
#include "janus/shading/program.h"
#include "janus/util/cancel.h"

namespace janus {

// What the program of a world knows of objects: there is none.
ObjectData no_object(const CameraView& camera);
// The point where Cycles runs it: `direction`, of a sphere that looks inwards.
ShadingPoint sky_point(vec3 direction, const ObjectData& surroundings, const PathSoFar& path = {});

class WorldProgram {
 public:
  WorldProgram(Program program, const CameraView& camera);

  // Runs the program, for one path or where it does not depend on that.
  Rgb radiance(vec3 direction, const PathSoFar& path = {}) const;
  bool by_path() const { return program_.by_path; }
  // A mean over usual paths.
  float mean_luminance(vec3 direction) const;

  // Columns of the widest picture that it reads; 0: none.
  int widest_picture() const;

  // The suns that outshine the sky beside them. They are lights of their own (SkySun).
  const std::vector<SunDisc>& suns() const { return suns_; }
  // The number of the first sun in that direction; their count: there is none.
  size_t sun_at(vec3 direction) const;

 private:
  // The mean luminance on a circle around the sun, of `share` of its radius.
  float luminance_around(const SunDisc& sun, float share) const;

  Program program_;
  ObjectData surroundings_;
  std::vector<SunDisc> suns_;
};

// A world without its suns.
class ProgramSky {
 public:
  // `sampled`: light is looked for in it, so that its brightness is measured first, which may take
  // a while; else it shines to the camera alone. Throws Cancelled.
  ProgramSky(std::shared_ptr<const WorldProgram> world, bool sampled, const CancelToken& cancel);

  Rgb radiance(vec3 direction, const PathSoFar& path = {}) const;
  bool by_path() const { return world_->by_path(); }

  // A direction, drawn with pdf_solid(). That is constant in each cell of a grid, near the cell's
  // mean luminance, and positive everywhere: what the program hides from the grid is found, too.
  vec3 sample(vec2 u) const { return map_.sample(u); }
  float pdf_solid(vec3 direction) const { return map_.pdf_solid(direction); }

  // The integral of the luminance over all directions (an estimate by cells).
  float total() const { return map_.total(); }

 private:
  EnvironmentMap measure(bool sampled, const CancelToken& cancel) const;

  std::shared_ptr<const WorldProgram> world_;
  EnvironmentMap map_;
};

// One of its suns: the same for the directions that lie in it. Where it stands is known, so that
// next event estimation leaves it out behind a surface.
class SkySun {
 public:
  // `number`: in WorldProgram::suns().
  SkySun(std::shared_ptr<const WorldProgram> world, size_t number);

  Rgb radiance(vec3 direction, const PathSoFar& path = {}) const;
  bool by_path() const { return world_->by_path(); }
  vec3 sample(vec2 u) const;  // uniform in its cone
  float pdf_solid(vec3 /*direction*/) const { return pdf_; }
  float total() const { return total_; }
  const SunDisc& cone() const { return world_->suns()[number_]; }

 private:
  std::shared_ptr<const WorldProgram> world_;
  size_t number_;
  float one_minus_cos_, pdf_, total_ = 0.0f;
};

}  // namespace janus
