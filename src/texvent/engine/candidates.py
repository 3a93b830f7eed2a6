"""Candidates of a pair of frames, found in bands of rows on several threads."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from types import TracebackType
from typing import Self, TypeVar

import numba
import numpy as np

from texvent.engine.kernels.candidates_cpu import find_cells, find_in_rows
from texvent.engine.kernels.interface import Candidates, Float64Array, Grids, Levels, Pictures
from texvent.interpolate.paths import Paths

BAND_PIXELS = 1 << 14
"""About how many pixels a thread takes at a time."""

Settled = TypeVar("Settled")


class CandidateFinder:
    """Finds the candidates of one pair after another; to be closed, because it may keep threads.

    As many threads as Numba would use. Bands are joined in their order, so their number and that
    of the threads change nothing.
    """

    def __init__(self) -> None:
        threads = numba.get_num_threads()
        self._threads = ThreadPoolExecutor(threads) if threads > 1 else None

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._threads is not None:
            self._threads.shutdown(cancel_futures=True)

    def find(self, paths: Paths, grids: Grids, levels: Levels) -> Candidates:
        """Every place where a pixel may fire; see `kernels.candidates_reference`."""
        found = list(self.map(lambda band: band, paths, grids, levels))
        return Candidates(*(np.concatenate(column) for column in zip(*found, strict=True)))

    def map(
        self, settle: Callable[[Candidates], Settled], paths: Paths, grids: Grids, levels: Levels
    ) -> Iterator[Settled]:
        """What a function makes of the candidates of each band of rows, from the top.

        Args:
            settle: called in the threads, so it must touch the pixels of its candidates only.
            paths: the pair.
            grids: when pixels are looked at.
            levels: what they compare with.
        """
        pictures = pictures_of(paths)
        cells = find_cells(pictures)

        def settle_band(rows: tuple[int, int]) -> Settled:
            return settle(find_in_rows(pictures, grids, levels, cells, rows))

        height, width = pictures.earlier.shape
        step = max(1, BAND_PIXELS // width)
        bands = [(start, min(start + step, height)) for start in range(0, height, step)]
        run = map if self._threads is None else self._threads.map
        return run(settle_band, bands)


def pictures_of(paths: Paths) -> Pictures:
    """The arrays of a pair, as kernels take them."""
    if paths.flows is None:
        nothing = np.empty((0, 0, 2), np.float32)
        return Pictures(paths.earlier, paths.later, nothing, nothing)
    return Pictures(paths.earlier, paths.later, *paths.flows)


def one_grid(positions: Sequence[float]) -> Grids:
    """The grid whose inner pictures are at some positions, for all pixels."""
    inner: Float64Array = np.array([*positions, 1.0])[np.newaxis]
    endless = np.array([np.inf])
    return Grids(inner, np.array([inner.size]), endless, endless)
