# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs sessions of the core for Blender. The only package that touches one."""
