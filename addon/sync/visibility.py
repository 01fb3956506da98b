# SPDX-License-Identifier: GPL-3.0-or-later
"""Visible things that Janus does not render yet: found here, named in the log, never fatal."""

from . import cycles_settings

RAYS = ("camera", "diffuse", "glossy", "transmission", "shadow")
LIGHT_RAYS = RAYS[:-1]  # a light is in nobody's way

TERMINATOR_OFFSET = 0.1001  # Cycles' default, and a little for rounding

# Object types that have a surface. Whatever they are, the depsgraph shows their faces as an
# instance of type MESH beside the object itself, so only that is exported.
SURFACE_TYPES = {"MESH", "CURVE", "SURFACE", "FONT", "META"}
SHAPE_TYPES = SURFACE_TYPES | {"CURVES", "POINTCLOUD"}

UNSUPPORTED_TYPES = {
    "VOLUME": "volumes are not supported yet",
}


def light_group(owner, view_layer) -> str:
    """The light group of an object or a world. As in Cycles, one that the view layer does not have
    is none: Blender keeps the names where groups are removed."""
    return owner.lightgroup if owner.lightgroup in view_layer.lightgroups else ""


def check_scene(depsgraph, log) -> None:
    """What concerns the whole scene or view layer."""
    if notice := cycles_settings.notice(depsgraph.scene_eval):
        log.info(notice)
    if getattr(getattr(depsgraph.scene_eval, "cycles", None), "use_fast_gi", False):
        log.info("Fast GI Approximation is Cycles' own: here light bounces as often as it may")


def seen_by(obj, rays=RAYS) -> dict:
    """The arguments of set_instance and set_light that say which rays meet the object."""
    names = (f"visible_{ray}" for ray in rays)
    return {name: getattr(obj, name) for name in names}


def surface_seen_by(instance, view_layer) -> dict:
    """The same for a surface as it stands in the scene: who instances it may hide it too, and
    collections may leave it to indirect light. And whether it holds out, which is for who instances
    it alone to say."""
    seen = seen_by(instance.object)
    owner = instance.object
    if instance.is_instance:
        owner = instance.parent
        seen = {name: seen[name] and value for name, value in seen_by(owner).items()}
    seen["visible_camera"] &= not owner.original.indirect_only_get(view_layer=view_layer)
    seen["holdout"] = owner.original.holdout_get(view_layer=view_layer)
    seen["shadow_catcher"] = is_shadow_catcher(instance.object, owner)
    return seen


def is_shadow_catcher(obj, owner) -> bool:
    """Is it part of the footage that the picture is laid over? `owner`: who shows it. Of lights,
    which most often are, Blender keeps the same setting."""
    return obj.is_shadow_catcher or owner.is_shadow_catcher


def check_object(obj, scene, log) -> None:
    """What concerns one object that has a surface."""
    settings, of_scene = getattr(obj, "cycles", None), getattr(scene, "cycles", None)
    if settings is None or of_scene is None:
        return
    for name, what in (("use_camera_cull", "Camera"), ("use_distance_cull", "Distance")):
        if getattr(settings, name, False) and getattr(of_scene, name, False):
            log.warning(f"{what} Cull is not supported, all of it is rendered", object=obj.name)
    # By default all objects have a little of the second.
    if settings.shadow_terminator_offset > 0.0 or (
        settings.shadow_terminator_geometry_offset > TERMINATOR_OFFSET
    ):
        log.warning(
            "offsets of the shadow terminator are not supported: give smooth faces more geometry "
            "where their shadows show edges",
            object=obj.name,
        )
