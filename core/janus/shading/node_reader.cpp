// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/node_reader.h"

#include <algorithm>

namespace janus {

void warn(Diagnostics& diagnostics, const std::string& material, const Node& node,
          const std::string& message) {
  Diagnostic diagnostic{Severity::Warning, "", material, node.name, message};
  if (std::find(diagnostics.begin(), diagnostics.end(), diagnostic) == diagnostics.end()) {
    diagnostics.push_back(std::move(diagnostic));
  }
}

void NodeReader::warn(const std::string& message) const {
  janus::warn(diagnostics_, material_, node_, message);
}

const NodeInput* NodeReader::input(std::string_view identifier) const {
  const auto it = node_.inputs.find(std::string(identifier));
  return it == node_.inputs.end() ? nullptr : &it->second;
}

float NodeReader::declared_default(std::string_view identifier) const {
  for (const SocketDecl& socket : decl_.inputs) {
    if (socket.identifier == identifier) {
      return socket.default_value;
    }
  }
  return 0.0f;
}

Rgb NodeReader::color(std::string_view identifier) const {
  const Rgb fallback(declared_default(identifier));
  const NodeInput* value = input(identifier);
  if (!value) {
    return fallback;
  }
  Rgb out = fallback;
  if (const auto* c = std::get_if<vec4>(value)) {
    out = Rgb(*c);
  } else if (const auto* v = std::get_if<vec3>(value)) {
    out = *v;
  } else if (const auto* f = std::get_if<float>(value)) {
    out = Rgb(*f);
  } else if (const auto* link = std::get_if<NodeLink>(value)) {
    warn("the input '" + std::string(identifier) + "' is linked to '" + link->node +
         "', which is not supported yet; its default is used");
  }
  if (!is_finite(out)) {
    warn("an input is not a finite number; its default is used");
    return fallback;
  }
  return out;
}

const NodeLink* NodeReader::closure(std::string_view identifier) const {
  const NodeInput* value = input(identifier);
  return value ? std::get_if<NodeLink>(value) : nullptr;
}

std::string NodeReader::property(std::string_view identifier, std::string_view fallback) const {
  const auto it = node_.properties.find(std::string(identifier));
  const auto* text = it == node_.properties.end() ? nullptr : std::get_if<std::string>(&it->second);
  return text ? *text : std::string(fallback);
}

void NodeReader::unlinked(std::string_view identifier) const {
  if (closure(identifier)) {
    color(identifier);
  }
}

}  // namespace janus
