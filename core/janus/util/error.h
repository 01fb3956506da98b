// SPDX-License-Identifier: GPL-3.0-or-later
//
// The exceptions of the core. Nothing here or elsewhere in the core exits or aborts: it lives in
// Blender's process, where the user's unsaved work is.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace janus {

// Base of everything the core throws on purpose.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A scene description that cannot be rendered. `key` names the item given to SceneBuilder, `path`
// the offending part of it ("triangles[12]").
class SceneError : public Error {
 public:
  SceneError(std::string key, std::string path, const std::string& message)
      : Error(key + (path.empty() ? "" : " (" + path + ")") + ": " + message),
        key(std::move(key)),
        path(std::move(path)),
        message(message) {}

  std::string key, path, message;
};

// A file that cannot be read or written; the message names it.
class IoError : public Error {
 public:
  using Error::Error;
};

// The work was cancelled by its CancelToken.
class Cancelled : public Error {
 public:
  Cancelled() : Error("cancelled") {}
};

}  // namespace janus
