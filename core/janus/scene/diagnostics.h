// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace janus {

enum class Severity { Info, Warning, Error };

// A recoverable finding: the scene renders, and the user is told what is not as asked. Empty
// strings mean "does not apply".
struct Diagnostic {
  Severity severity = Severity::Warning;
  std::string object, material, node, message;

  bool operator==(const Diagnostic&) const = default;
};

using Diagnostics = std::vector<Diagnostic>;

}  // namespace janus
