// SPDX-License-Identifier: GPL-3.0-or-later
//
// Light x closure x camera: path tracing, light tracing and BDPT have the same expectation for
// every combination. Here, a set of combinations in which every pair of levels meets; with
// JANUS_FULL the full product, each to a standard error of a few tenths of a percent.
//
// What one of them cannot see is not left out, but asserted to be missing:
// - pt finds no light of a point or a single direction by way of a delta surface;
// - lt finds no light that leaves a delta surface towards the camera.
// A second view, of diffuse surfaces lit by way of the delta ones, compares bdpt and lt there.
// Where lt sees a surface by a few bright samples, it is compared in the mean of the picture alone.
#include "support/matrix.h"

#include <atomic>
#include <thread>

#include "support/pictures.h"

namespace janus::test {
namespace {

const std::vector<LightLevel> kLights = light_levels();
const std::vector<ClosureLevel> kClosures = closure_levels();
const std::vector<CameraLevel> kCameras = camera_levels();
const std::array<size_t, 3> kSizes = {kLights.size(), kClosures.size(), kCameras.size()};

const LightLevel& light_of(const Combination& c) { return kLights[c.level[0]]; }
const ClosureLevel& closure_of(const Combination& c) { return kClosures[c.level[1]]; }
const CameraLevel& camera_of(const Combination& c) { return kCameras[c.level[2]]; }

std::string name(const Combination& c) {
  return light_of(c).name + " / " + closure_of(c).name + " / " + camera_of(c).name;
}

struct Pictures {
  std::vector<Mean> bdpt, pt, lt;
};

using MakeScene = SceneKit (*)(const Combination&);

// The pictures of all combinations, several at a time.
std::vector<Pictures> render_all(const std::vector<Combination>& cases, MakeScene make,
                                 bool with_pt) {
  std::vector<Pictures> out(cases.size());
  std::atomic<size_t> next{0};
  const auto work = [&] {
    for (size_t i = next++; i < cases.size(); i = next++) {
      const auto scene = make(cases[i]).build();
      EXPECT_TRUE(scene->diagnostics.empty()) << name(cases[i]);
      const auto picture = [&](IntegratorType integrator, int count) {
        const int more = integrator == IntegratorType::LightTracer ? 24 : 6;
        RenderSettings settings = small_picture(integrator, full() ? more * count : count);
        settings.max_bounces = 4;
        settings.threads = 1;
        // Errors of different combinations are independent, so that they may be pooled.
        settings.seed = 10000 * static_cast<uint32_t>(i + 1);
        return quarters(scene, settings);
      };
      out[i].bdpt = picture(IntegratorType::Bdpt, 12);
      out[i].lt = picture(IntegratorType::LightTracer, 24);
      if (with_pt) {
        out[i].pt = picture(IntegratorType::PathTracer, 20);
      }
    }
  };
  std::vector<std::thread> threads;
  for (unsigned i = 1; i < std::max(1u, std::thread::hardware_concurrency()); ++i) {
    threads.emplace_back(work);
  }
  work();
  for (std::thread& thread : threads) {
    thread.join();
  }
  return out;
}

// The mean of ratios to bdpt over many combinations. Not weighted by their errors: pictures with
// few bright samples would come out darker and seem more certain.
class Pool {
 public:
  void add(const Mean& a, const Mean& reference) {
    const double ratio = a.mean() / reference.mean();
    sum_ += ratio;
    variance_ +=
        sqr(ratio) * (sqr(a.error() / a.mean()) + sqr(reference.error() / reference.mean()));
    ++n_;
  }
  int count() const { return n_; }
  double ratio() const { return sum_ / n_; }
  double error() const { return std::sqrt(variance_) / n_; }
  double z() const { return (ratio() - 1.0) / error(); }

 private:
  static double sqr(double x) { return x * x; }
  int n_ = 0;
  double sum_ = 0.0, variance_ = 0.0;
};

std::ostream& operator<<(std::ostream& out, const Pool& pool) {
  return out << pool.ratio() << " +- " << pool.error() << " (" << pool.count() << ")";
}

// Comparisons of one integrator with bdpt, pooled over all combinations and by level.
class Comparisons {
 public:
  explicit Comparisons(std::string integrator) : integrator_(std::move(integrator)) {}

  // `outliers`: a picture may hang on few samples, and its error be unknown.
  void add(const Combination& c, const std::vector<Mean>& a, const std::vector<Mean>& bdpt,
           bool outliers = false) {
    SCOPED_TRACE(integrator_ + ": " + name(c));
    // With 12 seeds a side, |t| > 6 happens by chance once in 50000; there are 2000 of them.
    if (outliers) {
      const double off = a[0].mean() / bdpt[0].mean() - 1.0;
      EXPECT_TRUE(std::abs(off) < 0.2 || agree(a[0], bdpt[0], 6.0)) << off;
      return;
    }
    for (size_t k = 0; k < a.size(); ++k) {
      EXPECT_TRUE(agree(a[k], bdpt[k], 6.0)) << (k ? "quarter " + std::to_string(k) : "picture");
      const double z = std::abs(z_score(a[k], bdpt[k]));
      if (z > largest_z_) {
        largest_z_ = z;
        where_ = name(c);
      }
    }
    all_.add(a[0], bdpt[0]);
    for (size_t f = 0; f < 3; ++f) {
      by_level_[{f, c.level[f]}].add(a[0], bdpt[0]);
    }
  }

  void expect_agreement(double tolerance) const {
    SCOPED_TRACE(integrator_);
    EXPECT_NEAR(all_.ratio(), 1.0, tolerance);
    EXPECT_LT(all_.error(), 0.5 * tolerance);
    double largest_pooled_z = 0.0;
    for (const auto& [level, pool] : by_level_) {
      if (pool.count() < 5) {
        continue;  // hardly more than the test of the combination itself
      }
      EXPECT_LT(std::abs(pool.z()), 4.5) << name_of(level) << ": " << pool;
      largest_pooled_z = std::max(largest_pooled_z, std::abs(pool.z()));
    }
    std::cout << integrator_ << " / bdpt: " << all_ << ", largest |z| " << largest_z_ << " in "
              << where_ << ", by level " << largest_pooled_z << "\n";
  }

 private:
  static std::string name_of(std::pair<size_t, size_t> level) {
    const auto [factor, i] = level;
    return factor == 0 ? kLights[i].name : factor == 1 ? kClosures[i].name : kCameras[i].name;
  }

  std::string integrator_, where_;
  Pool all_;
  std::map<std::pair<size_t, size_t>, Pool> by_level_;
  double largest_z_ = 0.0;
};

void compare(const std::vector<Combination>& cases, double tolerance) {
  const auto pictures = render_all(
      cases, [](const Combination& c) { return stage(light_of(c), closure_of(c), camera_of(c)); },
      true);
  Comparisons pt("pt"), lt("lt");
  Pool blind_pt, blind_lt;
  for (size_t i = 0; i < cases.size(); ++i) {
    const Combination& c = cases[i];
    const Pictures& found = pictures[i];
    SCOPED_TRACE(name(c));
    if (light_of(c).delta && closure_of(c).delta) {
      EXPECT_LT(found.pt[0].mean(), found.bdpt[0].mean());  // caustics
      blind_pt.add(found.pt[0], found.bdpt[0]);
    } else {
      pt.add(c, found.pt, found.bdpt);
    }
    if (closure_of(c).delta) {
      EXPECT_LT(found.lt[0].mean(), found.bdpt[0].mean());  // reflections, what is seen through
      blind_lt.add(found.lt[0], found.bdpt[0]);
    } else {
      lt.add(c, found.lt, found.bdpt, closure_of(c).peaked);
    }
  }
  pt.expect_agreement(tolerance);
  lt.expect_agreement(tolerance);
  EXPECT_TRUE(blind_pt.count() == 0 || blind_pt.z() < -10.0) << blind_pt;
  EXPECT_LT(blind_lt.z(), -10.0) << blind_lt;
}

TEST(Matrix, SetCoversAllPairs) {
  const auto set = covering_set(kSizes);
  EXPECT_EQ(pairs(set), pairs(full_product(kSizes)));
  EXPECT_EQ(set.size(), kSizes[0] * kSizes[1]);  // no fewer can do
}

TEST(Matrix, PairwiseCoveringSet) { compare(covering_set(kSizes), 0.003); }

// The diffuse floor from above, beside the ball and lit by way of it.
SceneKit aside(const Combination& c) {
  SceneKit kit = stage(light_of(c), closure_of(c), camera_of(c));
  kit.camera({-0.87f, 0.35f, 3.0f}, {-0.87f, 0.35f, -0.55f}, 0.105f);
  return kit;
}

TEST(Matrix, CausticsOnDiffuseSurfaces) {
  std::vector<Combination> cases;
  for (const Combination& c : full_product({kSizes[0], kSizes[1], 1})) {
    if (closure_of(c).delta || closure_of(c).peaked) {
      cases.push_back(c);
    }
  }
  EXPECT_EQ(cases.size(), 7 * kSizes[0]);
  const auto pictures = render_all(cases, aside, false);
  Comparisons lt("lt");
  for (size_t i = 0; i < cases.size(); ++i) {
    lt.add(cases[i], pictures[i].lt, pictures[i].bdpt);
  }
  lt.expect_agreement(full() ? 0.006 : 0.012);
}

// --- The full product, by light and camera -------------------------------------------------------

class FullMatrix : public ::testing::TestWithParam<Combination> {};

TEST_P(FullMatrix, AllClosures) {
  std::vector<Combination> cases;
  for (const Combination& c : full_product(kSizes)) {
    if (c.level[0] == GetParam().level[0] && c.level[2] == GetParam().level[2]) {
      cases.push_back(c);
    }
  }
  EXPECT_EQ(cases.size(), kSizes[1]);
  compare(cases, 0.003);
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(FullMatrix);
INSTANTIATE_TEST_SUITE_P(Rows, FullMatrix,
                         ::testing::ValuesIn(full() ? full_product({kSizes[0], 1, kSizes[2]})
                                                    : std::vector<Combination>()),
                         [](const auto& info) {
                           return light_of(info.param).name + "_" + camera_of(info.param).name;
                         });

}  // namespace
}  // namespace janus::test
