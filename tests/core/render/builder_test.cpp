// SPDX-License-Identifier: GPL-3.0-or-later
//
// What cannot be rendered is refused by name; what can be survived is rendered and named.
#include "janus/render/builder.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "janus/util/error.h"
#include "support/scene_kit.h"
#include "support/statistics.h"

namespace janus::test {
namespace {

void expect_error(const SceneKit& kit, const std::string& key, const std::string& path) {
  try {
    kit.build();
    ADD_FAILURE() << "no error for " << key << " " << path;
  } catch (const SceneError& e) {
    EXPECT_EQ(e.key, key);
    EXPECT_EQ(e.path, path);
    EXPECT_FALSE(e.message.empty());
    EXPECT_NE(std::string(e.what()).find(key), std::string::npos);
  }
}

bool warned(const Scene& scene, const std::string& object, const std::string& part) {
  return std::any_of(scene.diagnostics.begin(), scene.diagnostics.end(), [&](const auto& d) {
    return d.object == object && d.message.find(part) != std::string::npos;
  });
}

SceneKit with_mesh(MeshDesc mesh) { return SceneKit().add("thing", std::move(mesh), {}); }

TEST(Builder, RefusesMeshesWithIndicesOutOfRange) {
  MeshDesc mesh = plane(1, 1);
  mesh.triangles[1].y = 4;
  expect_error(with_mesh(mesh), "thing", "triangles[1]");
  mesh = plane(1, 1);
  mesh.corner_vertices = {0, 1, 2, 9};
  expect_error(with_mesh(mesh), "thing", "corner_vertices[3]");
  mesh = plane(1, 1);
  mesh.corner_normals.resize(3);
  expect_error(with_mesh(mesh), "thing", "corner_normals");
  mesh = plane(1, 1);
  mesh.material_indices = {0};
  expect_error(with_mesh(mesh), "thing", "material_indices");
}

TEST(Builder, RefusesMissingReferences) {
  SceneKit kit = with_mesh(plane(1, 1));
  InstanceDesc instance;
  instance.mesh = "nothing";
  kit.builder.set_instance("lost", instance);
  expect_error(kit, "lost", "mesh");
  instance.mesh = "thing";
  instance.materials = {"no such"};
  kit.builder.set_instance("lost", instance);
  expect_error(kit, "lost", "materials");
  kit.builder.remove("lost");
  EXPECT_EQ(kit.build()->instances.size(), 1u);
}

TEST(Builder, RefusesCamerasWithoutAPicture) {
  EXPECT_THROW(SceneBuilder().commit(CancelToken()), SceneError);  // none at all
  const auto refused = [](auto&& spoil) {
    SceneBuilder builder;
    CameraDesc desc;
    desc.name = "Camera";
    spoil(desc);
    builder.set_camera(desc);
    EXPECT_THROW(builder.commit(CancelToken()), SceneError);
  };
  refused([](CameraDesc& c) { c.right = c.left; });
  refused([](CameraDesc& c) { c.top = NAN; });
  refused([](CameraDesc& c) { c.left = -INFINITY; });
  refused([](CameraDesc& c) { c.transform = scaling(vec3(0)); });
  refused([](CameraDesc& c) { c.transform[3][0] = NAN; });
  refused([](CameraDesc& c) { c.clip_end = c.clip_start; });
  refused([](CameraDesc& c) { c.clip_start = NAN; });
  refused([](CameraDesc& c) {
    c.type = CameraType::Equirectangular;
    c.top = 1.6f;
  });
  refused([](CameraDesc& c) {
    c.type = CameraType::FisheyeEquidistant;
    c.fisheye.fov = 0.0f;
  });
  refused([](CameraDesc& c) { c.aperture_radius = -1.0f; });
  refused([](CameraDesc& c) { c.aperture_radius = INFINITY; });
  refused([](CameraDesc& c) { c.focus_distance = NAN; });
  refused([](CameraDesc& c) { c.aperture_ratio = 0.0f; });
  refused([](CameraDesc& c) { c.aperture_rotation = NAN; });
}

TEST(Builder, LeavesOutBrokenTriangles) {
  MeshDesc mesh = plane(1, 1);
  add_quad(mesh, {0, 0, 1}, {1, 0, NAN}, {1, 1, 1}, {0, INFINITY, 1});
  const auto scene = with_mesh(mesh).build();
  EXPECT_EQ(scene->shapes[0]->primitives(), 2u);
  EXPECT_TRUE(warned(*scene, "thing", "2 triangles"));
  EXPECT_TRUE(scene->intersect(Ray{vec3(0.1f, 0.2f, 1), vec3(0, 0, -1)}));
}

TEST(Builder, LeavesOutFlatInstances) {
  for (const mat4& m : {scaling({1, 1, 0}), translation({0, NAN, 0})}) {
    const auto scene = SceneKit().add("flat", plane(1, 1), {}, m).build();
    EXPECT_TRUE(scene->instances.empty());
    EXPECT_TRUE(warned(*scene, "flat", "left out"));
  }
}

TEST(Builder, LeavesOutLampsThatCannotShine) {
  const auto refused = [](LightDesc desc) {
    const auto scene = SceneKit().light("lamp", desc).build();
    EXPECT_TRUE(scene->lights.empty());
    EXPECT_TRUE(warned(*scene, "lamp", "")) << "nothing was said";
  };
  refused(point_light({0, 0, NAN}, 1));
  refused(point_light({0, 0, 0}, INFINITY));
  refused(point_light({0, 0, 0}, -1));
  refused(area_light({0, 0, 1}, {0, 0, 0}, 0, 1));
  LightDesc thin = area_light({0, 0, 1}, {0, 0, 0}, 1, 1);
  thin.shape = AreaShape::Rectangle;
  thin.size_y = 0;
  refused(thin);
  thin.size_y = NAN;
  refused(thin);
  LightDesc flat = area_light({0, 0, 1}, {0, 0, 0}, 1, 1);
  flat.transform = scaling({1, 0, 1});
  refused(flat);
  LightDesc line = area_light({0, 0, 1}, {0, 0, 0}, 1, 1);
  line.transform[1] = line.transform[0];  // sheared until nothing is left
  refused(line);
  refused(point_light({0, 0, 0}, 1, NAN));
  for (LightDesc spot :
       {spot_light({0, 0, 1}, {0, 0, 0}, 1, 0, 0.1f),
        spot_light({0, 0, 1}, {0, 0, 0}, 1, NAN, 0.1f), spot_light({0, 0, 1}, {0, 0, 0}, 1, 1, NAN),
        spot_light({0, 0, 1}, {0, 0, 0}, 1, 1, 0.1f, INFINITY)}) {
    refused(spot);
  }
  LightDesc flat_spot = spot_light({0, 0, 1}, {0, 0, 0}, 1, 1, 0);
  flat_spot.transform = flat_spot.transform * scaling({1, 0, 1});
  refused(flat_spot);
  LightDesc sun = sun_light({0, 0, 1}, 1, NAN);
  refused(sun);
  sun = sun_light({0, 0, 1}, 1, 0.1f);
  sun.transform = scaling({1, 1, 0});
  refused(sun);
  refused(sun_light({0, 0, 1}, -1, 0.1f));
  // No light at all is not worth a word.
  EXPECT_TRUE(SceneKit().light("off", point_light({0, 0, 0}, 0)).build()->diagnostics.empty());
}

TEST(Builder, EmptyScenesAreScenes) {
  const auto scene = SceneKit().build();
  EXPECT_FALSE(scene->intersect(Ray{vec3(0), vec3(0, 0, 1)}));
  EXPECT_FALSE(scene->occluded(vec3(0), vec3(1)));
  EXPECT_FALSE(scene->light_sampler.emits());
  EXPECT_FALSE(scene->light_sampler.illuminates());
}

TEST(Builder, SlotsPickMaterials) {
  SceneKit kit = with_mesh(plane(1, 1));
  MeshDesc mesh = plane(2, 2);
  mesh.material_indices = {0, 7};  // beyond the list: the last slot, as in Cycles
  kit.builder.set_mesh("thing", mesh);
  kit.builder.set_material("dark", {"dark", diffuse(Rgb(0.1f))});
  kit.builder.set_material("lamp", {"lamp", emission(Rgb(1), 2)});
  InstanceDesc instance;
  instance.mesh = "thing";
  instance.materials = {std::nullopt, "dark", "lamp"};
  kit.builder.set_instance("thing", instance);
  const auto scene = kit.build();
  const auto emitted = [&](float x, float y) {
    const auto hit = scene->intersect(Ray{vec3(x, y, 1), vec3(0, 0, -1)});
    return scene->shade(*hit, hit->ng).emission.x;
  };
  EXPECT_EQ(emitted(0.5f, -0.5f), 0.0f);
  EXPECT_EQ(emitted(-0.5f, 0.5f), 2.0f);
  ASSERT_EQ(scene->lights.size(), 1u);
  EXPECT_NEAR(scene->lights[0]->power(), 2 * 3.14159265 * 2 * 2, 1e-3);  // one triangle, two sides
}

TEST(Builder, TheOrderOfCallsDoesNotMatter) {
  const auto build = [](bool reverse) {
    SceneKit kit;
    const auto add = [&](bool first) {
      const std::string name = first ? "a" : "b";
      kit.add(name, ball(first ? 0.5f : 0.4f, 8), emission(Rgb(1), first ? 1.0f : 2.0f));
      kit.light(name + "lamp", point_light({0, 0, 1}, first ? 1.0f : 3.0f));
    };
    add(!reverse);
    add(reverse);
    return kit.build();
  };
  const auto x = build(false), y = build(true);
  ASSERT_EQ(x->lights.size(), y->lights.size());
  for (size_t i = 0; i < x->lights.size(); ++i) {
    EXPECT_EQ(x->lights[i]->name, y->lights[i]->name);
    EXPECT_EQ(x->light_sampler.pmf_emission(i), y->light_sampler.pmf_emission(i));
  }
}

TEST(Builder, CanBeCancelled) {
  CancelToken cancel;
  cancel.cancel();
  EXPECT_THROW(open_box().builder.commit(cancel), Cancelled);
}

// A world's picture that is not as asked is rendered, and the node is named.
TEST(Builder, WorldPictureFindings) {
  Image black_hole(2, 2, 3);
  std::fill(black_hole.pixels.begin(), black_hole.pixels.end(), 1.0f);
  black_hole.pixels[4] = NAN;
  Image negative(2, 2, 3);
  std::fill(negative.pixels.begin(), negative.pixels.end(), -1.0f);
  const auto findings = [](const SceneKit& kit, const std::string& node, const std::string& part) {
    const auto scene = kit.build();
    ASSERT_EQ(scene->diagnostics.size(), 1u) << part;
    EXPECT_EQ(scene->diagnostics[0].material, "World");
    EXPECT_EQ(scene->diagnostics[0].node, node);
    EXPECT_NE(scene->diagnostics[0].message.find(part), std::string::npos)
        << scene->diagnostics[0].message;
    ASSERT_EQ(scene->lights.size(), 1u);
    const auto hit = scene->lights[0]->intersect(Ray{vec3(0), vec3(1, 0, 0)});
    ASSERT_TRUE(hit);
    EXPECT_TRUE(janus::is_finite(hit->radiance));
  };
  findings(SceneKit().world(black_hole), "Map", "not finite");
  findings(SceneKit().world(Image(1, 1, 3), 1, "Cubic").world(black_hole, 1, "Linear"), "Map",
           "not finite");
  SceneKit missing = SceneKit().world(black_hole);
  missing.builder.remove("image");
  findings(missing, "Map", "missing");
  black_hole.pixels[4] = 1.0f;
  const auto turn = [](std::map<std::string, NodeInput> inputs) {
    return node("Turn", "MAPPING", std::move(inputs));
  };
  findings(SceneKit().world(black_hole, 1, "Linear", turn({{"Rotation", vec3(NAN)}})), "Turn",
           "not a finite number");
  findings(SceneKit().world(black_hole, 1, "Linear", node("Cloud", "TEX_POINTDENSITY", {})),
           "Cloud", "TEX_POINTDENSITY");
  // Neither black nor negative pictures shine.
  EXPECT_TRUE(SceneKit().world(negative).build()->lights.empty());
  EXPECT_TRUE(SceneKit().world(Image(4, 2, 3)).build()->lights.empty());
  EXPECT_TRUE(SceneKit().world(black_hole, 0).build()->lights.empty());
}

// The tree of a world becomes a program; it is the picture where that says the same.
TEST(Builder, WorldOfNodes) {
  Image picture(8, 4, 3);
  for (size_t i = 0; i < picture.pixels.size(); ++i) {
    picture.pixels[i] = 0.1f + 0.01f * static_cast<float>(i % 31);
  }
  const auto lights = [](const SceneKit& kit) {
    const auto scene = kit.build();
    EXPECT_TRUE(scene->diagnostics.empty());
    EXPECT_EQ(scene->lights.size(), 1u);
    return scene;
  };
  const auto turn = [](vec3 angles, float last) {
    return node("Turn", "MAPPING", {{"Rotation", angles}, {"Scale", vec3(1, 1, last)}});
  };
  const vec3 angles(0.3f, -0.2f, 0.7f);
  for (const char* interpolation : {"Linear", "Closest"}) {
    const auto map = lights(SceneKit().world(picture, 2, interpolation, turn(angles, 1)));
    const auto program = lights(SceneKit().world(picture, 2, interpolation, turn(angles, 1.0001f)));
    const Light &a = *map->lights[0], &b = *program->lights[0];
    EXPECT_NEAR(b.power() / a.power(), 1, 0.02);
    Random random(5);
    int differ = 0;
    for (int i = 0; i < 1000; ++i) {
      const Ray ray{vec3(0), random.direction()};
      const Rgb x = a.intersect(ray)->radiance, y = b.intersect(ray)->radiance;
      differ += length2(x - y) > 1e-6f ? 1 : 0;
    }
    EXPECT_LT(differ, 5) << interpolation;  // at the edges of pixels
  }
  lights(SceneKit().world(picture, 1, "Cubic"));
  lights(SceneKit().world(picture, 1, "Linear",
                          node("Turn", "MAPPING", {{"Location", vec3(1, 0, 0)}})));
}

// One light for each answer of Light Path, seen by those rays alone.
TEST(Builder, WorldByRayType) {
  const auto masks = [](const char* output, NodeInput strength, RayMask visibility = kAllRays) {
    NodeGraph graph =
        combine("MIX_SHADER", single("BACKGROUND", {{"Color", vec4(1, 0, 0, 1)}}),
                single("BACKGROUND", {{"Color", vec4(0, 1, 0, 1)}, {"Strength", strength}}));
    graph.nodes.back().inputs["Fac"] = link("Path", output);
    graph.nodes.push_back(node("Path", "LIGHT_PATH", {}));
    SceneKit kit;
    kit.builder.set_world({"World", graph, visibility});
    const auto scene = kit.build();
    std::vector<std::pair<Rgb, int>> found;
    for (const auto& light : scene->lights) {
      EXPECT_TRUE(light->background);
      const auto hit = light->intersect(Ray{vec3(0), vec3(0, 0, 1)});
      found.emplace_back(hit->radiance, light->visibility & (kLabels | ray_bit(RayType::Camera)));
    }
    const bool known = std::string(output) != "Is Singular Ray";
    EXPECT_EQ(scene->diagnostics.size(), known ? 0u : 1u);
    return found;
  };
  using Found = std::vector<std::pair<Rgb, int>>;
  const int camera = ray_bit(RayType::Camera), diffuse = ray_bit(RayType::Diffuse);
  const int glossy = ray_bit(RayType::Glossy), through = ray_bit(RayType::Transmission);
  const Rgb red(1, 0, 0), green(0, 1, 0);
  EXPECT_EQ(masks("Is Camera Ray", 1.0f), (Found{{green, camera}, {red, kLabels}}));
  EXPECT_EQ(masks("Is Camera Ray", 0.0f), (Found{{red, kLabels}}));  // black is no light
  EXPECT_EQ(masks("Is Diffuse Ray", 1.0f),
            (Found{{red, camera | glossy | through}, {green, diffuse}}));
  EXPECT_EQ(masks("Is Glossy Ray", 1.0f),
            (Found{{red, camera | diffuse}, {green, glossy | through}}));
  EXPECT_EQ(masks("Is Reflection Ray", 1.0f),
            (Found{{red, camera | through}, {green, diffuse | glossy}}));
  EXPECT_EQ(masks("Is Transmission Ray", 1.0f),
            (Found{{red, camera | diffuse | glossy}, {green, through}}));
  EXPECT_EQ(masks("Is Shadow Ray", 1.0f), (Found{{red, camera | kLabels}}));
  EXPECT_EQ(masks("Is Glossy Ray", 1.0f, kAllRays & ~glossy),
            (Found{{red, camera | diffuse}, {green, through}}));
  EXPECT_EQ(masks("Is Singular Ray", 1.0f).size(), 1u);  // named, and a constant
  EXPECT_EQ(masks("Ray Depth", 1.0f).size(), 1u);        // asked for at each lookup
}

// A picture that Light Path chooses is the light that it is alone.
TEST(Builder, PictureByRayType) {
  Image picture(8, 4, 3);
  for (size_t i = 0; i < picture.pixels.size(); ++i) {
    picture.pixels[i] = 0.1f + 0.01f * static_cast<float>(i % 31);
  }
  SceneKit plain = SceneKit().world(picture), chosen = SceneKit().world(picture);
  NodeGraph graph = single("BACKGROUND", {{"Color", link("Map", "Color")}});
  graph.nodes.push_back(node("Map", "TEX_ENVIRONMENT", {}));
  graph.nodes.back().properties = {{"image", std::string("image")}};
  graph.nodes.push_back(node("Other", "BACKGROUND", {}));
  graph.nodes.push_back(node("Path", "LIGHT_PATH", {}));
  graph.nodes.push_back(node("Top", "MIX_SHADER",
                             {{"Fac", link("Path", "Is Camera Ray")},
                              {"Shader", link("Shader")},
                              {"Shader_001", link("Other")}}));
  graph.surface = NodeLink{"Top", "Shader"};
  chosen.builder.set_world({"World", graph});
  const auto a = plain.build(), b = chosen.build();
  ASSERT_EQ(b->lights.size(), 2u);
  const Light &seen = *b->lights[0], &other = *b->lights[1];
  EXPECT_EQ(other.visibility & (kLabels | ray_bit(RayType::Camera)), ray_bit(RayType::Camera));
  EXPECT_EQ(seen.visibility, kLabels);
  EXPECT_EQ(seen.power(), a->lights[0]->power());
  const Ray ray{vec3(0), normalize(vec3(1, 2, 0.5f))};
  EXPECT_EQ(seen.intersect(ray)->pdf_illumination, a->lights[0]->intersect(ray)->pdf_illumination);
}

// A lamp with a tree that asks who looks is one light for each answer, each of its own brightness.
TEST(Builder, LampsByRay) {
  NodeGraph graph = emission(Rgb(1), 1);
  graph.nodes[0].inputs["Strength"] = link("Path", "Is Glossy Ray");
  graph.nodes.push_back(node("Path", "LIGHT_PATH", {}));
  LightDesc lamp = point_light({0, 0, 1}, 10);
  lamp.graph = graph;
  const auto scene = SceneKit().light("lamp", lamp).build();
  EXPECT_TRUE(scene->diagnostics.empty());
  ASSERT_EQ(scene->lights.size(), 1u);
  EXPECT_EQ(scene->lights[0]->visibility,
            ray_bit(RayType::Glossy) | ray_bit(RayType::Transmission));
}

// The brightness of a tree that varies is part of the lamp's power.
TEST(Builder, LampsOfNodesKnowTheirPower) {
  NodeGraph graph = emission(Rgb(1), 1);
  graph.nodes[0].inputs["Strength"] = link("Split", "Z");
  graph.nodes.push_back(node("Split", "SEPXYZ", {{"Vector", link("Where", "Normal")}}));
  graph.nodes.push_back(node("Where", "TEX_COORD", {}));
  LightDesc lamp = point_light({0, 0, 1}, 10);
  const double plain = SceneKit().light("lamp", lamp).build()->lights[0]->power();
  lamp.graph = graph;  // the cosine over a hemisphere, nothing over the other
  const auto scene = SceneKit().light("lamp", lamp).build();
  EXPECT_TRUE(scene->diagnostics.empty());
  EXPECT_NEAR(scene->lights[0]->power() / plain, 0.25, 0.002);
  EXPECT_FALSE(scene->lights[0]->sample_illumination({0, 0, 0}, 0, vec2(0.5f)));
  const auto above = scene->lights[0]->sample_illumination({0, 0, 2}, 0, vec2(0.5f));
  EXPECT_NEAR(above->radiance.x, 10 / (4 * kPi), 1e-4);
}

}  // namespace
}  // namespace janus::test
