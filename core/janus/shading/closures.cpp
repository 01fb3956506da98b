// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/closures.h"

#include <algorithm>

#include "janus/shading/fresnel.h"

namespace janus {

namespace {

// Below it Cycles drops a component.
constexpr float kCutoff = 1e-5f;

struct Distribution {
  float alpha;
  bool multiscatter;
};

// Width and kind of the facets of a node. Other distributions than GGX are said, where it matters.
Distribution distribution(const NodeReader& node, std::string_view fallback) {
  const float roughness = node.fraction("Roughness");
  const std::string name = node.property("distribution", fallback);
  if (name != "GGX" && name != "MULTI_GGX" && roughness > 0.0f) {
    node.warn("the distribution " + name + " is not supported yet; GGX is used");
  }
  return {sqr(roughness), name == "MULTI_GGX"};
}

void without_thin_film(const NodeReader& node) {
  if (node.number("Thin Film Thickness") > 0.0f) {
    node.warn("thin film is not supported yet; it is left out");
  }
}

// Cycles' clamp: refraction with an index of 0 is not defined.
float index_of_refraction(const NodeReader& node) { return std::max(node.number("IOR"), kCutoff); }

Lobe rough_diffuse(Rgb weight, Rgb albedo, float roughness) {
  return roughness < kCutoff ? diffuse_lobe(weight) : oren_nayar_lobe(weight, albedo, roughness);
}

Lobe glossy(const NodeReader& node, float share) {
  if (node.number("Anisotropy") != 0.0f) {
    node.warn("anisotropy is not supported yet; 0 is used");
  }
  const Distribution facets = distribution(node, "MULTI_GGX");
  const Rgb color = node.positive_color("Color");
  return glossy_lobe(share * color, facets.alpha, facets.multiscatter, color);
}

Lobe glass(const NodeReader& node, float share) {
  without_thin_film(node);
  const Distribution facets = distribution(node, "MULTI_GGX");
  return glass_lobe(Rgb(share), node.positive_color("Color"), true, index_of_refraction(node),
                    facets.alpha, facets.multiscatter);
}

// Components of later versions, each with its socket and the neutral value.
void principled_limits(const NodeReader& node) {
  const auto limit = [&](const char* socket, float neutral, const char* message) {
    if (node.color(socket) != Rgb(neutral)) {
      node.warn(message);
    }
  };
  limit("Subsurface Weight", 0.0f, "subsurface scattering is not supported yet; diffuse is used");
  limit("Coat Weight", 0.0f, "coat is not supported yet; it is left out");
  limit("Sheen Weight", 0.0f, "sheen is not supported yet; it is left out");
  limit("Anisotropic", 0.0f, "anisotropy is not supported yet; 0 is used");
  limit("Specular Tint", 1.0f, "specular tint is not supported yet; white is used");
  without_thin_film(node);
}

// Cycles mixes from the outside in: alpha, metallic, transmission, and a dielectric layer over
// diffuse. Each takes its part of the weight that the ones before have left.
Closures principled(const NodeReader& node, float share) {
  principled_limits(node);
  Closures out;
  const float alpha = node.fraction("Alpha");
  out.transparency = Rgb(share * (1.0f - alpha));
  float weight = share * alpha;
  out.emission = weight * node.positive_color("Emission Color") *
                 std::max(node.number("Emission Strength"), 0.0f);

  const Rgb base = node.positive_color("Base Color"), clamped = glm::min(base, Rgb(1.0f));
  const float ior = index_of_refraction(node);
  const Distribution facets = distribution(node, "MULTI_GGX");

  const float metallic = node.fraction("Metallic");
  if (metallic > kCutoff) {
    out.lobes.push_back(
        metal_lobe(Rgb(weight * metallic), clamped, facets.alpha, facets.multiscatter));
    weight *= 1.0f - metallic;
  }
  const float transmission = node.fraction("Transmission Weight");
  if (transmission > kCutoff) {
    out.lobes.push_back(glass_lobe(Rgb(weight * transmission), glm::sqrt(clamped), false, ior,
                                   facets.alpha, facets.multiscatter));
    weight *= 1.0f - transmission;
  }

  float eta = ior;
  const float level = std::max(node.number("Specular IOR Level"), 0.0f);
  if (level != 0.5f) {
    eta = index_from_fresnel_normal(2.0f * level * fresnel_normal(ior));
    if (ior < 1.0f) {
      eta = 1.0f / eta;
    }
  }
  Lobe diffuse = rough_diffuse(weight * base, base, node.fraction("Diffuse Roughness"));
  if (eta != 1.0f) {
    const Lobe layer = specular_lobe(Rgb(weight), eta, facets.alpha, facets.multiscatter);
    out.lobes.push_back(layer);
    diffuse = below(diffuse, layer);
  }
  out.lobes.push_back(diffuse);
  return out;
}

}  // namespace

Closures make_closures(const NodeReader& node, NodeOp op, float share) {
  Closures out;
  node.unlinked("Normal");
  switch (op) {
    case NodeOp::Diffuse: {
      const Rgb color = node.positive_color("Color");
      out.lobes.push_back(rough_diffuse(share * color, color, node.number("Roughness")));
      break;
    }
    case NodeOp::Glossy:
      out.lobes.push_back(glossy(node, share));
      break;
    case NodeOp::Glass:
      out.lobes.push_back(glass(node, share));
      break;
    case NodeOp::Refraction: {
      const Distribution facets = distribution(node, "BECKMANN");
      out.lobes.push_back(refraction_lobe(share * node.positive_color("Color"),
                                          index_of_refraction(node), facets.alpha));
      break;
    }
    case NodeOp::Translucent:
      out.lobes.push_back(translucent_lobe(share * node.positive_color("Color")));
      break;
    case NodeOp::Transparent:
      out.transparency = share * node.positive_color("Color");
      break;
    case NodeOp::Emission:
      out.emission = share * node.positive_color("Color") * std::max(node.number("Strength"), 0.0f);
      break;
    case NodeOp::Principled:
      return principled(node, share);
    case NodeOp::MixShader:
    case NodeOp::AddShader:
      break;
  }
  return out;
}

}  // namespace janus
