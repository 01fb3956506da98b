# SPDX-License-Identifier: GPL-3.0-or-later
"""view_layer.janus: what Blender has no switches for, above all passes."""

import bpy
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

from .. import bridge


def check(function: str, text: str) -> str:
    """What the core says against a text that a user typed; empty if it is good."""
    try:
        return getattr(bridge.core(), function)(text)
    except bridge.CoreUnavailable:
        return ""  # the panels say that, in a place of its own


def update_passes(self, _context):
    """The compositor's sockets follow a setting that changes which passes there are."""
    for layer in self.id_data.view_layers:
        layer.update_render_passes()


def heard(cls):
    """A class of settings that Blender hears of when scripts set them: those that have an update
    function."""
    for setting in cls.__annotations__.values():
        if setting.function is not CollectionProperty:
            setting.keywords.setdefault("update", lambda _self, _context: None)
    return cls


def _check_expression(self, _context):
    self.message = check("check_expression", self.expression)


@heard
class JanusLightPathExpression(bpy.types.PropertyGroup):
    """A render pass that holds the light of certain paths"""

    name: StringProperty(name="Name", description="Name of the render pass", default="Paths")
    expression: StringProperty(
        name="Expression",
        description="The paths whose light the pass has, from the light (L) to the camera (E): D, "
        "G and S are diffuse, glossy and specular scattering, the dot is any. * + ? repeat what is "
        "before, | and () choose, as in LS+DE or L(D|S)*E",
        default="L.*E",
        update=_check_expression,
    )
    enabled: BoolProperty(
        name="Enabled", description="Render the pass", default=True, options=set()
    )
    message: StringProperty(
        name="Message", description="What is wrong with the expression", options={"HIDDEN"}
    )


@heard
class JanusViewLayerSettings(bpy.types.PropertyGroup):
    """View layer settings of Janus"""

    use_denoising: BoolProperty(
        name="Use Denoising",
        description="Denoise the rendered image",
        default=True,
        update=update_passes,
    )
    use_pass_shadow_catcher: BoolProperty(
        name="Shadow Catcher",
        description="Deliver the factor by which shadows and light on shadow catchers change the "
        "footage behind the picture, which is then without them",
        update=update_passes,
    )
    use_pass_direct: BoolProperty(
        name="Direct",
        description="Deliver the light that comes to the seen surface straight from its source",
    )
    use_pass_indirect: BoolProperty(
        name="Indirect",
        description="Deliver the light that bounces at least once before it comes to the seen "
        "surface",
    )
    use_pass_interreflections: BoolProperty(
        name="Diffuse Inter-Reflections",
        description="Deliver the light that goes from one diffuse surface to another and so on to "
        "the camera",
    )
    use_pass_caustics: BoolProperty(
        name="Caustics",
        description="Deliver the light that mirrors, glass and glossy surfaces throw on diffuse "
        "ones",
    )
    pass_debug_sample_count: BoolProperty(
        name="Sample Count", description="The part of all samples that each pixel has got"
    )
    denoising_store_passes: BoolProperty(
        name="Denoising Data",
        description="Deliver albedo, normals and depth as denoisers need them",
    )
    expressions: CollectionProperty(name="Light Path Expressions", type=JanusLightPathExpression)
    active_expression: IntProperty(name="Active Expression", min=0, options={"HIDDEN"})


CLASSES = (JanusLightPathExpression, JanusViewLayerSettings)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.ViewLayer.janus = PointerProperty(type=JanusViewLayerSettings)


def unregister():
    del bpy.types.ViewLayer.janus
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
