// SPDX-License-Identifier: GPL-3.0-or-later
//
// A compiled node graph: what is constant has become lobes, the rest is a list of instructions over
// registers, and closures that read their parameters from registers.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "janus/image/texture.h"
#include "janus/math/vec.h"
#include "janus/shading/bsdf.h"
#include "janus/shading/shading_point.h"

namespace janus {

// What a surface does at a point.
struct ShadingResult {
  Bsdf bsdf;
  Rgb emission = Rgb(0.0f);  // radiance, on both sides; of closures, a sum that may be below 0
  // Share of the light that passes straight through (Transparent BSDF, alpha): not a lobe, but a
  // crossing, which belongs to the walk.
  Rgb transparency = Rgb(0.0f);
  // Share of Holdout closures. They do nothing, but for what the camera sees (path/clear_view.h).
  float holdout = 0.0f;
  // The surface's shading normal, front side: that of the hit, or bumped by its displacement.
  vec3 ns = vec3(0.0f);
};

class Program;
struct Instruction;

inline constexpr int kMaxRegisters = 2048;
// Of a program's Bump nodes: each asks for two more points.
inline constexpr int kMaxFilterWidths = 8;
// Of the points that instructions read (0: the point): that with the normal that the surface has
// before its displacement bumps it; the two beside it follow.
inline constexpr uint16_t kUnbumped = 1 + 2 * kMaxFilterWidths;
inline constexpr float kBumpWidth = 0.1f;  // pixels to them: Cycles' filter width
// Of what a run keeps for other views of its point.
inline constexpr int kMaxKept = 64;

// The state of a run. Registers hold one float; a vector or colour takes three in a row.
struct RunState {
  float* registers;
  const ShadingPoint* points;  // the point, and for each width of bump two more beside it
  const Program& program;
};
using Kernel = void (*)(RunState&, const Instruction&);

struct Instruction {
  Kernel kernel;
  uint32_t operands;  // first index in Program::operands
  uint32_t data;      // the kernel's: an attribute slot, a table, an image, a mode
  uint16_t out;       // register
  uint16_t at;        // index of the point that it reads

  bool operator==(const Instruction&) const = default;
};

struct Closure;

// What a run depends on beside the point of the surface.
enum class Dependence : uint8_t {
  None,
  Side,  // the side of Ng that is looked at
  View,  // the direction
};

// What an AOV Output node writes.
struct AovWrite {
  uint32_t aov;           // a number of the scene's
  uint16_t color, value;  // registers
};

// A sun that the program of a world shows: within `half_angle` (radians) of `direction`.
struct SunDisc {
  vec3 direction;
  float half_angle;
};

class Program {
 public:
  // --- What does not vary over the surface.
  std::vector<Lobe> lobes;   // with selection probabilities, without normals; at most kMaxLobes
  Rgb emission = Rgb(0.0f);  // below 0, it dims what varies
  Rgb transparency = Rgb(0.0f);
  float holdout = 0.0f;
  bool sample_emission = true;  // MaterialDesc::sample_emission

  // --- What does.
  std::vector<float> constants;  // the first registers
  std::vector<uint16_t> operands;
  std::vector<Instruction> instructions;
  std::vector<Closure> closures;
  std::vector<std::vector<float>> tables;  // of ramps and curves
  std::vector<std::shared_ptr<const Texture>> textures;
  std::vector<std::string> attributes;  // keys, by slot
  uint16_t registers = 0;
  bool varying_emission = false, varying_transparency = false, varying_holdout = false;
  std::vector<float> filter_widths;  // pixels to the points beside the point that bump reads
  bool tangents = false;             // some attribute is a tangent
  bool fibers = false;               // some closure is one of hair
  bool edges = false;                // some operation reads the triangle's, and how wide a pixel is
  Dependence dependence = Dependence::None;
  bool by_path = false;       // something depends on the path that leads to the point
  std::vector<SunDisc> suns;  // which a world looks for
  bool transmits = false;     // some closure scatters to the other side, or may
  // Of the first instructions: they make the normal of the surface, which all others see.
  uint32_t bump_instructions = 0;
  uint16_t bumped_normal = 0;  // its register
  // Of a program that depends on the view: the first instructions, which depend on its side at
  // most, and the registers that they leave to the others and to the closures. None are kept where
  // they are too many, or where the view bumps the surface.
  uint32_t side_instructions = 0;
  uint16_t first_kept = 0, kept_count = 0;
  bool view_beside = false;  // some of the others read points beside the point

  // --- Of a program that does nothing else.
  std::vector<AovWrite> aovs;

  Program();
  ~Program();
  Program(Program&&) noexcept;
  Program& operator=(Program&&) noexcept;

  // Is all of it the same everywhere?
  bool constant() const { return closures.empty() && bump_instructions == 0; }
  bool has_transparency() const { return varying_transparency || !is_black(transparency); }
  bool holds_out() const { return varying_holdout || holdout > 0.0f; }
  bool emits() const { return varying_emission || !is_black(emission); }

  // Of a constant program. `normal`: shading normal on the front side, unit.
  void place(vec3 normal, ShadingResult& result) const {
    result.bsdf.clear();
    for (Lobe lobe : lobes) {
      lobe.normal = normal;
      result.bsdf.add(lobe);
    }
    result.emission = emission;
    result.transparency = transparency;
    result.holdout = holdout;
    result.ns = normal;
  }

  // `kept`: where to write kept_count floats; null: nobody asks for them.
  void run(const ShadingPoint& point, ShadingResult& result, float* kept = nullptr) const;
  // The same for another direction on the same side of a point where `kept` was written.
  void run_again(ShadingPoint point, const float* kept, ShadingResult& result) const;

  // Calls write(aov, color, value) for each of `aovs`. What is no number is 0.
  template <class Write>
  void run_aovs(ShadingPoint point, Write&& write) const {
    float r[kMaxRegisters];
    if (bump_instructions != 0) {
      fill_bumped(point, r);
    } else {
      fill(point, r);
    }
    const auto finite = [](float x) { return std::isfinite(x) ? x : 0.0f; };
    for (const AovWrite& a : aovs) {
      const float* c = r + a.color;
      write(a.aov, vec3(finite(c[0]), finite(c[1]), finite(c[2])), finite(r[a.value]));
    }
  }

  // Do both emit the same everywhere, to all appearance?
  bool emits_like(const Program& other) const;

 private:
  // Computes the registers.
  void fill(const ShadingPoint& point, float* registers) const;
  // The same where the surface is bumped: the point gets its new normal.
  void fill_bumped(ShadingPoint& point, float* registers) const;
  // Places the two points beside the first one, for each width.
  void place_beside(ShadingPoint* points) const;
  void execute(RunState state, size_t first, size_t end) const;
  void close(const ShadingPoint& point, const float* registers, ShadingResult& result) const;
};

// A point whose program depends on the view, to be run again for another one.
struct Reshading {
  const Program* program = nullptr;  // null: it does not depend on the view
  ShadingPoint point;
  float kept[kMaxKept];  // by its run; not initialised beyond the program's count

  Reshading() = default;
  Reshading(const Reshading& other) { *this = other; }
  // A copy costs what is kept.
  Reshading& operator=(const Reshading& other) {
    program = other.program;
    if (program) {
      point = other.point;
      std::copy_n(other.kept, program->kept_count, kept);
    }
    return *this;
  }

  void run(ShadingResult& result) { program->run(point, result, kept); }
};

}  // namespace janus
