// SPDX-License-Identifier: GPL-3.0-or-later
//
// Patterns: Gradient, Checker, Magic, Brick, Wave.
#include <algorithm>
#include <cmath>

#include "janus/math/noise.h"
#include "janus/shading/node_emitter.h"
#include "janus/shading/nodes/families.h"
#include "janus/shading/scalar.h"

namespace janus {

namespace {

using enum SocketType;

constexpr std::string_view kOutputs[] = {"Color", "Fac"};

void output_gray(NodeEmitter& e, Value factor) {
  e.output("Fac", factor);
  e.output("Color", e.convert(factor, Color));
}

// --- Gradient ------------------------------------------------------------------------------------

constexpr SocketDecl kGradientInputs[] = {{"Vector", Vector, Implicit::Generated}};

// From 1 in the middle to 0 at radius 1; a little before, for unit vectors to be at 0.
float ball(vec3 p) { return std::max(0.0f, 0.999999f - std::sqrt(dot(p, p))); }

struct GradientMode {
  std::string_view name;
  Operation operation;
};
const GradientMode kGradients[] = {
    {"LINEAR", pure<[](vec3 p) { return clamp01(p.x); }>},
    {"QUADRATIC", pure<[](vec3 p) { return clamp01(sqr(std::max(0.0f, p.x))); }>},
    {"EASING", pure<[](vec3 p) { return smoothstep(clamp01(p.x), 0.0f, 1.0f); }>},
    {"DIAGONAL", pure<[](vec3 p) { return clamp01(0.5f * (p.x + p.y)); }>},
    {"SPHERICAL", pure<[](vec3 p) { return ball(p); }>},
    {"QUADRATIC_SPHERE", pure<[](vec3 p) { return sqr(ball(p)); }>},
    {"RADIAL", pure<[](vec3 p) { return clamp01(std::atan2(p.y, p.x) / (2.0f * kPi) + 0.5f); }>},
};

void emit_gradient(NodeEmitter& e) {
  const auto& mode = find_mode(kGradients, e.property("gradient_type", "LINEAR"));
  output_gray(e, e.emit(mode.operation, {e.input("Vector")}));
}

// --- Checker -------------------------------------------------------------------------------------

constexpr SocketDecl kCheckerInputs[] = {{"Vector", Vector, Implicit::Generated},
                                         {"Color1", Color, 0.8f},
                                         {"Color2", Color, 0.2f},
                                         {"Scale", Float, 5.0f}};

// Sides of unit cubes belong to one cell each, whatever the rounding.
vec3 off_grid(vec3 p) { return (p + 0.000001f) * 0.999999f; }

constexpr Operation kChecker = pure<[](vec3 p, float scale) {
  p = glm::floor(off_grid(p * scale));
  return static_cast<float>((to_integer(p.x) ^ to_integer(p.y) ^ to_integer(p.z)) & 1);
}>;
constexpr Operation kChoose =
    pure<[](float first, vec3 a, vec3 b) { return first != 0.0f ? a : b; }>;

void emit_checker(NodeEmitter& e) {
  const Value first = e.emit(kChecker, {e.input("Vector"), e.input("Scale")});
  e.output("Fac", first);
  e.output("Color",
           e.convert(e.emit(kChoose, {first, e.input("Color1"), e.input("Color2")}), Color));
}

// --- Magic ---------------------------------------------------------------------------------------

constexpr SocketDecl kMagicInputs[] = {
    {"Vector", Vector, Implicit::Generated}, {"Scale", Float, 5.0f}, {"Distortion", Float, 1.0f}};

// What `data` says beside the depth: coordinates are brought into the first turn before they are
// scaled, as they were before Blender 5.2.
constexpr uint32_t kWrapsUnscaled = 16;

// Psychedelic sums of waves of waves. `data`: how deep.
vec3 magic(const Context& c, vec3 v, float scale, float distortion) {
  const auto in_turn = [](float x) { return std::fmod(x, 2.0f * kPi); };
  const uint32_t depth = c.data & ~kWrapsUnscaled;
  const float before = c.data & kWrapsUnscaled ? 1.0f : scale;
  const float after = c.data & kWrapsUnscaled ? scale : 1.0f;
  const vec3 p(in_turn(v.x * before), in_turn(v.y * before), in_turn(v.z * before));
  float x = std::sin((p.x + p.y + p.z) * 5.0f * after);
  float y = std::cos((-p.x + p.y - p.z) * 5.0f * after);
  float z = -std::cos((-p.x - p.y + p.z) * 5.0f * after);
  if (depth > 0) {
    x *= distortion;
    y *= distortion;
    z *= distortion;
  }
  for (uint32_t i = 0; i < depth; ++i) {
    switch (i) {
      case 0:
        y = distortion * -std::cos(x - y + z);
        break;
      case 1:
        x = distortion * std::cos(x - y - z);
        break;
      case 2:
        z = distortion * std::sin(-x - y - z);
        break;
      case 3:
        x = distortion * -std::cos(-x + y - z);
        break;
      case 4:
        y = distortion * -std::sin(-x + y + z);
        break;
      case 5:
        y = distortion * -std::cos(-x + y + z);
        break;
      case 6:
        x = distortion * std::cos(x + y + z);
        break;
      case 7:
        z = distortion * std::sin(x + y - z);
        break;
      case 8:
        x = distortion * -std::cos(-x - y + z);
        break;
      default:
        y = distortion * -std::sin(x - y + z);
    }
  }
  const float range = distortion != 0.0f ? 2.0f * distortion : 1.0f;
  return 0.5f - vec3(x, y, z) / range;
}

void emit_magic(NodeEmitter& e) {
  const auto depth = static_cast<uint32_t>(std::clamp(e.number("turbulence_depth"), 0.0f, 10.0f));
  const Value color =
      e.emit(pure<&magic>, {e.input("Vector"), e.input("Scale"), e.input("Distortion")},
             depth | (e.flag("wraps_unscaled") ? kWrapsUnscaled : 0));
  e.output("Color", e.convert(color, Color));
  e.output("Fac", e.convert(color, Float));
}

// --- Brick ---------------------------------------------------------------------------------------

constexpr SocketDecl kBrickInputs[] = {{"Vector", Vector, Implicit::Generated},
                                       {"Color1", Color, 0.8f},
                                       {"Color2", Color, 0.2f},
                                       {"Mortar", Color, 0.0f},
                                       {"Scale", Float, 5.0f},
                                       {"Mortar Size", Float, 0.02f},
                                       {"Mortar Smooth", Float, 0.1f},
                                       {"Bias", Float, 0.0f},
                                       {"Brick Width", Float, 0.5f},
                                       {"Row Height", Float, 0.25f}};

// A number in [0, 1] for a whole one (H. Elias).
float brick_noise(uint32_t n) {
  n = (n + 1013) & 0x7fffffffU;
  n = (n >> 13) ^ n;
  n = (n * (n * n * 60493 + 19990303) + 1376312589) & 0x7fffffffU;
  return 0.5f * (static_cast<float>(n) / 1073741824.0f);
}

// Which of how many rows are moved or stretched, as integers have remainders.
bool is_nth(int32_t row, float frequency) { return row % static_cast<int32_t>(frequency) == 0; }

// x: the share of Color2; y: that of mortar. The last four are settings of the node.
vec3 brick(vec3 p, float scale, float mortar_size, float mortar_smooth, float bias, float width,
           float height, float offset, float offset_frequency, float squash,
           float squash_frequency) {
  p *= scale;
  const int32_t row = to_integer(std::floor(p.y / height));
  float shift = 0.0f;
  if (offset_frequency >= 1.0f && squash_frequency >= 1.0f) {
    width *= is_nth(row, squash_frequency) ? squash : 1.0f;
    shift = is_nth(row, offset_frequency) ? width * offset : 0.0f;
  }
  const int32_t column = to_integer(std::floor((p.x + shift) / width));
  const float x = p.x + shift - width * static_cast<float>(column);
  const float y = p.y - height * static_cast<float>(row);
  const float tint = clamp01(
      brick_noise((static_cast<uint32_t>(row) << 16) + (static_cast<uint32_t>(column) & 0xffffU)) +
      bias);
  const float edge = lower(lower(x, y), lower(width - x, height - y));
  float mortar = 1.0f;
  if (edge >= mortar_size) {
    mortar = 0.0f;
  } else if (mortar_smooth != 0.0f) {
    mortar = smoothstep(1.0f - edge / mortar_size, 0.0f, mortar_smooth);
  }
  return vec3(tint, mortar, 0.0f);
}

constexpr Operation kLay = pure<[](vec3 brick, vec3 first, vec3 second, vec3 mortar) {
  const vec3 color = (1.0f - brick.x) * first + brick.x * second;
  return (1.0f - brick.y) * color + brick.y * mortar;
}>;

void emit_brick(NodeEmitter& e) {
  const Value laid =
      e.emit(pure<&brick>,
             {e.input("Vector"), e.input("Scale"), e.input("Mortar Size"), e.input("Mortar Smooth"),
              e.input("Bias"), e.input("Brick Width"), e.input("Row Height"),
              e.constant(e.number("offset")), e.constant(e.number("offset_frequency")),
              e.constant(e.number("squash")), e.constant(e.number("squash_frequency"))});
  e.output("Fac", e.emit(pure<[](vec3 v) { return v.y; }>, {laid}));
  e.output("Color",
           e.convert(e.emit(kLay, {laid, e.input("Color1"), e.input("Color2"), e.input("Mortar")}),
                     Color));
}

// --- Wave ----------------------------------------------------------------------------------------

constexpr SocketDecl kWaveInputs[] = {{"Vector", Vector, Implicit::Generated},
                                      {"Scale", Float, 5.0f},
                                      {"Distortion", Float, 0.0f},
                                      {"Detail", Float, 2.0f},
                                      {"Detail Scale", Float, 1.0f},
                                      {"Detail Roughness", Float, 0.5f},
                                      {"Phase Offset", Float, 0.0f}};

// How far on the wave is at a place, in radians.
struct WaveMode {
  std::string_view name;
  Operation operation;
};
const WaveMode kBands[] = {
    {"X", pure<[](vec3 p) { return 20.0f * p.x; }>},
    {"Y", pure<[](vec3 p) { return 20.0f * p.y; }>},
    {"Z", pure<[](vec3 p) { return 20.0f * p.z; }>},
    {"DIAGONAL", pure<[](vec3 p) { return 10.0f * (p.x + p.y + p.z); }>},
};
const WaveMode kRings[] = {
    {"X", pure<[](vec3 p) { return 20.0f * glm::length(vec2(p.y, p.z)); }>},
    {"Y", pure<[](vec3 p) { return 20.0f * glm::length(vec2(p.x, p.z)); }>},
    {"Z", pure<[](vec3 p) { return 20.0f * glm::length(vec2(p.x, p.y)); }>},
    {"SPHERICAL", pure<[](vec3 p) { return 20.0f * glm::length(p); }>},
};
const WaveMode kProfiles[] = {
    {"SIN", pure<[](float phase) { return 0.5f + 0.5f * std::sin(phase - 0.5f * kPi); }>},
    {"SAW", pure<[](float phase) {
       const float turns = phase / (2.0f * kPi);
       return turns - std::floor(turns);
     }>},
    {"TRI", pure<[](float phase) {
       const float turns = phase / (2.0f * kPi);
       return 2.0f * std::abs(turns - std::floor(turns + 0.5f));
     }>},
};

float disturbed(float phase, vec3 p, float distortion, float detail, float scale, float roughness) {
  if (distortion == 0.0f) {
    return phase;
  }
  const Fractal fractal{.detail = detail, .roughness = roughness, .normalize = true};
  return phase + distortion * (2.0f * fractal_noise<3>(p * scale, fractal) - 1.0f);
}

void emit_wave(NodeEmitter& e) {
  const bool rings = e.property("wave_type", "BANDS") == "RINGS";
  const WaveMode& way = rings ? find_mode(kRings, e.property("rings_direction", "X"))
                              : find_mode(kBands, e.property("bands_direction", "X"));
  const WaveMode& profile = find_mode(kProfiles, e.property("wave_profile", "SIN"));
  const Value p = e.emit(pure<[](vec3 v, float scale) { return off_grid(v * scale); }>,
                         {e.input("Vector"), e.input("Scale")});
  const Value phase = e.emit(pure<[](float a, float b) { return a + b; }>,
                             {e.emit(way.operation, {p}), e.input("Phase Offset")});
  const Value disturbance =
      e.emit(pure<&disturbed>, {phase, p, e.input("Distortion"), e.input("Detail"),
                                e.input("Detail Scale"), e.input("Detail Roughness")});
  output_gray(e, e.emit(profile.operation, {disturbance}));
}

}  // namespace

std::span<const NodeDecl> pattern_nodes() {
  static const auto kBandsDirections = names_of(kBands), kRingsDirections = names_of(kRings),
                    kWaveProfiles = names_of(kProfiles);
  static constexpr std::string_view kWaveTypes[] = {"BANDS", "RINGS"};
  static const EnumDecl kWave[] = {{"wave_type", kWaveTypes},
                                   {"bands_direction", kBandsDirections},
                                   {"rings_direction", kRingsDirections},
                                   {"wave_profile", kWaveProfiles}};
  static const auto kGradientTypes = names_of(kGradients);
  static const EnumDecl kGradient[] = {{"gradient_type", kGradientTypes}};
  static const NodeDecl kNodes[] = {
      {"TEX_GRADIENT", kGradientInputs, kOutputs, &emit_gradient, nullptr, MixOp::None, kGradient},
      {"TEX_CHECKER", kCheckerInputs, kOutputs, &emit_checker},
      {"TEX_MAGIC", kMagicInputs, kOutputs, &emit_magic},
      {"TEX_BRICK", kBrickInputs, kOutputs, &emit_brick},
      {"TEX_WAVE", kWaveInputs, kOutputs, &emit_wave, nullptr, MixOp::None, kWave},
  };
  return kNodes;
}

}  // namespace janus
