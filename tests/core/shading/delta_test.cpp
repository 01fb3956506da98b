// SPDX-License-Identifier: GPL-3.0-or-later
//
// A delta event knows the probability with which the opposite walk takes the same way back. No
// other test sees it: the oracle of weights believes what the event says.
#include "shading/lobes.h"

namespace janus::test {
namespace {

// An event of `mode` at `from` towards `to`, found by trying.
std::optional<BsdfSample> event_towards(const BsdfView& bsdf, vec3 from, vec3 to,
                                        TransportMode mode, Random& random) {
  for (int i = 0; i < 4000; ++i) {
    const auto s = bsdf.sample(from, random.next(), random.next_2d(), mode);
    if (s && s->delta && length2(s->direction - to) < 1e-8f) {
      return s;
    }
  }
  return std::nullopt;
}

// How often the glass is chosen depends on the angle, and so on the side of a refraction.
void expect_ways_back(const Lobe& glass) {
  const Bsdf storage = make({diffuse_lobe(Rgb(0.6f)), glass});
  const BsdfView bsdf = storage.view(kNg);
  Random random(21);
  int refractions = 0, one_way = 0;
  for (int i = 0; i < 8000; ++i) {
    const bool camera = i % 2 == 0;
    const auto there = camera ? TransportMode::Radiance : TransportMode::Importance;
    const auto back = camera ? TransportMode::Importance : TransportMode::Radiance;
    const vec3 from = random.direction();
    const auto s = bsdf.sample(from, random.next(), random.next_2d(), there);
    if (!s || !s->delta || std::abs(from.z) < 0.05f || std::abs(s->direction.z) < 0.05f) {
      continue;
    }
    const auto r = event_towards(bsdf, s->direction, from, back, random);
    if (s->pdf_reverse == 0.0f) {  // at a normal turned for the camera's view: no way back
      EXPECT_FALSE(r);
      ++one_way;
      continue;
    }
    ASSERT_TRUE(r) << "the way back does not exist";
    EXPECT_NEAR(s->pdf_reverse / r->pdf_solid, 1, 2e-3);
    EXPECT_NEAR(r->pdf_reverse / s->pdf_solid, 1, 2e-3);
    refractions += s->direction.z * from.z < 0;
  }
  EXPECT_GT(refractions, 100);
  EXPECT_LT(one_way, 100);
}

const Lobe kGlass =
    placed(glass_lobe(Rgb(0.5f), Rgb(0.1f), false, 1.5f, 0.0f), normalize(vec3(0.1f, 0.05f, 1)));

TEST(Delta, BothWalksKnowEachOthersProbabilities) { expect_ways_back(kGlass); }

// Each end of a refraction sees another film.
TEST(Delta, OfFilmsToo) { expect_ways_back(with_film(kGlass, 100, 2.4f)); }

}  // namespace
}  // namespace janus::test
