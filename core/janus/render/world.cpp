// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/render/world.h"

#include <algorithm>

#include "janus/math/warp.h"

namespace janus {

namespace {

class WorldCompiler {
 public:
  WorldCompiler(const WorldDesc& world, const std::map<std::string, ImageDesc>& images,
                Diagnostics& diagnostics)
      : world_(world), images_(images), diagnostics_(diagnostics) {}

  std::optional<EnvironmentMap> compile() {
    const Node* shader =
        world_.graph->surface ? world_.graph->find(world_.graph->surface->node) : nullptr;
    if (!shader || (shader->type != "BACKGROUND" && shader->type != "EMISSION")) {
      return std::nullopt;
    }
    const NodeLink* color = link(*shader, "Color");
    const Node* texture = color ? world_.graph->find(color->node) : nullptr;
    if (!texture || texture->type != "TEX_ENVIRONMENT" || color->output != "Color") {
      return std::nullopt;
    }
    const float strength = std::max(0.0f, number(*shader, "Strength"));
    return map(*texture, Rgb(strength));
  }

 private:
  void warn(const Node& node, const std::string& message) {
    diagnostics_.push_back({Severity::Warning, "", world_.name, node.name, message});
  }

  static const NodeInput* input(const Node& node, const std::string& identifier) {
    const auto it = node.inputs.find(identifier);
    return it == node.inputs.end() ? nullptr : &it->second;
  }

  static const NodeLink* link(const Node& node, const std::string& identifier) {
    const NodeInput* value = input(node, identifier);
    return value ? std::get_if<NodeLink>(value) : nullptr;
  }

  static std::string text(const Node& node, const std::string& property) {
    const auto it = node.properties.find(property);
    const auto* value =
        it == node.properties.end() ? nullptr : std::get_if<std::string>(&it->second);
    return value ? *value : std::string();
  }

  float number(const Node& node, const std::string& identifier) {
    const NodeInput* value = input(node, identifier);
    if (const auto* x = value ? std::get_if<float>(value) : nullptr; x && std::isfinite(*x)) {
      return *x;
    }
    if (value) {
      warn(node, "the input '" + identifier + "' is linked or not a number; 1 is used");
    }
    return 1.0f;
  }

  EnvironmentMap map(const Node& texture, Rgb scale) {
    if (const std::string projection = text(texture, "projection");
        !projection.empty() && projection != "EQUIRECTANGULAR") {
      warn(texture, "the projection " + projection +
                        " is not supported yet; the picture is read as EQUIRECTANGULAR");
    }
    const std::string name = text(texture, "interpolation");
    if (!name.empty() && name != "Linear" && name != "Closest") {
      warn(texture, "the interpolation " + name + " is not supported yet; Linear is used");
    }
    const auto interpolation = name == "Closest" ? Interpolation::Closest : Interpolation::Linear;
    const mat3 to_image = coordinates(texture);
    const auto it = images_.find(text(texture, "image"));
    if (it == images_.end() || !it->second.pixels || it->second.pixels->pixels.empty()) {
      warn(texture, "its image is missing; it is rendered magenta, as in Cycles");
      auto missing = std::make_shared<Image>(1, 1, 3);
      missing->pixels = {1.0f, 0.0f, 1.0f};
      return {missing, false, interpolation, scale, to_image};
    }
    const ImageDesc& image = it->second;
    return {finite(texture, image), image.srgb, interpolation, scale, to_image};
  }

  // The pixels, or a copy without those that are no numbers.
  std::shared_ptr<const Image> finite(const Node& texture, const ImageDesc& image) {
    const auto bad = [](float x) { return !std::isfinite(x); };
    const std::vector<float>& pixels = image.pixels->pixels;
    if (std::none_of(pixels.begin(), pixels.end(), bad)) {
      return image.pixels;
    }
    warn(texture, "the image '" + image.name +
                      "' holds values that are not finite; they are rendered black");
    auto copy = std::make_shared<Image>(*image.pixels);
    std::replace_if(copy->pixels.begin(), copy->pixels.end(), bad, 0.0f);
    return copy;
  }

  // From directions of the world to those of the picture.
  mat3 coordinates(const Node& texture) {
    const NodeLink* source = link(texture, "Vector");
    if (!source) {
      return mat3(1.0f);
    }
    const Node* node = world_.graph->find(source->node);
    if (!node) {
      return mat3(1.0f);
    }
    if (is_direction(*node, *source)) {
      return mat3(1.0f);
    }
    const NodeLink* inner = node->type == "MAPPING" ? link(*node, "Vector") : nullptr;
    const Node* origin = inner ? world_.graph->find(inner->node) : nullptr;
    if (!origin || !is_direction(*origin, *inner)) {
      warn(texture, "its vector comes from '" + node->name +
                        "', which is not supported yet; the direction is used");
      return mat3(1.0f);
    }
    return mapping(*node);
  }

  static bool is_direction(const Node& node, const NodeLink& link) {
    return node.type == "TEX_COORD" && link.output == "Generated";
  }

  mat3 mapping(const Node& node) {
    const vec3 angles = constant(node, "Rotation", vec3(0.0f));
    const vec3 scale = constant(node, "Scale", vec3(1.0f));
    const float size = std::abs(scale.x);
    const bool even = size > 0.0f && std::abs(std::abs(scale.y) - size) <= 1e-5f * size &&
                      std::abs(std::abs(scale.z) - size) <= 1e-5f * size;
    if (!even) {
      warn(node, "an uneven scale of a world's picture is not supported yet; 1 is used");
    }
    const std::string type = text(node, "vector_type");
    const bool moves = type != "VECTOR" && type != "NORMAL";
    if (moves && constant(node, "Location", vec3(0.0f)) != vec3(0.0f)) {
      warn(node, "the location of a world's picture is not supported yet; 0 is used");
    }
    mat3 mirror(1.0f);
    for (int i = 0; i < 3 && even; ++i) {
      mirror[i][i] = scale[i] < 0.0f ? -1.0f : 1.0f;
    }
    const mat3 turn = about(2, angles.z) * about(1, angles.y) * about(0, angles.x);
    return type == "TEXTURE" ? mirror * glm::transpose(turn) : turn * mirror;
  }

  // A rotation about a coordinate axis.
  static mat3 about(int axis, float angle) {
    const vec2 c = cos_sin(angle);
    const int j = (axis + 1) % 3, k = (axis + 2) % 3;
    mat3 m(1.0f);
    m[j][j] = c.x, m[j][k] = c.y;
    m[k][j] = -c.y, m[k][k] = c.x;
    return m;
  }

  vec3 constant(const Node& node, const std::string& identifier, vec3 fallback) {
    const NodeInput* value = input(node, identifier);
    if (!value) {
      return fallback;
    }
    if (const auto* v = std::get_if<vec3>(value); v && is_finite(*v)) {
      return *v;
    }
    warn(node, "the input '" + identifier + "' is linked or not finite; its default is used");
    return fallback;
  }

  const WorldDesc& world_;
  const std::map<std::string, ImageDesc>& images_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::optional<EnvironmentMap> compile_world_map(const WorldDesc& world,
                                                const std::map<std::string, ImageDesc>& images,
                                                Diagnostics& diagnostics) {
  return WorldCompiler(world, images, diagnostics).compile();
}

}  // namespace janus
