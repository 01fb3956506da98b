// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/geometry/accel.h"

#include <gtest/gtest.h>

#include "janus/math/frame.h"
#include "janus/math/warp.h"
#include "support/scene_kit.h"
#include "support/statistics.h"

namespace janus::test {
namespace {

using dvec3 = glm::dvec3;

// Nearest distance by testing all triangles in double precision; infinite for a miss, and `rim`
// tells that an edge was so close that rounding decides.
double brute_force(const Scene& scene, const Ray& ray, bool& rim) {
  double nearest = INFINITY;
  const dvec3 o(ray.origin), d(ray.direction);
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = *scene.shapes[instance.shape]->mesh();
    const glm::dmat4 m(instance.to_world);
    const auto at = [&](uint32_t v) { return dvec3(m * glm::dvec4(mesh.positions()[v], 1.0)); };
    for (const Mesh::Triangle& t : mesh.triangles()) {
      const dvec3 a = at(t.v[0]), e1 = at(t.v[1]) - a, e2 = at(t.v[2]) - a;
      const dvec3 p = glm::cross(d, e2);
      const double det = glm::dot(e1, p);
      const double u = glm::dot(o - a, p) / det;
      const double v = glm::dot(d, glm::cross(o - a, e1)) / det;
      const double distance = glm::dot(e2, glm::cross(o - a, e1)) / det;
      const double inside = std::min({u, v, 1 - u - v});
      if (distance > -1e-4 && std::abs(inside) < 1e-4) {
        rim = true;
      }
      if (inside >= 0 && distance > 0 && distance < nearest) {
        nearest = distance;
      }
    }
  }
  return nearest;
}

// Random triangles under uneven, sheared and mirrored transforms.
std::shared_ptr<const Scene> soup() {
  Random random(15);
  MeshDesc mesh;
  for (uint32_t i = 0; i < 40; ++i) {
    const vec3 center = 2.0f * random.direction() * random.next();
    for (int k = 0; k < 3; ++k) {
      mesh.positions.push_back(center + 0.5f * random.direction());
    }
    mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  SceneKit kit;
  kit.add("a", mesh, {});
  kit.add("b", mesh, {}, translation({1, 2, 0}) * scaling({-1, 3, 0.2f}) * rotation({1, 2, 3}, 1));
  kit.add("c", mesh, {}, rotation({1, 0, 1}, 2) * scaling({2, 0.1f, 1}) * rotation({0, 1, 1}, 1));
  return kit.build();
}

TEST(Accel, FindsWhatBruteForceFinds) {
  const auto scene = soup();
  Random random(16);
  int hits = 0, misses = 0;
  for (int i = 0; i < 5000; ++i) {
    const Ray ray{random.in(0, 5) * random.direction(), random.direction()};
    bool rim = false;
    const double expected = brute_force(*scene, ray, rim);
    if (rim) {
      continue;
    }
    const auto hit = scene->intersect(ray);
    ASSERT_EQ(hit.has_value(), std::isfinite(expected));
    if (!hit) {
      ++misses;
      continue;
    }
    ++hits;
    const float t = glm::length(hit->p - ray.origin);
    EXPECT_NEAR(t, expected, 1e-4);
    EXPECT_NEAR(glm::length(hit->p - (ray.origin + t * ray.direction)), 0, 1e-4);
    // Shadow rays agree, and t_max is respected.
    EXPECT_TRUE(scene->occluded(ray.origin, ray.origin + (t + 1e-3f) * ray.direction));
    EXPECT_FALSE(scene->occluded(ray.origin, ray.origin + (t - 1e-3f) * ray.direction));
    EXPECT_FALSE(scene->intersect(Ray{ray.origin, ray.direction, t - 1e-3f}));
  }
  EXPECT_GT(hits, 1000);
  EXPECT_GT(misses, 300);
}

TEST(Accel, RaysThatAreNoneMeetNothing) {
  const auto scene = soup();
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  SurfaceInteraction hit;
  for (const float wrong : {kNone, std::numeric_limits<float>::infinity(), -3e38f, 2e18f}) {
    for (int axis = 0; axis < 3; ++axis) {
      vec3 place(0.0f), direction(0.0f, 0.0f, 1.0f);
      place[axis] = wrong;
      EXPECT_FALSE(scene->accel->intersect_any({place, vec3(0, 0, 1), INFINITY}, hit));
      EXPECT_TRUE(scene->accel->occluded(place, vec3(0.0f), RayType::Shadow));
      direction[axis] = wrong;
      EXPECT_FALSE(scene->accel->intersect_any({vec3(0.0f), direction, INFINITY}, hit));
    }
  }
  EXPECT_FALSE(scene->accel->intersect_any({vec3(0.0f), vec3(0, 0, 1), kNone}, hit));
}

TEST(Accel, NormalsPointOutwardsUnderAnyTransform) {
  Random random(17);
  for (const mat4& m : {mat4(1), scaling({-1, 1, 1}), scaling({-2, -0.3f, -1}),
                        rotation({1, 2, 3}, 2) * scaling({3, 0.2f, 1}) * rotation({2, 0, 1}, 1)}) {
    const auto scene = SceneKit().add("ball", ball(1, 32, true), {}, m).build();
    const mat3 inverse = glm::inverse(mat3(m));
    for (int i = 0; i < 500; ++i) {
      const auto hit = scene->intersect(Ray{vec3(0), random.direction()});  // from within
      ASSERT_TRUE(hit);
      // The gradient of |M^-1 p|^2 is the true normal of the ellipsoid.
      const vec3 normal = normalize(glm::transpose(inverse) * (inverse * hit->p));
      EXPECT_GT(dot(hit->ng, normal), 0.7f);
      EXPECT_GT(dot(hit->ns, normal), 0.99f);
      EXPECT_NEAR(length2(hit->ng), 1, 1e-5);
      EXPECT_NEAR(length2(hit->ns), 1, 1e-5);
    }
  }
}

// Instances that are not opaque: rays can ask for them alone, and for all others alone.
TEST(Accel, OpaqueAndTransparentInstances) {
  SceneKit kit;
  for (int i = 0; i < 4; ++i) {
    kit.add(std::string(1, static_cast<char>('a' + i)), plane(2, 2), {},
            translation({0, 0, static_cast<float>(i)}));
  }
  const auto scene = kit.build();
  const auto down = [](float z) { return Ray{vec3(0.1f, 0.2f, z), vec3(0, 0, -1)}; };
  constexpr RayType kRay = RayType::Shadow;
  SurfaceInteraction hit;
  EXPECT_FALSE(scene->accel->intersect_transparent(down(9), kRay, hit));
  EXPECT_TRUE(scene->accel->occluded_opaque(vec3(0.1f, 0, 2.5f), vec3(0.1f, 0, 1.5f), kRay));

  std::vector<Instance> instances = scene->instances;
  instances[1].opaque = instances[2].opaque = false;
  const Accel accel(scene->shapes, instances, CancelToken());
  EXPECT_TRUE(accel.intersect_transparent(down(9), kRay, hit) && hit.instance == 2);
  EXPECT_TRUE(accel.intersect_transparent(down(1.5f), kRay, hit) && hit.instance == 1);
  EXPECT_FALSE(accel.intersect_transparent(down(0.5f), kRay, hit));
  Ray capped = down(9);
  capped.t_max = 6.9f;
  EXPECT_FALSE(accel.intersect_transparent(capped, kRay, hit));
  EXPECT_TRUE(accel.intersect(down(9), kRay, hit) && hit.instance == 3);
  for (int i = 0; i < 4; ++i) {
    const vec3 above(0.1f, 0.2f, i + 0.5f), below(0.1f, 0.2f, i - 0.5f);
    EXPECT_TRUE(accel.occluded(above, below, kRay));
    EXPECT_EQ(accel.occluded_opaque(above, below, kRay), i == 0 || i == 3);
  }
}

TEST(Accel, InstancesShareTheirMesh) {
  const ShapeList shapes{std::make_shared<const Mesh>("ball", ball(1, 64, true))};
  const auto bytes = [&](int count) {
    std::vector<Instance> instances(count);
    for (int i = 0; i < count; ++i) {
      instances[i].to_world = translation({3.0f * i, 0, 0}) * scaling({1, 1 + 1e-3f * i, 1});
      instances[i].normal_to_world = glm::transpose(glm::inverse(mat3(instances[i].to_world)));
      instances[i].materials = {0};
    }
    const Accel accel(shapes, instances, CancelToken());
    for (const int i : {0, count / 2, count - 1}) {
      SurfaceInteraction hit;
      EXPECT_TRUE(accel.intersect_any(Ray{vec3(3.0f * i, 0, 9), vec3(0, 0, -1)}, hit));
      EXPECT_EQ(hit.instance, static_cast<uint32_t>(i));
    }
    return accel.bytes();
  };
  const size_t one = bytes(1);
  EXPECT_GT(one, shapes[0]->primitives() * 32);
  EXPECT_LT((bytes(5000) - one) / 4999, 2048u);
}

// Walks must neither meet the surface that they leave nor slip through it, for tiny and huge
// objects, near the origin and a thousand times their size away from it.
class Offsets : public ::testing::TestWithParam<std::tuple<float, float, bool>> {
 protected:
  mat4 transform() const {
    const auto& [scale, distance, in_mesh] = GetParam();
    const mat4 turned = rotation({1, 2, 3}, 0.7f);
    return translation(scale * distance * vec3(0.6f, -0.7f, 0.4f)) * turned *
           (in_mesh ? mat4(1) : scaling(vec3(scale)));
  }
  MeshDesc sized(MeshDesc mesh) const {  // the size in the mesh instead of in the transform
    for (vec3& p : mesh.positions) {
      p *= std::get<2>(GetParam()) ? std::get<0>(GetParam()) : 1.0f;
    }
    return mesh;
  }
  SurfaceInteraction random_point(const Scene& scene) {
    const auto count = static_cast<float>(scene.shapes[0]->primitives());
    const auto triangle = static_cast<uint32_t>(random_.next() * count);
    return scene.accel->surface_point(0, triangle, square_to_triangle(random_.next_2d()));
  }
  Random random_{18};
};

TEST_P(Offsets, ConvexBodyNeitherBlocksItselfNorLeaks) {
  const auto scene = SceneKit().add("ball", sized(ball(1, 12)), {}, transform()).build();
  int blocked = 0, leaked = 0;
  for (int i = 0; i < 20000; ++i) {
    const SurfaceInteraction p = random_point(*scene);
    const vec3 d = Frame(p.ng).to_world(square_to_cosine_hemisphere(random_.next_2d()));
    blocked += scene->intersect(Ray{offset_origin(p.p, p.ng, p.offset, d), d}).has_value();
    leaked += !scene->intersect(Ray{offset_origin(p.p, p.ng, p.offset, -d), -d}).has_value();
  }
  EXPECT_EQ(blocked, 0);
  EXPECT_EQ(leaked, 0);
}

TEST_P(Offsets, PointsInARoomSeeEachOther) {
  const auto scene =
      SceneKit().add("room", sized(cuboid(vec3(-1), vec3(1))), {}, transform()).build();
  int compared = 0, blocked = 0;
  for (int i = 0; i < 20000; ++i) {
    const SurfaceInteraction a = random_point(*scene), b = random_point(*scene);
    const vec3 d = b.p - a.p;
    if (dot(a.ng, b.ng) > 0.9f) {
      continue;  // one wall
    }
    ++compared;
    blocked += scene->occluded(offset_origin(a.p, a.ng, a.offset, d),
                               offset_origin(b.p, b.ng, b.offset, -d));
  }
  EXPECT_GT(compared, 10000);
  EXPECT_LE(blocked, compared / 5000);  // next to an edge a point may round behind a wall
}

INSTANTIATE_TEST_SUITE_P(Scales, Offsets,
                         ::testing::Combine(::testing::Values(1e-3f, 1.0f, 1e3f),
                                            ::testing::Values(0.0f, 10.0f, 1000.0f),
                                            ::testing::Bool()));

}  // namespace
}  // namespace janus::test
