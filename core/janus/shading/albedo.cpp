// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/albedo.h"

#include <cmath>

#include "janus/shading/table_lookup.h"

namespace janus {

namespace {

#include "albedo_tables.inc"

constexpr int kFine = 32, kCoarse = 16;

// Place of an index of refraction; the same for eta and 1 / eta.
Place<kCoarse> index_place(float eta) {
  return Place<kCoarse>(std::sqrt(std::abs((eta - 1.0f) / (eta + 1.0f))));
}

}  // namespace

float reflection_albedo(float rough, float mu) {
  return read(kReflection, Place<kFine>(rough), Place<kFine>(mu));
}

float reflection_albedo_average(float rough) {
  return read(kReflectionAverage, Place<kFine>(rough));
}

float glass_albedo(float rough, float mu, float eta) {
  return read(eta < 1.0f ? kGlassInside : kGlassOutside, Place<kCoarse>(rough), Place<kCoarse>(mu),
              index_place(eta));
}

float glass_albedo_average(float rough, float eta) {
  return read(eta < 1.0f ? kGlassInsideAverage : kGlassOutsideAverage, Place<kCoarse>(rough),
              index_place(eta));
}

float schlick_reflectance(float rough, float mu) {
  return read(kSchlickPosition, Place<kCoarse>(rough), Place<kCoarse>(mu));
}

float dielectric_position(float rough, float mu, float eta) {
  return read(kFresnelPosition, Place<kCoarse>(rough), Place<kCoarse>(mu), index_place(eta));
}

}  // namespace janus
