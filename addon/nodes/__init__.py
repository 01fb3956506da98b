# SPDX-License-Identifier: GPL-3.0-or-later
"""Shader node trees as plain data. Knows nothing of the core."""

from .flatten import diffuse_graph, flatten_aovs, flatten_tree, image_key

__all__ = ["diffuse_graph", "flatten_aovs", "flatten_tree", "image_key"]
