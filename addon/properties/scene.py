# SPDX-License-Identifier: GPL-3.0-or-later
"""scene.janus. Names and words are Cycles' where Cycles has the setting.

Settings that a file does not hold come from Cycles: read them through sync/cycles_settings.py.
"""

import bpy
from bpy.props import (
    BoolProperty,
    EnumProperty,
    FloatProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

from .view_layer import check, heard, update_passes

# The numbers are what .blend files hold: never change or reuse one.
INTEGRATORS = (
    ("BDPT", "Bidirectional", "Paths from the camera and from the lights, combined", 0),
    ("PT", "Path Tracing", "Paths from the camera only, as in Cycles", 1),
    ("LT", "Light Tracing", "Paths from the lights only; blind to what is seen in mirrors", 2),
)
FILTERS = (
    ("BOX", "Box", "Box filter", 0),
    ("GAUSSIAN", "Gaussian", "Gaussian filter", 1),
    ("BLACKMAN_HARRIS", "Blackman-Harris", "Blackman-Harris filter", 2),
)
HEURISTICS = (
    ("BALANCE", "Balance", "Weights proportional to each technique's density", 0),
    ("POWER", "Power", "Weights proportional to the square of each technique's density", 1),
    ("NONE", "None", "No weights: the mean of the techniques that are chosen below", 2),
)
CONNECTION_MODES = (
    (
        "CACHE",
        "Light Vertex Cache",
        "Each vertex of a camera path is joined with vertices of any light path",
        0,
    ),
    (
        "CLASSIC",
        "Classic",
        "Each camera path has a light path of its own, and all their vertices are joined",
        1,
    ),
)
DENOISING_QUALITIES = (
    ("HIGH", "High", "High quality", 1),
    ("BALANCED", "Balanced", "Balanced between performance and quality", 2),
    ("FAST", "Fast", "High performance", 3),
)
DENOISING_PASSES = (
    ("RGB", "None", "The picture alone", 1),
    ("RGB_ALBEDO", "Albedo", "The picture and its albedo", 2),
    ("RGB_ALBEDO_NORMAL", "Albedo and Normal", "The picture, its albedo and normals", 3),
)
DENOISING_PREFILTERS = (
    ("NONE", "None", "Nothing: for passes without noise", 1),
    ("FAST", "Fast", "Denoise them along with the picture", 2),
    ("ACCURATE", "Accurate", "Denoise them first, which takes more time", 3),
)


def _check_strategies(self, _context):
    self.strategies_message = check("check_strategies", self.strategies)


# Of renders and of viewports.


def _adaptive_sampling(name: str):
    return BoolProperty(
        name=name,
        description="Stop pixels that have little noise before the others. That is quicker, but "
        "light that comes seldom may be missed: a bias, which grows with the threshold",
        default=False,
    )


def _noise_threshold(name: str, default: float):
    return FloatProperty(
        name=name,
        description="Noise at which pixels stop, as Cycles measures it: lower values are slower "
        "and cleaner",
        min=1e-5,
        max=1.0,
        soft_min=0.001,
        default=default,
        precision=4,
    )


def _min_samples(name: str):
    return IntProperty(
        name=name,
        description="Samples that each pixel gets at least; 0 is a number by the threshold",
        min=0,
        max=4096,
        default=0,
    )


@heard
class JanusSceneSettings(bpy.types.PropertyGroup):
    """Render settings of Janus"""

    samples: IntProperty(
        name="Samples",
        description="Number of samples to render for each pixel",
        min=1,
        max=(1 << 31) - 1,
        soft_max=1 << 16,
        default=64,
    )
    use_adaptive_sampling: _adaptive_sampling("Use Adaptive Sampling")
    adaptive_threshold: _noise_threshold("Noise Threshold", 0.01)
    adaptive_min_samples: _min_samples("Min Samples")
    preview_samples: IntProperty(
        name="Viewport Samples",
        description="Number of samples to render in the viewport, unlimited if 0",
        min=0,
        max=1 << 24,
        soft_max=1 << 16,
        default=1024,
    )
    use_preview_adaptive_sampling: _adaptive_sampling("Use Viewport Adaptive Sampling")
    preview_adaptive_threshold: _noise_threshold("Viewport Noise Threshold", 0.1)
    preview_adaptive_min_samples: _min_samples("Viewport Min Samples")
    time_limit: FloatProperty(
        name="Time Limit",
        description="Limit the render time, without set-up (0 disables the limit)",
        min=0.0,
        default=0.0,
        step=100.0,
        unit="TIME_ABSOLUTE",
    )
    use_denoising: BoolProperty(
        name="Use Denoising",
        description="Denoise the rendered image",
        default=False,
        update=update_passes,
    )
    denoising_quality: EnumProperty(
        name="Denoising Quality",
        description="Overall denoising quality when using OpenImageDenoise",
        items=DENOISING_QUALITIES,
        default="HIGH",
    )
    denoising_input_passes: EnumProperty(
        name="Denoising Input Passes",
        description="Passes that tell the denoiser noise from detail of shaders and geometry",
        items=DENOISING_PASSES,
        default="RGB_ALBEDO_NORMAL",
    )
    denoising_prefilter: EnumProperty(
        name="Denoising Prefilter",
        description="What to do about the noise of albedo and normals themselves",
        items=DENOISING_PREFILTERS,
        default="ACCURATE",
    )
    use_preview_denoising: BoolProperty(
        name="Use Viewport Denoising",
        description="Denoise the picture of the 3D viewport",
        default=False,
    )
    preview_denoising_start_sample: IntProperty(
        name="Start Denoising",
        description="Number of samples that a picture must have to be denoised",
        min=0,
        max=1 << 24,
        default=1,
    )
    preview_denoising_input_passes: EnumProperty(
        name="Viewport Denoising Input Passes",
        description="Passes that tell the denoiser noise from detail of shaders and geometry",
        items=DENOISING_PASSES,
        default="RGB_ALBEDO",
    )
    preview_denoising_prefilter: EnumProperty(
        name="Viewport Denoising Prefilter",
        description="What to do about the noise of albedo and normals themselves",
        items=DENOISING_PREFILTERS,
        default="FAST",
    )
    preview_denoising_quality: EnumProperty(
        name="Viewport Denoising Quality",
        description="Overall denoising quality when using OpenImageDenoise",
        items=DENOISING_QUALITIES,
        default="BALANCED",
    )
    seed: IntProperty(
        name="Seed",
        description="Seed of the noise: the same seed gives the same picture",
        min=0,
        default=0,
    )
    use_animated_seed: BoolProperty(
        name="Use Animated Seed",
        description="Give each frame noise of its own",
        default=False,
    )
    max_bounces: IntProperty(
        name="Total",
        description="Total maximum number of bounces",
        min=0,
        max=1024,
        default=12,
    )
    diffuse_bounces: IntProperty(
        name="Diffuse",
        description="Maximum number of diffuse reflection bounces",
        min=0,
        max=1024,
        default=4,
    )
    glossy_bounces: IntProperty(
        name="Glossy",
        description="Maximum number of glossy reflection bounces",
        min=0,
        max=1024,
        default=4,
    )
    transmission_bounces: IntProperty(
        name="Transmission",
        description="Maximum number of transmission bounces",
        min=0,
        max=1024,
        default=12,
    )
    transparent_max_bounces: IntProperty(
        name="Transparent",
        description="Maximum number of transparent surfaces that a path passes",
        min=0,
        max=1024,
        default=8,
    )
    sample_clamp_direct: FloatProperty(
        name="Clamp Direct",
        description="The most that a contribution of direct light adds to a sample. Darkens the "
        "picture to avoid fireflies (0 disables clamping)",
        min=0.0,
        default=0.0,
    )
    sample_clamp_indirect: FloatProperty(
        name="Clamp Indirect",
        description="The most that a contribution of indirect light adds to a sample. Darkens the "
        "picture to avoid fireflies, and cuts caustics (0 disables clamping)",
        min=0.0,
        default=0.0,
    )
    integrator: EnumProperty(
        name="Integrator",
        description="How light is found",
        items=INTEGRATORS,
        default="BDPT",
    )
    next_event: BoolProperty(
        name="Next Event Estimation",
        description="Paths also look for the other side at each vertex: camera paths for a light, "
        "light paths for the camera. Without, they must hit it by chance, so lights without size "
        "and cameras without an aperture stay dark to them",
        default=True,
    )
    connection_mode: EnumProperty(
        name="Connections",
        description="Which vertices of light paths the camera paths are joined with",
        items=CONNECTION_MODES,
        default="CACHE",
    )
    adaptive_counts: BoolProperty(
        name="Automatic",
        description="Starts with the numbers below, measures their use in the scene, and goes on "
        "with those that clear the picture soonest, which may be hardly any. Needs the balance "
        "heuristic",
        default=True,
    )
    light_paths: FloatProperty(
        name="Light Paths",
        description="Paths traced from the lights for each pixel and sample. Zero makes "
        "Bidirectional a path tracer, at a path tracer's cost",
        min=0.0,
        max=64.0,
        soft_max=4.0,
        default=1.0,
    )
    connections: FloatProperty(
        name="Connections",
        description="How many vertices of light paths each vertex of a camera path is "
        "connected with",
        min=0.0,
        max=64.0,
        soft_max=8.0,
        default=1.0,
    )
    use_merging: BoolProperty(
        name="Merge Vertices",
        description="Also joins light paths and camera paths where they arrive at almost the same "
        "place. Clears caustics that are seen in mirrors and through glass, and blurs light by the "
        "radius, less with every sample. The numbers above are then not automatic",
        default=False,
    )
    merge_radius: FloatProperty(
        name="Merge Radius",
        description="How far apart vertices may be to be merged in the first sample: the width of "
        "the finest caustics that matter",
        subtype="DISTANCE",
        min=1e-6,
        soft_max=1.0,
        default=0.01,
    )
    heuristic: EnumProperty(
        name="Heuristic",
        description="How the techniques that can find the same path share its light",
        items=HEURISTICS,
        default="BALANCE",
    )
    strategies: StringProperty(
        name="Strategies",
        description="The techniques in use, as pairs s,t of how many vertices are made from the "
        "light and from the camera, * for any number: 0,* is path tracing without, 1,* with next "
        "event estimation, *,1 light tracing. Nothing: all. Several that find paths of the same "
        "length are averaged",
        update=_check_strategies,
    )
    strategies_message: StringProperty(
        name="Message", description="What is wrong with the strategies", options={"HIDDEN"}
    )
    pixel_filter_type: EnumProperty(
        name="Filter Type",
        description="Pixel filter type",
        items=FILTERS,
        default="BLACKMAN_HARRIS",
    )
    filter_width: FloatProperty(
        name="Filter Width",
        description="Pixel filter width",
        min=0.01,
        max=10.0,
        default=1.5,
        subtype="PIXEL",
    )
    film_exposure: FloatProperty(
        name="Exposure",
        description="Image brightness scale",
        min=0.0,
        soft_max=10.0,
        default=1.0,
    )
    film_transparent_glass: BoolProperty(
        name="Transparent Glass",
        description="Leaves the world out of the picture behind clear glass, too, for compositing "
        "it over another background",
        default=False,
    )
    film_transparent_roughness: FloatProperty(
        name="Roughness Threshold",
        description="Glass is clear up to this roughness",
        min=0.0,
        max=1.0,
        default=0.1,
    )
    cycles_notice: BoolProperty(
        name="Notice",
        description="The settings were copied from Cycles, and nobody has said yet that they know",
        default=False,
        options={"HIDDEN"},
    )
    capture_path: StringProperty(
        name="Capture",
        description="File that the next renders save the scene description to, for "
        "rendering without Blender",
        subtype="FILE_PATH",
        options={"HIDDEN", "SKIP_SAVE"},
    )


def register():
    bpy.utils.register_class(JanusSceneSettings)
    bpy.types.Scene.janus = PointerProperty(type=JanusSceneSettings)


def unregister():
    del bpy.types.Scene.janus
    bpy.utils.unregister_class(JanusSceneSettings)
