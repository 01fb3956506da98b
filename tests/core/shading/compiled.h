// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "janus/shading/compiler.h"
#include "support/scene_kit.h"

namespace janus::test {

struct Compiled {
  Program program;
  Diagnostics diagnostics;
};

inline Compiled compiled(const NodeGraph& graph) {
  Compiled result;
  result.program = compile(graph, "Material", {}, result.diagnostics);
  return result;
}

inline bool warned(const Compiled& c, const std::string& node, const std::string& part) {
  return std::any_of(c.diagnostics.begin(), c.diagnostics.end(), [&](const Diagnostic& d) {
    return d.material == "Material" && d.node == node && d.message.find(part) != std::string::npos;
  });
}

}  // namespace janus::test
