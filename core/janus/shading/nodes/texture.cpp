// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pictures: Image Texture, Environment Texture.
#include <algorithm>
#include <cmath>

#include "janus/image/latlong.h"
#include "janus/shading/node_emitter.h"
#include "janus/shading/nodes/families.h"
#include "janus/shading/rotation.h"

namespace janus {

namespace {

using enum SocketType;

constexpr std::string_view kImageOutputs[] = {"Color", "Alpha"};
constexpr SocketDecl kImageInputs[] = {{"Vector", Vector, Implicit::Uv}};

// What a lookup does besides: see `data`.
enum Flags : uint32_t { kUnassociate = 1u << 31, kTiled = 1u << 30 };

const vec4 kMissing(1.0f, 0.0f, 1.0f, 1.0f);  // Cycles' magenta

// The number of the picture on which `uv` lies, and `uv` on it. Tables of tiles hold pairs: the
// number of a UDIM tile, that of its picture.
std::optional<uint32_t> find_tile(const std::vector<float>& table, vec2& uv) {
  if (!(uv.x > -1.0f && uv.x < 10.0f && uv.y > -1.0f && uv.y < 1e6f)) {
    return std::nullopt;
  }
  const vec2 corner = glm::trunc(uv);
  const float tile = 1001.0f + 10.0f * corner.y + corner.x;
  for (size_t i = 0; i + 1 < table.size(); i += 2) {
    if (table[i] == tile) {
      uv -= corner;
      return static_cast<uint32_t>(table[i + 1]);
    }
  }
  return std::nullopt;
}

// Of the picture with the number in `data`, or of a table of tiles.
vec4 picture(const Context& c, vec2 uv) {
  uint32_t number = c.data & ~(kUnassociate | kTiled);
  if (c.data & kTiled) {
    const auto tile = find_tile(c.program.tables[number], uv);
    if (!tile) {
      return kMissing;
    }
    number = *tile;
  }
  const Texture& texture = *c.program.textures[number];
  vec4 rgba = texture.lookup(uv);
  if ((c.data & kUnassociate) && rgba.w != 0.0f && rgba.w != 1.0f) {
    rgba = vec4(vec3(rgba) / rgba.w, rgba.w);
  }
  return texture.decode(rgba);
}

vec4 look_flat(const Context& c, vec3 p) { return picture(c, vec2(p)); }

// The square [0, 1] becomes [-1, 1] first.
vec4 look_sphere(const Context& c, vec3 p) {
  return picture(c, direction_to_sphere(2.0f * p - 1.0f));
}
vec4 look_tube(const Context& c, vec3 p) {
  const vec3 q = 2.0f * p - 1.0f;
  const float length = std::sqrt(q.x * q.x + q.y * q.y);
  vec2 uv(0.0f);
  if (length > 0.0f) {
    uv = vec2(0.5f * (1.0f - std::atan2(q.x / length, q.y / length) * kInvPi), 0.5f * (q.z + 1.0f));
  }
  return picture(c, uv);
}

// Weights of the three axes by the normal of the object: one axis, or in the seams a mix of two or
// three, of the width `blend`.
vec3 box_weights(vec3 n, float blend) {
  n = glm::abs(n);
  n /= n.x + n.y + n.z;
  const float limit = 0.5f * (1.0f + blend);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    if (n[i] > limit * (n[i] + n[j]) && n[i] > limit * (n[i] + n[k])) {
      vec3 only(0.0f);
      only[i] = 1.0f;
      return only;
    }
  }
  if (blend <= 0.0f) {
    return vec3(1.0f, 0.0f, 0.0f);
  }
  const auto share = [blend](float a, float b) {
    return std::clamp((a / (a + b) - 0.5f * (1.0f - blend)) / blend, 0.0f, 1.0f);
  };
  if (n.z < (1.0f - limit) * (n.y + n.x)) {
    const float w = share(n.x, n.y);
    return vec3(w, 1.0f - w, 0.0f);
  }
  if (n.x < (1.0f - limit) * (n.y + n.z)) {
    const float w = share(n.y, n.z);
    return vec3(0.0f, w, 1.0f - w);
  }
  if (n.y < (1.0f - limit) * (n.x + n.z)) {
    const float w = share(n.x, n.z);
    return vec3(w, 0.0f, 1.0f - w);
  }
  return ((2.0f - limit) * n + (limit - 1.0f)) / (2.0f * limit - 1.0f);
}

// No side shows its picture mirrored.
vec4 look_box(const Context& c, vec3 p, float blend) {
  // Box projection goes by the object's own side: it is the same from in front and from behind.
  const vec3 n = glm::transpose(mat3(c.point.object->to_world)) * c.point.facing(c.point.ns);
  const vec3 w = box_weights(n, blend);
  vec4 sum(0.0f);
  if (w.x > 0.0f) {
    sum += w.x * picture(c, vec2(n.x < 0.0f ? 1.0f - p.y : p.y, p.z));
  }
  if (w.y > 0.0f) {
    sum += w.y * picture(c, vec2(n.y > 0.0f ? 1.0f - p.x : p.x, p.z));
  }
  if (w.z > 0.0f) {
    sum += w.z * picture(c, vec2(n.z > 0.0f ? 1.0f - p.y : p.y, p.x));
  }
  return sum;
}

template <auto Look>
vec3 color_of(const Context& c, vec3 p) {
  return vec3(Look(c, p));
}
template <auto Look>
float alpha_of(const Context& c, vec3 p) {
  return Look(c, p).w;
}
void prefetch_flat(RunState& state, const Instruction& i) {
  if (!(i.data & kTiled)) {
    const float* uv = state.registers + state.program.operands[i.operands];
    state.program.textures[i.data & ~kUnassociate]->prefetch(vec2(uv[0], uv[1]));
  }
}
constexpr Operation prefetched(Operation operation) {
  operation.prefetch = &prefetch_flat;
  return operation;
}

vec3 box_color(const Context& c, vec3 p, float blend) { return vec3(look_box(c, p, blend)); }
float box_alpha(const Context& c, vec3 p, float blend) { return look_box(c, p, blend).w; }

Interpolation interpolation_of(const std::string& name) {
  return name == "Closest"                    ? Interpolation::Closest
         : name == "Cubic" || name == "Smart" ? Interpolation::Cubic
                                              : Interpolation::Linear;
}

Extension extension_of(const std::string& name) {
  return name == "EXTEND"   ? Extension::Extend
         : name == "CLIP"   ? Extension::Clip
         : name == "MIRROR" ? Extension::Mirror
                            : Extension::Repeat;
}

uint32_t add_picture(NodeEmitter& e, const ImageDesc& image, Extension extension) {
  Texture texture;
  texture.image = image.pixels;
  texture.srgb = image.srgb;
  texture.interpolation = interpolation_of(e.property("interpolation"));
  texture.extension = extension;
  // Colours are multiplied by alpha, unless somebody takes care of alpha.
  const bool unassociate = image.associated && e.output_linked("Alpha");
  return e.texture(std::move(texture)) | (unassociate ? uint32_t{kUnassociate} : 0U);
}

// `data` for the node's picture; where there is none, its outputs are Cycles' magenta.
std::optional<uint32_t> add_texture(NodeEmitter& e, Extension extension) {
  const std::string key = e.property("image");
  if (const std::vector<float>* tiles = e.list("tiles")) {
    std::vector<float> table;
    uint32_t flags = kTiled;
    for (const float tile : *tiles) {
      const std::string name = key + ":" + std::to_string(static_cast<int>(tile));
      if (const ImageDesc* image = e.image(name)) {
        const uint32_t data = add_picture(e, *image, extension);
        flags |= data & kUnassociate;
        table.insert(table.end(), {tile, static_cast<float>(data & ~kUnassociate)});
      } else {
        e.warn("the tile " + std::to_string(static_cast<int>(tile)) +
               " of its image is missing; it is rendered magenta, as in Cycles");
      }
    }
    return e.table(std::move(table)) | flags;
  }
  if (const ImageDesc* image = e.image(key)) {
    return add_picture(e, *image, extension);
  }
  e.warn("its image is missing; it is rendered magenta, as in Cycles");
  e.output("Color", e.convert(e.constant(vec3(kMissing)), Color));
  e.output("Alpha", e.constant(1.0f));
  return std::nullopt;
}

void emit_image(NodeEmitter& e) {
  const Value p = e.input("Vector");  // first: what is asked for does not depend on the picture
  const auto texture = add_texture(e, extension_of(e.property("extension")));
  if (!texture) {
    return;
  }
  const std::string projection = e.property("projection", "FLAT");
  Value color = p, alpha = p;
  if (projection == "BOX") {
    const Value blend = e.constant(e.number("projection_blend"));
    color = e.emit(by_side<&box_color>, {p, blend}, *texture);
    alpha = e.emit(by_side<&box_alpha>, {p, blend}, *texture);
  } else {
    const bool sphere = projection == "SPHERE", tube = projection == "TUBE";
    color = e.emit(sphere ? pure<&color_of<&look_sphere>>
                   : tube ? pure<&color_of<&look_tube>>
                          : prefetched(pure<&color_of<&look_flat>>),
                   {p}, *texture);
    alpha = e.emit(sphere ? pure<&alpha_of<&look_sphere>>
                   : tube ? pure<&alpha_of<&look_tube>>
                          : prefetched(pure<&alpha_of<&look_flat>>),
                   {p}, *texture);
  }
  e.output("Color", e.convert(color, Color));
  e.output("Alpha", alpha);
}

// --- Environment Texture -------------------------------------------------------------------------

constexpr SocketDecl kEnvironmentInputs[] = {{"Vector", Vector, Implicit::Position}};
constexpr std::string_view kEnvironmentOutputs[] = {"Color"};

vec3 look_lat_long(const Context& c, vec3 d) {
  return vec3(picture(c, is_black(d) ? vec2(0.0f) : direction_to_latlong(safe_normalize(d))));
}
vec3 look_mirror_ball(const Context& c, vec3 d) {
  d = safe_normalize(d);
  d.y -= 1.0f;
  const float scale = 2.0f * std::sqrt(std::max(-0.5f * d.y, 0.0f));
  d = scale > 0.0f ? d / scale : d;
  return vec3(picture(c, 0.5f * (vec2(d.x, d.z) + 1.0f)));
}

void emit_environment(NodeEmitter& e) {
  const auto texture = add_texture(e, Extension::Repeat);
  if (!texture) {
    return;
  }
  const bool ball = e.property("projection") == "MIRROR_BALL";
  e.output("Color", e.convert(ball ? e.emit(pure<&look_mirror_ball>, {e.input("Vector")}, *texture)
                                   : e.emit(pure<&look_lat_long>, {e.input("Vector")}, *texture),
                              Color));
}

constexpr std::string_view kInterpolations[] = {"Linear", "Closest", "Cubic", "Smart"},
                           kExtensions[] = {"REPEAT", "EXTEND", "CLIP", "MIRROR"},
                           kProjections[] = {"FLAT", "BOX", "SPHERE", "TUBE"},
                           kSkies[] = {"EQUIRECTANGULAR", "MIRROR_BALL"};
constexpr EnumDecl kImage[] = {{"interpolation", kInterpolations},
                               {"extension", kExtensions},
                               {"projection", kProjections}},
                   kEnvironment[] = {{"interpolation", kInterpolations}, {"projection", kSkies}};

}  // namespace

std::span<const NodeDecl> texture_nodes() {
  static const NodeDecl kNodes[] = {
      {"TEX_IMAGE", kImageInputs, kImageOutputs, &emit_image, nullptr, MixOp::None, kImage},
      {"TEX_ENVIRONMENT", kEnvironmentInputs, kEnvironmentOutputs, &emit_environment, nullptr,
       MixOp::None, kEnvironment},
  };
  return kNodes;
}

}  // namespace janus
