// SPDX-License-Identifier: GPL-3.0-or-later
//
// Radial Tiling: polar coordinates whose circles are polygons with rounded corners. The plane is
// cut into as many segments as there are sides; of a fraction of a side is the last one, a smaller
// one.
#include <algorithm>
#include <cmath>

#include "janus/shading/node_emitter.h"
#include "janus/shading/nodes/families.h"
#include "janus/shading/scalar.h"

namespace janus {

namespace {

using enum SocketType;

// One half of a segment, between its bisector and a corner. Lengths are measured on the polygon
// whose sides are at 1 from the middle; angles in radians.
struct Half {
  float angle;      // of the half
  float bevel;      // where the corner is rounded: so far from it
  float roundness;  // of the bevel the share that is an arc; the rest leads over to it

  float straight_angle() const { return angle - bevel; }
  float transition() const { return (1.0f - roundness) * bevel; }
  float arc() const { return roundness * bevel; }

  // How wide it is at a height on the bisector, and at a distance from the middle.
  float width_at_height(float h) const {
    return h * std::tan(straight_angle()) + transition() * (0.5f * h + 0.5f) + arc();
  }
  float width_at_distance(float d) const {
    return d * std::sin(straight_angle()) +
           transition() * (0.5f * d * std::cos(straight_angle()) + 0.5f) + arc();
  }
  // How far from the bisector a place in the bevel is, `inside` from its start towards the corner.
  float across(float distance, float inside) const {
    const float height = distance * std::cos(straight_angle());
    const float start = distance * std::sin(straight_angle());
    return start + (inside < transition()
                        ? height * inside + 0.5f * (1.0f - height) * sqr(inside) / transition()
                        : transition() * (0.5f * height - 0.5f) + inside);
  }
};

// A place: across and up its segment.
struct Tile {
  float across = 0.0f, height = 0.0f;
  float width = 0.0f;     // of half a segment, at height 1
  float rotation = 0.0f;  // of its bisector
};

// On the straight part of a side, `off` from the bisector.
Tile on_side(const Half& half, float distance, float off, bool normalize) {
  const float height = distance * std::cos(off);
  const float across = height * std::tan(std::abs(off));
  return {normalize ? across / half.width_at_height(height) : across, height};
}
// In a bevel, `off` from the corner; `radius`: how far out the polygon is there, `scale`: how high
// its side is.
Tile in_bevel(const Half& half, float distance, float off, float radius, float scale,
              bool normalize) {
  const float inside = half.bevel - std::abs(off), height = scale * distance / radius;
  float across = half.across(distance, inside);
  if (normalize) {
    const float a = half.width_at_height(height), b = half.width_at_distance(distance);
    across /= a + inside / half.bevel * (b - a);
  }
  return {across, height};
}

// From the origin in a direction to a circle around it, of which the far side counts.
float to_circle(vec2 center, float radius, float angle) {
  const float along = dot(vec2(std::cos(angle), std::sin(angle)), center);
  return along + std::sqrt(sqr(along) + sqr(radius) - dot(center, center));
}

// The corners on both sides of the last segment. They are looked at as that on the x axis.
struct LastCorner {
  Half inner, outer;
  vec2 center;
  float radius;

  LastCorner(float half_angle, float last_angle, float roundness) {
    inner = {last_angle, last_angle - std::atan((1.0f - roundness) * std::tan(last_angle)),
             roundness};
    radius = roundness * std::tan(last_angle) / std::tan(0.5f * (half_angle + last_angle));
    const float start = 1.0f / std::cos(inner.straight_angle());
    center = start * vec2(std::cos(inner.bevel), -std::sin(inner.bevel)) +
             radius * vec2(-std::cos(last_angle), std::sin(last_angle));
    const vec2 end = center + radius * vec2(std::cos(half_angle), std::sin(half_angle));
    const float bevel = std::atan(end.y / end.x);
    outer = {half_angle, bevel, 1.0f - std::tan(half_angle - bevel) / std::tan(half_angle)};
  }
};

Tile tile(vec2 p, float sides, float roundness, bool normalize) {
  constexpr float kTurn = 2.0f * kPi;
  const float distance = glm::length(p);
  const float angle = std::atan2(p.y, p.x) + (p.y < 0.0f ? kTurn : 0.0f);
  const float half_angle = kPi / sides;
  const float first = std::floor(angle / (2.0f * half_angle)) * (2.0f * half_angle);
  const float in_segment = angle - first;
  const bool whole = sides == std::floor(sides), sharp = roundness == 0.0f;
  const float last_angle = whole ? 0.0f : kPi - std::floor(sides) * half_angle;
  const float last_start = kTurn - 2.0f * last_angle;
  const float bevel =
      sharp ? 0.0f : half_angle - std::atan((1.0f - roundness) * std::tan(half_angle));
  const Half regular{half_angle, bevel, roundness};

  // The regular segments, with `half` for how wide they are here.
  const auto finish = [&](Tile t, float middle, float width) {
    t.across = in_segment < middle ? -t.across : t.across;
    t.width = width;
    t.rotation = first + middle;
    return t;
  };
  const auto on_regular_side = [&](const Half& half) {
    // Two sides have no corners.
    const bool endless = sides == 2.0f && sharp;
    return finish(on_side(half, distance, half_angle - in_segment, normalize && !endless),
                  half_angle, endless ? 0.0f : regular.width_at_height(1.0f));
  };
  const auto in_regular_bevel = [&] {
    const float off = in_segment - (in_segment > half_angle ? 2.0f * half_angle : 0.0f);
    const vec2 center((1.0f - roundness) / std::cos(half_angle), 0.0f);
    const float radius = to_circle(center, roundness, off);
    return finish(in_bevel(regular, distance, off, radius, 1.0f, normalize), half_angle,
                  regular.width_at_height(1.0f));
  };
  if (whole) {
    if (roundness == 1.0f) {  // circles
      const float across = std::abs(half_angle - in_segment);
      return finish({normalize ? across / half_angle : across, distance}, half_angle, half_angle);
    }
    const bool beveled = in_segment >= 2.0f * half_angle - bevel || in_segment < bevel;
    return !sharp && beveled ? in_regular_bevel() : on_regular_side(regular);
  }

  // The side of the last segment is farther out; it is scaled to be where the others are.
  const float scale = std::cos(half_angle) / std::cos(last_angle);
  const auto finish_last = [&](Tile t, const Half& half, float height) {
    t.across *= normalize ? 1.0f : scale;
    t.height = height;
    return finish(t, last_angle,
                  std::tan(half.straight_angle()) +
                      scale * (half.transition() * (0.5f / scale + 0.5f) + half.arc()));
  };
  const auto on_last_side = [&](const Half& half) {
    const Tile t = on_side(half, distance, last_angle - in_segment, normalize);
    return finish_last(t, half, scale * t.height);
  };
  if (sharp) {
    return angle < last_start ? on_regular_side(regular) : on_last_side({last_angle, 0.0f, 0.0f});
  }
  const LastCorner corner(half_angle, last_angle, roundness);
  if (angle >= corner.outer.bevel && angle < last_start - corner.outer.bevel) {
    const bool between = in_segment >= bevel && in_segment < 2.0f * half_angle - bevel;
    if (!between && angle < last_start - bevel && angle >= bevel) {
      return in_regular_bevel();
    }
    const bool beside = angle >= last_start - half_angle || angle < half_angle;
    return on_regular_side(beside ? corner.outer : regular);
  }
  if (angle >= last_start + corner.inner.bevel && angle < kTurn - corner.inner.bevel) {
    return on_last_side(corner.inner);
  }
  float off = std::atan2(p.y, p.x);
  if (angle >= last_start - corner.outer.bevel && angle < kTurn - last_angle) {
    off = -(off + 2.0f * last_angle);
  }
  const float radius = to_circle(corner.center, corner.radius, off);
  if (off < 0.0f) {
    const Tile t = in_bevel(corner.inner, distance, off, radius, 1.0f, normalize);
    return finish_last(t, corner.inner, scale * t.height);
  }
  return finish(in_bevel(corner.outer, distance, off, radius, scale, normalize), half_angle,
                regular.width_at_height(1.0f));
}

// `data`: 1, normalized.
Tile tile_at(const Context& c, vec3 p, float sides, float roundness) {
  Tile t = tile(vec2(p), std::max(2.0f, sides), clamp01(roundness), c.data != 0);
  if (p.x == 0.0f && p.y == 0.0f) {
    t.across = 0.0f;
  }
  if (c.data != 0) {
    t.across = 0.5f * t.across + 0.5f;
  } else {
    t.height -= 1.0f;
  }
  return t;
}

constexpr Operation kCoordinates = pure<[](const Context& c, vec3 p, float sides, float roundness) {
  const Tile t = tile_at(c, p, sides, roundness);
  return vec3(t.across, t.height, 0.0f);
}>;
constexpr Operation kWidth = pure<[](const Context& c, vec3 p, float sides, float roundness) {
  return tile_at(c, p, sides, roundness).width;
}>;
constexpr Operation kRotation = pure<[](const Context& c, vec3 p, float sides, float roundness) {
  return tile_at(c, p, sides, roundness).rotation;
}>;
constexpr Operation kNumber = pure<[](vec3 p, float sides) {
  const float turns = std::atan2(p.y, p.x) / (2.0f * kPi) + (p.y < 0.0f ? 1.0f : 0.0f);
  return std::floor(std::max(2.0f, sides) * turns);
}>;

constexpr SocketDecl kInputs[] = {
    {"Vector", Vector, 0.0f}, {"Sides", Float, 5.0f}, {"Roundness", Float, 0.0f}};
constexpr std::string_view kOutputs[] = {"Segment Coordinates", "Segment ID", "Segment Width",
                                         "Segment Rotation"};

void emit_radial_tiling(NodeEmitter& e) {
  const Value p = e.input("Vector"), sides = e.input("Sides"), roundness = e.input("Roundness");
  const uint32_t data = e.flag("normalize") ? 1 : 0;
  e.output("Segment Coordinates", e.emit(kCoordinates, {p, sides, roundness}, data));
  e.output("Segment ID", e.emit(kNumber, {p, sides}));
  e.output("Segment Width", e.emit(kWidth, {p, sides, roundness}, data));
  e.output("Segment Rotation", e.emit(kRotation, {p, sides, roundness}, data));
}

}  // namespace

std::span<const NodeDecl> radial_tiling_nodes() {
  static const NodeDecl kNodes[] = {
      {"ShaderNodeRadialTiling", kInputs, kOutputs, &emit_radial_tiling},
  };
  return kNodes;
}

}  // namespace janus
