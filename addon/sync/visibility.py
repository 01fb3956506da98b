# SPDX-License-Identifier: GPL-3.0-or-later
"""Visible things that Janus does not render yet: found here, named in the log, never fatal."""

from . import cycles_settings

# Cycles' defaults; anything else changes the picture.
RAYS = ("camera", "diffuse", "glossy", "transmission", "shadow")

UNSUPPORTED_TYPES = {
    "VOLUME": "volumes are not supported yet",
    "POINTCLOUD": "point clouds are not supported yet",
    "CURVES": "hair curves are not supported yet",
}


def check_scene(depsgraph, log) -> None:
    """What concerns the whole scene or view layer."""
    render = depsgraph.scene_eval.render
    if notice := cycles_settings.notice(depsgraph.scene_eval):
        log.info(notice)
    if render.use_motion_blur:
        log.warning("Motion blur is not supported yet")
    if render.use_multiview:
        log.warning("Stereoscopy is not supported, all views show the same picture")
    _check_collections(depsgraph.view_layer.layer_collection, log)


def _check_collections(layer_collection, log) -> None:
    for child in layer_collection.children:
        if child.exclude:
            continue
        if child.holdout:
            log.warning(f"Collection '{child.name}': holdout is not supported yet")
        if child.indirect_only:
            log.warning(f"Collection '{child.name}': indirect only is not supported yet")
        _check_collections(child, log)


def check_object(obj, log) -> None:
    """What concerns one object that has a surface."""
    hidden = [name for name in RAYS if not getattr(obj, f"visible_{name}")]
    if hidden:
        log.warning(f"ray visibility is not supported yet ({', '.join(hidden)})", object=obj.name)
    if obj.is_holdout:
        log.warning("holdout is not supported yet", object=obj.name)
    if obj.is_shadow_catcher:
        log.warning("shadow catchers are not supported yet", object=obj.name)
    check_linking(obj, log)


def check_linking(obj, log) -> None:
    """Light and shadow linking, of emitters and receivers alike."""
    linking = obj.light_linking
    if linking.receiver_collection or linking.blocker_collection:
        log.warning("light linking is not supported yet", object=obj.name)


def check_hair(obj, log) -> None:
    """Particle hair hangs on its emitter, which may itself be hidden."""
    for system in obj.particle_systems:
        settings = system.settings
        if settings.type == "HAIR" and settings.render_type == "PATH":
            log.warning("particle hair is not supported yet", object=obj.name)
