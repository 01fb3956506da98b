# SPDX-License-Identifier: GPL-3.0-or-later
"""`python -m janus_core`: renders a captured scene; see cli.py."""

import sys

from .cli import main

sys.exit(main())
