# SPDX-License-Identifier: GPL-3.0-or-later
"""Whole pictures: integrators agree, renders repeat, and Cycles says the same."""
