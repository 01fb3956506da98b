// SPDX-License-Identifier: GPL-3.0-or-later
#include "bind_data.h"
#include "bind_progress.h"
#include "janus/render/scene.h"
#include "janus/session/session.h"
#include "janus/util/error.h"

namespace janus::python {

namespace {

using namespace py::literals;

constexpr EnumName<IntegratorType> kIntegrators[] = {{"bdpt", IntegratorType::Bdpt},
                                                     {"pt", IntegratorType::PathTracer},
                                                     {"lt", IntegratorType::LightTracer}};
constexpr EnumName<FilterType> kFilters[] = {{"BLACKMAN_HARRIS", FilterType::BlackmanHarris},
                                             {"GAUSSIAN", FilterType::Gaussian},
                                             {"BOX", FilterType::Box}};
constexpr EnumName<Heuristic> kHeuristics[] = {{"BALANCE", Heuristic::Balance},
                                               {"POWER", Heuristic::Power}};
constexpr EnumName<ConnectionMode> kConnectionModes[] = {{"CACHE", ConnectionMode::Cache},
                                                         {"CLASSIC", ConnectionMode::Classic}};

// --- Settings ---

using Crop = std::optional<std::array<int, 4>>;
using Expressions = std::vector<std::pair<std::string, std::string>>;

// With these "weights", strategies are averaged.
constexpr const char* kNoWeights = "NONE";

std::optional<Strategies> to_strategies(const std::string& heuristic, const std::string& text) {
  if (heuristic != kNoWeights) {
    if (!text.empty()) {
      throw SceneError("settings", "strategies", "can be chosen with the heuristic NONE only");
    }
    return std::nullopt;
  }
  try {
    return Strategies::parse(text);
  } catch (const Error& error) {
    throw SceneError("settings", "strategies", error.what());
  }
}

Expressions to_list(const std::vector<ExpressionPass>& passes) {
  Expressions list;
  for (const ExpressionPass& pass : passes) {
    list.emplace_back(pass.name, pass.expression);
  }
  return list;
}

// The message of what `parse` throws for `text`; empty: nothing is wrong.
template <class Parse>
std::string complaint(const std::string& text, Parse&& parse) {
  try {
    parse(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

RenderSettings make_settings(
    int width, int height, const Crop& crop, int samples, float noise_threshold, int min_samples,
    double seconds, uint32_t seed, int threads, int max_bounces, int max_diffuse_bounces,
    int max_glossy_bounces, int max_transmission_bounces, int transparent_max_bounces,
    float clamp_direct, float clamp_indirect, const std::string& integrator,
    const std::string& filter, float filter_width, float light_paths, float connections,
    float merge_radius, bool adaptive_counts, const std::string& heuristic, bool motion_blur,
    float film_exposure, bool film_transparent, bool film_transparent_glass,
    float film_transparent_roughness, bool roulette, bool check_weights, bool next_event,
    const std::string& connection_mode, const std::string& strategies,
    const Expressions& expressions, const std::vector<std::string>& light_passes,
    int strategy_images, bool shadow_catcher, const std::vector<std::string>& data_passes,
    const std::vector<std::string>& cryptomatte, int cryptomatte_levels, float pass_alpha_threshold,
    const std::array<float, 3>& mist, float occlusion_distance, const AovList& aovs) {
  RenderSettings s;
  s.data = to_data(data_passes, cryptomatte, cryptomatte_levels, aovs);
  s.data_settings = {{mist[0], mist[1], mist[2]}, pass_alpha_threshold, occlusion_distance};
  s.width = width;
  s.height = height;
  if (crop) {
    s.crop = FilmRect{(*crop)[0], (*crop)[1], (*crop)[2], (*crop)[3]};
  }
  s.samples = samples;
  s.noise_threshold = noise_threshold;
  s.min_samples = min_samples;
  s.seconds = seconds;
  s.seed = seed;
  s.threads = threads;
  s.max_bounces = max_bounces;
  s.max_diffuse_bounces = max_diffuse_bounces;
  s.max_glossy_bounces = max_glossy_bounces;
  s.max_transmission_bounces = max_transmission_bounces;
  s.transparent_max_bounces = transparent_max_bounces;
  s.clamp_direct = clamp_direct;
  s.clamp_indirect = clamp_indirect;
  s.integrator = from_name(kIntegrators, integrator, "integrator");
  s.filter = from_name(kFilters, filter, "filter");
  s.filter_width = filter_width;
  s.light_paths = light_paths;
  s.connections = connections;
  s.merge_radius = merge_radius;
  s.adaptive_counts = adaptive_counts;
  s.strategies = to_strategies(heuristic, strategies);
  s.heuristic = s.strategies ? Heuristic::Balance : from_name(kHeuristics, heuristic, "heuristic");
  s.next_event = next_event;
  s.connection_mode = from_name(kConnectionModes, connection_mode, "connection_mode");
  for (const auto& [name, expression] : expressions) {
    s.expressions.push_back({name, expression});
  }
  s.light_passes = light_passes;
  s.strategy_images = strategy_images;
  s.shadow_catcher = shadow_catcher;
  s.motion_blur = motion_blur;
  s.film_exposure = film_exposure;
  s.film_transparent = film_transparent;
  s.film_transparent_glass = film_transparent_glass;
  s.film_transparent_roughness = film_transparent_roughness;
  s.roulette = roulette;
  s.check_weights = check_weights;
  s.validate();
  return s;
}

py::dict to_dict(const RenderSettings& s) {
  py::dict d;
  d["width"] = s.width;
  d["height"] = s.height;
  d["crop"] = s.crop ? py::object(py::make_tuple(s.crop->x0, s.crop->y0, s.crop->x1, s.crop->y1))
                     : py::object(py::none());
  d["samples"] = s.samples;
  d["noise_threshold"] = s.noise_threshold;
  d["min_samples"] = s.min_samples;
  d["seconds"] = s.seconds;
  d["seed"] = s.seed;
  d["threads"] = s.threads;
  d["max_bounces"] = s.max_bounces;
  d["max_diffuse_bounces"] = s.max_diffuse_bounces;
  d["max_glossy_bounces"] = s.max_glossy_bounces;
  d["max_transmission_bounces"] = s.max_transmission_bounces;
  d["transparent_max_bounces"] = s.transparent_max_bounces;
  d["clamp_direct"] = s.clamp_direct;
  d["clamp_indirect"] = s.clamp_indirect;
  d["integrator"] = to_name(kIntegrators, s.integrator);
  d["filter"] = to_name(kFilters, s.filter);
  d["filter_width"] = s.filter_width;
  d["light_paths"] = s.light_paths;
  d["connections"] = s.connections;
  d["merge_radius"] = s.merge_radius;
  d["adaptive_counts"] = s.adaptive_counts;
  d["heuristic"] = s.strategies ? kNoWeights : to_name(kHeuristics, s.heuristic);
  d["strategies"] = s.strategies ? s.strategies->text() : "";
  d["next_event"] = s.next_event;
  d["connection_mode"] = to_name(kConnectionModes, s.connection_mode);
  d["expressions"] = to_list(s.expressions);
  d["light_passes"] = s.light_passes;
  d["strategy_images"] = s.strategy_images;
  add_data(d, s.data);
  d["shadow_catcher"] = s.shadow_catcher;
  d["pass_alpha_threshold"] = s.data_settings.alpha_threshold;
  const Mist& mist = s.data_settings.mist;
  d["mist"] = py::make_tuple(mist.start, mist.depth, mist.falloff);
  d["occlusion_distance"] = s.data_settings.occlusion_distance;
  d["motion_blur"] = s.motion_blur;
  d["film_exposure"] = s.film_exposure;
  d["film_transparent"] = s.film_transparent;
  d["film_transparent_glass"] = s.film_transparent_glass;
  d["film_transparent_roughness"] = s.film_transparent_roughness;
  d["roulette"] = s.roulette;
  d["check_weights"] = s.check_weights;
  return d;
}

void bind_settings(py::module_& m) {
  const RenderSettings d;
  py::class_<RenderSettings> settings(
      m, "RenderSettings",
      "What to render of a scene: immutable, checked when made (SceneError names the setting). "
      "crop: (x0, y0, x1, y1) in pixels of the full frame from the bottom left; seconds: time "
      "limit, 0 for none; threads: 0 for all; max_bounces: as in Cycles, 0 is direct light; "
      "max_diffuse_bounces, max_glossy_bounces, max_transmission_bounces: of them by kind; "
      "transparent_max_bounces: surfaces passed by alpha or transparency; clamp_direct, "
      "clamp_indirect: the most that a contribution adds to a sample, 0 for no limit; integrator: "
      "bdpt, pt or lt; filter: BLACKMAN_HARRIS, GAUSSIAN or BOX, filter_width in pixels; "
      "light_paths per pixel; connections per camera vertex; merge_radius: bdpt merges vertices "
      "that are so close, too, in scene units, 0 for none; adaptive_counts: bdpt starts with "
      "these two and then takes what is most efficient for the scene; heuristic: BALANCE or "
      "POWER, or NONE: bdpt without weights; strategies: then those alone, as '0,* 2,3' (s "
      "vertices from the light, t from the camera), averaged by length; next_event: False leaves "
      "next event estimation out: pt then finds lights by hitting them, and lt a camera with a "
      "lens; connection_mode: CACHE or CLASSIC (a light path for each camera path); expressions: "
      "(name, light path expression) of each additional pass; light_passes: Cycles' passes by "
      "Blender's names, DiffDir, DiffInd, DiffCol, the same of Gloss and Trans, Emit and Env; "
      "strategy_images: bdpt makes passes for each strategy of paths of up to so many edges; "
      "shadow_catcher: a pass of what shadow catchers show, and not in the picture; data_passes: "
      "Depth, Position, IndexOB, IndexMA (of the first sample of a pixel), Normal, UV, Vector, "
      "Mist, AO, Denoising Albedo, Denoising Normal, Denoising Depth, Debug Sample Count; "
      "cryptomatte: Object, Material, Asset, each in so many cryptomatte_levels (pictures of two "
      "ids); pass_alpha_threshold: surfaces with less alpha are looked through; "
      "occlusion_distance: how far away the surroundings occlude (0: however far); aovs: (name, "
      "COLOR or VALUE) of what AOV Output nodes write, the picture is called 'AOV name'; mist: "
      "start "
      "and depth in metres, and the power of the falloff; noise_threshold: pixels with less "
      "noise, as Cycles measures it, stop after min_samples (0: a number by the threshold); 0: "
      "none stops; motion_blur: whether what moves is blurred; film_exposure: a factor of the "
      "colour; film_transparent: the world is not in the picture; film_transparent_glass: nor "
      "behind glass of up to film_transparent_roughness; roulette: False traces every path and "
      "every shadow ray to its end (slow); check_weights: compare the MIS weights of sampled "
      "paths with their definition (slow).");
  settings.def(
      py::init(&make_settings), py::kw_only(), "width"_a = d.width, "height"_a = d.height,
      "crop"_a = py::none(), "samples"_a = d.samples, "noise_threshold"_a = d.noise_threshold,
      "min_samples"_a = d.min_samples, "seconds"_a = d.seconds, "seed"_a = d.seed,
      "threads"_a = d.threads, "max_bounces"_a = d.max_bounces,
      "max_diffuse_bounces"_a = d.max_diffuse_bounces,
      "max_glossy_bounces"_a = d.max_glossy_bounces,
      "max_transmission_bounces"_a = d.max_transmission_bounces,
      "transparent_max_bounces"_a = d.transparent_max_bounces, "clamp_direct"_a = d.clamp_direct,
      "clamp_indirect"_a = d.clamp_indirect, "integrator"_a = to_name(kIntegrators, d.integrator),
      "filter"_a = to_name(kFilters, d.filter), "filter_width"_a = d.filter_width,
      "light_paths"_a = d.light_paths, "connections"_a = d.connections,
      "merge_radius"_a = d.merge_radius, "adaptive_counts"_a = d.adaptive_counts,
      "heuristic"_a = to_name(kHeuristics, d.heuristic), "motion_blur"_a = d.motion_blur,
      "film_exposure"_a = d.film_exposure, "film_transparent"_a = d.film_transparent,
      "film_transparent_glass"_a = d.film_transparent_glass,
      "film_transparent_roughness"_a = d.film_transparent_roughness, "roulette"_a = d.roulette,
      "check_weights"_a = d.check_weights, "next_event"_a = d.next_event,
      "connection_mode"_a = to_name(kConnectionModes, d.connection_mode), "strategies"_a = "",
      "expressions"_a = Expressions(), "light_passes"_a = std::vector<std::string>(),
      "strategy_images"_a = d.strategy_images, "shadow_catcher"_a = d.shadow_catcher,
      "data_passes"_a = std::vector<std::string>(), "cryptomatte"_a = std::vector<std::string>(),
      "cryptomatte_levels"_a = d.data.matte_levels,
      "pass_alpha_threshold"_a = d.data_settings.alpha_threshold,
      "mist"_a = std::array{d.data_settings.mist.start, d.data_settings.mist.depth,
                            d.data_settings.mist.falloff},
      "occlusion_distance"_a = d.data_settings.occlusion_distance, "aovs"_a = AovList());
  settings.def("to_dict", &to_dict, "The keyword arguments that make these settings.");
  settings.def("__repr__", [](const RenderSettings& s) {
    return py::str("RenderSettings(**{!r})").format(to_dict(s));
  });
  settings.def("__eq__", [](const RenderSettings& a, const py::object& b) {
    return py::isinstance<RenderSettings>(b) && to_dict(a).equal(to_dict(b.cast<RenderSettings>()));
  });
  settings.attr("__hash__") = py::none();
  for (const auto& item : to_dict(d)) {
    const std::string name = py::str(item.first);
    settings.def_property_readonly(name.c_str(), [name](const RenderSettings& s) {
      return py::object(to_dict(s)[name.c_str()]);
    });
  }
}

// --- Session

bool wait(RenderSession& self, double seconds) {
  return wait_slices([&](double slice) { return self.wait(slice); }, seconds);
}

void finish(RenderSession& self) {
  if (self.progress().state == Progress::State::Waiting) {
    return;
  }
  while (!wait(self, 1.0)) {
  }
  self.finish();
}

py::array_t<float> snapshot(const RenderSession& self, const std::string& name) {
  const std::vector<std::string> names = self.passes();
  if (std::ranges::find(names, name) == names.end()) {
    throw py::value_error("there is no pass '" + name + "' in this render");
  }
  return to_array([&] { return self.snapshot(name); });
}

}  // namespace

void bind_session(py::module_& m) {
  bind_settings(m);
  m.def(
      "cryptomatte_hash",
      [](const std::string& name) { return cryptomatte_hex(cryptomatte_hash(name)); }, "name"_a,
      "The hash of a name in Cryptomatte, eight hexadecimal digits.");
  m.def(
      "check_expression",
      [](const std::string& text) {
        return complaint(text, [](const std::string& t) { parse_expression(t); });
      },
      "text"_a, "What is wrong with a light path expression, for the user; empty: nothing.");
  m.def(
      "check_strategies",
      [](const std::string& text) {
        return complaint(text, [](const std::string& t) { Strategies::parse(t); });
      },
      "text"_a, "What is wrong with a choice of strategies, for the user; empty: nothing.");
  // release_gil_before_calling_cpp_dtor: the destructor waits for the render threads.
  py::class_<RenderSession>(m, "RenderSession", py::release_gil_before_calling_cpp_dtor(),
                            "One render, on threads of its own that never run Python. Dropping it "
                            "cancels it. Methods may be called from any thread.")
      .def(py::init([](std::shared_ptr<Scene> scene, const RenderSettings& settings) {
             return std::make_unique<RenderSession>(std::move(scene), settings);
           }),
           "scene"_a.none(false), "settings"_a)
      .def("start", &RenderSession::start, "Starts the render and returns. Once only.")
      .def("wait", &wait, "seconds"_a,
           "Waits up to `seconds` for the end, without the GIL; True if the render has ended.")
      .def(
          "progress", [](const RenderSession& s) { return to_dict(s.progress()); },
          "samples, target_samples, seconds (since start), remaining (seconds, None before the "
          "first pass) and state: waiting, rendering, done, cancelled or failed.")
      .def("cancel", &RenderSession::cancel,
           "Asks the render to stop and returns. Whole passes are kept.")
      .def("snapshot", &snapshot, "name"_a = "Combined",
           "The mean of the whole passes so far: float32 [height, width, 4] of the crop, scene "
           "linear, premultiplied alpha, bottom row first; other passes than Combined have three "
           "channels, or what they need. A new array each time.")
      .def("passes", &RenderSession::passes,
           "The names that snapshot() knows: Combined, the expressions', then the strategies': "
           "'s1 t2 weighted', 's1 t2 alone' (without weight), and 'longer weighted'; then those of "
           "data, CryptoObject00 and so on among them.")
      .def(
          "manifest",
          [](const RenderSession& s, const std::string& kind) {
            return s.manifest(to_matte_kind(kind));
          },
          "kind"_a,
          "The names that Cryptomatte knows as Object, Material or Asset, with their hashes.")
      .def_property_readonly(
          "diagnostics", [](const RenderSession& s) { return s.diagnostics(); },
          "What of the settings has no effect in this scene: list of Diagnostic.")
      .def("finish", &finish,
           "Waits for the end and raises what went wrong on the render threads, if anything.")
      .def(
          "stats", [](const RenderSession& s) { return to_dict(s.statistics()); },
          "samples per pixel, seconds of rendering, paths (camera, light), rays by kind, "
          "light_vertices (kept in the cache), dropped (values that were not finite), "
          "weight_error.");
}

}  // namespace janus::python
