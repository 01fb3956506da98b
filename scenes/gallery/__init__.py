# SPDX-License-Identifier: GPL-3.0-or-later
"""The show-case behind `./dev gallery`: the lecture's comparisons, rendered and measured."""
