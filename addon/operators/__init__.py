# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators, and what happens when the user picks the engine."""

from . import cycles_settings, dual, expressions, report, strategies

MODULES = (cycles_settings, dual, expressions, report, strategies)


def register():
    for module in MODULES:
        module.register()


def unregister():
    for module in reversed(MODULES):
        module.unregister()
