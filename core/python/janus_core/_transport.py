# SPDX-License-Identifier: GPL-3.0-or-later
"""The light transport matrix: what it holds, and its files. See janus_core.dual."""

from __future__ import annotations

import os
from typing import Any

import numpy as np
import numpy.typing as npt

from ._core import IoError
from ._files import read_array, reading, write
from ._products import Products, root_size

FORMAT, VERSION = "janus-transport", 1
_ARRAYS = {
    "blocks": np.uint32,
    "entry_pixel": np.uint32,
    "entry_block": np.uint32,
    "entry_value": np.float32,
    "entry_variance": np.float32,
    "share_value": np.float32,
    "share_variance": np.float32,
    "own_watts": np.float32,
    "plain_watts": np.float32,
}
_NUMBERS = ("samples", "tile_size", "shares_size")


class TransportMatrix:
    """T = E S, by channel: sparse, with a variance for each entry of E and each share.

    Camera pixels are in tiles, for each of which the projector's pixels are divided into square
    blocks. An entry of E is the light that a camera pixel gets of a block. S spreads the light of a
    block over its pixels, as the whole tile has seen it. So the sums over the projector's pixels
    are exact for every camera pixel, those over a tile's camera pixels for every projector pixel
    (for squares of shares_size pixels), however coarse the blocks are.

    samples: passes of which it is the mean. blocks: uint32[B, 4], tile, x, y and size. entry_pixel,
    entry_block: uint32[M]; camera pixels are counted row by row. entry_value, entry_variance:
    float32[M, 3], radiance per watt of all pixels of the block, and the variance of this mean.
    share_value, share_variance: float32[tiles, rows, columns, 3], sums over the pixels of a tile.
    own_watts, plain_watts: float32[height, width, 3], what the light emits into each pixel, with
    and without its node tree. projector, camera: dicts, where they stand.
    """

    samples: int
    tile_size: int
    shares_size: int
    blocks: npt.NDArray[np.uint32]
    entry_pixel: npt.NDArray[np.uint32]
    entry_block: npt.NDArray[np.uint32]
    entry_value: npt.NDArray[np.float32]
    entry_variance: npt.NDArray[np.float32]
    share_value: npt.NDArray[np.float32]
    share_variance: npt.NDArray[np.float32]
    own_watts: npt.NDArray[np.float32]
    plain_watts: npt.NDArray[np.float32]

    def __init__(
        self,
        arrays: dict[str, Any],
        camera_size: tuple[int, int],
        projector: dict[str, Any],
        camera: dict[str, Any],
    ) -> None:
        """Raises ValueError for arrays that do not belong together."""
        for name in _NUMBERS:
            setattr(self, name, int(arrays[name]))
        for name, kind in _ARRAYS.items():
            setattr(self, name, np.asarray(arrays[name], dtype=kind))
        self.camera_size = tuple(camera_size)
        self.projector, self.camera = projector, camera
        self._check()
        self._products = Products(self)

    @property
    def projector_size(self) -> tuple[int, int]:
        """Width and height of the projector's picture."""
        return self.plain_watts.shape[1], self.plain_watts.shape[0]

    @property
    def nbytes(self) -> int:
        """Of all arrays."""
        return sum(getattr(self, name).nbytes for name in _ARRAYS)

    # --- Products. Nothing is traced here. ---

    def relight(self, watts: npt.ArrayLike | None = None) -> npt.NDArray[np.float32]:
        """T p: the camera's picture when the projector emits `watts` by pixel and channel.

        `watts`: [height, width, 3] or [height, width]; None: those of the light as it was captured,
        own_watts. See shown() for slides. Raises ValueError for another shape.
        """
        p = self._picture(self.own_watts if watts is None else watts, self.projector_size)
        return self._products.to_camera(
            self.entry_value * self._products.in_blocks(p)[self.entry_block]
        )

    def relight_variance(self, watts: npt.ArrayLike | None = None) -> npt.NDArray[np.float32]:
        """The variance of relight(watts), the squared standard error of each number in it.

        From how the passes scatter, entry by entry. The real one is rather smaller where the
        projector shines evenly: light that is missing in one block is in another.
        """
        p = self._picture(self.own_watts if watts is None else watts, self.projector_size)
        factor = self._products.in_blocks(p)[self.entry_block]
        return self._products.to_camera(self.entry_variance * factor * factor)

    def dual(self, watts: npt.ArrayLike | None = None) -> npt.NDArray[np.float32]:
        """The transpose of T times c: what the projector sees when the camera emits `watts`.

        `watts`: [height, width, 3] or [height, width] of the camera; None: the same from each
        pixel, in all as much as plain_watts. The result has the projector's size, its numbers are
        radiance. Raises ValueError for another shape.
        """
        return self._products.from_camera(self._emitted(watts))[0]

    def dual_variance(self, watts: npt.ArrayLike | None = None) -> npt.NDArray[np.float32]:
        """The variance of dual(watts), likewise."""
        return self._products.from_camera(self._emitted(watts))[1]

    def shown(self, slide: npt.ArrayLike) -> npt.NDArray[np.float32]:
        """The watts of the light with `slide` before it: plain_watts times its colours.

        A slide of another size than the projector's is averaged over its pixels, or repeated.
        """
        slide = np.asarray(slide, dtype=np.float64)
        if slide.ndim not in (2, 3) or (slide.ndim == 3 and slide.shape[2] not in (3, 4)):
            raise ValueError(f"a slide is [height, width, 3], not {slide.shape}")
        slide = slide[..., None].repeat(3, axis=2) if slide.ndim == 2 else slide[..., :3]
        width, height = self.projector_size
        return self.plain_watts * _resized(_resized(slide, height, 0), width, 1)

    def row(self, x: int, y: int) -> npt.NDArray[np.float32]:
        """All that camera pixel (x, y) gets, by projector pixel: [height, width, 3], per watt."""
        return self.dual(_one(self.camera_size, x, y))

    def column(self, x: int, y: int) -> npt.NDArray[np.float32]:
        """The camera's picture while projector pixel (x, y) emits one watt."""
        return self.relight(_one(self.projector_size, x, y))

    # --- Files ---

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a .npz file: the arrays by their names, and transport.json with the rest.

        The file appears when it is complete. Raises IoError, which names it.
        """
        description = {
            "format": FORMAT,
            "version": VERSION,
            "camera_size": self.camera_size,
            "projector": self.projector,
            "camera": self.camera,
            **{name: getattr(self, name) for name in _NUMBERS},
        }
        arrays = {name: getattr(self, name) for name in _ARRAYS}
        write(path, "transport.json", description, arrays, level=1)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> TransportMatrix:
        """What save() has written. Raises IoError, which names the file, for anything else."""
        name = os.fspath(path)
        with reading(name, "a light transport matrix of Janus", "transport.json", FORMAT) as (
            described,
            archive,
        ):
            if described.get("version") != VERSION:
                raise IoError(
                    f"cannot read {name}: version {described.get('version')} of the format is "
                    f"not known here, only {VERSION}"
                )
            arrays = {key: described[key] for key in _NUMBERS}
            arrays |= {key: read_array(archive, key) for key in _ARRAYS}
            size = described["camera_size"]
            return cls(arrays, size, described["projector"], described["camera"])

    def _check(self) -> None:
        width, height = self.camera_size
        tiles = -(-width // self.tile_size) * -(-height // self.tile_size)
        blocks, entries, size = len(self.blocks), len(self.entry_pixel), self.shares_size
        rows, columns = (-(-side // size) for side in reversed(self.projector_size))
        shapes = {
            "blocks": (blocks, 4),
            "entry_block": (entries,),
            "entry_value": (entries, 3),
            "entry_variance": (entries, 3),
            "share_value": (tiles, rows, columns, 3),
            "share_variance": (tiles, rows, columns, 3),
            "own_watts": self.plain_watts.shape,
        }
        for name, shape in shapes.items():
            if getattr(self, name).shape != shape:
                raise ValueError(f"{name} has the shape {getattr(self, name).shape}, not {shape}")
        sizes = self.blocks[:, 3]
        if (
            np.any(np.diff(self.blocks[:, 0].astype(np.int64)) < 0)
            or np.any(self.blocks[:, 0] >= tiles)
            or np.any(self.blocks[:, 1:3] >= self.projector_size)
            or np.any(
                (sizes == 0) | (sizes & (sizes - 1)) | (sizes > root_size(self.projector_size))
            )
            or size & (size - 1)
            or np.any(self.blocks[:, 1:3] % np.maximum(sizes, 1)[:, None])
            or np.any(self.entry_block >= blocks)
            or np.any(self.entry_pixel >= width * height)
        ):
            raise ValueError("the blocks or the entries lie outside of the matrix")

    def _picture(self, pixels: npt.ArrayLike, size: tuple[int, int]) -> np.ndarray:
        """float64[height, width, 3]."""
        pixels = np.asarray(pixels, dtype=np.float64)
        width, height = size
        if pixels.shape == (height, width):
            pixels = pixels[..., None]
        if pixels.shape not in ((height, width, 1), (height, width, 3)):
            raise ValueError(
                f"the picture must be [{height}, {width}, 3] or [{height}, {width}], "
                f"not {list(pixels.shape)}"
            )
        return np.broadcast_to(pixels, (height, width, 3))

    def _emitted(self, watts: npt.ArrayLike | None) -> np.ndarray:
        """By the camera's pixels, float64[height, width, 3]."""
        width, height = self.camera_size
        if watts is None:
            total = self.plain_watts.sum(axis=(0, 1), dtype=np.float64)
            watts = np.broadcast_to(total / (width * height), (height, width, 3))
        return self._picture(watts, self.camera_size)


def _one(size: tuple[int, int], x: int, y: int) -> np.ndarray:
    width, height = size
    if not (0 <= x < width and 0 <= y < height):
        raise ValueError(f"there is no pixel ({x}, {y}) in {width} x {height}")
    picture = np.zeros((height, width))
    picture[y, x] = 1.0
    return picture


def _resized(pixels: np.ndarray, size: int, axis: int) -> np.ndarray:
    """The mean over the part of `pixels` that each of `size` new ones covers."""
    old = pixels.shape[axis]
    if old == 0:
        raise ValueError("a slide must not be empty")
    total = np.zeros((old + 1, *np.delete(pixels.shape, axis)))
    np.cumsum(np.moveaxis(pixels, axis, 0), axis=0, out=total[1:])
    places = np.linspace(0.0, old, size + 1)
    whole = np.minimum(places.astype(int), old - 1)
    part = (places - whole).reshape(-1, *[1] * (total.ndim - 1))
    integral = total[whole] * (1.0 - part) + total[whole + 1] * part
    return np.moveaxis(np.diff(integral, axis=0) * (size / old), 0, axis)
