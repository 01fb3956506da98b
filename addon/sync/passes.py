# SPDX-License-Identifier: GPL-3.0-or-later
"""The passes that a view layer asks for: what Blender calls them, and the core is asked for."""

from dataclasses import dataclass

import bpy

from .. import bridge
from ..report import RenderRefused
from . import cycles_settings

MAX_EXPRESSIONS = 64  # of the core
MAX_NAME_BYTES = 63  # of a pass in Blender

# What switches it on in a view layer; Blender's name since 5.0; the one before, which is the core's
LIGHT_PASSES = (
    ("use_pass_diffuse_direct", "Diffuse Direct", "DiffDir"),
    ("use_pass_diffuse_indirect", "Diffuse Indirect", "DiffInd"),
    ("use_pass_diffuse_color", "Diffuse Color", "DiffCol"),
    ("use_pass_glossy_direct", "Glossy Direct", "GlossDir"),
    ("use_pass_glossy_indirect", "Glossy Indirect", "GlossInd"),
    ("use_pass_glossy_color", "Glossy Color", "GlossCol"),
    ("use_pass_transmission_direct", "Transmission Direct", "TransDir"),
    ("use_pass_transmission_indirect", "Transmission Indirect", "TransInd"),
    ("use_pass_transmission_color", "Transmission Color", "TransCol"),
    ("use_pass_emit", "Emission", "Emit"),
    ("use_pass_environment", "Environment", "Env"),
)

# The same of what the camera sees, with the names of channels and Blender's type of a pass.
DATA_PASSES = (
    ("use_pass_z", "Depth", "Depth", "Z", "VALUE"),
    ("use_pass_mist", "Mist", "Mist", "Z", "VALUE"),
    ("use_pass_position", "Position", "Position", "XYZ", "VECTOR"),
    ("use_pass_normal", "Normal", "Normal", "XYZ", "VECTOR"),
    ("use_pass_vector", "Vector", "Vector", "XYZW", "VECTOR"),
    ("use_pass_uv", "UV", "UV", "UVA", "VECTOR"),
    ("use_pass_ambient_occlusion", "Ambient Occlusion", "AO", "RGB", "COLOR"),
    ("use_pass_object_index", "Object Index", "IndexOB", "X", "VALUE"),
    ("use_pass_material_index", "Material Index", "IndexMA", "X", "VALUE"),
)
# And those that are switched on in view_layer.janus.
SAMPLE_COUNT = "Debug Sample Count"
OWN_DATA_PASSES = (
    ("pass_debug_sample_count", SAMPLE_COUNT, "X", "VALUE"),
    ("denoising_store_passes", "Denoising Normal", "XYZ", "VECTOR"),
    ("denoising_store_passes", "Denoising Albedo", "RGB", "COLOR"),
    ("denoising_store_passes", "Denoising Depth", "Z", "VALUE"),
)
# Of an AOV by its type: the names of channels and Blender's type of a pass.
AOV_CHANNELS = {"COLOR": ("RGBA", "COLOR"), "VALUE": ("X", "VALUE")}
MATTES = ("Object", "Material", "Asset")
FALLOFFS = {"QUADRATIC": 2.0, "LINEAR": 1.0, "INVERSE_QUADRATIC": 0.5}  # of mist: powers
# What a denoiser looks at beside the picture, by Cycles' words for it.
GUIDES = {
    "RGB": (),
    "RGB_ALBEDO": ("Denoising Albedo",),
    "RGB_ALBEDO_NORMAL": ("Denoising Albedo", "Denoising Normal"),
}
# What switches it on in view_layer.janus, the name of the pass, its light path expression
READY_MADE = (
    ("use_pass_direct", "Direct", "L.E"),
    ("use_pass_indirect", "Indirect", "L..+E"),
    ("use_pass_interreflections", "Diffuse Inter-Reflections", "LDD+E"),
    ("use_pass_caustics", "Caustics", "L(S|G)+D.*E"),
)

# Name of a scene -> number of edges of the longest paths of which its next renders make an image
# for each technique. No property: it must not be saved with the file.
strategy_lengths: dict[str, int] = {}


@dataclass(frozen=True)
class Pass:
    name: str  # in Blender's render result
    key: str  # for RenderSession.snapshot()
    channels: str = "RGB"
    kind: str = "COLOR"  # Blender's type of a pass


COMBINED = Pass("Combined", "Combined", "RGBA")
SHADOW_CATCHER = Pass("Shadow Catcher", "Shadow Catcher")
NOISY_IMAGE = Pass("Noisy Image", "Combined", "RGBA")  # Combined before it is denoised


def requested(scene, layer) -> list[Pass]:
    """All passes of a render of the view layer but Combined, in the order of the menus."""
    names = [name for name, _ in expressions(layer)]
    names += strategy_names(strategy_length(scene))
    noisy = [NOISY_IMAGE] if denoises(scene, layer) else []
    own = [Pass(name, name) for name in names]
    made = [Pass(aov.name, f"AOV {aov.name}", *AOV_CHANNELS[aov.type]) for aov in aovs(layer)]
    caught = [SHADOW_CATCHER] if catches_shadows(layer) else []
    of_data, of_light = data_passes(layer), light_passes(layer)
    return [*of_data, *of_light, *caught, *mattes(layer), *made, *noisy, *own]


def catches_shadows(layer) -> bool:
    """Are the shadows on shadow catchers a pass, and not in the picture?"""
    return cycles_settings.layer_value(layer, "use_pass_shadow_catcher")


def denoises(scene, layer) -> bool:
    """Is the picture to be denoised? Not that of strategies: their sum must be the picture."""
    wanted = cycles_settings.value(scene, "use_denoising")
    return (
        wanted
        and cycles_settings.layer_value(layer, "use_denoising")
        and not strategy_length(scene)
    )


def arguments(scene, layer) -> dict:
    """What the passes are to RenderSettings. Raises RenderRefused for what makes no pass."""
    for item in layer.janus.expressions:
        if item.enabled and (problem := name_problem(layer, item)):
            raise RenderRefused(f"Light path expression '{item.name}': {problem}")
    wanted = expressions(layer)
    if len(wanted) > MAX_EXPRESSIONS:
        raise RenderRefused(
            f"View layer '{layer.name}' has {len(wanted)} passes that are light path expressions, "
            f"and there can be {MAX_EXPRESSIONS}"
        )
    for name, text in wanted:
        if problem := bridge.core().check_expression(text):
            raise RenderRefused(f"Light path expression '{name}': {problem}")
    return {
        "expressions": wanted,
        "light_passes": [found.key for found in light_passes(layer)],
        "strategy_images": strategy_length(scene),
        "shadow_catcher": catches_shadows(layer),
        **data_arguments(scene, layer),
    }


def data_arguments(scene, layer) -> dict:
    """Those of them that are passes of data."""
    wanted = [found.key for found in data_passes(layer)]
    guides = guides_of(scene) if denoises(scene, layer) else ()
    mist = scene.world and scene.world.mist_settings
    return {
        "data_passes": list(dict.fromkeys([*wanted, *guides])),
        "aovs": [(aov.name, aov.type) for aov in aovs(layer)],
        "cryptomatte": matte_kinds(layer),
        "cryptomatte_levels": matte_levels(layer),
        "pass_alpha_threshold": layer.pass_alpha_threshold,
        "occlusion_distance": scene.world.light_settings.distance if scene.world else 0.0,
        **({"mist": (mist.start, mist.depth, FALLOFFS[mist.falloff])} if mist else {}),
    }


def guides_of(scene) -> tuple[str, ...]:
    """The passes that the denoiser looks at."""
    return GUIDES[cycles_settings.value(scene, "denoising_input_passes")]


def renamed() -> bool:
    """Blender 5.0 has given passes longer names."""
    return bpy.app.version >= (5, 0, 0)


def data_passes(layer) -> list[Pass]:
    """What the camera sees."""
    found = [
        Pass(name if renamed() else key, key, channels, kind)
        for toggle, name, key, channels, kind in DATA_PASSES
        if getattr(layer, toggle)
    ]
    return found + [
        Pass(name, name, channels, kind)
        for toggle, name, channels, kind in OWN_DATA_PASSES
        if getattr(layer.janus, toggle)
    ]


def matte_kinds(layer) -> list[str]:
    return [kind for kind in MATTES if getattr(layer, f"use_pass_cryptomatte_{kind.lower()}")]


def matte_levels(layer) -> int:
    """Pictures, each with two ids of a pixel."""
    return (min(16, layer.pass_cryptomatte_depth) + 1) // 2


def mattes(layer) -> list[Pass]:
    """Their channels have lower case letters: OpenEXR then compresses them without loss."""
    names = [
        f"Crypto{kind}{level:02d}"
        for kind in matte_kinds(layer)
        for level in range(matte_levels(layer))
    ]
    return [Pass(name, name, "rgba") for name in names]


def aovs(layer) -> list:
    """The layer's AOVs that are rendered."""
    return [aov for aov in layer.aovs if not aov_problem(layer, aov)]


def aov_problem(layer, aov) -> str:
    """Why the layer's AOV is not rendered; empty if it is.

    Blender compares names, too (is_valid), but not when a layer gets another engine.
    """
    taken = {COMBINED.name, NOISY_IMAGE.name, SHADOW_CATCHER.name}
    taken |= {found.name for found in (*data_passes(layer), *light_passes(layer), *mattes(layer))}
    taken |= {name for name, _ in expressions(layer)}
    if aov.is_valid and aov.name not in taken:
        return ""
    return f"The AOV '{aov.name}' is not rendered: another pass has its name"


def unsupported(layer) -> list[str]:
    """What to say of passes that the view layer asks for and does not get."""
    return [problem for aov in layer.aovs if (problem := aov_problem(layer, aov))]


def light_passes(layer) -> list[Pass]:
    """Those that Cycles has, too."""
    return [
        Pass(name if renamed() else key, key)
        for toggle, name, key in LIGHT_PASSES
        if getattr(layer, toggle)
    ]


def expressions(layer) -> list[tuple[str, str]]:
    """(name of the pass, expression): ready-made ones, light groups, the user's."""
    found = [(name, text) for toggle, name, text in READY_MADE if getattr(layer.janus, toggle)]
    found += [
        (f"Combined_{group.name}", f"L{{{quoted(group.name)}}}.*E") for group in layer.lightgroups
    ]
    found += [
        (item.name, item.expression)
        for item in layer.janus.expressions
        if item.enabled and not name_problem(layer, item)
    ]
    return found


def quoted(name: str) -> str:
    """As an expression holds a name, whatever characters it has."""
    return name.replace("\\", "\\\\").replace("}", "\\}")


def name_problem(layer, item) -> str:
    """Why an expression cannot have its name as a pass; empty if it can."""
    if not item.name:
        return "The pass needs a name"
    if "." in item.name:
        return "The name of a pass must have no dot, OpenEXR files divide names there"
    if len(item.name.encode()) > MAX_NAME_BYTES:
        return "The name of the pass is too long"
    taken = {COMBINED.name, NOISY_IMAGE.name, SHADOW_CATCHER.name}
    taken |= {name for names in (*LIGHT_PASSES, *DATA_PASSES) for name in names[1:3]}
    taken |= {names[1] for names in OWN_DATA_PASSES} | {found.name for found in mattes(layer)}
    taken |= {name for toggle, name, _ in READY_MADE if getattr(layer.janus, toggle)}
    taken |= {f"Combined_{group.name}" for group in layer.lightgroups}
    for other in layer.janus.expressions:
        if other == item:
            break
        taken.add(other.name)
    return f"There is another pass '{item.name}'" if item.name in taken else ""


def strategy_length(scene) -> int:
    return strategy_lengths.get(scene.name_full, 0)


def strategies(length: int) -> list[tuple[int, int]]:
    """The techniques (s, t) of all paths of up to `length` edges, shortest paths first.

    A path of k edges has k + 1 vertices: s are made from the light and t from the camera, where
    one, the camera's own, always is. Light straight into the camera is found by s=0 alone.
    """
    return [
        (s, edges + 1 - s)
        for edges in range(1, length + 1)
        for s in range(edges + 1 if edges > 1 else 1)
    ]


def strategy_name(s: int, t: int, kind: str) -> str:
    """`kind` is "weighted" or "alone", which is without weight."""
    return f"s{s} t{t} {kind}"


def strategy_names(length: int) -> list[str]:
    if length == 0:
        return []
    names = [
        strategy_name(s, t, kind) for kind in ("weighted", "alone") for s, t in strategies(length)
    ]
    return [*names, LONGER]


LONGER = "longer weighted"  # all paths of more edges than those that have images
