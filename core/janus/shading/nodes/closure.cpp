// SPDX-License-Identifier: GPL-3.0-or-later
//
// Nodes that give closures; what they do is in closures.cpp. And AOV Output, where other trees end.
#include "janus/shading/closures.h"
#include "janus/shading/nodes/families.h"

namespace janus {

namespace {

constexpr std::string_view kBsdf[] = {"BSDF"}, kBssrdf[] = {"BSSRDF"}, kEmission[] = {"Emission"},
                           kBackground[] = {"Background"}, kShader[] = {"Shader"},
                           kHoldout[] = {"Holdout"};
constexpr SocketDecl kMix[] = {{"Fac", SocketType::Float, 0.5f},
                               {"Shader", SocketType::Closure},
                               {"Shader_001", SocketType::Closure}};
constexpr SocketDecl kAdd[] = {{"Shader", SocketType::Closure},
                               {"Shader_001", SocketType::Closure}};

constexpr SocketDecl kAov[] = {{"Color", SocketType::Color}, {"Value", SocketType::Float}};

// Glossy has one more. What Refraction does not have comes first, so that the places are the same.
constexpr std::string_view kDistributions[] = {"MULTI_GGX", "GGX", "BECKMANN"},
                           kFour[] = {"MULTI_GGX", "GGX", "BECKMANN", "ASHIKHMIN_SHIRLEY"},
                           kTwoGgx[] = {"MULTI_GGX", "GGX"};
// Items in the order of SubsurfaceMethod. Christensen-Burley is named where it matters.
constexpr std::string_view kMethods[] = {"RANDOM_WALK", "RANDOM_WALK_LEGACY", "RANDOM_WALK_SKIN"},
                           kBurley[] = {"BURLEY"};
constexpr EnumDecl kDistribution[] = {{"distribution", kDistributions}},
                   kGlossy[] = {{"distribution", kFour}},
                   kPrincipled[] = {{"distribution", kTwoGgx},
                                    {"subsurface_method", kMethods, kBurley}},
                   kSubsurface[] = {{"falloff", kMethods, kBurley}};

constexpr std::string_view kFresnelTypes[] = {"F82", "PHYSICAL_CONDUCTOR"},
                           kSheens[] = {"MICROFIBER", "ASHIKHMIN"},
                           kToons[] = {"DIFFUSE", "GLOSSY"};
constexpr EnumDecl kMetallic[] = {{"distribution", kDistributions},
                                  {"fresnel_type", kFresnelTypes}},
                   kSheen[] = {{"distribution", kSheens}}, kToon[] = {{"component", kToons}};

constexpr std::string_view kComponents[] = {"Reflection", "Transmission"},
                           kParametrizations[] = {"ABSORPTION", "MELANIN", "COLOR"},
                           kModels[] = {"CHIANG"};
// Hair of the other model looks much like this one.
constexpr EnumDecl kComponent[] = {{"component", kComponents}},
                   kPrincipledHair[] = {{"parametrization", kParametrizations}, {"model", kModels}};

}  // namespace

std::span<const NodeDecl> closure_nodes() {
  static const NodeDecl kNodes[] = {
      {"BSDF_DIFFUSE", kDiffuseInputs, kBsdf, nullptr, &kDiffuseClosure},
      {"BSDF_GLOSSY", kGlossyInputs, kBsdf, nullptr, &kGlossyClosure, MixOp::None, kGlossy},
      {"BSDF_ANISOTROPIC", kGlossyInputs, kBsdf, nullptr, &kGlossyClosure, MixOp::None, kGlossy},
      {"BSDF_GLASS", kGlassInputs, kBsdf, nullptr, &kGlassClosure, MixOp::None, kDistribution},
      {"BSDF_REFRACTION", kRefractionInputs, kBsdf, nullptr, &kRefractionClosure, MixOp::None,
       kDistribution},
      {"BSDF_TRANSLUCENT", kTranslucentInputs, kBsdf, nullptr, &kTranslucentClosure},
      {"BSDF_TRANSPARENT", kTransparentInputs, kBsdf, nullptr, &kTransparentClosure},
      {"HOLDOUT", {}, kHoldout, nullptr, &kHoldoutClosure},
      {"EMISSION", kEmissionInputs, kEmission, nullptr, &kEmissionClosure},
      {"BACKGROUND", kEmissionInputs, kBackground, nullptr, &kEmissionClosure},
      {"BSDF_PRINCIPLED", kPrincipledInputs, kBsdf, nullptr, &kPrincipledClosure, MixOp::None,
       kPrincipled},
      {"BSDF_METALLIC", kMetallicInputs, kBsdf, nullptr, &kMetallicClosure, MixOp::None, kMetallic},
      {"BSDF_SHEEN", kSheenInputs, kBsdf, nullptr, &kSheenClosure, MixOp::None, kSheen},
      {"BSDF_TOON", kToonInputs, kBsdf, nullptr, &kToonClosure, MixOp::None, kToon},
      {"SUBSURFACE_SCATTERING", kSubsurfaceInputs, kBssrdf, nullptr, &kSubsurfaceClosure,
       MixOp::None, kSubsurface},
      {"BSDF_HAIR", kHairInputs, kBsdf, nullptr, &kHairClosure, MixOp::None, kComponent},
      {"BSDF_HAIR_PRINCIPLED", kPrincipledHairInputs, kBsdf, nullptr, &kPrincipledHairClosure,
       MixOp::None, kPrincipledHair},
      {"MIX_SHADER", kMix, kShader, nullptr, nullptr, MixOp::Mix},
      {"ADD_SHADER", kAdd, kShader, nullptr, nullptr, MixOp::Add},
      {"OUTPUT_AOV", kAov, {}},
  };
  return kNodes;
}

}  // namespace janus
