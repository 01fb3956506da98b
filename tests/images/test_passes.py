# SPDX-License-Identifier: GPL-3.0-or-later
"""Cycles' passes of light and light groups, through Cycles, path tracing and BDPT."""

import numpy as np
import pytest

from . import pass_scenes
from .conftest import made_by_both
from .statistics import compare

# Blender's names since 5.0, and the core's.
NAMES = {
    f"{kind} {what}": f"{short}{what[:3]}"
    for kind, short in (("Diffuse", "Diff"), ("Glossy", "Gloss"), ("Transmission", "Trans"))
    for what in ("Direct", "Indirect", "Color")
}
NAMES["Emission"], NAMES["Environment"] = "Emit", "Env"
NAMES["Combined"] = "Combined"
NAMES.update({f"Combined_{group}": f"Combined_{group}" for group in pass_scenes.GROUPS.values()})
NAMES = {
    name: key.replace("Dire", "Dir").replace("Indi", "Ind").replace("Colo", "Col")
    for name, key in NAMES.items()
}
# Passes of few paths.
ERRORS = {"Glossy Indirect": 0.005, "Transmission Direct": 0.007, "Transmission Indirect": 0.005}
TOLERANCES = {name: 3.0 * error for name, error in ERRORS.items()}
WAYS = {"pt": ("pt", 1024), "bdpt": ("bdpt", 512)}


@pytest.fixture(scope="module")
def pictures(tmp_path_factory):
    """get() -> by way or "cycles": a dictionary of pictures for each seed."""
    captured, cycles = made_by_both(pass_scenes, tmp_path_factory.mktemp("passes"))("passes")
    found = {"cycles": [{key.split(".")[-1]: p for key, p in one.items()} for one in cycles]}
    for way, (integrator, samples) in WAYS.items():
        found[way] = [
            captured.render_passes(
                integrator=integrator, samples=samples, seed=100 + seed, adaptive_counts=False
            )
            for seed in range(pass_scenes.SEEDS)
        ]
    return found


def light(passes: dict[str, np.ndarray], name: str, color: str) -> np.ndarray:
    """A pass, not divided by its colour: at edges, that is a quotient of two noisy numbers."""
    divided = name.endswith(("Dir", "Ind", "Direct", "Indirect"))
    return passes[name][..., :3] * (passes[color] if divided else 1.0)


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("name", NAMES)
def test_parity(pictures, name, way):
    ours = [light(one, NAMES[name], NAMES[name][:-3] + "Col") for one in pictures[way]]
    theirs = [light(one, name, name.split()[0] + " Color") for one in pictures["cycles"]]
    found = compare(ours, theirs, block=8, noisy=0.03, dark=1e-3, rounding=3e-5)
    print(f"{name}, {way} against Cycles: {found}")
    if name.endswith("Color"):  # hardly any noise: differences of tables show
        off = np.abs(np.delete(found.blocks, found.left_out))
        assert (off <= 0.005 + 4.0 * np.delete(found.errors, found.left_out)).all(), found
    else:
        found.check(TOLERANCES.get(name, 0.006), ERRORS.get(name, 0.003))


@pytest.mark.parametrize("way", WAYS)
def test_passes_make_the_picture(pictures, way):
    """As compositing files put it together."""
    one = pictures[way][0]
    total = one["Emit"] + one["Env"]
    for kind in ("Diff", "Gloss", "Trans"):
        total = total + one[f"{kind}Col"] * (one[f"{kind}Dir"] + one[f"{kind}Ind"])
    np.testing.assert_allclose(total, one["Combined"][..., :3], rtol=1e-3, atol=1e-5)
