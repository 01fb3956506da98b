// SPDX-License-Identifier: GPL-3.0-or-later
//
// The light transport matrix of a projector: nothing of the light is lost in it, whatever its
// blocks are.
#include "janus/session/transport.h"

#include "janus/path/oracle.h"
#include "janus/util/error.h"
#include "support/pictures.h"

namespace janus::test {
namespace {

constexpr float kAngle = 0.9f;

LightDesc projector_lamp() { return spot_light({0.4f, -2.6f, 0.3f}, {0, 0, -0.2f}, 50, kAngle, 0); }
LightDesc parallel_lamp() {
  LightDesc desc = area_light({0.2f, -1.5f, 0.4f}, {0, 0, -0.4f}, 1.2f, 50, 0);
  desc.shape = AreaShape::Rectangle;
  desc.size_y = 0.7f;
  return desc;
}

SceneKit lit(LightDesc lamp) {
  return room().light("l", std::move(lamp)).light("other", point_light({0, 0, 0.8f}, 20));
}

struct Capture {
  RenderSettings settings = small_picture(IntegratorType::Bdpt, 24);
  TransportSettings transport{"l", 12, 9, size_t{64} << 20};

  std::unique_ptr<TransportSession> run(const SceneKit& kit) const {
    auto session = std::make_unique<TransportSession>(kit.build(), settings, transport);
    session->start();
    session->finish();
    return session;
  }
};

// By camera pixel, over the projector.
std::vector<glm::dvec3> row_sums(const TransportMatrix& m, size_t pixels) {
  std::vector<glm::dvec3> sums(pixels, glm::dvec3(0.0));
  for (size_t i = 0; i < m.values.size(); ++i) {
    sums[m.pixels[i]] += m.values[i];
  }
  return sums;
}

void expect_sums_are(const Image& picture, const TransportMatrix& m) {
  const auto sums = row_sums(m, static_cast<size_t>(picture.width) * picture.height);
  double total = 0.0;
  for (size_t i = 0; i < sums.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double expected = picture.pixels[4 * i + c];
      EXPECT_NEAR(sums[i][c], expected, 1e-4 * expected + 1e-7) << i;
      total += expected;
    }
  }
  EXPECT_GT(total, 0.0);
  glm::dvec3 shares(0.0);
  for (const Rgb share : m.shares) {
    shares += share;
  }
  EXPECT_NEAR((shares.x + shares.y + shares.z) / total, 1.0, 1e-4);
}

TEST(Transport, SumsOverTheProjectorAreThePicture) {
  for (const LightDesc& lamp : {projector_lamp(), parallel_lamp()}) {
    const auto session = Capture().run(lit(lamp));
    expect_sums_are(session->snapshot(), session->matrix());
  }
}

TEST(Transport, EveryTechniqueIsCounted) {
  Capture classic, merging, unconnected;
  classic.settings.connection_mode = ConnectionMode::Classic;
  merging.settings.merge_radius = 0.1f;
  unconnected.settings.light_paths = 0.0f;
  for (const Capture& capture : {classic, merging, unconnected}) {
    const auto session = capture.run(lit(projector_lamp()));
    expect_sums_are(session->snapshot(), session->matrix());
  }
}

// Then a pass sees the scene at several times, in waves of its own.
TEST(Transport, ThingsMayMove) {
  SceneKit kit = lit(projector_lamp());
  kit.builder.set_instance_motion("low", {mat4(1.0f), translation({0.0f, 0.0f, 0.3f})});
  Capture capture;
  const auto session = capture.run(kit);
  expect_sums_are(session->snapshot(), session->matrix());
  capture.settings.motion_blur = false;
  const auto still = capture.run(kit);
  EXPECT_NE(still->matrix().shares, session->matrix().shares);
}

// A mirror sends the projector's light on: only light paths find where it arrives.
TEST(Transport, CausticsStartInTheirPixels) {
  SceneKit kit = lit(projector_lamp());
  kit.add("mirror", plane(0.7f, 0.7f), mirror(Rgb(0.9f)),
          translation({0, 0.6f, -0.1f}) * rotation({1, 0, 0}, 0.4f * kPi));
  const auto session = Capture().run(kit);
  expect_sums_are(session->snapshot(), session->matrix());
}

// The projector's picture in which one pixel shines, by a render of its own: a spot that is so
// narrow and so turned. Whatever techniques find the light, it belongs to the pixel that emits it.
TEST(Transport, ColumnsAreWhatAPixelLights) {
  Capture capture;
  capture.transport.width = capture.transport.height = 3;
  capture.settings.samples = samples(96);
  SceneKit kit = lit(projector_lamp());
  kit.add("wax", ball(0.3f), subsurface(Rgb(0.8f, 0.6f, 0.4f)), translation({0.3f, 0.2f, 0.2f}));
  const auto session = capture.run(kit);
  const TransportMatrix m = session->matrix();
  ASSERT_EQ(m.shares_size, 1);
  for (const int pixel : {4, 3, 7}) {
    ProjectorDesc one = session->projector();
    const vec2 step = (one.high - one.low) / 3.0f;
    one.low += step * vec2(pixel % 3, pixel / 3);
    one.high = one.low + step;
    one.width = one.height = 1;
    const auto scene = under_projector(kit.build(), one);
    double light = 0.0, variance = 0.0;
    for (size_t tile = 0; tile < m.shares.size() / 9; ++tile) {
      light += luminance(m.shares[9 * tile + pixel]);
      variance += luminance(m.share_variances[9 * tile + pixel]);
    }
    RenderSettings settings = capture.settings;
    settings.samples = samples(32);
    const Mean picture = quarters(scene, settings)[0];
    const double pixels = 256.0;
    const double z = (light / pixels - picture.mean()) /
                     std::hypot(std::sqrt(variance) / pixels, picture.error());
    EXPECT_LT(std::abs(z), 4.0) << light / pixels << " against " << picture.mean();
    EXPECT_LT(picture.error(), 0.02 * picture.mean());
  }
}

TEST(Transport, DoesNotDependOnThreads) {
  Capture capture;
  capture.settings.threads = 1;
  const TransportMatrix one = capture.run(lit(projector_lamp()))->matrix();
  capture.settings.threads = 3;
  const TransportMatrix three = capture.run(lit(projector_lamp()))->matrix();
  EXPECT_EQ(one.pixels, three.pixels);
  EXPECT_EQ(one.entry_blocks, three.entry_blocks);
  EXPECT_EQ(one.values, three.values);
  EXPECT_EQ(one.variances, three.variances);
  EXPECT_EQ(one.shares, three.shares);
}

TEST(Transport, NoSumDependsOnTheBlocks) {
  Capture fine, coarse;
  fine.transport.width = fine.transport.height = coarse.transport.width = coarse.transport.height =
      64;
  fine.transport.memory = size_t{256} << 20;
  coarse.transport.memory = size_t{1} << 20;
  const auto a = fine.run(lit(projector_lamp())), b = coarse.run(lit(projector_lamp()));
  const TransportMatrix m = a->matrix(), n = b->matrix();
  EXPECT_GT(m.blocks.size(), 2 * n.blocks.size());
  EXPECT_LE(n.blocks.size(), TransportSums::blocks_for(size_t{1} << 19));
  const auto fine_sums = row_sums(m, 256), coarse_sums = row_sums(n, 256);
  for (size_t i = 0; i < fine_sums.size(); ++i) {
    EXPECT_NEAR(fine_sums[i].x, coarse_sums[i].x, 1e-5 * fine_sums[i].x + 1e-9);
  }
  expect_sums_are(b->snapshot(), n);
}

// Most of the light comes straight from the projector: it is told apart by pixels.
TEST(Transport, BlocksAreSmallWhereThereIsLight) {
  Capture capture;
  capture.transport.width = capture.transport.height = 32;
  capture.settings.max_bounces = 0;
  const TransportMatrix m = capture.run(lit(projector_lamp()))->matrix();
  double small = 0.0, all = 0.0;
  for (size_t i = 0; i < m.values.size(); ++i) {
    const double value = luminance(m.values[i]);
    all += value;
    small += m.blocks[m.entry_blocks[i]].size <= 2 ? value : 0.0;
  }
  EXPECT_GT(small, 0.9 * all);
  EXPECT_LT(m.values.size(), 256u * 32 * 32 / 20);  // sparse
}

// The reported variances against how captures with other seeds scatter, for sums that do not depend
// on the blocks. Samples of a capture fill each other's gaps, so they may be a little too large.
TEST(Transport, KnowsItsVariance) {
  Capture capture;
  capture.settings.samples = 16;
  capture.settings.roulette = false;
  std::vector<Mean> shares;
  std::vector<double> reported;
  const int count = seeds(32);
  for (int seed = 0; seed < count; ++seed) {
    capture.settings.seed = 100 + seed;
    const TransportMatrix m = capture.run(lit(projector_lamp()))->matrix();
    shares.resize(m.shares.size());
    reported.resize(m.shares.size(), 0.0);
    for (size_t i = 0; i < m.shares.size(); ++i) {
      shares[i].add(m.shares[i].x);
      reported[i] += m.share_variances[i].x / count;
    }
  }
  double seen = 0.0, told = 0.0;
  for (size_t i = 0; i < shares.size(); ++i) {
    const double brightness = std::max(shares[i].mean(), 1e-9);
    seen += count * shares[i].error() * shares[i].error() / (brightness * brightness);
    told += reported[i] / (brightness * brightness);
  }
  EXPECT_GT(told / seen, 0.85);
  EXPECT_LT(told / seen, 1.5);
}

TEST(Transport, ProjectorsAreLights) {
  const auto built = lit(projector_lamp()).build();
  const auto scene = under_projector(built, find_projector(*built, "l", 4, 4));
  EXPECT_EQ(scene->lights.size(), 1u);
  expect_integrators_agree(scene, 32, true);
  const auto camera = make_camera(scene->camera, 32, 32);
  Random random(7);
  uint64_t paths = 0;
  for (int i = 0; i < 500; ++i) {
    const WeightCheck c = check_weights(*scene, *camera, 32.0f * random.next_2d(),
                                        Heuristic::Balance, {1, 1, 0.5f, 2}, {}, 3, i);
    paths += c.paths;
    ASSERT_LT(c.max_error, 1e-3);
  }
  EXPECT_GT(paths, 500u);
}

// What the lamp emits into the pixels is what it emits, and lights the scene as it does.
TEST(Transport, WattsAreTheLamps) {
  for (const auto& [lamp, watts] : {std::pair(projector_lamp(), 50 * 0.5 * (1 - std::cos(0.45))),
                                    std::pair(parallel_lamp(), 50.0)}) {
    const auto built = lit(lamp).build();
    const LampWatts found = lamp_watts(*built, find_projector(*built, "l", 40, 30));
    double own = 0.0, plain = 0.0;
    for (size_t i = 0; i < found.own.size(); ++i) {
      own += found.own[i].y;
      plain += found.plain[i].y;
    }
    EXPECT_NEAR(own / watts, 1.0, 5e-3);
    EXPECT_EQ(own, plain);
  }
}

std::string refused(const SceneKit& kit, const Capture& capture) {
  try {
    TransportSession(kit.build(), capture.settings, capture.transport);
  } catch (const SceneError& error) {
    return error.key + "/" + error.path;
  }
  return "";
}

TEST(Transport, RefusesByName) {
  const Capture fine;
  EXPECT_EQ(refused(lit(projector_lamp()), fine), "");
  Capture c;
  c.transport.width = 257;
  EXPECT_EQ(refused(lit(projector_lamp()), c), "settings/projector_width");
  c = {};
  c.transport.height = 0;
  EXPECT_EQ(refused(lit(projector_lamp()), c), "settings/projector_height");
  c = {};
  c.settings.height = 513;
  EXPECT_EQ(refused(lit(projector_lamp()), c), "settings/height");
  c = {};
  c.settings.integrator = IntegratorType::PathTracer;
  EXPECT_EQ(refused(lit(projector_lamp()), c), "settings/integrator");
  c = {};
  c.transport.memory = 1000;
  EXPECT_EQ(refused(lit(projector_lamp()), c), "settings/memory");
  c = {};
  c.transport.memory = size_t{1} << 60;
  EXPECT_EQ(refused(lit(projector_lamp()), c), "settings/memory");
  c = {};
  c.transport.projector = "nobody";
  EXPECT_EQ(refused(lit(projector_lamp()), c), "nobody/projector");
  c = {};
  c.transport.projector = "other";
  EXPECT_EQ(refused(lit(projector_lamp()), c), "other/type");
  LightDesc lamp = projector_lamp();
  lamp.radius = 0.1f;
  EXPECT_EQ(refused(lit(lamp), fine), "l/radius");
  lamp = projector_lamp();
  lamp.spot_size = kPi;
  EXPECT_EQ(refused(lit(lamp), fine), "l/spot_size");
  lamp = parallel_lamp();
  lamp.spread = 0.5f;
  EXPECT_EQ(refused(lit(lamp), fine), "l/spread");
  lamp = projector_lamp();
  lamp.transform[1] += 0.5f * lamp.transform[0];
  EXPECT_EQ(refused(lit(lamp), fine), "l/transform");
  // A tree with Light Falloff.
  for (const LightDesc& desc : {projector_lamp(), parallel_lamp()}) {
    lamp = desc;
    lamp.graph = single("EMISSION", {{"Strength", link("Falloff", "Linear")}});
    lamp.graph->surface = NodeLink{"Shader", "Emission"};
    lamp.graph->nodes.push_back(node("Falloff", "LIGHT_FALLOFF", {{"Strength", 1.0f}}));
    EXPECT_EQ(refused(lit(lamp), fine), "l/node_tree");
    lamp.graph->nodes[0].inputs["Strength"] = link("Falloff", "Quadratic");
    EXPECT_EQ(refused(lit(lamp), fine), "");
  }
}

TEST(Transport, CancelKeepsWholePasses) {
  Capture capture;
  capture.settings.samples = 100000;
  TransportSession early(lit(projector_lamp()).build(), capture.settings, capture.transport);
  early.cancel();
  early.start();
  early.finish();
  EXPECT_EQ(early.progress().state, Progress::State::Cancelled);
  EXPECT_THROW(early.matrix(), Error);

  TransportSession late(lit(projector_lamp()).build(), capture.settings, capture.transport);
  EXPECT_THROW(late.matrix(), Error);
  late.start();
  while (late.statistics().samples < 3) {
    late.wait(0.01);
  }
  late.cancel();
  EXPECT_TRUE(late.wait(2.0));
  late.finish();
  const TransportMatrix m = late.matrix();
  EXPECT_EQ(m.samples, late.statistics().samples);
  EXPECT_EQ(late.progress().samples, m.samples + late.pilot_samples());
  expect_sums_are(late.snapshot(), m);
}

}  // namespace
}  // namespace janus::test
