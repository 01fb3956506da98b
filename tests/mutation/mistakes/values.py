# SPDX-License-Identifier: GPL-3.0-or-later
"""Values of contributions."""

from __future__ import annotations

from mistake import Edit, Mistake, one

from mistakes.sources import (
    BIDIRECTIONAL,
    BSDF,
    BSDFS,
    CACHE,
    CAMERAS,
    CAPS,
    CLAMP,
    CONNECT,
    CROSSINGS,
    FLIGHT,
    PICTURES,
    ROULETTE,
    SCATTER,
    SUBPATH,
)

VALUES = (
    one(
        "no-adjoint-factor",
        4,
        "the cosines of the adjoint BSDF are those of Ns, not of Ng",
        f"{PICTURES}:{BSDFS}",
        BSDF,
        "const float adjoint = std::abs(d.wo_ng / d.wi_ng);",
        "const float adjoint = lobes_.empty() ? 1.0f :"
        " std::abs(dot(wo, lobes_[0].normal) / dot(wi, lobes_[0].normal));",
    ),
    one(
        "no-adjoint-in-walks",
        4,
        "... in light walks",
        BSDFS,
        BSDF,
        "sample->weight = e.f / pdf;",
        "sample->weight = e.f / pdf * (radiance ? 1.0f : std::abs(dot(*to, lobe.normal) *"
        " dot(from, ng_) / (dot(from, lobe.normal) * dot(*to, ng_))));",
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
        "Rgb weight = color / chosen;",
        "Rgb weight = color / chosen * (radiance && event->transmitted ? eta2 : 1.0f);",
    ),
    one(
        "no-eta-squared-rough",
        5,
        "rough glass without eta^2",
        BSDFS,
        SCATTER,
        "(density / (1.0f + lambda_o + lambda_i));",
        "(density / (sqr(eta) * (1.0f + lambda_o + lambda_i)));",
    ),
    one(
        "bumps-end-at-the-camera",
        0,
        "the end of light on a bump is taken from where one looks",
        "*Bumps*",
        SCATTER,
        "out.f *= lit_bumps(n, d.ns, d.wi);",
        "out.f *= lit_bumps(n, d.ns, d.wo);",
    ),
    one(
        "roulette-does-not-divide",
        1,
        "contributions that survive roulette are not made up for those that do not",
        PICTURES,
        ROULETTE,
        "scale /= q;",
        "",
    ),
    one(
        "walk-roulette-does-not-divide",
        1,
        "the same for walks",
        PICTURES,
        SUBPATH,
        "step.beta = beta / q;",
        "step.beta = beta;",
    ),
    one(
        "crossing-does-not-divide",
        0,
        "walks that stop at a surface with alpha are not made up for those that pass",
        CROSSINGS,
        FLIGHT,
        "v.beta /= 1.0f - pmf_pass;",
        "",
    ),
    one(
        "seam-counted-twice",
        0,
        "a film position chosen among several is not made up for the others",
        CAMERAS,
        CONNECT,
        "* (importance / to_camera->pmf);",
        "* importance;",
    ),
    one(
        "splats-through-the-lens-centre",
        0,
        "splats see a pinhole, camera rays a lens",
        CAMERAS,
        CONNECT,
        "camera.connect(v.hit.p, u_lens, margin)",
        "camera.connect(v.hit.p, vec2(0.5f), margin)",
    ),
    one(
        "label-share-missing-in-splats",
        2,
        "a splat counts in full where a limit of bounces allows only some of its labels",
        CAPS,
        CONNECT,
        "v.beta * e.f * share * (importance",
        "v.beta * e.f * (importance",
    ),
    one(
        "label-share-missing-in-connections",
        2,
        "the same for connections",
        CAPS,
        CONNECT,
        "scale *= share;",
        "",
    ),
    one(
        "label-share-without-adjoint",
        4,
        "the diffuse share of a light walk's value has not the factor that the value has",
        CAPS,
        BSDF,
        "sum.diffuse *= adjoint;",
        "",
    ),
    Mistake(
        "splats-not-clamped",
        14,
        "clamping acts on samples of pixels only",
        CLAMP,
        (
            Edit(
                BIDIRECTIONAL,
                "c, v.edges + 1, roulettes.at(s->raster)",
                "c, -1, roulettes.at(s->raster)",
            ),
            Edit(
                BIDIRECTIONAL,
                "return settings_.clamp(arrived, edges) * scale;",
                "return (edges < 0 ? arrived : settings_.clamp(arrived, edges)) * scale;",
            ),
        ),
    ),
    one(
        "clamped-before-weights",
        14,
        "clamping acts on what a technique alone would add",
        CLAMP,
        BIDIRECTIONAL,
        "arriving(c->value * w, *c, edges,",
        "arriving(settings_.clamp(c->value, edges) * w, *c, edges,",
    ),
    one(
        "clamped-after-roulette",
        14,
        "clamping cuts what roulette has made larger",
        CLAMP,
        BIDIRECTIONAL,
        "return settings_.clamp(arrived, edges) * scale;",
        "return settings_.clamp(arrived * scale, edges);",
    ),
    one(
        "brighter-of-two",
        0,
        "of two cached vertices the brighter one is joined, as if it had been picked uniformly",
        PICTURES,
        CACHE,
        "picks.entries[n] = at(std::min(i, size() - 1));",
        "picks.entries[n] = at(std::min(i, size() - 1)); const auto other = at(size() - 1 - i);"
        " if (other.vertex->bound > picks.entries[n].vertex->bound) { picks.entries[n] = other; }",
    ),
)
