# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings that Blender saves with a file: scene.janus and view_layer.janus."""

from . import scene, view_layer


def register():
    scene.register()
    view_layer.register()


def unregister():
    view_layer.unregister()
    scene.unregister()
