# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings that Blender saves with a file: scene.janus, view_layer.janus and light.janus."""

from . import light, scene, view_layer


def register():
    scene.register()
    view_layer.register()
    light.register()


def unregister():
    light.unregister()
    view_layer.unregister()
    scene.unregister()
