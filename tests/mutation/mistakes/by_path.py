# SPDX-License-Identifier: GPL-3.0-or-later
"""What depends on the camera's side of a path, of which light walks know nothing."""

from __future__ import annotations

from mistake import one

from mistakes.sources import CONNECT, ORACLE, SUBPATH

TECHNIQUES = ORACLE + ":*ByPath*"

BY_PATH = (
    one(
        "joins-over-crossings",
        0,
        "a join over what depends on the path weighs light walks that could not go there",
        TECHNIQUES,
        CONNECT,
        "joined->by_path ? kNothing : c.mis",
        "c.mis",
    ),
    one(
        "walks-back-over-crossings",
        0,
        "a hit weighs light walks that would have come over what depends on the path",
        TECHNIQUES,
        SUBPATH,
        "v.mis.b = {};  // or goes",
        "// or goes",
    ),
    one(
        "labels-that-lights-count",
        0,
        "next event estimation counts the vertex that it lights, where hits do not",
        TECHNIQUES,
        CONNECT,
        "v.path_beyond(label).looking(label)",
        "v.path_beyond(label)",
    ),
)
