# SPDX-License-Identifier: GPL-3.0-or-later
"""The parts of `./dev render`; scenes/render.py puts them together."""
