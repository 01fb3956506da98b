// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/ashikhmin_shirley.h"

#include <algorithm>
#include <cmath>

#include "janus/math/frame.h"
#include "janus/math/pack.h"
#include "janus/math/warp.h"

namespace janus {

namespace {

// Cosine to n to the power of an exponent, which may be another one along the tangent than across.
class Power {
 public:
  Power(const Lobe& lobe, vec3 n)
      : frame_(n), x_(exponent(lobe.alpha)), y_(exponent(lobe.alpha_y)) {
    if (lobe.alpha != lobe.alpha_y) {
      const vec3 side = cross(n, unpack_direction(lobe.tangent));
      const float length = glm::length(side);
      if (length > 1e-6f) {
        frame_.t = side / length;
        frame_.s = cross(frame_.t, n);
      }
    }
  }

  // Of h per solid angle (eq. 4 and 6). The logarithm comes from the sine: narrow lobes have
  // exponents of millions.
  float density(vec3 h) const {
    const float x2 = sqr(dot(h, frame_.s)), y2 = sqr(dot(h, frame_.t));
    const float sin2 = std::min(x2 + y2, 1.0f - 0x1p-23f);
    const float log_cos = sin2 > 1e-12f ? 0.5f * std::log1p(-sin2) / sin2 : -0.5f;
    const float power = std::exp((x_ * x2 + y_ * y2) * log_cos);
    return std::sqrt((x_ + 1.0f) * (y_ + 1.0f)) * 0.5f * kInvPi * power;
  }

  // Eq. 9 and 10, in four quarters.
  vec3 sample(vec2 u) const {
    const float turns = 4.0f * u.x, quarter = std::min(std::floor(turns), 3.0f);
    const float angle = 0.5f * kPi * (turns - quarter);
    // Along and across swap from one quarter to the next.
    const bool even = quarter == 0.0f || quarter == 2.0f;
    const float ratio = std::sqrt((x_ + 1.0f) / (y_ + 1.0f));
    const vec2 c = cos_sin(angle);
    vec2 axis(c.x, (even ? ratio : 1.0f / ratio) * c.y);
    axis /= glm::length(axis);
    const vec2 turned = quarter == 0.0f   ? axis
                        : quarter == 1.0f ? vec2(-axis.y, axis.x)
                        : quarter == 2.0f ? -axis
                                          : vec2(axis.y, -axis.x);
    const float e = x_ * sqr(turned.x) + y_ * sqr(turned.y);
    const float log_cos = std::log(std::max(1.0f - u.y, 0x1p-32f)) / (e + 1.0f);
    const float sine = std::sqrt(-std::expm1(2.0f * log_cos));
    return frame_.to_world(vec3(sine * turned, std::exp(log_cos)));
  }

 private:
  static float exponent(float alpha) { return 2.0f / sqr(alpha) - 2.0f; }

  Frame frame_;
  float x_, y_;
};

}  // namespace

LobeEval evaluate_ashikhmin_shirley(const Lobe& lobe, const Directions& d, vec3 n, vec3 n_light) {
  const vec3 h = normalize(d.wo + d.wi);
  const float quarter = 0.25f / std::max(std::abs(dot(h, d.wo)), 1e-6f);
  LobeEval out;
  const float cos_o = dot(d.wo, n), cos_i = dot(d.wi, n);
  if (cos_o > 0.0f && cos_i > 0.0f) {
    const float density = quarter * Power(lobe, n).density(h);
    out.f = lobe.weight * (density * cos_i / std::max({cos_o, cos_i, 1e-6f}));
    out.pdf_radiance = out.pdf_importance = density;
  }
  if (n != n_light) {
    const bool seen = dot(d.wo, n_light) > 0.0f && dot(d.wi, n_light) > 0.0f;
    out.pdf_importance = seen ? quarter * Power(lobe, n_light).density(h) : 0.0f;
  }
  return out;
}

vec3 sample_half_vector(const Lobe& lobe, vec3 n, vec2 u) { return Power(lobe, n).sample(u); }

}  // namespace janus
