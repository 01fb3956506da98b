# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings that a file made for Cycles brings along.

A setting that a file does not hold in Janus' own words has Cycles' value, whoever renders: nothing
has to be written for that, so it works in background renders and from evaluated copies alike.
Where files can be written, `adopt` makes the values Janus' own.
"""

# By name in scene.janus; the names in scene.cycles are the same.
SHARED = (
    "max_bounces",
    "diffuse_bounces",
    "glossy_bounces",
    "transmission_bounces",
    "transparent_max_bounces",
    "pixel_filter_type",
    "filter_width",
    "film_exposure",
    "film_transparent_glass",
    "film_transparent_roughness",
    "samples",
    "use_adaptive_sampling",
    "adaptive_threshold",
    "adaptive_min_samples",
    "preview_samples",
    "use_preview_adaptive_sampling",
    "preview_adaptive_threshold",
    "preview_adaptive_min_samples",
    "time_limit",
    "use_animated_seed",
    "use_denoising",
    "denoising_quality",
    "denoising_input_passes",
    "denoising_prefilter",
    "use_preview_denoising",
    "preview_denoising_start_sample",
    "preview_denoising_input_passes",
    "preview_denoising_prefilter",
    "preview_denoising_quality",
)

# Cycles' defaults for these are no answers, so they are taken over only where somebody has set
# something (most often the setting itself). The number of samples is a ceiling for its adaptive
# sampling, which belongs to it; adaptive sampling and denoising are biases, which here are on only
# where somebody has asked for them.
CHOSEN = {
    "samples": "samples",
    "use_adaptive_sampling": "samples",
    "use_preview_adaptive_sampling": "use_preview_adaptive_sampling",
    "use_denoising": "use_denoising",
    "use_preview_denoising": "use_preview_denoising",
}


def value(scene, name: str):
    """A setting of scene.janus, or Cycles' while the file has none."""
    if not scene.janus.is_property_set(name):
        return from_cycles(scene).get(name, getattr(scene.janus, name))
    return getattr(scene.janus, name)


def from_cycles(scene) -> dict:
    """What Janus takes over from scene.cycles, by name in scene.janus. Empty without Cycles."""
    cycles = getattr(scene, "cycles", None)
    if cycles is None:
        return {}
    values = {name: getattr(cycles, name) for name in SHARED if hasattr(cycles, name)}
    for name, chosen in CHOSEN.items():
        if not cycles.is_property_set(chosen):
            values.pop(name, None)
    return values


# By name in view_layer.janus and in view_layer.cycles: what it is without both.
OF_LAYERS = {"use_denoising": True, "use_pass_shadow_catcher": False}


def layer_value(layer, name: str) -> bool:
    """A setting of view_layer.janus, or Cycles' while the file has none."""
    if layer.janus.is_property_set(name):
        return getattr(layer.janus, name)
    return _of_cycles_layer(layer, name)


def _of_cycles_layer(layer, name: str) -> bool:
    return getattr(getattr(layer, "cycles", None), name, OF_LAYERS[name])


def adopted(scene) -> bool:
    """Does the file hold Janus' own values?"""
    return all(scene.janus.is_property_set(name) for name in SHARED)


def adopt(scene, again: bool = False) -> None:
    """Writes Cycles' values into scene.janus: where there are none yet, or `again`, everywhere."""
    values = from_cycles(scene)
    for name in SHARED:
        if again or not scene.janus.is_property_set(name):
            setattr(scene.janus, name, values.get(name, getattr(scene.janus, name)))
    for layer in scene.view_layers:
        for name in OF_LAYERS:
            if again or not layer.janus.is_property_set(name):
                setattr(layer.janus, name, _of_cycles_layer(layer, name))
    scene.janus.cycles_notice = bool(values)


def notice(scene) -> str:
    """What the user has to know as long as the values are Cycles' and nobody has looked at them."""
    if not from_cycles(scene) or (adopted(scene) and not scene.janus.cycles_notice):
        return ""
    text = "Bounces, film, samples and denoising are copied from Cycles"
    if scene.cycles.use_denoising and not value(scene, "use_denoising"):
        text = "Bounces, film and samples are copied from Cycles. Denoising is off"
    left_out = _left_out(scene.cycles)
    return f"{text}. Not copied, as it cuts caustics: {', '.join(left_out)}" if left_out else text


def _left_out(cycles) -> list[str]:
    found = []
    for name, words in (
        ("sample_clamp_direct", "Clamping of Direct Light"),
        ("sample_clamp_indirect", "Clamping of Indirect Light"),
        ("blur_glossy", "Filter Glossy"),
    ):
        number = getattr(cycles, name, 0.0)
        if number > 0.0:
            found.append(f"{words} {number:g}")
    for name in ("reflective", "refractive"):
        if not getattr(cycles, f"caustics_{name}", True):
            found.append(f"{name.capitalize()} Caustics off")
    return found
