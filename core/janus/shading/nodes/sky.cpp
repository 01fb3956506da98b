// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sky Texture: the colour of the sky in a direction, and the sun in it.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "janus/math/warp.h"
#include "janus/shading/node_emitter.h"
#include "janus/shading/nodes/families.h"
#include "janus/shading/point_reads.h"
#include "janus/shading/sky/atmosphere.h"
#include "janus/shading/sky/formulas.h"

namespace janus {

namespace {

using enum SocketType;
using Model = Atmosphere::Model;

constexpr SocketDecl kInputs[] = {{"Vector", Vector, Implicit::Generated}};
constexpr std::string_view kOutputs[] = {"Color"};

// A structure of floats in a table of the program, and back.
template <class T>
uint32_t add_table(NodeEmitter& e, const T& x) {
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(float) == 0);
  std::vector<float> table(sizeof(T) / sizeof(float));
  std::memcpy(table.data(), &x, sizeof(T));
  return e.table(std::move(table));
}
template <class T>
T read_table(const Context& c) {
  T x;
  std::memcpy(&x, c.program.tables[c.data].data(), sizeof(T));
  return x;
}

// --- Skies that are pictures ---------------------------------------------------------------------

// What a lookup knows besides the picture.
struct Sun {
  Rgb bottom, top;  // radiance at the lower and the upper edge, as linear Rec.709
  vec3 direction;   // to its middle
  float elevation;  // radians
  float angle;      // its diameter, radians; below 0: it is not shown
  float horizon;    // how low it is shown, radians
  float turn;       // of the picture around the zenith, radians
  float picture;    // its number
};

float elevation_of(vec3 d) { return 0.5f * kPi - std::acos(std::clamp(d.z, -1.0f, 1.0f)); }

// The sun's radiance in a direction, dimmed towards its edge; nullopt: it is not there. `height`:
// between its lower and its upper edge.
std::optional<Rgb> sun_radiance(const Sun& sun, vec3 d, float height) {
  const float x = angle_between(d, sun.direction) / (0.5f * sun.angle);
  if (!(sun.angle >= 0.0f && x < 1.0f)) {
    return std::nullopt;
  }
  return (0.4f + 0.6f * std::sqrt(1.0f - x * x)) * glm::mix(sun.bottom, sun.top, height);
}

Rgb sky_radiance(const Context& c, const Sun& sun, vec3 d, float v) {
  const float turns = (sun.turn - std::atan2(d.y, d.x) - 0.5f * kPi) * (0.5f * kInvPi);
  const Texture& texture = *c.program.textures[static_cast<size_t>(sun.picture)];
  return Rgb(texture.lookup(vec2(turns - std::floor(turns), v)));
}

vec3 look(const Context& c, vec3 d) {
  const Sun sun = read_table<Sun>(c);
  const float elevation = elevation_of(d);
  const float v = std::copysign(std::sqrt(std::abs(elevation) * 2.0f * kInvPi), elevation);
  Rgb color = sky_radiance(c, sun, d, 0.5f * v + 0.5f);
  if (elevation > sun.horizon) {
    color +=
        sun_radiance(sun, d, (elevation - sun.elevation) / sun.angle + 0.5f).value_or(Rgb(0.0f));
  }
  return glm::max(color, Rgb(0.0f));
}

// Of Blender up to 4.5: the sun hides the sky, and below the horizon its lowest row fades.
vec3 look_nishita(const Context& c, vec3 d) {
  const Sun sun = read_table<Sun>(c);
  if (d.z < 0.0f) {
    const float left = std::max(0.0f, 1.0f + 2.5f * d.z);
    return glm::max(left * left * left * sky_radiance(c, sun, d, -0.5f), Rgb(0.0f));
  }
  const float elevation = elevation_of(d), high = sun.elevation + 0.5f * sun.angle;
  const float height = sun.elevation - 0.5f * sun.angle > 0.0f
                           ? (elevation - sun.elevation) / sun.angle + 0.5f
                           : elevation / high;
  auto color = sun_radiance(sun, d, height);
  if (!color) {
    color = sky_radiance(c, sun, d, std::sqrt(elevation * 2.0f * kInvPi));
  }
  return glm::max(*color, Rgb(0.0f));
}

// As Cycles brings any angles into their ranges, so that a day can be a turn of the elevation.
struct SunPlace {
  float elevation, turn;  // radians; the turn of the picture
};
SunPlace place_of_sun(float elevation, float rotation) {
  constexpr float kTurn = 2.0f * kPi;
  elevation = std::fmod(elevation, kTurn);
  if (std::abs(elevation) >= kPi) {
    elevation -= std::copysign(kTurn, elevation);
  }
  if (std::abs(elevation) >= 0.5f * kPi) {
    elevation = std::copysign(kPi, elevation) - elevation;
    rotation += kPi;
  }
  rotation = std::fmod(rotation, kTurn);
  return {elevation, kTurn - (rotation < 0.0f ? rotation + kTurn : rotation)};
}

// Of a surface that faces it, over the solid angle that Cycles takes the sun for: so small a one is
// far from exact in floats.
void set_edges(Sun& sun, const Atmosphere& atmosphere, float size, float intensity) {
  const float solid_angle = 2.0f * kPi * (1.0f - std::cos(0.5f * size));
  float low = sun.elevation - 0.5f * size, high = sun.elevation + 0.5f * size;
  if (atmosphere.model != Model::MultipleScattering) {
    intensity = high > 0.0f ? intensity : 0.0f;
    low = std::max(low, 0.0f);
    high = std::max(high, 0.0f);
  }
  sun.bottom = intensity / solid_angle * sun_irradiance(atmosphere, low);
  sun.top = intensity / solid_angle * sun_irradiance(atmosphere, high);
}

void emit_atmosphere(NodeEmitter& e, Model model) {
  const Value d = e.input("Vector");
  const auto [elevation, turn] = place_of_sun(e.number("sun_elevation"), e.number("sun_rotation"));
  const bool old = model == Model::Nishita;
  const Atmosphere atmosphere{model,
                              elevation,
                              e.number("altitude"),
                              e.number("air_density"),
                              e.number(old ? "dust_density" : "aerosol_density"),
                              e.number("ozone_density")};
  const float size = std::max(e.number("sun_size"), 0.0005f);
  Sun sun{};
  const vec2 up = cos_sin(elevation), around = cos_sin(turn);
  sun.direction = vec3(-up.x * around.y, up.x * around.x, up.y);
  sun.elevation = elevation;
  sun.angle = e.flag("sun_disc") ? size : -1.0f;
  constexpr float kEarth = 6371.0f;  // kilometres
  sun.horizon = std::asin(kEarth / (kEarth + atmosphere.altitude / 1000.0f)) - 0.5f * kPi;
  sun.turn = turn;
  set_edges(sun, atmosphere, size, e.number("sun_intensity"));
  sun.picture = static_cast<float>(
      e.texture({sky_picture(atmosphere), Interpolation::Linear, Extension::Extend, false}));
  const Operation& operation = old ? pure<&look_nishita> : pure<&look>;
  e.output("Color", e.convert(e.emit(operation, {d}, add_table(e, sun)), Color));
  if (e.flag("sun_disc")) {
    e.sun(d, {sun.direction, 0.5f * size});
  }
}

// --- Skies by formulas ---------------------------------------------------------------------------

template <auto Radiance>
void emit_formula(NodeEmitter& e, const SkyFormula& sky) {
  constexpr Operation kOperation =
      pure<[](const Context& c, vec3 d) { return Radiance(read_table<SkyFormula>(c), d); }>;
  e.output("Color", e.convert(e.emit(kOperation, {e.input("Vector")}, add_table(e, sky)), Color));
}

vec3 sun_direction(const NodeEmitter& e) {
  const std::vector<float>* d = e.list("sun_direction");
  return d && d->size() == 3 ? safe_normalize(vec3((*d)[0], (*d)[1], (*d)[2])) : vec3(0, 0, 1);
}

// --- The node ------------------------------------------------------------------------------------

struct Sky {
  std::string_view name;
  void (*emit)(NodeEmitter& e);
};
constexpr Sky kSkies[] = {
    {"MULTIPLE_SCATTERING", [](NodeEmitter& e) { emit_atmosphere(e, Model::MultipleScattering); }},
    {"SINGLE_SCATTERING", [](NodeEmitter& e) { emit_atmosphere(e, Model::SingleScattering); }},
    {"NISHITA", [](NodeEmitter& e) { emit_atmosphere(e, Model::Nishita); }},
    {"PREETHAM",
     [](NodeEmitter& e) {
       emit_formula<&preetham_radiance>(e, preetham(sun_direction(e), e.number("turbidity")));
     }},
    {"HOSEK_WILKIE",
     [](NodeEmitter& e) {
       emit_formula<&hosek_wilkie_radiance>(
           e, hosek_wilkie(sun_direction(e), e.number("turbidity"), e.number("ground_albedo")));
     }},
};

void emit_sky(NodeEmitter& e) { find_mode(kSkies, e.property("sky_type")).emit(e); }

}  // namespace

std::span<const NodeDecl> sky_nodes() {
  static const std::vector<std::string_view> kNames = names_of(kSkies);
  static const EnumDecl kSettings[] = {{"sky_type", kNames}};
  static const NodeDecl kNodes[] = {
      {"TEX_SKY", kInputs, kOutputs, &emit_sky, nullptr, MixOp::None, kSettings}};
  return kNodes;
}

}  // namespace janus
