# SPDX-License-Identifier: GPL-3.0-or-later
"""From Blender's depsgraph to the calls of a SceneBuilder. Knows no session."""

from .scene_sync import sync_scene

__all__ = ["sync_scene"]
