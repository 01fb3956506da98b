# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of luminaires in descriptions that others wrote."""

import pytest


@pytest.mark.parametrize(
    "table",
    [None, [], [1.0, 2.0, 0.0], [2.0, 2.0, *[0.5] * 7], [1e9, 1e9], [0.0, 0.0], [-1.0, 2.0]],
)
def test_tables_of_luminaires_that_are_none(builder, table):
    properties = {} if table is None else {"ies": table}
    ies = {"name": "Beam", "type": "TEX_IES", "inputs": {}, "properties": properties}
    lamp = {"Color": [1, 1, 1, 1], "Strength": {"link": ["Beam", "Fac"]}}
    emission = {"name": "Lamp", "type": "EMISSION", "inputs": lamp, "properties": {}}
    graph = {"nodes": [ies, emission], "surface": {"link": ["Lamp", "Emission"]}}
    builder.set_material("m", name="Paint", graph=graph)
    (found,) = builder.commit().diagnostics
    assert (found.material, found.node) == ("Paint", "Beam")
    assert "its table is none; the value is 100" in found.message
