// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/light/program_sky.h"

#include <algorithm>
#include <functional>

#include "janus/image/latlong.h"
#include "janus/math/frame.h"
#include "janus/math/warp.h"
#include "janus/util/parallel.h"

namespace janus {

namespace {

// Columns of the grid of brightness: as many as the widest picture has, within limits.
constexpr int kLeastColumns = 1024, kMostColumns = 2048;

constexpr int kBlock = 16;      // rows that a thread does at once: they share their edges
constexpr float kMost = 1e20f;  // sums of it are finite

// Of all directions, this share is drawn whatever the grid says.
constexpr double kUniformShare = 0.01;

// Of a sun's disc: so much more belongs to its cone, lest rounding leaves its edge to the sky.
constexpr float kMargin = 1.001f;

// 1 - cos of an angle, precise for the real sun's quarter of a degree.
float one_minus_cos(float angle) { return 2.0f * sqr(cos_sin(0.5f * angle).y); }

}  // namespace

ObjectData no_object(const CameraView& camera) {
  ObjectData object;
  object.camera = std::make_shared<const CameraView>(camera);
  object.color = vec4(0.0f);
  return object;
}

ShadingPoint sky_point(vec3 direction, const ObjectData& surroundings, const PathSoFar& path) {
  ShadingPoint point{};
  point.p = direction;
  point.ng = point.ns = point.view = point.object_normal = -direction;
  point.object = &surroundings;
  point.footprint = 1e-2f;
  point.path = path;
  return point;
}

WorldProgram::WorldProgram(Program program, const CameraView& camera)
    : program_(std::move(program)), surroundings_(no_object(camera)) {
  for (const SunDisc& sun : program_.suns) {
    const SunDisc cone{sun.direction, std::min(kMargin * sun.half_angle, kPi)};
    float inside = 0.0f;
    for (const float share : {0.1f, 0.5f, 0.9f}) {
      inside += luminance_around(cone, share) / 3.0f;
    }
    // It may be below the horizon, or hidden by what the tree does with it.
    if (inside > 2.0f * luminance_around(cone, 1.05f) && sun_at(cone.direction) == suns_.size()) {
      suns_.push_back(cone);
    }
  }
}

Rgb WorldProgram::radiance(vec3 direction, const PathSoFar& path) const {
  ShadingResult result;
  program_.run(sky_point(direction, surroundings_, path), result);
  return is_finite(result.emission) ? result.emission : Rgb(0.0f);
}

float WorldProgram::mean_luminance(vec3 direction) const {
  const int count = by_path() ? kUsualPaths : 1;
  float sum = 0.0f;
  for (int i = 0; i < count; ++i) {
    sum += luminance(radiance(direction, usual_path(i, kInfinity)));
  }
  return sum / static_cast<float>(count);
}

int WorldProgram::widest_picture() const {
  int width = 0;
  for (const auto& texture : program_.textures) {
    width = std::max(width, texture->image->width);
  }
  return width;
}

size_t WorldProgram::sun_at(vec3 direction) const {
  // 1 - cos = |a - b|^2 / 2 keeps its precision.
  const auto found = std::ranges::find_if(suns_, [&](const SunDisc& sun) {
    return 0.5f * length2(direction - sun.direction) <= one_minus_cos(sun.half_angle);
  });
  return static_cast<size_t>(found - suns_.begin());
}

float WorldProgram::luminance_around(const SunDisc& sun, float share) const {
  constexpr int kPoints = 16;
  const Frame frame(sun.direction);
  const vec2 c = cos_sin(std::min(share * sun.half_angle, kPi));
  float sum = 0.0f;
  for (int i = 0; i < kPoints; ++i) {
    const vec2 around = cos_sin(2.0f * kPi * static_cast<float>(i) / kPoints);
    sum += mean_luminance(frame.to_world(vec3(c.y * around, c.x)));
  }
  return sum / kPoints;
}

SkySun::SkySun(std::shared_ptr<const WorldProgram> world, size_t number)
    : world_(std::move(world)),
      number_(number),
      one_minus_cos_(one_minus_cos(cone().half_angle)),
      pdf_(0.5f * kInvPi / one_minus_cos_) {
  constexpr int kSide = 16;
  for (int i = 0; i < kSide * kSide; ++i) {
    const vec2 u = (vec2(i % kSide, i / kSide) + 0.5f) / static_cast<float>(kSide);
    const vec3 direction = sample(u);
    total_ += world_->sun_at(direction) == number_
                  ? world_->mean_luminance(direction) / (pdf_ * kSide * kSide)
                  : 0.0f;
  }
}

Rgb SkySun::radiance(vec3 direction, const PathSoFar& path) const {
  return world_->sun_at(direction) == number_ ? world_->radiance(direction, path) : Rgb(0.0f);
}

vec3 SkySun::sample(vec2 u) const {
  return Frame(cone().direction).to_world(square_to_cone(u, one_minus_cos_));
}

ProgramSky::ProgramSky(std::shared_ptr<const WorldProgram> world, bool sampled,
                       const CancelToken& cancel)
    : world_(std::move(world)), map_(measure(sampled, cancel)) {}

Rgb ProgramSky::radiance(vec3 direction, const PathSoFar& path) const {
  return world_->sun_at(direction) == world_->suns().size() ? world_->radiance(direction, path)
                                                            : Rgb(0.0f);
}

// The mean of each cell over points on its edges, or inside, too: no line between bright and dark
// is missed, as happens where one looks at the middles alone.
EnvironmentMap ProgramSky::measure(bool sampled, const CancelToken& cancel) const {
  const int width = world_->widest_picture();
  const int columns = sampled ? std::clamp(width, kLeastColumns, kMostColumns) : 4;
  const int rows = columns / 2, steps = width > kMostColumns ? 2 : 1;
  // By columns: the sums over the points on and between their edges, on the line at `v`.
  const auto line = [&](double v) {
    cancel.throw_if_cancelled();
    std::vector<float> sums(columns, 0.0f);
    for (int i = 0; i < columns * steps; ++i) {
      const vec3 direction =
          latlong_to_direction(static_cast<double>(i) / (columns * steps), latlong_z(v));
      const bool sky = world_->sun_at(direction) == world_->suns().size();
      const float found = sky ? std::min(world_->mean_luminance(direction), kMost) : 0.0f;
      sums[i / steps] += found;
      if (i % steps == 0) {
        sums[(i / steps + columns - 1) % columns] += found;
      }
    }
    return sums;
  };
  auto grid = std::make_shared<Image>(columns, rows, 3);
  std::vector<double> brightness(rows);
  ThreadPool pool(sampled ? 0 : 1);
  pool.parallel_for((rows + kBlock - 1) / kBlock, [&](size_t block) {
    const int first = static_cast<int>(block) * kBlock;
    std::vector<float> edge = line(static_cast<double>(first) / rows);
    for (int row = first; row < std::min(first + kBlock, rows); ++row) {
      std::vector<float> cells = edge;
      for (int j = 1; j <= steps; ++j) {
        edge = line((row + static_cast<double>(j) / steps) / rows);
        std::ranges::transform(cells, edge, cells.begin(), std::plus());
      }
      const double height =
          latlong_z((row + 1.0) / rows) - latlong_z(row / static_cast<double>(rows));
      for (int i = 0; i < columns; ++i) {
        const float mean = cells[i] / static_cast<float>((steps + 1) * (steps + 1));
        brightness[row] += 0.5 * height / columns * mean;
        std::fill_n(&grid->pixels[3 * (static_cast<size_t>(row) * columns + i)], 3, mean);
      }
    }
  });
  double mean = 0.0;
  for (const double b : brightness) {
    mean += b;
  }
  const auto least = static_cast<float>(std::max(kUniformShare * mean, 1e-6));
  for (float& x : grid->pixels) {
    x += least;
  }
  return {std::move(grid), false, Interpolation::Closest, Rgb(1.0f), mat3(1.0f)};
}

}  // namespace janus
