# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings that Blender saves with a file: scene.janus."""

from .scene import JanusSceneSettings, register, unregister

__all__ = ["JanusSceneSettings", "register", "unregister"]
