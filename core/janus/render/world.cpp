// SPDX-License-Identifier: GPL-3.0-or-later
#include "janus/render/world.h"

#include <algorithm>

#include "janus/math/warp.h"
#include "janus/render/onlookers.h"
#include "janus/shading/node_reader.h"

namespace janus {

namespace {

const NodeInput* input(const Node& node, const std::string& identifier) {
  const auto it = node.inputs.find(identifier);
  return it == node.inputs.end() ? nullptr : &it->second;
}

const NodeLink* link(const Node& node, const std::string& identifier) {
  const NodeInput* value = input(node, identifier);
  return value ? std::get_if<NodeLink>(value) : nullptr;
}

// The world that is a lat-long picture: Environment Texture -> Background, the texture's vector
// unlinked or from Texture Coordinate (Generated), by way of a Mapping that only turns. Its pixels
// are sampled exactly, and looked up without a program.
class PictureOfWorld {
 public:
  PictureOfWorld(const WorldDesc& world, const ImageMap& images, Diagnostics& diagnostics)
      : world_(world), images_(images), diagnostics_(diagnostics) {}

  // With this closure on top. nullopt: it is another graph, which compile() knows.
  std::optional<EnvironmentMap> find(const NodeLink& top) {
    const Node* shader = world_.graph->find(top.node);
    if (!shader || (shader->type != "BACKGROUND" && shader->type != "EMISSION")) {
      return std::nullopt;
    }
    const NodeLink* color = link(*shader, "Color");
    const Node* texture = color ? world_.graph->find(color->node) : nullptr;
    if (!texture || texture->type != "TEX_ENVIRONMENT" || color->output != "Color") {
      return std::nullopt;
    }
    const auto strength = constant(*shader, "Strength", 1.0f);
    return strength ? map(*texture, Rgb(std::max(0.0f, *strength))) : std::nullopt;
  }

 private:
  static std::string text(const Node& node, const std::string& property) {
    const auto it = node.properties.find(property);
    const auto* value =
        it == node.properties.end() ? nullptr : std::get_if<std::string>(&it->second);
    return value ? *value : std::string();
  }

  // A finite number or vector, by default `fallback`; nullopt: something else.
  template <class T>
  static std::optional<T> constant(const Node& node, const std::string& identifier, T fallback) {
    const NodeInput* value = input(node, identifier);
    if (!value) {
      return fallback;
    }
    const T* found = std::get_if<T>(value);
    return found && is_finite(vec3(*found)) ? std::optional(*found) : std::nullopt;
  }

  std::optional<EnvironmentMap> map(const Node& texture, Rgb scale) {
    const std::string projection = text(texture, "projection");
    const std::string name = text(texture, "interpolation");
    const auto to_image = coordinates(texture);
    const auto it = images_.find(text(texture, "image"));
    if ((!projection.empty() && projection != "EQUIRECTANGULAR") ||
        (!name.empty() && name != "Linear" && name != "Closest") || !to_image ||
        it == images_.end() || !it->second.pixels || it->second.pixels->pixels.empty()) {
      return std::nullopt;
    }
    const auto interpolation = name == "Closest" ? Interpolation::Closest : Interpolation::Linear;
    const ImageDesc& image = it->second;
    return EnvironmentMap(finite(texture, image), image.srgb, interpolation, scale, *to_image);
  }

  // The pixels, or a copy without those that are no numbers.
  std::shared_ptr<const Image> finite(const Node& texture, const ImageDesc& image) {
    const auto bad = [](float x) { return !std::isfinite(x); };
    const std::vector<float>& pixels = image.pixels->pixels;
    if (std::none_of(pixels.begin(), pixels.end(), bad)) {
      return image.pixels;
    }
    warn(
        diagnostics_, world_.name, texture,
        "the image '" + image.name + "' holds values that are not finite; they are rendered black");
    auto copy = std::make_shared<Image>(*image.pixels);
    std::replace_if(copy->pixels.begin(), copy->pixels.end(), bad, 0.0f);
    return copy;
  }

  // From directions of the world to those of the picture, if that is a turn.
  std::optional<mat3> coordinates(const Node& texture) {
    const NodeLink* source = link(texture, "Vector");
    if (!source) {
      return mat3(1.0f);
    }
    const Node* node = world_.graph->find(source->node);
    if (node && is_direction(*node, *source)) {
      return mat3(1.0f);
    }
    const NodeLink* inner = node && node->type == "MAPPING" ? link(*node, "Vector") : nullptr;
    const Node* origin = inner ? world_.graph->find(inner->node) : nullptr;
    return origin && is_direction(*origin, *inner) ? mapping(*node) : std::nullopt;
  }

  static bool is_direction(const Node& node, const NodeLink& link) {
    return node.type == "TEX_COORD" && link.output == "Generated";
  }

  static std::optional<mat3> mapping(const Node& node) {
    const auto angles = constant(node, "Rotation", vec3(0.0f));
    const auto scale = constant(node, "Scale", vec3(1.0f));
    const auto location = constant(node, "Location", vec3(0.0f));
    if (!angles || !scale || !location) {
      return std::nullopt;
    }
    const float size = std::abs(scale->x);
    const bool even = size > 0.0f && std::abs(std::abs(scale->y) - size) <= 1e-5f * size &&
                      std::abs(std::abs(scale->z) - size) <= 1e-5f * size;
    const std::string type = text(node, "vector_type");
    const bool moves = type != "VECTOR" && type != "NORMAL" && *location != vec3(0.0f);
    if (!even || moves) {
      return std::nullopt;
    }
    mat3 mirror(1.0f);
    for (int i = 0; i < 3; ++i) {
      mirror[i][i] = (*scale)[i] < 0.0f ? -1.0f : 1.0f;
    }
    const mat3 turn = about(2, angles->z) * about(1, angles->y) * about(0, angles->x);
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

  const WorldDesc& world_;
  const ImageMap& images_;
  Diagnostics& diagnostics_;
};

// The closure on top as `ray` sees it: behind the mixes between which Light Path chooses.
std::optional<NodeLink> top_closure(const NodeGraph& graph, RayType ray) {
  std::optional<NodeLink> top = graph.surface;
  for (size_t step = 0; top && step < graph.nodes.size(); ++step) {  // a cycle ends, too
    const Node* mix = graph.find(top->node);
    const NodeLink* factor = mix && mix->type == "MIX_SHADER" ? link(*mix, "Fac") : nullptr;
    const Node* path = factor ? graph.find(factor->node) : nullptr;
    const auto answer =
        path && path->type == "LIGHT_PATH" ? light_path_answer(ray, factor->output) : std::nullopt;
    if (!answer) {
      break;
    }
    const NodeLink* chosen = link(*mix, *answer ? "Shader_001" : "Shader");
    top = chosen ? std::optional(*chosen) : std::nullopt;
  }
  return top;
}

// A picture that some rays see.
struct SeenPicture {
  RayMask seen_by;      // the camera, and labels
  std::string closure;  // of the picture
  EnvironmentMap picture;
};

// What a world is, by who looks at it.
struct Parts {
  std::vector<SeenPicture> pictures;
  std::vector<SeenProgram> programs;
};

Parts find_parts(const WorldDesc& world, const ImageMap& images, Diagnostics& diagnostics) {
  const bool by_ray = asks_for_rays(*world.graph);
  PictureOfWorld finder(world, images, diagnostics);
  Parts parts;
  for (const RayType ray : kOnlookers) {
    const auto top = top_closure(*world.graph, ray);
    const auto known = std::ranges::find_if(
        parts.pictures, [&](const SeenPicture& seen) { return top && seen.closure == top->node; });
    if (known != parts.pictures.end()) {
      known->seen_by |= ray_bit(ray);
    } else if (auto picture = top ? finder.find(*top) : std::nullopt) {
      parts.pictures.push_back({ray_bit(ray), top->node, std::move(*picture)});
    } else {
      Diagnostics said;
      add_seen(parts.programs, ray,
               compile(*world.graph, world.name, images, said, {SeenTree::Of::World, ray}));
      add_new(diagnostics, said);
    }
    if (!by_ray) {
      break;
    }
  }
  if (parts.pictures.size() + parts.programs.size() == 1) {
    for (auto& picture : parts.pictures) {
      picture.seen_by = kAllRays;
    }
    for (auto& program : parts.programs) {
      program.seen_by = kAllRays;
    }
  }
  return parts;
}

// Rays of an orthographic camera all go one way, and so see one colour.
void check_window(const WorldDesc& world, const CameraView& camera, Diagnostics& diagnostics) {
  if (camera.type != CameraType::Orthographic) {
    return;
  }
  for (const Node& node : world.graph->nodes) {
    for (const auto& [identifier, value] : node.inputs) {
      const auto* link = std::get_if<NodeLink>(&value);
      const Node* source =
          link && link->output == "Window" ? world.graph->find(link->node) : nullptr;
      if (source && source->type == "TEX_COORD") {
        warn(diagnostics, world.name, *source,
             "an orthographic camera sees one place of the window in all of a world");
      }
    }
  }
}

}  // namespace

std::vector<std::unique_ptr<Light>> make_world(const WorldDesc& world, const ImageMap& images,
                                               const CameraView& camera, const SceneBox& scene,
                                               Diagnostics& diagnostics,
                                               const CancelToken& cancel) {
  std::vector<std::unique_ptr<Light>> lights;
  const auto add = [&](std::unique_ptr<Light> light, RayMask seen_by) {
    light->visibility = world.visibility & seen_by;
    light->background = true;
    light->name = world.name.empty() ? light->name : world.name;
    light->light_group = world.light_group;
    lights.push_back(std::move(light));
  };
  if (!world.graph) {
    return lights;
  }
  check_window(world, camera, diagnostics);
  Parts parts = find_parts(world, images, diagnostics);
  if (std::ranges::any_of(parts.programs, [](const auto& p) { return scatters(p.program); })) {
    diagnostics.push_back(
        {Severity::Warning, "", world.name, "", "a surface shader in a world has no effect"});
  }
  for (auto& [seen_by, closure, picture] : parts.pictures) {
    if (!picture.black()) {
      add(make_environment_light(std::move(picture), scene), seen_by);
    }
  }
  for (auto& [seen_by, program] : parts.programs) {
    if (program.varying_emission) {
      const bool sampled = (world.visibility & seen_by & kLabels) != 0;
      const auto shown = std::make_shared<const WorldProgram>(std::move(program), camera);
      add(make_environment_light(ProgramSky(shown, sampled, cancel), scene), seen_by);
      for (size_t sun = 0; sun < shown->suns().size(); ++sun) {
        add(make_environment_light(SkySun(shown, sun), scene), seen_by);
      }
    } else if (!is_black(program.emission)) {
      add(make_environment_light(program.emission, scene), seen_by);
    }
  }
  return lights;
}

}  // namespace janus
