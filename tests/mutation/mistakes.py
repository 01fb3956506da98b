# SPDX-License-Identifier: GPL-3.0-or-later
"""The classic mistakes of bidirectional path tracing."""

from __future__ import annotations

from mistake import Edit, Mistake, one

CONNECT = "core/janus/path/connect.cpp"
SUBPATH = "core/janus/path/subpath.h"
FLIGHT = "core/janus/path/flight.h"
MIS = "core/janus/path/mis.h"
BDPT = "core/janus/integrator/bdpt.cpp"
BSDF = "core/janus/shading/bsdf.cpp"
SCATTER = "core/janus/shading/scatter.cpp"
FILM = "core/janus/film/film.cpp"
CAMERA = "core/janus/camera/camera.h"

# What each kind of test is called. Wildcards, because files of tests are split and merged.
ORACLE = "*Oracle*:*MisRecursion*"
PICTURES = "*Agreement*:*Techniques*:*KnownAnswer*:Mistakes*"
CROSSINGS = "*Crossings*:*Transparency*:Mistakes.*"
BSDFS = "*Bsdfs*:*Dielectric*:*Delta*:*Furnace*"

MISTAKES = (
    # --- Densities and weights --------------------------------------------------------------------
    one(
        "roulette-in-camera-pdf",
        1,
        "survival of roulette in the densities of camera walks only",
        ORACLE,
        SUBPATH,
        "{sample->delta, sample->pdf_solid, sample->pdf_reverse},",
        "{sample->delta, mode == TransportMode::Radiance ? q * sample->pdf_solid :"
        " sample->pdf_solid, sample->pdf_reverse},",
    ),
    one(
        "crossing-in-pdf",
        1,
        "the chance to pass transparent surfaces in the densities of camera walks",
        f"{ORACLE}:{CROSSINGS}",
        SUBPATH,
        "const float cos_1 = std::abs(dot(ray.direction, v.hit.ng));",
        "const float cos_1 = std::abs(dot(ray.direction, v.hit.ng)) *"
        " std::exp2(-static_cast<float>(v.crossings));",
    ),
    one(
        "nee-pdf-as-emission-pdf",
        6,
        "next event estimation's choice of the light in the density of emission",
        f"{ORACLE}:{PICTURES}",
        CONNECT,
        "scene.light_sampler.pmf_emission(choice.light) *",
        "choice.pmf *",
    ),
    one(
        "pmf-of-wrong-receiver",
        6,
        "at hits, the probability of the light as seen from the light, not from the last vertex",
        "*GlowingBox*:Mistakes.*",
        SUBPATH,
        "scene.light_sampler.pmf_illumination(previous, index, hit.primitive) *",
        "scene.light_sampler.pmf_illumination(Receiver{hit.t < kInfinity ? ray.origin + 0.999f *"
        " hit.t * ray.direction : previous.p, -ray.direction, true}, index, hit.primitive) *",
    ),
    one(
        "distance-on-infinite-lights",
        7,
        "1/d^2 in the density of a light path that starts at an infinite light",
        f"{ORACLE}:{PICTURES}",
        SUBPATH,
        "length2(v.hit.p - *endpoint));",
        "length2(v.hit.p - *endpoint)) / (light.infinite() ? length2(v.hit.p - *endpoint) : 1.0f);",
    ),
    one(
        "shading-normal-in-pdf",
        8,
        "Ns instead of Ng where a density turns from solid angle to area",
        ORACLE,
        SUBPATH,
        "std::abs(dot(step->ray.direction, v.hit.ng)) / d2",
        "std::abs(dot(step->ray.direction, v.hit.ns)) / d2",
    ),
    one(
        "camera-pdf-per-frame",
        9,
        "the density of the first vertex per frame, not per pixel",
        ORACLE,
        SUBPATH,
        "camera_density(start.density, cos_1, d2)",
        "camera_density(start.density, cos_1, d2) / 1024.0f",
    ),
    one(
        "importance-per-frame",
        9,
        "We normalised over the frame, not over a pixel",
        f"{PICTURES}:Camera.*",
        CAMERA,
        "return camera_density(density, 1.0f, distance2);",
        "return camera_density(density, 1.0f, distance2) / 256.0f;",
    ),
    one(
        "no-light-paths-in-splat-weight",
        9,
        "the number of light paths is missing in the weight of t = 1",
        ORACLE,
        MIS,
        "total(light, pdf_on_light), splat_);",
        "total(light, pdf_on_light), nee_);",
    ),
    one(
        "delta-selection-ratio",
        11,
        "a delta event is as likely from either side",
        BSDFS,
        BSDF,
        "pmf(lobe, grazing(to_ng)) * event->probability;",
        "own;",
    ),
    one(
        "delta-jacobian",
        11,
        "the solid angles of the two ends of a refraction are taken as equal",
        BSDFS,
        BSDF,
        "(radiance ? own : other) * jacobian;",
        "(radiance ? own : other);",
    ),
    one(
        "hit-weight-of-delta-lights",
        13,
        "the camera walk is thought to hit points",
        ORACLE,
        CONNECT,
        "light.hittable() ? e.pdf_radiance : 0.0f",
        "e.pdf_radiance",
    ),
    one(
        "hittable-ignored-by-light-walk",
        13,
        "the same, seen from light paths",
        ORACLE,
        MIS,
        "state.b.hit = hittable ? raise(1.0f / joint) : 0.0f;",
        "state.b.hit = raise(1.0f / joint); (void)hittable;",
    ),
    one(
        "own-size-in-weights",
        19,
        "weights from the size of the pass's own cache, not from its expectation",
        "Mistakes.*",
        BDPT,
        "merge(caches);",
        """merge(caches);
    if (connect && !cache_.vertices.empty()) {
      counts_.connection = settings_.connections * wave_paths_ / cache_.vertices.size();
      mis_ = Mis(settings_.heuristic, counts_);
    }""",
    ),
    one(
        "clamped-weights",
        14,
        "weights of connections are cut at 1/2",
        ORACLE,
        CONNECT,
        "l.beta * scale, weight,",
        "l.beta * scale, std::min(weight, 0.5f),",
    ),
    # --- Values -----------------------------------------------------------------------------------
    one(
        "no-adjoint-factor",
        4,
        "the cosines of the adjoint BSDF are those of Ns, not of Ng",
        f"{PICTURES}:{BSDFS}",
        BSDF,
        "sum.f *= std::abs(d.wo_ng / d.wi_ng);",
        "sum.f *= std::abs(dot(wo, lobes_[0].normal) / dot(wi, lobes_[0].normal));",
    ),
    one(
        "no-adjoint-in-walks",
        4,
        "... in light walks",
        BSDFS,
        BSDF,
        "return BsdfSample{*to, e.f / pdf, pdf,",
        "return BsdfSample{*to, e.f / pdf * (radiance ? 1.0f : std::abs(dot(*to, lobe.normal) *"
        " dot(from, ng_) / (dot(from, lobe.normal) * dot(*to, ng_)))), pdf,",
    ),
    one(
        "no-adjoint-in-deltas",
        4,
        "... in smooth reflection and refraction",
        f"{BSDFS}:{PICTURES}",
        BSDF,
        "std::abs(to_ng / from_ng);",
        "std::abs(dot(to, event->normal) / dot(from, event->normal));",
    ),
    one(
        "no-adjoint-in-connections",
        4,
        "... in connections",
        "*Agreement*:*Techniques*",
        CONNECT,
        "const BsdfEval at_light = light_bsdf.evaluate(-wi, l.wi, TransportMode::Importance);",
        """BsdfEval at_light = light_bsdf.evaluate(-wi, l.wi, TransportMode::Importance);
  if (!light_bsdf.lobes().empty()) {
    const vec3 ns = light_bsdf.lobes()[0].normal;
    at_light.f *= std::abs(dot(wi, ns) * dot(l.wi, l.ng) / (dot(l.wi, ns) * dot(wi, l.ng)));
  }""",
    ),
    one(
        "no-adjoint-in-splats",
        4,
        "... in connections to the camera",
        "*Agreement*:*Techniques*",
        CONNECT,
        "const BsdfEval e = bsdf.evaluate(wo, v.back, TransportMode::Importance);",
        """BsdfEval e = bsdf.evaluate(wo, v.back, TransportMode::Importance);
  if (!bsdf.lobes().empty()) {
    const vec3 ns = bsdf.lobes()[0].normal, ng = v.hit.ng;
    e.f *= std::abs(dot(wo, ns) * dot(v.back, ng) / (dot(v.back, ns) * dot(wo, ng)));
  }""",
    ),
    one(
        "no-eta-squared",
        5,
        "light walks through smooth glass gain no eta^2",
        BSDFS,
        BSDF,
        "weight *= jacobian *",
        "weight *= jacobian / (event->transmitted ? eta2 : 1.0f) *",
    ),
    one(
        "eta-squared-twice",
        5,
        "light walks through smooth glass gain it twice",
        BSDFS,
        BSDF,
        "weight *= jacobian *",
        "weight *= jacobian * (event->transmitted ? eta2 : 1.0f) *",
    ),
    one(
        "eta-squared-both-ways",
        5,
        "camera walks through smooth glass gain it too",
        f"{PICTURES}:{BSDFS}",
        BSDF,
        "Rgb weight = event->color / chosen;",
        "Rgb weight = event->color / chosen * (radiance && event->transmitted ? eta2 : 1.0f);",
    ),
    one(
        "no-eta-squared-rough",
        5,
        "rough glass without eta^2",
        BSDFS,
        SCATTER,
        "(sqr(eta) * common / (cos_o * (1.0f + lambda_o + lambda_i)));",
        "(common / (cos_o * (1.0f + lambda_o + lambda_i)));",
    ),
    one(
        "roulette-does-not-divide",
        1,
        "contributions that survive roulette are not made up for those that do not",
        PICTURES,
        "core/janus/path/roulette.h",
        "scale /= q;",
        "",
    ),
    one(
        "walk-roulette-does-not-divide",
        1,
        "the same for walks",
        PICTURES,
        SUBPATH,
        "beta /= q;",
        "",
    ),
    # --- Which paths there are --------------------------------------------------------------------
    one(
        "separate-caps",
        2,
        "subpaths have caps of their own, the path has none",
        PICTURES,
        BDPT,
        "l.edges + v.edges + 1 > settings_.walk.max_edges",
        "l.edges > settings_.walk.max_edges",
    ),
    one(
        "crossings-per-subpath",
        2,
        "the cap on transparent surfaces counts the camera side only",
        CROSSINGS,
        CONNECT,
        "c.crossings + l.crossings",
        "c.crossings",
    ),
    one(
        "short-connections-skipped",
        3,
        "connections too short to be trusted are left out, with their weights left in",
        PICTURES,
        CONNECT,
        "if (!(d2 > 0.0f)) {",
        "if (!(d2 > 0.04f)) {",
    ),
    one(
        "mixtures-not-cached",
        12,
        "surfaces with a delta lobe among others are not connected to",
        PICTURES,
        BDPT,
        "if (v.bsdf().connectible() && v.edges + 2 <=",
        "if (v.bsdf().connectible() && v.bsdf().lobes().size() == 1 && v.edges + 2 <=",
    ),
    one(
        "shadow-ray-epsilon",
        21,
        "the far end of a connection's shadow ray lies in the surface",
        PICTURES,
        CONNECT,
        "offset_origin(l.p, l.ng, l.offset, -wi)",
        "l.p",
    ),
    # --- Film, samples, threads -------------------------------------------------------------------
    one(
        "box-filter-for-splats",
        10,
        "splats fall into one pixel whatever the filter",
        f"{PICTURES}:*Film*:*Filters*",
        FILM,
        "filter_.evaluate(splat.raster - vec2(x + 0.5f, y + 0.5f));",
        "static_cast<int>(std::floor(splat.raster.x)) == x &&"
        " static_cast<int>(std::floor(splat.raster.y)) == y ? 1.0f : 0.0f;",
    ),
    Mistake(
        "splats-over-sum-of-taps",
        10,
        "splats are divided by the sum of the filter's taps",
        f"{PICTURES}:*Film*:*Filters*",
        (
            Edit(
                FILM,
                "for (int y = y0; y <= y1; ++y) {",
                """float taps = 0.0f;
        for (int y = y0; y <= y1; ++y) {
          for (int x = x0; x <= x1; ++x) {
            taps += filter_.evaluate(splat.raster - vec2(x + 0.5f, y + 0.5f));
          }
        }
        for (int y = y0; y <= y1; ++y) {""",
            ),
            Edit(FILM, "weight * splat.value;", "weight * splat.value / std::max(taps, 1e-6f);"),
        ),
    ),
    one(
        "splats-per-wave",
        23,
        "splats count the light paths of their wave, not of the pass",
        "*Techniques*",
        BDPT,
        "/ static_cast<float>(light_paths_)",
        "/ static_cast<float>(wave_paths_)",
    ),
    one(
        "shared-stream",
        17,
        "light and camera walks draw from the same stream",
        f"{PICTURES}:Sampler.*",
        "core/janus/sampling/sampler.h",
        "Light = 0x4c494748",
        "Light = Camera",
    ),
    one(
        "shared-dimensions",
        17,
        "light path i shares its random numbers with the camera path of pixel i",
        f"{PICTURES}:Sampler.*",
        BDPT,
        "Sampler sampler(settings_.seed, Stream::Light, 0,"
        " static_cast<uint64_t>(pass) * light_paths_ + i);",
        "const size_t i_x = i % context_.film.rect().width();"
        " Sampler sampler(settings_.seed, Stream::Camera,"
        " static_cast<uint64_t>(i / context_.film.rect().width()) << 32 | i_x, pass);",
    ),
    Mistake(
        "cache-in-order-of-threads",
        0,
        "the cache is filled in the order in which threads end",
        "*Threads*",
        (
            Edit(
                BDPT,
                "std::vector<VertexCache> caches(blocks);",
                "std::vector<VertexCache> caches(blocks), ended;",
            ),
            Edit(
                BDPT,
                "counters.light_vertices = caches[block].vertices.size();",
                """counters.light_vertices = caches[block].vertices.size();
      {
        const std::lock_guard lock(check_mutex_);
        ended.push_back(std::move(caches[block]));
      }""",
            ),
            Edit(BDPT, "merge(caches);", "merge(ended);"),
        ),
    ),
)
