// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/shading/node_reader.h"

#include <algorithm>

namespace janus {

namespace {

template <class T>
const T* property_as(const Node& node, std::string_view identifier) {
  const auto it = node.properties.find(std::string(identifier));
  return it == node.properties.end() ? nullptr : std::get_if<T>(&it->second);
}

// As people read it.
std::string setting_name(std::string_view property) {
  std::string name(property);
  std::ranges::replace(name, '_', ' ');
  return name;
}

}  // namespace

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

std::optional<vec4> NodeReader::value(std::string_view identifier) const {
  const NodeInput* value = input(identifier);
  if (!value) {
    return std::nullopt;
  }
  if (const auto* c = std::get_if<vec4>(value)) {
    return *c;
  }
  if (const auto* v = std::get_if<vec3>(value)) {
    return vec4(*v, 1.0f);
  }
  if (const auto* f = std::get_if<float>(value)) {
    return vec4(*f, *f, *f, 1.0f);
  }
  return std::nullopt;
}

vec3 NodeReader::color(std::string_view identifier) const {
  const auto socket = std::find_if(decl_.inputs.begin(), decl_.inputs.end(),
                                   [&](const SocketDecl& s) { return s.identifier == identifier; });
  const vec3 fallback = socket == decl_.inputs.end() ? vec3(0.0f) : socket->value;
  const auto constant = value(identifier);
  if (!constant) {
    return fallback;
  }
  if (!is_finite(vec3(*constant))) {
    warn("an input is not a finite number; its default is used");
    return fallback;
  }
  return *constant;
}

const NodeLink* NodeReader::link(std::string_view identifier) const {
  const NodeInput* value = input(identifier);
  return value ? std::get_if<NodeLink>(value) : nullptr;
}

bool NodeReader::omitted(std::string_view identifier) const {
  const NodeInput* value = input(identifier);
  return !value || std::holds_alternative<std::monostate>(*value);
}

std::string NodeReader::property(std::string_view identifier, std::string_view fallback) const {
  const auto* text = property_as<std::string>(node_, identifier);
  if (!text) {
    return std::string(fallback);
  }
  for (const EnumDecl& setting : decl_.settings) {
    const auto has = [&](const auto& items) {
      return std::ranges::find(items, *text) != items.end();
    };
    if (setting.property == identifier && !has(setting.items) && !has(setting.named)) {
      const std::string used(setting.items[0]);
      warn("its " + setting_name(identifier) + " " + *text + " is not supported yet; " + used +
           " is used");
      return used;
    }
  }
  return *text;
}

bool NodeReader::flag(std::string_view identifier) const {
  const auto* value = property_as<bool>(node_, identifier);
  return value && *value;
}

float NodeReader::number_property(std::string_view identifier) const {
  const auto* value = property_as<float>(node_, identifier);
  return value && std::isfinite(*value) ? *value : 0.0f;
}

const std::vector<float>* NodeReader::list(std::string_view identifier) const {
  return property_as<std::vector<float>>(node_, identifier);
}

}  // namespace janus
