// SPDX-License-Identifier: GPL-3.0-or-later
//
// The choice of an emitter: a probability for each receiver, the same forwards and backwards, and
// above zero wherever light can go.
#include "janus/light/light_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "janus/light/lamp_index.h"
#include "light/light_cases.h"

namespace janus::test {
namespace {

// All kinds of lights in a space of side 8.
SceneKit many_lights(int count, uint64_t seed, bool infinite) {
  SceneKit kit;
  Random random(seed);
  const auto place = [&] { return vec3(random.in(-4, 4), random.in(-4, 4), random.in(-4, 4)); };
  for (int i = 0; i < count; ++i) {
    const std::string name = "lamp" + std::to_string(i);
    const float watts = std::exp(random.in(-3, 4)), size = std::exp(random.in(-3, 0.5f));
    const vec3 from = place(), to = from + random.direction();
    switch (i % 5) {
      case 0:
        kit.light(name, point_light(from, watts, i % 2 ? size : 0.0f, i % 3 == 0));
        break;
      case 1:
        kit.light(name, spot_light(from, to, watts, random.in(0.1f, 3), random.next(),
                                   i % 2 ? size : 0.0f, i % 3 == 0));
        break;
      case 2:
        kit.light(name, area_light(from, to, size, watts, i % 2 ? kPi : random.in(0.1f, 3)));
        break;
      case 3: {
        LightDesc desc = spot_light(from, to, watts, random.in(0.1f, 3), 0.2f);
        desc.transform = desc.transform * scaling({random.in(0.3f, 3), random.in(0.3f, 3), 1}) *
                         sheared(2, 0, random.in(-1, 1));
        kit.light(name, desc);
        break;
      }
      default:
        kit.add(name, ball(1, 6), emission(Rgb(1), watts), look_at(from, to) * scaling(vec3(size)));
    }
  }
  if (infinite) {
    kit.light("sun", sun_light({1, 2, 3}, 1, 0.3f)).light("sun2", sun_light({-1, 2, -3}, 2, 0));
    kit.world(sky(), 0.1f);
  }
  return kit;
}

void for_each_emitter(const Scene& scene, const std::function<void(size_t, uint32_t)>& f) {
  for (size_t i = 0; i < scene.lights.size(); ++i) {
    for (uint32_t k = 0; k < scene.lights[i]->emitters().size(); ++k) {
      f(i, k);
    }
  }
}

struct SamplerCase {
  int count;
  bool infinite;
};

class Choice : public ::testing::TestWithParam<SamplerCase> {
 protected:
  Receiver receiver() {
    return {vec3(random_.in(-5, 5), random_.in(-5, 5), random_.in(-5, 5)), random_.direction(),
            random_.next() < 0.5f};
  }
  const std::shared_ptr<const Scene> scene_ =
      many_lights(GetParam().count, 5, GetParam().infinite).build();
  const LightSampler& sampler_ = scene_->light_sampler;
  Random random_{21};
};

TEST_P(Choice, ProbabilitiesSumToOne) {
  for (int i = 0; i < 300; ++i) {
    const Receiver r = receiver();
    const Receiver flipped{r.p, r.two_sided ? -r.n : r.n, r.two_sided};
    double sum = 0;
    for_each_emitter(*scene_, [&](size_t light, uint32_t k) {
      const float pmf = sampler_.pmf_illumination(r, light, k);
      sum += pmf;
      EXPECT_EQ(pmf, sampler_.pmf_illumination(flipped, light, k));
    });
    ASSERT_NEAR(sum, 1, 1e-5);
  }
}

// To the last bit: weights of both walks rely on it.
TEST_P(Choice, SampledAndAskedForIsTheSame) {
  for (int i = 0; i < 3000; ++i) {
    const Receiver r = receiver();
    const LightChoice c = sampler_.sample_illumination(r, random_.next());
    EXPECT_GT(c.pmf, 0.0f);
    EXPECT_EQ(c.pmf, sampler_.pmf_illumination(r, c.light, c.primitive));
  }
  for (const float u : {0.0f, 0x1.fffffep-1f}) {
    const Receiver r = receiver();
    const LightChoice c = sampler_.sample_illumination(r, u);
    EXPECT_EQ(c.pmf, sampler_.pmf_illumination(r, c.light, c.primitive));
  }
}

TEST_P(Choice, FitsItsProbabilities) {
  for (int i = 0; i < 4; ++i) {
    const Receiver r = receiver();
    const int n = 20000;
    std::vector<std::vector<double>> counts(scene_->lights.size());
    for (size_t light = 0; light < counts.size(); ++light) {
      counts[light].resize(scene_->lights[light]->emitters().size());
    }
    for (int k = 0; k < n; ++k) {
      const LightChoice c = sampler_.sample_illumination(r, random_.next());
      ++counts[c.light][c.primitive];
    }
    std::vector<double> seen, expected;
    for_each_emitter(*scene_, [&](size_t light, uint32_t k) {
      seen.push_back(counts[light][k]);
      expected.push_back(n * sampler_.pmf_illumination(r, light, k));
    });
    EXPECT_LT(chi_square_z(seen, expected), 4.0);
  }
}

// What can light a receiver is never left out, and seldom far less likely than it ought to be.
TEST_P(Choice, ReachesAllThatShines) {
  int reached = 0;
  for (int i = 0; i < 250; ++i) {
    const Receiver r = receiver();
    for_each_emitter(*scene_, [&](size_t light, uint32_t k) {
      const Light& l = *scene_->lights[light];
      if (!(l.emitters()[k].strength > 0.0f)) {
        EXPECT_EQ(sampler_.pmf_illumination(r, light, k), 0.0f);
        return;
      }
      for (int j = 0; j < 4; ++j) {
        const auto s = l.sample_illumination(r.p, k, random_.next_2d());
        const float cosine = s ? dot(s->wi, r.n) : 0.0f;
        if (s && (r.two_sided ? cosine != 0 : cosine > 0)) {
          ++reached;
          ASSERT_GT(sampler_.pmf_illumination(r, light, k), 0.0f) << l.name << " " << k;
        }
      }
    });
  }
  EXPECT_GT(reached, 200);
}

INSTANTIATE_TEST_SUITE_P(Lights, Choice,
                         ::testing::Values(SamplerCase{1, false}, SamplerCase{2, false},
                                           SamplerCase{5, false}, SamplerCase{40, false},
                                           SamplerCase{0, true}, SamplerCase{30, true}),
                         [](const auto& info) {
                           return std::to_string(info.param.count) +
                                  (info.param.infinite ? "_with_infinite" : "");
                         });

// Near a lamp of a long row, behind a lamp, and next to a strong one that looks away.
TEST(LightSampler, PrefersWhatShinesThere) {
  SceneKit row;
  for (int i = 0; i < 100; ++i) {
    row.light("lamp" + std::to_string(100 + i), point_light({i, 0, 0}, 1));
  }
  const auto scene = row.build();
  const auto pmf = [](const Scene& s, vec3 p, vec3 n, size_t light) {
    return s.light_sampler.pmf_illumination({p, n, false}, light, 0);
  };
  EXPECT_GT(pmf(*scene, {70, 0, -0.2f}, {0, 0, 1}, 70), 0.6f);
  EXPECT_EQ(pmf(*scene, {50.5f, 0, 0}, {1, 0, 0}, 20), 0.0f);

  const auto away = SceneKit()
                        .light("a", area_light({0, 0, 1}, {0, 0, 2}, 0.1f, 1000))
                        .light("b", area_light({1, 0, 1}, {0, 0, 0}, 0.1f, 1))
                        .build();
  EXPECT_EQ(pmf(*away, vec3(0), {0, 0, 1}, 0), 0.0f);
  EXPECT_EQ(pmf(*away, vec3(0), {0, 0, 1}, 1), 1.0f);
}

// The estimates are worth having: for the median receiver, the variance of the irradiance over the
// choices is far smaller than with a choice by strength.
TEST(LightSampler, LowersTheVariance) {
  const auto scene = many_lights(60, 8, false).build();
  Random random(31);
  std::vector<double> by_tree, by_strength;
  double strength = 0;
  for_each_emitter(*scene, [&](size_t light, uint32_t k) {
    strength += scene->lights[light]->emitters()[k].strength;
  });
  for (int i = 0; i < 100; ++i) {
    const Receiver r{vec3(random.in(-4, 4), random.in(-4, 4), random.in(-4, 4)), random.direction(),
                     false};
    double total = 0, tree = 0, plain = 0;
    for_each_emitter(*scene, [&](size_t light, uint32_t k) {
      const Light& l = *scene->lights[light];
      const auto s = l.sample_illumination(r.p, k, vec2(0.5f));
      const double e = s ? std::max(0.0f, dot(s->wi, r.n)) * s->radiance.x / s->pdf_solid : 0.0;
      if (e > 0) {
        total += e;
        tree += e * e / scene->light_sampler.pmf_illumination(r, light, k);
        plain += e * e * strength / l.emitters()[k].strength;
      }
    });
    if (total > 0) {
      by_tree.push_back(tree / (total * total) - 1);
      by_strength.push_back(plain / (total * total) - 1);
    }
  }
  ASSERT_GT(by_tree.size(), 50u);
  const auto median = [](std::vector<double>& v) {
    std::nth_element(v.begin(), v.begin() + v.size() / 2, v.end());
    return v[v.size() / 2];
  };
  const double tree = median(by_tree), plain = median(by_strength);
  EXPECT_LT(tree, 0.3 * plain) << tree << " " << plain;
}

TEST(LightSampler, EmissionAndTheWorldOfOneColour) {
  const auto scene = SceneKit()
                         .add("lamp", plane(1, 1), emission(Rgb(1), 1))
                         .light("a", point_light({0, 0, 1}, 1))
                         .light("b", point_light({0, 0, 2}, 1000))
                         .world(Rgb(1))
                         .build();
  ASSERT_EQ(scene->lights.size(), 4u);
  const Receiver receiver{vec3(0), vec3(0, 0, 1), true};
  float emission = 0;
  for (size_t i = 0; i < 4; ++i) {
    emission += scene->light_sampler.pmf_emission(i);
    EXPECT_GT(scene->light_sampler.pmf_emission(i), 0.0f);
  }
  EXPECT_FLOAT_EQ(emission, 1);
  EXPECT_EQ(scene->light_sampler.pmf_illumination(receiver, 3, 0), 0.0f);
}

// The lamps that rays meet: all that a plain loop finds, in its order, and few others.
TEST(LampIndex, FindsWhatALoopFinds) {
  for (const int count : {5, 300}) {
    const auto scene = many_lights(count, 13, true).build();
    const LampIndex index(scene->lights, scene->lamps);
    Random random(41);
    size_t asked = 0, hits = 0;
    for (int i = 0; i < 2000; ++i) {
      const vec3 origin(random.in(-5, 5), random.in(-5, 5), random.in(-5, 5));
      // Along the axes, too: there the test of a box divides by zero.
      vec3 d = random.direction();
      if (i % 10 == 0) {
        d = vec3(0.0f);
        d[i / 10 % 3] = i % 20 ? 1.0f : -1.0f;
      }
      const Ray ray{origin, d, i % 2 ? kInfinity : random.in(0.1f, 8)};
      std::vector<size_t> expected, found;
      for (const size_t lamp : scene->lamps) {
        if (scene->lights[lamp]->intersect(ray)) {
          expected.push_back(lamp);
        }
      }
      index.for_each_on_ray(ray, [&](size_t lamp) {
        ++asked;
        if (scene->lights[lamp]->intersect(ray)) {
          found.push_back(lamp);
        }
      });
      ASSERT_EQ(found, expected);
      hits += expected.size();
    }
    EXPECT_GT(hits, 1000u);
    if (count > 100) {
      EXPECT_LT(asked, 2000 * 40u);  // of more than 150
    }
  }
}

}  // namespace
}  // namespace janus::test
