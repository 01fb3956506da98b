// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/subsurface.h"

#include "janus/math/frame.h"
#include "janus/math/warp.h"
#include "janus/shading/microfacet.h"

namespace janus {

namespace {

// --- Albedo and radius ---------------------------------------------------------------------------

// Single scattering albedo for the albedo of the surface: the fit of Chiang et al., extended to
// anisotropic scattering. The numbers are Cycles' (Apache-2.0).
float chiang_albedo(float albedo, float g) {
  const auto fit = [g](const float (&c)[8]) {
    float sum = 0.0f;
    for (int i = 7; i >= 0; --i) {
      sum = sum * g + c[i];
    }
    return sum;
  };
  static constexpr float kA[8] = {1.8260523782f,   -1.28451056436f, -1.79904629312f,
                                  9.19393289202f,  -22.8215585862f, 32.0234874259f,
                                  -23.6264803333f, 7.21067002658f};
  static constexpr float kB[8] = {
      0.0f,           31.1491581433f,  -201.847017512f, 841.576016723f, -2018.09288505f,
      2731.71560286f, -1935.41424244f, 559.009054474f};
  static constexpr float kC[8] = {1.09686102424f,  -0.394704063468f, 1.05258115941f,
                                  -8.83963712726f, 28.8643230661f,   -46.8802913581f,
                                  38.5402837518f,  -12.7181042538f};
  static constexpr float kD[8] = {0.496310210422f, 0.360146581622f, -2.15139309747f,
                                  17.8896899217f,  -55.2984010333f, 82.065982243f,
                                  -58.5106008578f, 15.8478295021f};
  static constexpr float kE[8] = {
      0.0f,           76.7316253952f,  -594.356773233f, 2448.8834203f, -5576.68528998f,
      7116.60171912f, -4763.54467887f, 1303.5318055f};
  static constexpr float kF[8] = {2.40602999408f, -2.51814844609f, 9.18494908356f, -79.2191708682f,
                                  259.082868209f, -403.613804597f, 302.85712436f,  -87.4370473567f};
  const float b = 4.98511194385f + 0.127355959438f * std::exp(fit(kB));
  const float e = 4.23190299701f + 0.00310603949088f * std::exp(fit(kE));
  const float blend = std::pow(albedo, 0.25f);
  return (1.0f - blend) * fit(kA) * std::pow(std::atan(b * albedo), fit(kC)) +
         blend * fit(kD) * std::pow(std::atan(e * albedo), fit(kF));
}

// The same by d'Eon, "A Hitchhiker's Guide to Multiple Scattering", v0.3.2, eq. 53.7, with van de
// Hulst's similarity.
float deon_albedo(float albedo, float g) {
  const float s2 = sqr(4.20863f * albedo -
                       std::sqrt(9.59217f + 41.6808f * albedo + 17.7126f * sqr(albedo)) + 4.09712f);
  const float rest = 1.0f - g * s2;
  return rest != 0.0f ? (1.0f - s2) / rest : 0.0f;
}

// The reduced albedo whose dipole (Jensen et al. 2001) has the diffuse reflectance `rd`.
float dipole_albedo(float rd, float four_thirds_a) {
  if (rd < 1e-4f) {
    return 0.0f;
  }
  if (rd >= 0.995f) {
    return 0.999999f;
  }
  float low = 0.0f, high = 1.0f, middle = 0.5f;
  for (int i = 0; i < 12; ++i) {
    middle = 0.5f * (low + high);
    const float s = std::sqrt(3.0f * (1.0f - middle));
    const float reflected = 0.5f * middle * (1.0f + std::exp(-four_thirds_a * s)) * std::exp(-s);
    (reflected < rd ? low : high) = middle;
  }
  return middle;
}

// Skin keeps the width of its blur whatever the albedo.
Rgb skin_radius_scale(Rgb albedo, float ior) {
  const float inverse = 1.0f / ior;
  const float f_dr = inverse * (-1.440f * inverse + 0.710f) + 0.668f + 0.0636f * ior;
  const float four_thirds_a = (4.0f / 3.0f) * (1.0f + f_dr) / (1.0f - f_dr);
  Rgb scale;
  for (int c = 0; c < 3; ++c) {
    scale[c] = std::sqrt(3.0f * (1.0f - dipole_albedo(albedo[c], four_thirds_a)));
  }
  return scale;
}

SubsurfaceMethod method(const Lobe& lobe) { return static_cast<SubsurfaceMethod>(lobe.tangent); }

// --- Henyey and Greenstein -----------------------------------------------------------------------

float phase(float cos, float g) {
  if (std::abs(g) < 1e-3f) {
    return 0.25f * kInvPi;
  }
  const float x = 1.0f + sqr(g) - 2.0f * g * cos;
  return (1.0f - sqr(g)) * 0.25f * kInvPi / std::max(1e-7f, x * std::sqrt(x));
}

float sample_phase_cosine(float g, float u) {
  if (std::abs(g) < 1e-3f) {
    return 1.0f - 2.0f * u;
  }
  const float k = (1.0f - sqr(g)) / (1.0f - g + 2.0f * g * u);
  return std::clamp((1.0f + sqr(g) - sqr(k)) / (2.0f * g), -1.0f, 1.0f);
}

vec3 around(vec3 axis, float cos, float u) {
  const float r = std::sqrt(std::max(0.0f, 1.0f - sqr(cos)));
  return normalize(Frame(axis).to_world(vec3(r * cos_sin(2.0f * kPi * u), cos)));
}

}  // namespace

Lobe subsurface_lobe(SubsurfaceMethod method, Rgb weight, Rgb albedo, Rgb radius, float anisotropy,
                     float ior, float alpha) {
  const bool skin = method == SubsurfaceMethod::Skin;
  Lobe out = diffuse_lobe(weight);
  out.type = LobeType::Subsurface;
  out.tangent = static_cast<uint32_t>(method);
  out.color = albedo;
  out.sigma = method == SubsurfaceMethod::RandomWalk ? std::clamp(anisotropy, -0.99f, 0.99f)
                                                     : std::clamp(anisotropy, 0.0f, 0.9f);
  out.ior = std::clamp(ior, 1.01f, 3.8f);
  out.alpha = out.alpha_y = skin ? 1.0f : std::clamp(alpha, 0.0f, 1.0f);
  // The first factor makes the blur as wide as that of older models.
  out.edge = radius * (skin ? skin_radius_scale(albedo, out.ior) : Rgb(0.25f * kInvPi));
  return out;
}

// --- The ends ------------------------------------------------------------------------------------

std::optional<vec3> sample_entry(const Lobe& lobe, vec3 n, vec3 wo, vec2 u) {
  if (method(lobe) == SubsurfaceMethod::Skin) {
    if (u.x < 0.5f) {
      return Frame(-n).to_world(square_to_cosine_hemisphere(vec2(2.0f * u.x, u.y)));
    }
    u.x = 2.0f * (u.x - 0.5f);
  }
  if (!(dot(n, wo) > 0.0f)) {
    return std::nullopt;
  }
  const vec3 h = lobe.alpha > 0.0f ? Facets(lobe, n).sample_visible(wo, u) : n;
  const float eta = 1.0f / lobe.ior, cos_h = dot(h, wo);
  const float cos_below = std::sqrt(std::max(1.0f - sqr(eta) * (1.0f - sqr(cos_h)), 1e-14f));
  return normalize(-eta * wo + (eta * cos_h - cos_below) * h);
}

float entry_density(const Lobe& lobe, vec3 n, vec3 wo, vec3 below) {
  const bool skin = method(lobe) == SubsurfaceMethod::Skin;
  const float diffuse = skin ? std::max(-dot(n, below), 0.0f) * kInvPi : 0.0f;
  float refracted = 0.0f;
  const float cos_o = dot(n, wo);
  if (cos_o > 0.0f) {
    // Half vector of a refraction (Walter et al. 2007, eq. 16 and 17).
    const vec3 sum = -(wo + lobe.ior * below);
    const float length = glm::length(sum);
    const vec3 h = sum / length;
    const float h_o = dot(h, wo), h_below = dot(h, below);
    if (length > 0.0f && dot(h, n) > 0.0f && h_o > 0.0f && h_below < 0.0f) {
      const Facets facets(lobe, n);
      refracted = facets.distribution(h) * h_o / (cos_o * (1.0f + facets.lambda(wo, cos_o))) *
                  sqr(lobe.ior) * std::abs(h_below) / sqr(length);
    }
  }
  return skin ? 0.5f * (diffuse + refracted) : refracted;
}

const Lobe* light_passage(std::span<const Lobe> lobes) {
  constexpr float kSmooth = 1e-4f;  // facets' width below which the entry is one direction
  const Lobe* found = nullptr;
  for (const Lobe& lobe : lobes) {
    if (lobe.type == LobeType::Subsurface) {
      if (found || lobe.alpha < kSmooth || lobe.sigma != 0.0f) {
        return nullptr;
      }
      found = &lobe;
    }
  }
  return found;
}

// --- Between them --------------------------------------------------------------------------------

SubsurfaceMedium::SubsurfaceMedium(const Lobe& lobe) {
  // Darker media than this are made of it, and dimmed: their walks would be singular.
  constexpr float kLeastAlbedo = 0.2f, kMostAlbedo = 0.999999f;
  const float g = lobe.sigma;
  const bool deon = method(lobe) == SubsurfaceMethod::RandomWalk;
  Rgb sigma_t = 1.0f / glm::max(lobe.edge, Rgb(1e-16f));
  if (!deon) {
    sigma_t /= 1.0f - g;
  }
  for (int c = 0; c < 3; ++c) {
    const float albedo = std::max(lobe.color[c], 0.0f);
    const float single =
        std::clamp(deon ? deon_albedo(albedo, g) : chiang_albedo(albedo, g), 0.0f, kMostAlbedo);
    albedo_[c] = std::max(single, kLeastAlbedo);
    scale_[c] = albedo > 0.0f ? std::min(single / kLeastAlbedo, 1.0f) / albedo : 0.0f;
  }
  const Rgb sigma_s = albedo_ * sigma_t;
  const float guided = 1.0f - std::max(0.5f, std::pow(std::abs(g), 0.125f));
  levels_[0] = {sigma_t, sigma_s, g, guided};
  levels_[1] = {sigma_t - g * sigma_s, (1.0f - g) * sigma_s, 0.0f, 0.75f};
  // d'Eon and Krivanek, "Zero-Variance Theory for Efficient Subsurface Scattering" (2020), eq. 67,
  // for the brightest channel.
  const float a = max_component(albedo_);
  const float decay = std::pow(a, 2.44294f - 0.0215813f * a + 0.578637f / a);
  diffusion_length_ = 1.0f / std::sqrt(1.0f - decay);
  phase_log_ = std::log((diffusion_length_ + 1.0f) / (diffusion_length_ - 1.0f));
}

Rgb SubsurfaceWalker::channel_pmf() const {
  const Rgb share = throughput_ * medium_.albedo_;
  const float sum = share.x + share.y + share.z;
  return sum > 0.0f && std::isfinite(sum) ? share / sum : Rgb(1.0f / 3.0f);
}

SubsurfaceWalker::Segment SubsurfaceWalker::sample(vec3 previous, float u_channel, float u_length,
                                                   float u_guide, vec2 u) const {
  const SubsurfaceMedium::Level& level = medium_.level(step_);
  const Rgb pmf = channel_pmf();
  const int channel = u_channel < pmf.x ? 0 : u_channel < pmf.x + pmf.y || pmf.z == 0.0f ? 1 : 2;
  float sigma_t = level.sigma_t[channel];
  vec3 direction = previous;
  if (step_ > 0 && u_guide < level.guided) {
    // Towards the surface, and straighter (Krivanek & d'Eon 2014; Meng et al. 2016, eq. 10).
    const float v = medium_.diffusion_length_;
    const float cos = v - (v + 1.0f) * std::exp(-u.x * medium_.phase_log_);
    direction = around(normal_, std::clamp(cos, -1.0f, 1.0f), u.y);
    sigma_t *= 1.0f - dot(direction, normal_) / v;
  } else if (step_ > 0) {
    direction = around(previous, sample_phase_cosine(level.anisotropy, u.x), u.y);
  }
  return {direction, -std::log1p(-u_length) / sigma_t};
}

SubsurfaceWalker::Step SubsurfaceWalker::advance(const Segment& segment, bool arrived) {
  const SubsurfaceMedium::Level& level = medium_.level(step_);
  const Rgb pmf = channel_pmf();
  // Density of a distance to scatter at, or probability of getting as far as the surface.
  const auto along = [&](float stretch) {
    const Rgb sigma = stretch * level.sigma_t;
    const Rgb through = glm::exp(-segment.length * sigma);
    return arrived ? through : sigma * through;
  };
  const Rgb through = glm::exp(-segment.length * level.sigma_t);
  Step step{arrived ? through : level.sigma_s * through,
            dot(pmf, arrived ? through : level.sigma_t * through)};
  if (step_ > 0) {
    const float scattered = phase(dot(previous_, segment.direction), level.anisotropy);
    const float cos = dot(segment.direction, normal_), v = medium_.diffusion_length_;
    const float guided = 0.5f * kInvPi / ((v - cos) * medium_.phase_log_);  // Meng et al., eq. 9
    step.value *= scattered;
    step.pdf = (1.0f - level.guided) * scattered * step.pdf +
               level.guided * guided * dot(pmf, along(1.0f - cos / v));
  }
  if (step.pdf > 0.0f) {
    throughput_ *= step.value / step.pdf;
  }
  previous_ = segment.direction;
  ++step_;
  return step;
}

}  // namespace janus
