// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/closures.h"

#include <algorithm>

#include "janus/shading/fresnel.h"
#include "janus/shading/node_reader.h"

namespace janus {

namespace {

using enum SocketType;

// Below it Cycles drops a component.
constexpr float kCutoff = 1e-5f;

void add_lobe(const ClosureArguments& a, Lobe lobe, ShadingResult& out) {
  if (!is_black(lobe.weight)) {
    lobe.normal = a.normal();
    lobe.bumped = a.bumped();
    out.bsdf.add(lobe);
  }
}

// Cycles' clamp: refraction with an index of 0 is not defined.
float usable_index(float ior) { return std::max(ior, kCutoff); }

Lobe rough_diffuse(Rgb weight, Rgb albedo, float roughness) {
  return roughness < kCutoff ? diffuse_lobe(weight) : oren_nayar_lobe(weight, albedo, roughness);
}

// --- What cannot be rendered as asked ------------------------------------------------------------

// Other distributions than GGX, where it matters.
void check_distribution(const NodeReader& node, std::string_view fallback) {
  const std::string name = node.property("distribution", fallback);
  if (name != "GGX" && name != "MULTI_GGX" &&
      (node.link("Roughness") || node.number("Roughness") > 0.0f)) {
    node.warn("the distribution " + name + " is not supported yet; GGX is used");
  }
}

constexpr LeftOut kThinFilm = {"Thin Film Thickness", 0.0f,
                               "thin film is not supported yet; it is left out"};

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
enum Input { Color, Roughness };
constexpr SocketDecl kInputs[] = {{"Color", SocketType::Color, 0.8f},
                                  {"Roughness", Float, 0.5f},
                                  {"Anisotropy", Float, 0.0f},
                                  {"Normal", Vector, Implicit::Normal}};

void add(const ClosureArguments& a, ShadingResult& out) {
  const Rgb color = a.positive_color(Color);
  add_lobe(a, glossy_lobe(a.share() * color, sqr(a.fraction(Roughness)), a.multiscatter(), color),
           out);
}

constexpr LeftOut kLeftOut[] = {{"Anisotropy", 0.0f, "anisotropy is not supported yet; 0 is used"}};

void check(const NodeReader& node) { check_distribution(node, "MULTI_GGX"); }
}  // namespace glossy

namespace glass {
enum Input { Color, Roughness, Ior };
constexpr SocketDecl kInputs[] = {{"Color", SocketType::Color, 1.0f},
                                  {"Roughness", Float, 0.0f},
                                  {"IOR", Float, 1.5f},
                                  {"Normal", Vector, Implicit::Normal},
                                  {"Thin Film Thickness", Float, 0.0f}};

void add(const ClosureArguments& a, ShadingResult& out) {
  add_lobe(a,
           glass_lobe(Rgb(a.share()), a.positive_color(Color), true, usable_index(a.number(Ior)),
                      sqr(a.fraction(Roughness)), a.multiscatter()),
           out);
}

constexpr LeftOut kLeftOut[] = {kThinFilm};

void check(const NodeReader& node) { check_distribution(node, "MULTI_GGX"); }
}  // namespace glass

namespace refraction {
enum Input { Color, Roughness, Ior };
constexpr SocketDecl kInputs[] = {{"Color", SocketType::Color, 1.0f},
                                  {"Roughness", Float, 0.0f},
                                  {"IOR", Float, 1.45f},
                                  {"Normal", Vector, Implicit::Normal}};

void add(const ClosureArguments& a, ShadingResult& out) {
  add_lobe(a,
           refraction_lobe(a.share() * a.positive_color(Color), usable_index(a.number(Ior)),
                           sqr(a.number(Roughness))),  // Cycles clamps only the square
           out);
}

void check(const NodeReader& node) { check_distribution(node, "BECKMANN"); }
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

namespace principled {
enum Input {
  BaseColor,
  Metallic,
  Roughness,
  Ior,
  Alpha,
  DiffuseRoughness,
  SpecularLevel,
  Transmission,
  EmissionColor,
  EmissionStrength
};
constexpr SocketDecl kInputs[] = {{"Base Color", Color, 0.8f},
                                  {"Metallic", Float, 0.0f},
                                  {"Roughness", Float, 0.5f},
                                  {"IOR", Float, 1.5f},
                                  {"Alpha", Float, 1.0f},
                                  {"Diffuse Roughness", Float, 0.0f},
                                  {"Specular IOR Level", Float, 0.5f},
                                  {"Transmission Weight", Float, 0.0f},
                                  {"Emission Color", Color, 1.0f},
                                  {"Emission Strength", Float, 0.0f},
                                  {"Normal", Vector, Implicit::Normal},
                                  {"Subsurface Weight", Float, 0.0f},
                                  {"Specular Tint", Color, 1.0f},
                                  {"Anisotropic", Float, 0.0f},
                                  {"Coat Weight", Float, 0.0f},
                                  {"Sheen Weight", Float, 0.0f},
                                  {"Thin Film Thickness", Float, 0.0f},
                                  {"Thin Wall", Float, 0.0f}};

// The index of the specular layer: the level moves it away from the IOR's.
float layer_index(float ior, float level, float f0) {
  if (level == 0.5f) {
    return ior;
  }
  const float eta = index_from_fresnel_normal(f0);
  return ior < 1.0f ? 1.0f / eta : eta;
}

// No index has such a reflectance, but Cycles' layer does, which then is a mirror that hides what
// is below it.
constexpr float kMirror = 0.995f;

// Cycles mixes from the outside in: alpha, metallic, transmission, and a dielectric layer over
// diffuse. Each takes its part of the weight that the ones before have left.
void add(const ClosureArguments& a, ShadingResult& out) {
  const float alpha = a.fraction(Alpha);
  out.transparency += Rgb(a.share() * (1.0f - alpha));
  float weight = a.share() * alpha;
  out.emission +=
      weight * a.positive_color(EmissionColor) * std::max(a.number(EmissionStrength), 0.0f);

  const Rgb base = a.positive_color(BaseColor), clamped = glm::min(base, Rgb(1.0f));
  const float ior = usable_index(a.number(Ior)), width = sqr(a.fraction(Roughness));

  const float metallic = a.fraction(Metallic);
  if (metallic > kCutoff) {
    add_lobe(a, metal_lobe(Rgb(weight * metallic), clamped, width, a.multiscatter()), out);
    weight *= 1.0f - metallic;
  }
  const float transmission = a.fraction(Transmission);
  if (transmission > kCutoff) {
    add_lobe(a,
             glass_lobe(Rgb(weight * transmission), glm::sqrt(clamped), false, ior, width,
                        a.multiscatter()),
             out);
    weight *= 1.0f - transmission;
  }
  if (weight == 0.0f) {
    return;
  }
  const float level = std::max(a.number(SpecularLevel), 0.0f);
  const float f0 = 2.0f * level * fresnel_normal(ior);
  if (level != 0.5f && f0 > kMirror) {
    add_lobe(a, glossy_lobe(Rgb(weight), width, a.multiscatter()), out);
    return;
  }
  const float eta = layer_index(ior, level, f0);
  Lobe diffuse = rough_diffuse(weight * base, base, a.fraction(DiffuseRoughness));
  if (eta != 1.0f) {
    const Lobe layer = specular_lobe(Rgb(weight), eta, width, a.multiscatter());
    add_lobe(a, layer, out);
    diffuse = below(diffuse, layer);
  }
  add_lobe(a, diffuse, out);
}

constexpr LeftOut kLeftOut[] = {
    {"Subsurface Weight", 0.0f, "subsurface scattering is not supported yet; diffuse is used"},
    {"Coat Weight", 0.0f, "coat is not supported yet; it is left out"},
    {"Sheen Weight", 0.0f, "sheen is not supported yet; it is left out"},
    {"Anisotropic", 0.0f, "anisotropy is not supported yet; 0 is used"},
    {"Specular Tint", 1.0f, "specular tint is not supported yet; white is used"},
    kThinFilm,
    {"Thin Wall", 0.0f, "thin walls are not supported yet; a closed surface is rendered"},
};

void check(const NodeReader& node) { check_distribution(node, "MULTI_GGX"); }
}  // namespace principled

}  // namespace

const ClosureDecl kDiffuseClosure{&diffuse::add, {.lobes = 1}},
    kGlossyClosure{&glossy::add, {.lobes = 1}, glossy::kLeftOut, &glossy::check},
    kGlassClosure{&glass::add, {.transmits = true, .lobes = 1}, glass::kLeftOut, &glass::check},
    kRefractionClosure{&refraction::add, {.transmits = true, .lobes = 1}, {}, &refraction::check},
    kTranslucentClosure{&translucent::add, {.transmits = true, .lobes = 1}},
    kTransparentClosure{&transparent::add, {.transparent = true}},
    kHoldoutClosure{&holdout::add, {.holds_out = true}},
    kEmissionClosure{&emission::add, {.emits = true, .emission = {1, 0.0f}}},
    kPrincipledClosure{&principled::add,
                       {.emits = true,
                        .transparent = true,
                        .transmits = true,
                        .lobes = 4,
                        .emission = {principled::EmissionStrength, 0.0f},
                        .alpha = {principled::Alpha, 1.0f},
                        .transmission = {principled::Transmission, 0.0f},
                        .parts = {{principled::Metallic, 0.0f}, {principled::Transmission, 0.0f}}},
                       principled::kLeftOut,
                       &principled::check};

const std::span<const SocketDecl> kDiffuseInputs(diffuse::kInputs), kGlossyInputs(glossy::kInputs),
    kGlassInputs(glass::kInputs), kRefractionInputs(refraction::kInputs),
    kTranslucentInputs(translucent::kInputs), kTransparentInputs(transparent::kInputs),
    kEmissionInputs(emission::kInputs), kPrincipledInputs(principled::kInputs);

}  // namespace janus
