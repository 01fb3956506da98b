// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each technique (s,t) alone, without weights, estimates all light over paths of its length that it
// can make at all. Here it can make all of them: nothing is specular, the lamp can be hit, and the
// surfaces are apart from each other, because 1/d^2 has infinite variance where they meet.
#include "janus/util/error.h"
#include "support/pictures.h"
#include "support/scene_kit.h"

namespace janus::test {
namespace {

// A floor below, a ceiling above, a wall between them at some distance, seen from the side.
SceneKit plates() {
  return SceneKit()
      .add("floor", plane(4, 4), diffuse(Rgb(0.8f, 0.7f, 0.6f)), translation({0, 0, -1}))
      .add("ceiling", plane(4, 4), diffuse(Rgb(0.6f, 0.7f, 0.8f)),
           translation({0.1f, 0, 1.2f}) * rotation({1, 0, 0}, 3.0f))
      .add("wall", plane(1.2f, 1.2f), diffuse(Rgb(0.7f)),
           translation({-2.4f, 0.3f, 0}) * rotation({0, 1, 0}, 1.3f))
      .camera({0, -2.6f, 0.8f}, {0, 0.2f, -0.9f}, 0.7f);
}

struct LengthCase {
  std::string name;
  SceneKit (*make)();
  bool hittable = true;
  int more = 1;  // times as many samples
};

const LengthCase kCases[] = {
    {"area",
     [] { return plates().light("l", area_light({1.6f, 0, 0.4f}, {0, 0, -0.6f}, 1.0f, 30)); }},
    {"mesh",
     [] {
       return plates().add("lamp", plane(1, 1), emission(Rgb(1, 0.9f, 0.8f), 8),
                           translation({1.7f, 0.2f, 0.2f}) * rotation({0, 1, 0}, -1.2f));
     }},
    {"sphere",
     [] { return plates().light("l", point_light({1.6f, 0.2f, 0.3f}, 30, 0.4f, false)); }},
    {"point", [] { return plates().light("l", point_light({1.6f, 0.2f, 0.3f}, 30)); }, false},
    // Shading normals: the adjoint of the BSDF at every vertex of a light subpath.
    {"smooth",
     [] {
       return plates()
           .add("ball", ball(0.5f, 10, true), diffuse(Rgb(0.9f)), translation({0.2f, 0, 0}))
           .light("l", area_light({1.7f, -0.3f, 0.2f}, {0, 0, -0.4f}, 0.8f, 30));
     }},
    // Entry and exit are one vertex, whichever walk goes below.
    {"subsurface",
     [] {
       return plates()
           .add("wax", ball(0.5f, 10, true), subsurface(Rgb(0.8f, 0.7f, 0.6f)),
                translation({0.2f, 0, 0}))
           .light("l", area_light({1.7f, -0.3f, 0.2f}, {0, 0, -0.4f}, 0.8f, 30));
     },
     true, 3},
    // Tubes and balls, seen from outside alone.
    {"round",
     [] {
       return plates()
           .add("tube", strand({{-0.9f, 0, -0.2f}, {0, 0.2f, 0.2f}, {0.9f, 0, -0.2f}}, 0.25f),
                diffuse(Rgb(0.9f)))
           .add("balls", balls({{0.2f, 0.1f, -0.6f}, {-0.7f, 0.2f, 0.5f}}, 0.2f),
                diffuse(Rgb(0.6f, 0.9f, 0.7f)))
           .light("l", area_light({1.7f, -0.3f, 0.2f}, {0, 0, -0.4f}, 0.8f, 30));
     }},
    // Crossings are in no density, whichever walk passes them.
    {"panes",
     [] {
       const NodeGraph pane = single("BSDF_TRANSPARENT", {{"Color", vec4(0.9f, 0.7f, 0.5f, 1)}});
       return plates()
           .add("pane", plane(1.4f, 1.4f), pane,
                translation({0.9f, 0, 0.1f}) * rotation({0, 1, 0}, 1.4f))
           .add("screen", plane(5, 5), combine("MIX_SHADER", diffuse(Rgb(0.8f)), pane),
                translation({0, 0, 2}))
           .add("low", plane(4, 4), pane, translation({0, 0, -0.6f}))
           .light("l", area_light({1.6f, 0, 0.4f}, {0, 0, -0.6f}, 1.0f, 30));
     }},
};

std::ostream& operator<<(std::ostream& out, const LengthCase& c) { return out << c.name; }

class SingleTechniques : public ::testing::TestWithParam<LengthCase> {};

TEST_P(SingleTechniques, AgreeForEachPathLength) {
  const auto scene = GetParam().make().build();
  const int longest = full() ? 4 : 3;
  for (int edges = 2; edges <= longest; ++edges) {
    std::vector<Mean> reference;
    for (int s = 1; s <= edges; ++s) {
      auto settings = small_picture(IntegratorType::Bdpt, samples(48 * GetParam().more));
      settings.strategies = Technique{s, edges + 1 - s};
      const auto found = quarters(scene, settings);
      if (s == 1) {
        reference = found;
        continue;
      }
      SCOPED_TRACE(::testing::Message() << "s = " << s << ", t = " << edges + 1 - s);
      expect_agreement(found, reference, 0.05);
    }
    RenderSettings hits = small_picture(IntegratorType::Bdpt, samples(400));
    hits.light_paths = 0.0f;
    hits.strategies = Technique{0, edges + 1};
    SCOPED_TRACE(::testing::Message() << "s = 0, t = " << edges + 1);
    if (GetParam().hittable) {
      expect_agreement(quarters(scene, hits), reference, 0.06);
    } else {
      EXPECT_THROW(RenderSession(scene, hits), SceneError);  // nothing hits a point
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, SingleTechniques, ::testing::ValuesIn(kCases),
                         [](const auto& info) { return std::string(info.param.name); });

// --- Next event estimation, a connection and a splat, where it is hard for them ------------------

void expect_agreement_over_three_edges(const SceneKit& kit) {
  const auto scene = kit.build();
  std::vector<Mean> reference;
  for (int s = 1; s <= 3; ++s) {
    RenderSettings settings = small_picture(IntegratorType::Bdpt, samples(64));
    settings.strategies = Technique{s, 4 - s};
    settings.seed = 100 * s;
    SCOPED_TRACE(::testing::Message() << "s = " << s);
    const auto found = quarters(scene, settings);
    if (s == 1) {
      reference = found;
    } else {
      expect_agreement(found, reference, 0.05);
    }
  }
}

// By 35 degrees, away from the lamp on one surface and towards it on the other: without the factor
// of the adjoint BSDF, a light path's vertex is up to twice as bright or as dark.
TEST(TechniquesOfThreeEdges, LeaningNormals) {
  const float lean = std::tan(0.6f);
  expect_agreement_over_three_edges(
      SceneKit()
          .add("floor", leaning(plane(4, 4), {-lean, 0, 1}), diffuse(Rgb(0.8f, 0.7f, 0.6f)),
               translation({0, 0, -1}))
          .add("ceiling", leaning(plane(4, 4), {-lean, 0, 1}), diffuse(Rgb(0.6f, 0.7f, 0.8f)),
               translation({0.1f, 0, 1.2f}) * rotation({1, 0, 0}, 3.0f))
          .light("l", area_light({1.6f, 0, 0.1f}, {0, 0, 0}, 1.0f, 30))
          .camera({0, -2.6f, 0.8f}, {0, 0.2f, -0.9f}, 0.7f));
}

// A hundred metres from the origin, surfaces a centimetre apart are known to a thousandth of their
// distance: shadow rays must keep off both of them.
TEST(TechniquesOfThreeEdges, CloseSurfacesFarFromTheOrigin) {
  const mat4 place = translation({70, -90, 40}) * scaling(vec3(0.01f));
  CameraDesc camera;
  camera.name = "Camera";
  camera.transform =
      look_at(vec3(place * vec4(0, -2.6f, 0.8f, 1)), vec3(place * vec4(0, 0.2f, -0.9f, 1)));
  camera.left = camera.bottom = -0.7f;
  camera.right = camera.top = 0.7f;
  camera.clip_start = 1e-4f;
  SceneKit kit;
  kit.add("floor", plane(4, 4), diffuse(Rgb(0.8f)), place * translation({0, 0, -1}))
      .add("ceiling", plane(4, 4), diffuse(Rgb(0.7f)),
           place * translation({0.1f, 0, 1.2f}) * rotation({1, 0, 0}, 3.0f))
      .add("lamp", plane(1, 1), emission(Rgb(1), 8),
           place * translation({1.7f, 0.2f, 0.2f}) * rotation({0, 1, 0}, -1.2f));
  kit.builder.set_camera(camera);
  expect_agreement_over_three_edges(kit);
}

}  // namespace
}  // namespace janus::test
