// SPDX-License-Identifier: GPL-3.0-or-later
//
// Small pictures, and whether two ways of rendering them have the same expectation.
#pragma once

#include <memory>

#include "janus/session/session.h"
#include "support/scene_kit.h"
#include "support/statistics.h"

namespace janus::test {

// 16 x 16 pixels, box filter of one pixel, all threads.
inline RenderSettings small_picture(IntegratorType integrator, int samples) {
  RenderSettings s;
  s.width = s.height = 16;
  s.samples = samples;
  s.integrator = integrator;
  s.filter = FilterType::Box;
  s.filter_width = 1.0f;
  s.max_bounces = 6;
  return s;
}

inline Image render(const std::shared_ptr<const Scene>& scene, const RenderSettings& settings) {
  RenderSession session(scene, settings);
  session.start();
  session.finish();
  return session.snapshot();
}

// Luminance of the picture (first) and of its four quarters, as means over independent seeds: the
// error bars come from the scatter between seeds, so correlations inside a picture do not matter.
inline std::vector<Mean> quarters(const std::shared_ptr<const Scene>& scene,
                                  RenderSettings settings, int count = seeds()) {
  std::vector<Mean> means(5);
  settings.seed += 1000 * (static_cast<uint32_t>(settings.integrator) + 1);
  for (int i = 0; i < count; ++i, ++settings.seed) {
    const Image image = render(scene, settings);
    double sums[5] = {};
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const float* p = &image.pixels[4 * (static_cast<size_t>(y) * image.width + x)];
        const float value = luminance(Rgb(p[0], p[1], p[2]));
        sums[0] += value;
        sums[1 + 2 * (y >= image.height / 2) + (x >= image.width / 2)] += value;
      }
    }
    const double pixels = static_cast<double>(image.width) * image.height;
    for (int k = 0; k < 5; ++k) {
      means[k].add(sums[k] / (k ? pixels / 4 : pixels));
    }
  }
  return means;
}

// With 12 seeds a side, |t| > 4.8 happens by chance once in ten thousand.
inline void expect_agreement(const std::vector<Mean>& a, const std::vector<Mean>& b,
                             double tolerance = 0.02) {
  EXPECT_GT(a[0].mean(), 0.0);
  EXPECT_TRUE(close(a[0], b[0], tolerance));
  for (size_t k = 0; k < a.size(); ++k) {
    EXPECT_TRUE(agree(a[k], b[k], 4.8)) << (k ? "quarter " + std::to_string(k) : "picture");
  }
}

// The settings against path tracing with as many as `reference` samples in a quick run.
inline void expect_as_path_traced(const SceneKit& kit, const RenderSettings& settings,
                                  int reference, double tolerance = 0.02) {
  const auto scene = kit.build();
  EXPECT_TRUE(scene->diagnostics.empty());
  RenderSettings pt = settings;
  pt.integrator = IntegratorType::PathTracer;
  pt.samples = samples(reference);
  expect_agreement(quarters(scene, settings), quarters(scene, pt), tolerance);
}

// bdpt against pt, and against lt where that sees everything. `count`: samples of bdpt and lt in a
// quick run; pt gets three times as many.
inline void expect_integrators_agree(const std::shared_ptr<const Scene>& scene, int count,
                                     bool light_tracing) {
  const auto bdpt = quarters(scene, small_picture(IntegratorType::Bdpt, samples(count)));
  expect_agreement(bdpt,
                   quarters(scene, small_picture(IntegratorType::PathTracer, samples(3 * count))));
  if (light_tracing) {
    expect_agreement(bdpt,
                     quarters(scene, small_picture(IntegratorType::LightTracer, samples(count))));
  }
}

}  // namespace janus::test
