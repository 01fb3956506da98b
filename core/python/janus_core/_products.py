# SPDX-License-Identifier: GPL-3.0-or-later
"""Products of a light transport matrix with pictures, some tiles at a time."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from ._transport import TransportMatrix

_CHUNK = 1 << 22  # numbers at a time, so that products take little memory beside the matrix


def root_size(size: tuple[int, int]) -> int:
    """Of a square block with all pixels of the projector in it: a power of two."""
    return 1 << (max(size) - 1).bit_length()


class Products:
    """With E and S of the matrix, and with their transposes."""

    def __init__(self, matrix: TransportMatrix) -> None:
        self._of = matrix
        self._root = root_size(matrix.projector_size)
        changes = np.flatnonzero(np.diff(matrix.entry_pixel)) + 1
        self._runs = np.append(0, changes) if len(matrix.entry_pixel) else changes
        count = len(matrix.share_value)
        self._first_block = np.searchsorted(matrix.blocks[:, 0], np.arange(count + 1))
        self._sums: np.ndarray | None = None

    def to_camera(self, parts: np.ndarray) -> npt.NDArray[np.float32]:
        """Sums over the entries of each camera pixel, of parts[M, 3]."""
        width, height = self._of.camera_size
        result = np.zeros((height * width, 3), dtype=np.float32)
        if len(parts):
            sums = np.add.reduceat(parts, self._runs, axis=0, dtype=np.float64)
            np.add.at(result, self._of.entry_pixel[self._runs], sums.astype(np.float32))
        return result.reshape(height, width, 3)

    def _tiles(self) -> Iterator[tuple[slice, slice]]:
        """(tiles, their blocks), some at a time."""
        step = max(1, _CHUNK // (3 * self._squares**2))
        for begin in range(0, len(self._of.share_value), step):
            end = min(begin + step, len(self._of.share_value))
            yield slice(begin, end), slice(self._first_block[begin], self._first_block[end])

    @property
    def _squares(self) -> int:
        """On a side of the root block, the shares' squares."""
        return max(self._root // self._of.shares_size, 1)

    def _padded(self, squares: np.ndarray) -> np.ndarray:
        """[..., rows, columns, 3] as float64, as large as the root block."""
        rows, columns = squares.shape[-3:-1]
        result = np.zeros((*squares.shape[:-3], self._squares, self._squares, 3))
        result[..., :rows, :columns, :] = squares
        return result

    def _levels(self, blocks: slice) -> Iterator[tuple[int, np.ndarray, tuple[np.ndarray, ...]]]:
        """For each size of blocks that have shares: (squares on a side, which of them, where they
        are: tile, row and column)."""
        tile, x, y, size = self._of.blocks[blocks].T.astype(np.int64)
        for side in np.unique(size[size >= self._of.shares_size]):
            which = np.flatnonzero(size == side)
            where = (tile[which], y[which] // side, x[which] // side)
            yield max(int(side) // self._of.shares_size, 1), which + blocks.start, where

    def _small(self) -> Iterator[tuple[int, np.ndarray, tuple[np.ndarray, np.ndarray]]]:
        """For each size of blocks that are smaller than the shares' squares, likewise."""
        _, x, y, size = self._of.blocks.T.astype(np.int64)
        for side in np.unique(size[size < self._of.shares_size]):
            which = np.flatnonzero(size == side)
            yield int(side), which, (y[which] // side, x[which] // side)

    def _pixels_in(self, side: int) -> np.ndarray:
        """How many pixels squares of that side have, [rows, columns] up to the root's border."""
        inside = np.zeros((self._root, self._root, 1))
        inside[: self._of.projector_size[1], : self._of.projector_size[0]] = 1.0
        return _sums(inside, side)

    def _means(self, p: np.ndarray, side: int) -> np.ndarray:
        padded = np.zeros((self._root, self._root, 3))
        padded[: p.shape[0], : p.shape[1]] = p
        return _sums(padded, side) / np.maximum(self._pixels_in(side), 1.0)

    def _block_sums(self) -> np.ndarray:
        """Sums of the shares over each block, float64[B, 3]; 1 for the small ones."""
        if self._sums is None:
            self._sums = self._weighted_sums(None)
        return self._sums

    def _weighted_sums(self, weights: np.ndarray | None) -> np.ndarray:
        result = np.ones((len(self._of.blocks), 3))
        for tiles, blocks in self._tiles():
            shares = self._padded(self._of.share_value[tiles])
            if weights is not None:
                shares *= weights
            for side, which, (tile, row, column) in self._levels(blocks):
                result[which] = _sums(shares, side)[tile - tiles.start, row, column]
        return result

    def in_blocks(self, p: np.ndarray) -> np.ndarray:
        """S p: for each block and channel the mean of p, weighted by the shares."""
        squares = min(self._of.shares_size, self._root)
        sums = self._block_sums()
        result = self._weighted_sums(self._means(p, squares))
        result = np.divide(result, sums, out=np.zeros_like(result), where=sums != 0.0)
        for side, which, (row, column) in self._small():
            result[which] = self._means(p, side)[row, column]
        return result

    def from_camera(self, c: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The transpose of E S times a camera's picture, [height, width, 3] of the projector, and
        the variance of that."""
        c = c.reshape(-1, 3)[self._of.entry_pixel]
        light = self._by_block(self._of.entry_value * c)
        noise = self._by_block(self._of.entry_variance * c * c)
        sums = self._block_sums()
        per_share = np.divide(light, sums, out=np.zeros_like(light), where=sums != 0.0)
        noise_per_share = np.divide(noise, sums**2, out=np.zeros_like(light), where=sums != 0.0)
        inverse = np.divide(1.0, sums, out=np.zeros_like(light), where=sums != 0.0)

        squares = min(self._of.shares_size, self._root)
        mean = np.zeros((self._squares, self._squares, 3))
        variance = np.zeros_like(mean)
        for tiles, blocks in self._tiles():
            share = self._padded(self._of.share_value[tiles])
            share_variance = self._padded(self._of.share_variance[tiles])
            for side, which, (tile, row, column) in self._levels(blocks):
                at = (tile - tiles.start, row, column)
                factor = self._spread(per_share[which], at, len(share), side)
                mean += (factor * share).sum(axis=0)
                # A product of two means; what they have in common, the block's share, counts once.
                noisy = self._spread(noise_per_share[which], at, len(share), side)
                rest = 1.0 - share * self._spread(inverse[which], at, len(share), side)
                variance += (noisy * share * share).sum(axis=0)
                variance += (factor * factor * share_variance * np.maximum(rest, 0.0)).sum(axis=0)
        pixels = np.maximum(self._pixels_in(squares), 1.0)
        mean = (mean / pixels).repeat(squares, axis=0).repeat(squares, axis=1)
        variance = (variance / pixels**2).repeat(squares, axis=0).repeat(squares, axis=1)
        for side, which, at in self._small():
            pixels = np.maximum(self._pixels_in(side), 1.0)
            for result, values, power in ((mean, light, 1), (variance, noise, 2)):
                grid = np.zeros((*pixels.shape[:2], 3))
                np.add.at(grid, at, values[which])
                result += (grid / pixels**power).repeat(side, axis=0).repeat(side, axis=1)
        width, height = self._of.projector_size
        return tuple(a[:height, :width].astype(np.float32) for a in (mean, variance))

    def _spread(self, values: np.ndarray, at: tuple, tiles: int, side: int) -> np.ndarray:
        """Values of blocks in each square of them: [tiles, rows, columns, 3], else 0."""
        grid = np.zeros((tiles, self._squares // side, self._squares // side, 3))
        grid[at] = values
        return grid.repeat(side, axis=1).repeat(side, axis=2)

    def _by_block(self, parts: np.ndarray) -> np.ndarray:
        count = len(self._of.blocks)
        sums = [np.bincount(self._of.entry_block, parts[:, c], minlength=count) for c in range(3)]
        return np.stack(sums, axis=1).astype(np.float64)  # of no entries, whole numbers


def _sums(pixels: np.ndarray, side: int) -> np.ndarray:
    """Sums over squares of the last axes but one, [..., rows, columns, channels]."""
    *rest, rows, columns, channels = pixels.shape
    squares = pixels.reshape(*rest, rows // side, side, columns // side, side, channels)
    return squares.sum(axis=(-4, -2))
