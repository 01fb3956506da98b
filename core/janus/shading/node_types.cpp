// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/node_types.h"

namespace janus {

namespace {

using enum SocketType;

constexpr SocketDecl kDiffuse[] = {
    {"Color", Color, 0.8f}, {"Roughness", Float, 0.0f}, {"Normal", Vector, 0.0f}};
constexpr SocketDecl kGlossy[] = {{"Color", Color, 0.8f},
                                  {"Roughness", Float, 0.5f},
                                  {"Anisotropy", Float, 0.0f},
                                  {"Normal", Vector, 0.0f}};
constexpr SocketDecl kGlass[] = {{"Color", Color, 1.0f},
                                 {"Roughness", Float, 0.0f},
                                 {"IOR", Float, 1.5f},
                                 {"Normal", Vector, 0.0f},
                                 {"Thin Film Thickness", Float, 0.0f}};
constexpr SocketDecl kRefraction[] = {{"Color", Color, 1.0f},
                                      {"Roughness", Float, 0.0f},
                                      {"IOR", Float, 1.45f},
                                      {"Normal", Vector, 0.0f}};
constexpr SocketDecl kTranslucent[] = {{"Color", Color, 0.8f}, {"Normal", Vector, 0.0f}};
constexpr SocketDecl kTransparent[] = {{"Color", Color, 1.0f}};
constexpr SocketDecl kEmission[] = {{"Color", Color, 1.0f}, {"Strength", Float, 1.0f}};
constexpr SocketDecl kPrincipled[] = {{"Base Color", Color, 0.8f},
                                      {"Metallic", Float, 0.0f},
                                      {"Roughness", Float, 0.5f},
                                      {"IOR", Float, 1.5f},
                                      {"Alpha", Float, 1.0f},
                                      {"Normal", Vector, 0.0f},
                                      {"Diffuse Roughness", Float, 0.0f},
                                      {"Subsurface Weight", Float, 0.0f},
                                      {"Specular IOR Level", Float, 0.5f},
                                      {"Specular Tint", Color, 1.0f},
                                      {"Anisotropic", Float, 0.0f},
                                      {"Transmission Weight", Float, 0.0f},
                                      {"Coat Weight", Float, 0.0f},
                                      {"Sheen Weight", Float, 0.0f},
                                      {"Emission Color", Color, 1.0f},
                                      {"Emission Strength", Float, 0.0f},
                                      {"Thin Film Thickness", Float, 0.0f}};
constexpr SocketDecl kMix[] = {
    {"Fac", Float, 0.5f}, {"Shader", Closure, 0.0f}, {"Shader_001", Closure, 0.0f}};
constexpr SocketDecl kAdd[] = {{"Shader", Closure, 0.0f}, {"Shader_001", Closure, 0.0f}};

constexpr NodeDecl kNodeTypes[] = {
    {"BSDF_DIFFUSE", NodeOp::Diffuse, kDiffuse, "BSDF"},
    {"BSDF_GLOSSY", NodeOp::Glossy, kGlossy, "BSDF"},
    {"BSDF_ANISOTROPIC", NodeOp::Glossy, kGlossy, "BSDF"},
    {"BSDF_GLASS", NodeOp::Glass, kGlass, "BSDF"},
    {"BSDF_REFRACTION", NodeOp::Refraction, kRefraction, "BSDF"},
    {"BSDF_TRANSLUCENT", NodeOp::Translucent, kTranslucent, "BSDF"},
    {"BSDF_TRANSPARENT", NodeOp::Transparent, kTransparent, "BSDF"},
    {"EMISSION", NodeOp::Emission, kEmission, "Emission"},
    {"BACKGROUND", NodeOp::Emission, kEmission, "Background"},
    {"BSDF_PRINCIPLED", NodeOp::Principled, kPrincipled, "BSDF"},
    {"MIX_SHADER", NodeOp::MixShader, kMix, "Shader"},
    {"ADD_SHADER", NodeOp::AddShader, kAdd, "Shader"},
};

}  // namespace

std::span<const NodeDecl> node_types() { return kNodeTypes; }

const NodeDecl* find_node_type(std::string_view type) {
  for (const NodeDecl& decl : kNodeTypes) {
    if (decl.type == type) {
      return &decl;
    }
  }
  return nullptr;
}

}  // namespace janus
