// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/closures.h"

#include <algorithm>

#include "janus/shading/closure_parts.h"
#include "janus/shading/layers.h"
#include "janus/shading/rotation.h"
#include "janus/shading/scatter.h"

namespace janus {

Rgb ClosureArguments::seen_through(const ShadingResult& result, int layer) const {
  return layer < 0 || !point_
             ? Rgb(1.0f)
             : through(result.bsdf.lobes()[static_cast<size_t>(layer)], point_->ng, point_->view);
}

float ClosureArguments::seen_cosine() const {
  if (!point_) {
    return 1.0f;
  }
  const vec3 n = valid_normal(point_->facing(normal_), point_->facing(point_->ng), point_->view);
  return std::max(0.0f, dot(n, point_->view));
}

int add_lobe(const ClosureArguments& a, Lobe lobe, ShadingResult& out, vec3 normal, int layer) {
  if (is_black(lobe.weight)) {
    return -1;
  }
  lobe.normal = normal;
  lobe.bumped = normal != a.surface_normal();
  return out.bsdf.add(lobe, layer) ? out.bsdf.size() - 1 : -1;
}

FacetWidths turned_widths(const ClosureArguments& a, float alpha, float x, float y, int tangent,
                          int turns) {
  const vec3 along = a.vector(tangent), n = a.from_behind() ? -a.normal() : a.normal();
  const float angle = 2.0f * kPi * a.number(turns);
  return {alpha * x, alpha * y, angle == 0.0f ? along : axis_rotation(n, angle) * along};
}

FacetWidths stretched_widths(const ClosureArguments& a, float alpha, int anisotropy, int tangent,
                             int turns) {
  const float stretch = a.fraction(anisotropy);
  if (stretch == 0.0f) {
    return alpha;
  }
  const float aspect = std::sqrt(1.0f - 0.9f * stretch);
  return turned_widths(a, alpha, 1.0f / aspect, aspect, tangent, turns);
}

void add_subsurface(const ClosureArguments& a, int method, Rgb weight, Rgb albedo, Rgb radius,
                    float anisotropy, float ior, float alpha, ShadingResult& out, int layer) {
  Rgb flat(0.0f);
  for (int c = 0; c < 3; ++c) {
    if (radius[c] < kLeastSubsurfaceRadius) {
      flat[c] = weight[c];
      weight[c] = 0.0f;
    }
  }
  add_lobe(a, diffuse_lobe(flat), out, layer);
  add_lobe(a,
           subsurface_lobe(static_cast<SubsurfaceMethod>(a.setting(method)), weight, albedo, radius,
                           anisotropy, ior, alpha),
           out, layer);
}

Lobe of_distribution(const ClosureArguments& a, const Lobe& lobe) {
  return a.beckmann() ? with_beckmann(lobe) : lobe;
}

namespace {

using enum SocketType;

// --- The closures --------------------------------------------------------------------------------

namespace diffuse {
enum Input { Color, Roughness };
constexpr SocketDecl kInputs[] = {{"Color", SocketType::Color, 0.8f},
                                  {"Roughness", Float, 0.0f},
                                  {"Normal", Vector, Implicit::Normal}};

void add(const ClosureArguments& a, ShadingResult& out) {
  const Rgb color = a.positive_color(Color);
  add_lobe(a, rough_diffuse(a.share() * color, color, a.number(Roughness)), out);
}
}  // namespace diffuse

namespace glossy {
enum Input { Color, Roughness, Anisotropy, Rotation, Tangent };
constexpr int kAshikhminShirley = 3;  // among its distributions
constexpr SocketDecl kInputs[] = {{"Color", SocketType::Color, 0.8f},
                                  {"Roughness", Float, 0.5f},
                                  {"Anisotropy", Float, 0.0f},
                                  {"Rotation", Float, 0.0f},
                                  {"Tangent", Vector, Implicit::Tangent},
                                  {"Normal", Vector, Implicit::Normal}};

// Below 0 the facets are wide along the tangent, above it across.
FacetWidths widths(const ClosureArguments& a) {
  const float alpha = sqr(a.fraction(Roughness));
  const float anisotropy = std::clamp(a.number(Anisotropy), -0.99f, 0.99f);
  if (std::abs(anisotropy) <= 1e-4f) {
    return alpha;
  }
  const float narrow = 1.0f - std::abs(anisotropy);
  return anisotropy < 0.0f ? turned_widths(a, alpha, 1.0f / narrow, narrow, Tangent, Rotation)
                           : turned_widths(a, alpha, narrow, 1.0f / narrow, Tangent, Rotation);
}

void add(const ClosureArguments& a, ShadingResult& out) {
  const Rgb color = a.positive_color(Color);
  if (a.setting() == kAshikhminShirley) {
    add_lobe(a, ashikhmin_shirley_lobe(a.share() * color, widths(a)), out);
    return;
  }
  const Lobe lobe = glossy_lobe(a.share() * color, widths(a), a.multiscatter(), color);
  add_lobe(a, of_distribution(a, lobe), out);
}
}  // namespace glossy

namespace glass {
enum Input { Color, Roughness, Ior, NormalInput, FilmThickness, FilmIor };
constexpr SocketDecl kInputs[] = {{"Color", SocketType::Color, 1.0f},
                                  {"Roughness", Float, 0.0f},
                                  {"IOR", Float, 1.5f},
                                  {"Normal", Vector, Implicit::Normal},
                                  {"Thin Film Thickness", Float, 0.0f},
                                  {"Thin Film IOR", Float, 1.33f}};

void add(const ClosureArguments& a, ShadingResult& out) {
  const Lobe lobe =
      glass_lobe(Rgb(a.share()), a.positive_color(Color), true, usable_index(a.number(Ior)),
                 sqr(a.fraction(Roughness)), a.multiscatter());
  add_lobe(a, below_film(a, of_distribution(a, lobe), FilmThickness, FilmIor), out);
}
}  // namespace glass

namespace refraction {
enum Input { Color, Roughness, Ior };
constexpr SocketDecl kInputs[] = {{"Color", SocketType::Color, 1.0f},
                                  {"Roughness", Float, 0.0f},
                                  {"IOR", Float, 1.45f},
                                  {"Normal", Vector, Implicit::Normal}};

void add(const ClosureArguments& a, ShadingResult& out) {
  const Lobe lobe =
      refraction_lobe(a.share() * a.positive_color(Color), usable_index(a.number(Ior)),
                      sqr(a.number(Roughness)));  // Cycles clamps only the square
  add_lobe(a, of_distribution(a, lobe), out);
}
}  // namespace refraction

namespace translucent {
constexpr SocketDecl kInputs[] = {{"Color", SocketType::Color, 0.8f},
                                  {"Normal", Vector, Implicit::Normal}};

void add(const ClosureArguments& a, ShadingResult& out) {
  add_lobe(a, translucent_lobe(a.share() * a.positive_color(0)), out);
}
}  // namespace translucent

namespace transparent {
constexpr SocketDecl kInputs[] = {{"Color", SocketType::Color, 1.0f}};

void add(const ClosureArguments& a, ShadingResult& out) {
  out.transparency += a.share() * a.positive_color(0);
}
}  // namespace transparent

namespace holdout {
void add(const ClosureArguments& a, ShadingResult& out) { out.holdout += a.share(); }
}  // namespace holdout

namespace emission {
constexpr SocketDecl kInputs[] = {{"Color", SocketType::Color, 1.0f}, {"Strength", Float, 1.0f}};

void add(const ClosureArguments& a, ShadingResult& out) {
  out.emission += a.share() * a.vector(0) * a.number(1);
}
}  // namespace emission

namespace metallic {
enum Input {
  BaseColor,
  EdgeTint,
  Index,
  Extinction,
  Roughness,
  Anisotropy,
  Rotation,
  NormalInput,
  Tangent,
  FilmThickness,
  FilmIor
};
constexpr SocketDecl kInputs[] = {{"Base Color", Color, vec3(0.617f, 0.577f, 0.540f)},
                                  {"Edge Tint", Color, vec3(0.695f, 0.726f, 0.770f)},
                                  {"IOR", Vector, vec3(2.757f, 2.513f, 2.231f)},
                                  {"Extinction", Vector, vec3(3.867f, 3.404f, 3.009f)},
                                  {"Roughness", Float, 0.5f},
                                  {"Anisotropy", Float, 0.0f},
                                  {"Rotation", Float, 0.0f},
                                  {"Normal", Vector, Implicit::Normal},
                                  {"Tangent", Vector, Implicit::Tangent},
                                  {"Thin Film Thickness", Float, 0.0f},
                                  {"Thin Film IOR", Float, 1.33f}};

void add(const ClosureArguments& a, ShadingResult& out) {
  const FacetWidths widths =
      stretched_widths(a, sqr(a.fraction(Roughness)), Anisotropy, Tangent, Rotation);
  const Rgb weight(a.share());
  const bool physical = a.setting(1) == 1;
  const Lobe lobe = physical
                        ? conductor_lobe(weight, a.positive_color(Index),
                                         a.positive_color(Extinction), widths, a.multiscatter())
                        : metal_lobe(weight, a.positive_color(BaseColor), widths, a.multiscatter(),
                                     a.positive_color(EdgeTint));
  add_lobe(a, below_film(a, of_distribution(a, lobe), FilmThickness, FilmIor), out);
}
}  // namespace metallic

namespace sheen {
enum Input { Color, Roughness };
constexpr SocketDecl kInputs[] = {{"Color", SocketType::Color, 0.8f},
                                  {"Roughness", Float, 0.5f},
                                  {"Normal", Vector, Implicit::Normal}};

void add(const ClosureArguments& a, ShadingResult& out) {
  const Rgb weight = a.share() * a.positive_color(Color);
  const float roughness = a.fraction(Roughness);
  add_lobe(a, a.setting() == 0 ? sheen_lobe(weight, roughness) : velvet_lobe(weight, roughness),
           out);
}
}  // namespace sheen

namespace toon {
enum Input { Color, Size, Smooth };
constexpr SocketDecl kInputs[] = {{"Color", SocketType::Color, 0.8f},
                                  {"Size", Float, 0.5f},
                                  {"Smooth", Float, 0.0f},
                                  {"Normal", Vector, Implicit::Normal}};

void add(const ClosureArguments& a, ShadingResult& out) {
  add_lobe(a,
           toon_lobe(a.setting() == 1, a.share() * a.positive_color(Color), a.number(Size),
                     a.number(Smooth)),
           out);
}
}  // namespace toon

namespace subsurface {
enum Input { Color, Scale, Radius, Ior, Roughness, Anisotropy };
constexpr SocketDecl kInputs[] = {{"Color", SocketType::Color, 0.8f},
                                  {"Scale", Float, 0.05f},
                                  {"Radius", Vector, vec3(1.0f, 0.2f, 0.1f)},
                                  {"IOR", Float, 1.4f},
                                  {"Roughness", Float, 1.0f},
                                  {"Anisotropy", Float, 0.0f},
                                  {"Normal", Vector, Implicit::Normal}};

void add(const ClosureArguments& a, ShadingResult& out) {
  const Rgb color = a.positive_color(Color);
  add_subsurface(a, 0, a.share() * color, color,
                 glm::max(a.number(Scale) * a.vector(Radius), Rgb(0.0f)), a.number(Anisotropy),
                 a.number(Ior), a.fraction(Roughness), out);
}

void check(const NodeReader& node) {
  if (node.property("falloff", "") == "BURLEY") {
    node.warn("the method BURLEY is not supported; a random walk is used");
  }
}
}  // namespace subsurface

}  // namespace

const ClosureDecl kDiffuseClosure{&diffuse::add, {.lobes = 1}},
    kGlossyClosure{&glossy::add, {.lobes = 1, .anisotropy = {glossy::Anisotropy, 0.0f}}},
    kGlassClosure{&glass::add, {.transmits = true, .lobes = 1}},
    kRefractionClosure{&refraction::add, {.transmits = true, .lobes = 1}},
    kTranslucentClosure{&translucent::add, {.transmits = true, .lobes = 1}},
    kTransparentClosure{&transparent::add, {.transparent = true}},
    kHoldoutClosure{&holdout::add, {.holds_out = true}},
    kEmissionClosure{&emission::add, {.emits = true, .emission = {1, 0.0f}}},
    kMetallicClosure{&metallic::add, {.lobes = 1, .anisotropy = {metallic::Anisotropy, 0.0f}}},
    kSheenClosure{&sheen::add, {.lobes = 1}}, kToonClosure{&toon::add, {.lobes = 1}},
    kSubsurfaceClosure{&subsurface::add, {.lobes = 2}, &subsurface::check};

const std::span<const SocketDecl> kDiffuseInputs(diffuse::kInputs), kGlossyInputs(glossy::kInputs),
    kGlassInputs(glass::kInputs), kRefractionInputs(refraction::kInputs),
    kTranslucentInputs(translucent::kInputs), kTransparentInputs(transparent::kInputs),
    kEmissionInputs(emission::kInputs), kMetallicInputs(metallic::kInputs),
    kSheenInputs(sheen::kInputs), kToonInputs(toon::kInputs),
    kSubsurfaceInputs(subsurface::kInputs);

}  // namespace janus
