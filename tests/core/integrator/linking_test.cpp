// SPDX-License-Identifier: GPL-3.0-or-later
//
// Light and shadow linking: which lights a surface sees, and what stands in their way.
#include "janus/render/shadows_ahead.h"
#include "support/pictures.h"
#include "support/scene_kit.h"

namespace janus::test {
namespace {

constexpr IntegratorType kIntegrators[] = {IntegratorType::Bdpt, IntegratorType::PathTracer,
                                           IntegratorType::LightTracer};

double floor_of(const SceneKit& kit, IntegratorType integrator, int max_bounces = 0) {
  RenderSettings settings = small_picture(integrator, samples(64));
  settings.max_bounces = max_bounces;
  return quarters(kit.build(), settings, 4)[0].mean();
}

void place(SceneKit& kit, const std::string& name, MeshDesc mesh, const NodeGraph& surface,
           const mat4& transform, EmitterLinks emitter, ReceiverLinks receiver) {
  kit.add(name, std::move(mesh), surface, transform);
  InstanceDesc instance;
  instance.mesh = name;
  instance.transform = transform;
  instance.materials.emplace_back(name);
  instance.emitter = emitter;
  instance.receiver = receiver;
  kit.builder.set_instance(name, instance);
}

// A floor that is lit by all sets but those of `links`, seen from above.
SceneKit floor_with(ReceiverLinks links) {
  SceneKit kit;
  place(kit, "floor", plane(2, 2), diffuse(Rgb(0.6f)), mat4(1.0f), {}, links);
  return kit.camera({0, 0, 1}, {0, 0, 0});
}

// Lights of all kinds, in set 3, shine on what is not left out of it.
TEST(Linking, LightsShineOnTheirReceiversAlone) {
  for (int kind = 0; kind < 4; ++kind) {
    const auto picture = [&](ReceiverLinks links, int set, IntegratorType integrator) {
      SceneKit kit = floor_with(links);
      LightDesc light = kind == 0   ? point_light({0, 0, 2}, 40)
                        : kind == 1 ? area_light({0, 0, 2}, {0, 0, 0}, 0.5f, 40)
                                    : sun_light({0.3f, 0, 1}, 3, 0.2f);
      light.links.receivers = set;
      if (kind < 3) {
        kit.light("l", light);
      } else {
        place(kit, "lamp", plane(0.5f, 0.5f), emission(Rgb(1), 30), translation({0.2f, 0, 2}),
              {set, -1}, {});
      }
      return floor_of(kit, integrator);
    };
    for (const IntegratorType integrator : kIntegrators) {
      SCOPED_TRACE(::testing::Message() << kind << ", " << static_cast<int>(integrator));
      const double lit = picture({}, -1, integrator);
      EXPECT_GT(lit, 0.01);
      EXPECT_NEAR(picture({}, 3, integrator), lit, 0.05 * lit);
      EXPECT_NEAR(picture({1 << 2, 0}, 3, integrator), lit, 0.05 * lit);
      EXPECT_EQ(picture({1 << 3, 0}, 3, integrator), 0.0);
      EXPECT_NEAR(picture({1 << 3, 0}, -1, integrator), lit, 0.05 * lit);
    }
  }
}

// Next event estimation wastes no sample on a light that is dark to a surface.
TEST(Linking, DarkLightsAreNotChosen) {
  SceneKit kit = floor_with({1, 0});
  for (int i = 0; i < 9; ++i) {
    LightDesc light = point_light({0.1f * static_cast<float>(i), 0, 2}, 40);
    light.links.receivers = i == 4 ? -1 : 0;
    kit.light(std::string(1, static_cast<char>('a' + i)), light);
  }
  const auto scene = kit.build();
  const auto hit = scene->intersect(Ray{vec3(0.1f, 0.2f, 1), vec3(0, 0, -1)});
  const Receiver receiver = scene->receiver(*hit, false, vec3(0, 0, 1));
  for (int i = 0; i < 32; ++i) {
    const auto choice =
        scene->light_sampler.sample_illumination(receiver, (static_cast<float>(i) + 0.5f) / 32);
    EXPECT_EQ(scene->lights[choice.light]->name, "e");
    EXPECT_EQ(choice.pmf, 1.0f);
  }
  for (size_t i = 0; i < scene->lights.size(); ++i) {
    const float pmf = scene->light_sampler.pmf_illumination(receiver, i, 0);
    EXPECT_EQ(pmf, scene->lights[i]->name == "e" ? 1.0f : 0.0f);
  }
}

// A plate between a lamp of set 2 and the floor.
TEST(Linking, LightsAreBlockedByTheirBlockersAlone) {
  for (const IntegratorType integrator : kIntegrators) {
    SCOPED_TRACE(static_cast<int>(integrator));
    const auto picture = [&](LinkMask lets_pass, int set, int more) {
      SceneKit kit = floor_with({});
      LightDesc light = area_light({0, 0, 2}, {0, 0, 0}, 0.5f, 40);
      light.links.blockers = set;
      kit.light("l", light);
      if (more >= 0) {  // a light that the plate blocks
        LightDesc other = light;
        other.links.blockers = more;
        kit.light("m", other);
      }
      place(kit, "plate", plane(5, 5), diffuse(Rgb(0.0f)), translation({0, 0, 1.5f}), {},
            {0, lets_pass});
      return floor_of(kit, integrator);
    };
    EXPECT_EQ(picture(0, -1, -1), 0.0);
    EXPECT_EQ(picture(0, 2, -1), 0.0);
    EXPECT_EQ(picture(1 << 2, 1, -1), 0.0);
    const double lit = picture(1 << 2, 2, -1);
    EXPECT_GT(lit, 0.1);
    EXPECT_NEAR(picture(1 << 2, 2, 1), lit, 0.05 * lit);
    EXPECT_NEAR(picture(1 << 2 | 1 << 1, 2, 1), 2 * lit, 0.1 * lit);
  }
}

// What a walk meets before it finds lights of several sets.
TEST(Linking, ShadowsOfEachSetAreItsOwn) {
  const RayType plain = RayType::Shadow, first = shadow_ray_of(1), second = shadow_ray_of(4);
  ShadowsAhead ahead(ray_bit(plain) | ray_bit(first) | ray_bit(second), 0, 2);
  ahead.meet(ray_bit(plain) | ray_bit(second), Rgb(0.5f));
  ahead.meet(ray_bit(second) | ray_bit(RayType::Camera), Rgb(0.5f));
  EXPECT_EQ(ahead.through(plain), Rgb(0.5f));
  EXPECT_EQ(ahead.through(first), Rgb(1.0f));
  EXPECT_EQ(ahead.through(second), Rgb(0.25f));
  ahead.meet(ray_bit(second), Rgb(0.5f));  // a third crossing: more than there may be
  EXPECT_EQ(ahead.through(second), Rgb(0.0f));
  ahead.meet(ray_bit(plain), Rgb(0.0f));
  EXPECT_FALSE(ahead.ended());
  ahead.meet(ray_bit(first), Rgb(0.0f));
  EXPECT_TRUE(ahead.ended());
}

// All of it in one scene with glossy surfaces, glass and a sky, by all integrators.
TEST(Linking, IsTheSameByAllIntegrators) {
  SceneKit kit = open_box();
  LightDesc lamp = area_light({0, 0, 0.9f}, {0, 0, 0}, 0.5f, 20);
  lamp.links = {0, 0};
  LightDesc bulb = point_light({-0.6f, -0.4f, 0.4f}, 8, 0.1f);
  bulb.links = {1, -1};
  kit.light("lamp", lamp).light("bulb", bulb).world(Rgb(0.2f, 0.3f, 0.5f));
  const auto shiny = plastic(Rgb(0.5f, 0.4f, 0.3f), 0.2f);
  place(kit, "block", cuboid({-0.7f, -0.2f, -1}, {-0.2f, 0.4f, 0.1f}), shiny, mat4(1), {}, {1, 1});
  place(kit, "low", cuboid({0.2f, -0.6f, -1}, {0.7f, 0.0f, -0.4f}), shiny, mat4(1), {}, {2, 0});
  place(kit, "pane", plane(0.8f, 0.8f),
        combine("MIX_SHADER", diffuse(Rgb(0.7f)), single("BSDF_TRANSPARENT", {})),
        translation({0.2f, 0, 0.3f}), {}, {0, 1});
  place(kit, "tube", cuboid({-0.1f, -0.1f, -0.1f}, {0.1f, 0.1f, 0.1f}), emission(Rgb(1), 6),
        translation({0.6f, 0.3f, 0.2f}), {0, 1}, {});
  const auto scene = kit.build();
  EXPECT_TRUE(scene->has_links && scene->has_own_shadows);
  expect_integrators_agree(scene, 96, true);
}

}  // namespace
}  // namespace janus::test
