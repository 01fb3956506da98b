# SPDX-License-Identifier: GPL-3.0-or-later
"""The strategy pyramid: what each technique (s, t) finds, with its weight and alone."""

import os

from ..sync.passes import strategy_lengths
from . import contact_sheet, picture
from .final import keep_passes_of, kept_passes


def ask(scene, length: int) -> None:
    """The next renders make images of the techniques of all paths of up to `length` edges."""
    strategy_lengths[scene.name_full] = length
    keep_passes_of.add(scene.name_full)


def withdraw(scene) -> None:
    """The next renders are as usual."""
    strategy_lengths.pop(scene.name_full, None)
    keep_passes_of.discard(scene.name_full)
    kept_passes.clear()


def save(scene, folder: str, exposure: float = 0.0) -> list[str]:
    """Writes the last render into the folder: the paths of the files, the sheets first.

    strategies.png is the contact sheet, with several view layers one for each; strategies.exr the
    render result with the passes as they are. None without strategies. Raises OSError or
    RuntimeError for what cannot be written.
    """
    os.makedirs(folder, exist_ok=True)
    files = []
    for layer, passes in kept_passes.items():
        if not contact_sheet.longest(passes):
            continue
        suffix = f"_{layer.replace(os.sep, '_')}" if len(kept_passes) > 1 else ""
        path = os.path.join(folder, f"strategies{suffix}.png")
        sheet = contact_sheet.lay_out(passes, exposure)
        display = picture.displayed(scene, sheet.picture[::-1])[::-1]
        picture.save_bytes(path, contact_sheet.label(sheet, display)[::-1])
        files.append(path)
    if files:
        files.append(os.path.join(folder, "strategies.exr"))
        picture.save_result(scene, files[-1])
    return files
