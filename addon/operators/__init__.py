# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators, and what happens when the user picks the engine."""

from .cycles_settings import register, unregister

__all__ = ["register", "unregister"]
