// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Principled BSDF: from the outside in, sheen, coat, metal, glass, a dielectric layer, diffuse.
#include <algorithm>

#include "janus/shading/closure_parts.h"
#include "janus/shading/facet_lobes.h"
#include "janus/shading/fresnel.h"
#include "janus/shading/thin_wall.h"

namespace janus {

namespace {

using enum SocketType;

namespace principled {
enum Input {
  BaseColor,
  Metallic,
  Roughness,
  Ior,
  Alpha,
  DiffuseRoughness,
  SpecularLevel,
  SpecularTint,
  Anisotropic,
  AnisotropicRotation,
  Tangent,
  Transmission,
  CoatWeight,
  CoatRoughness,
  CoatIor,
  CoatTint,
  CoatNormal,
  SheenWeight,
  SheenRoughness,
  SheenTint,
  EmissionColor,
  EmissionStrength,
  FilmThickness,
  FilmIor,
  SubsurfaceWeight,
  SubsurfaceRadius,
  SubsurfaceScale,
  SubsurfaceIor,
  SubsurfaceAnisotropy,
  NormalInput,
  ThinWall
};
constexpr SocketDecl kInputs[] = {{"Base Color", Color, 0.8f},
                                  {"Metallic", Float, 0.0f},
                                  {"Roughness", Float, 0.5f},
                                  {"IOR", Float, 1.5f},
                                  {"Alpha", Float, 1.0f},
                                  {"Diffuse Roughness", Float, 0.0f},
                                  {"Specular IOR Level", Float, 0.5f},
                                  {"Specular Tint", Color, 1.0f},
                                  {"Anisotropic", Float, 0.0f},
                                  {"Anisotropic Rotation", Float, 0.0f},
                                  {"Tangent", Vector, Implicit::Tangent},
                                  {"Transmission Weight", Float, 0.0f},
                                  {"Coat Weight", Float, 0.0f},
                                  {"Coat Roughness", Float, 0.03f},
                                  {"Coat IOR", Float, 1.5f},
                                  {"Coat Tint", Color, 1.0f},
                                  {"Coat Normal", Vector, 0.0f},  // 0: as Normal
                                  {"Sheen Weight", Float, 0.0f},
                                  {"Sheen Roughness", Float, 0.5f},
                                  {"Sheen Tint", Color, 1.0f},
                                  {"Emission Color", Color, 1.0f},
                                  {"Emission Strength", Float, 0.0f},
                                  {"Thin Film Thickness", Float, 0.0f},
                                  {"Thin Film IOR", Float, 1.33f},
                                  {"Subsurface Weight", Float, 0.0f},
                                  {"Subsurface Radius", Vector, vec3(1.0f, 0.2f, 0.1f)},
                                  {"Subsurface Scale", Float, 0.05f},
                                  {"Subsurface IOR", Float, 1.4f},
                                  {"Subsurface Anisotropy", Float, 0.0f},
                                  {"Normal", Vector, Implicit::Normal},
                                  {"Thin Wall", Float, 0.0f}};

// What covers all else; -1: nothing does.
int add_covers(const ClosureArguments& a, float weight, ShadingResult& out) {
  const vec3 coat_normal = a.normal(CoatNormal);
  const float coat = a.positive(CoatWeight), sheen = a.positive(SheenWeight);
  int layer = -1;
  if (sheen > kCutoff) {
    const Rgb share = sheen * a.positive_color(SheenTint);
    const vec3 between = glm::mix(a.normal(), coat_normal, std::min(coat, 1.0f));
    const float length = glm::length(between);
    layer = add_lobe(a, sheen_lobe(weight * share, a.fraction(SheenRoughness), share), out,
                     length > 0.0f ? between / length : a.normal());
  }
  if (coat > kCutoff) {
    const Lobe lobe = coat_lobe(Rgb(weight * coat), std::max(a.number(CoatIor), 1.0f),
                                sqr(a.fraction(CoatRoughness)), coat, a.positive_color(CoatTint));
    layer = add_lobe(a, lobe, out, coat_normal, layer);
  }
  return layer;
}

// The index of the specular layer: the level moves it away from the IOR's.
float layer_index(float ior, float level, float f0) {
  if (level == 0.5f) {
    return ior;
  }
  const float eta = index_from_fresnel_normal(f0);
  return ior < 1.0f ? 1.0f / eta : eta;
}

// A sheet of glass with all reflections between its sides. What goes straight through it is no lobe
// but a crossing: in Cycles, too, for all rays but the camera's.
void add_thin_glass(const ClosureArguments& a, float weight, Rgb base, float ior, float width,
                    Rgb tint, int covers, ShadingResult& out) {
  const Lobe side = glass_lobe(Rgb(1.0f), Rgb(1.0f), false, ior, 0.0f, false, tint);
  const ThinGlass glass =
      thin_glass(below_film(a, side, FilmThickness, FilmIor), base, a.seen_cosine());
  add_lobe(a, glossy_lobe(weight * glass.reflected, width, true, tint), out, covers);
  const Lobe through = mirrored_glossy_lobe(weight * glass.transmitted, thin_width(width, ior));
  if (is_delta(through)) {
    out.transparency += through.weight * a.seen_through(out, covers);
  } else {
    add_lobe(a, through, out, covers);
  }
}

// A sheet of dense scattering matter: light comes out on both sides.
void add_thin_subsurface(const ClosureArguments& a, Rgb weight, Rgb albedo, int layer,
                         ShadingResult& out) {
  const float forward = std::clamp(0.5f + 0.5f * a.number(SubsurfaceAnisotropy), 0.0f, 1.0f);
  const float rough = a.fraction(DiffuseRoughness);
  add_lobe(a, rough_diffuse((1.0f - forward) * weight, albedo, rough), out, layer);
  add_lobe(a, rough_translucent_lobe(forward * weight, albedo, rough), out, layer);
}

// Cycles mixes from the outside in: alpha, the covers, metallic, transmission, and a dielectric
// layer over diffuse. Each takes its part of the weight that the ones before have left.
void add(const ClosureArguments& a, ShadingResult& out) {
  const float alpha = a.fraction(Alpha);
  out.transparency += Rgb(a.share() * (1.0f - alpha));
  float weight = a.share() * alpha;
  const int covers = add_covers(a, weight, out);
  out.emission += weight * a.seen_through(out, covers) * a.positive_color(EmissionColor) *
                  a.positive(EmissionStrength);

  const Rgb base = a.positive_color(BaseColor), clamped = glm::min(base, Rgb(1.0f));
  const Rgb tint = a.positive_color(SpecularTint);
  const float ior = usable_index(a.number(Ior)), width = sqr(a.fraction(Roughness));
  const FacetWidths widths = stretched_widths(a, width, Anisotropic, Tangent, AnisotropicRotation);

  const auto filmed = [&](const Lobe& lobe) { return below_film(a, lobe, FilmThickness, FilmIor); };
  const float metallic = a.fraction(Metallic);
  if (metallic > kCutoff) {
    add_lobe(a, filmed(metal_lobe(Rgb(weight * metallic), clamped, widths, a.multiscatter(), tint)),
             out, covers);
    weight *= 1.0f - metallic;
  }
  const bool thin = std::abs(a.number(ThinWall)) >= 1.0f;  // a whole number in Cycles
  const float transmission = a.fraction(Transmission);
  if (transmission > kCutoff) {
    if (thin) {
      add_thin_glass(a, weight * transmission, clamped, ior, width, tint, covers, out);
    } else {
      add_lobe(a,
               filmed(glass_lobe(Rgb(weight * transmission), glm::sqrt(clamped), false, ior, width,
                                 a.multiscatter(), tint)),
               out, covers);
    }
    weight *= 1.0f - transmission;
  }
  if (weight == 0.0f) {
    return;
  }
  const float level = a.positive(SpecularLevel);
  const float f0 = level == 0.5f ? fresnel_normal(ior) : 2.0f * level * fresnel_normal(ior);
  const float eta = layer_index(ior, level, f0);
  int layer = covers;
  const Lobe specular =
      filmed(specular_lobe(Rgb(weight), eta, f0 * tint, widths, a.multiscatter()));
  if (eta != 1.0f || film(specular).exists()) {
    layer = add_lobe(a, specular, out, covers);
  }
  const float subsurface = a.fraction(SubsurfaceWeight);
  if (subsurface > 0.0f && thin) {
    add_thin_subsurface(a, subsurface * weight * clamped, clamped, layer, out);
    weight *= 1.0f - subsurface;
  } else if (subsurface > 0.0f) {
    const bool skin = a.setting(1) == static_cast<int>(SubsurfaceMethod::Skin);
    add_subsurface(a, 1, subsurface * weight * clamped, clamped,
                   glm::max(a.number(SubsurfaceScale) * a.vector(SubsurfaceRadius), Rgb(0.0f)),
                   a.number(SubsurfaceAnisotropy), skin ? a.number(SubsurfaceIor) : eta, width, out,
                   layer);
    weight *= 1.0f - subsurface;
  }
  add_lobe(a, rough_diffuse(weight * base, base, a.fraction(DiffuseRoughness)), out, layer);
}

void check(const NodeReader& node) {
  const bool thin = !node.link("Thin Wall") && std::abs(node.number("Thin Wall")) >= 1.0f;
  if (!thin && node.property("subsurface_method", "") == "BURLEY" &&
      (node.link("Subsurface Weight") || node.number("Subsurface Weight") > 0.0f)) {
    node.warn("the subsurface method BURLEY is not supported; a random walk is used");
  }
}

}  // namespace principled

}  // namespace

const ClosureDecl kPrincipledClosure{
    &principled::add,
    {.emits = true,
     .transparent = true,
     .transmits = true,
     .lobes = 8,
     .emission = {principled::EmissionStrength, 0.0f},
     .alpha = {principled::Alpha, 1.0f},
     .transmission = {principled::Transmission, 0.0f},
     .anisotropy = {principled::Anisotropic, 0.0f},
     .thin_wall = {principled::ThinWall, 0.0f},
     .parts = {{principled::Metallic, 0.0f},
               {principled::Transmission, 0.0f},
               {principled::SubsurfaceWeight, 0.0f},
               {principled::SubsurfaceWeight, 0.0f}},
     .covers = {{principled::CoatWeight, 0.0f}, {principled::SheenWeight, 0.0f}}},
    &principled::check};

const std::span<const SocketDecl> kPrincipledInputs(principled::kInputs);

}  // namespace janus
