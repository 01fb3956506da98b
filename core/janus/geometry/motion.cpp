// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/geometry/motion.h"

namespace janus {

namespace {

// The orthogonal matrix nearest to `m` (polar decomposition; Higham 1986, Newton's iteration).
// Without reflections: those belong to the stretch.
mat3 nearest_rotation(const mat3& m) {
  mat3 r = m;
  for (int i = 0; i < 100; ++i) {
    const mat3 next = 0.5f * (r + glm::transpose(glm::inverse(r)));
    float change = 0.0f;
    for (int c = 0; c < 3; ++c) {
      change = std::max(change, max_abs_component(next[c] - r[c]));
    }
    r = next;
    if (change < 1e-6f) {
      break;
    }
  }
  return glm::determinant(r) < 0.0f ? -r : r;
}

}  // namespace

Motion::Motion(const std::vector<mat4>& keys) {
  for (const mat4& key : keys) {
    const mat3 linear(key);
    const mat3 rotation = nearest_rotation(linear);
    glm::quat q = glm::quat_cast(rotation);
    if (!poses_.empty() && glm::dot(poses_.back().rotation, q) < 0.0f) {
      q = -q;  // the shorter way
    }
    poses_.push_back({vec3(key[3]), q, glm::transpose(rotation) * linear});
  }
}

mat4 Motion::at(float time) const {
  const KeyTime key(time, poses_.size());
  const Pose &a = poses_[key.first], &b = poses_[key.first + 1];
  const float t = key.share;
  const mat3 linear = glm::mat3_cast(glm::slerp(a.rotation, b.rotation, t)) *
                      ((1.0f - t) * a.stretch + t * b.stretch);
  mat4 result(linear);
  result[3] = vec4((1.0f - t) * a.place + t * b.place, 1.0f);
  return result;
}

Bounds Motion::swept(const Bounds& local) const {
  Bounds result;
  if (local.empty()) {
    return result;
  }
  const auto turns = [&](const Pose& p) { return p.rotation != poses_.front().rotation; };
  if (std::none_of(poses_.begin(), poses_.end(), turns)) {
    for (size_t i = 0; i < poses_.size(); ++i) {
      const float last = static_cast<float>(poses_.size() - 1);
      result.extend(transformed(local, at(static_cast<float>(i) / last)));
    }
    return result;
  }
  // A ball around the origin that moves in a straight line from key to key.
  float radius = 0.0f;
  for (const Pose& pose : poses_) {
    const Bounds stretched = transformed(local, mat4(pose.stretch));
    radius = std::max(radius,
                      glm::length(glm::max(glm::abs(stretched.lower), glm::abs(stretched.upper))));
  }
  for (const Pose& pose : poses_) {
    result.extend(pose.place - radius);
    result.extend(pose.place + radius);
  }
  return result;
}

}  // namespace janus
