# SPDX-License-Identifier: GPL-3.0-or-later
"""The classic mistakes of bidirectional path tracing, by kind."""

from __future__ import annotations

from mistakes.below import BELOW
from mistakes.by_path import BY_PATH
from mistakes.catchers import CATCHERS
from mistakes.clear_views import CLEAR
from mistakes.data import DATA_AND_COMMITS
from mistakes.densities import DENSITIES
from mistakes.fibers import FIBERS
from mistakes.film import FILM_AND_SAMPLES
from mistakes.lecture import LECTURE_MADE_VISIBLE
from mistakes.merges import MERGES
from mistakes.motion import MOTION_AND_LINKING
from mistakes.paths import PATHS
from mistakes.specular_walks import SPECULAR_WALKS
from mistakes.thin_walls import THIN_WALLS
from mistakes.transport import TRANSPORT
from mistakes.values import VALUES
from mistakes.views import VIEWS

MISTAKES = DENSITIES + VALUES + PATHS + FILM_AND_SAMPLES + VIEWS + CLEAR + MERGES + SPECULAR_WALKS
MISTAKES += LECTURE_MADE_VISIBLE + DATA_AND_COMMITS + MOTION_AND_LINKING + CATCHERS + FIBERS
MISTAKES += BELOW + TRANSPORT + BY_PATH + THIN_WALLS
