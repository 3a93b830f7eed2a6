"""Candidates of a pair of frames, found in bands of rows on several threads."""

from __future__ import annotations

import importlib
import math
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from types import TracebackType
from typing import Self, TypeVar

import numpy as np

from texvent.interpolate.densify import Pair
from texvent.pairs.motion_interpolation import Paths, load_warp
from texvent.simulate.fused.candidates_reference import find_candidates
from texvent.simulate.fused.interface import (
    Candidates,
    Cells,
    Float32Array,
    Float64Array,
    Grids,
    Int64Array,
    Levels,
    Pictures,
    Surveyed,
)
from texvent.simulate.fused.load import find_compiled

BAND_PIXELS = 1 << 16
"""How many pixels a thread takes at a time, at most: candidates are held band by band."""
BUSY = 0.65
"""From this share of active pixels on, drawing the frames costs less: each pixel has to be warped
in each frame either way, and scanning whole frames is faster than following pixels one by one.
Measured (docs/design/simulators.md): at a share of 0.5 the fused pass takes 0.8 to 0.9 of the time
of drawing, at 0.7 0.97 to 1.07, at 0.98 1.3."""

Settled = TypeVar("Settled")


class CandidateFinder:
    """Finds the candidates of one pair after another; to be closed, because it may keep threads.

    As many threads as Numba would use. Bands are joined in their order, so their number and that
    of the threads change nothing. Until the kernels are compiled, pictures are drawn after all.
    """

    def __init__(self) -> None:
        self._threads: ThreadPoolExecutor | None = None
        find_compiled("candidates")  # begins to compile

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

    def survey(self, pair: Pair, levels: Callable[[], Levels]) -> Cells | None:
        """Whether a pair is worth looking for candidates.

        Args:
            pair: two frames.
            levels: tells what the pixels compare with; not called where it makes no difference.

        Returns:
            What `map` wants to know of the pair; None where drawing its pictures costs less: a
            share of `BUSY` or more of its pixels, estimated from a sample of its rows, may fire;
            nothing moves, so that a picture costs next to nothing; or nothing is compiled yet.
        """
        kernels, paths = find_compiled("candidates"), pair.between
        if kernels is None or not isinstance(paths, Paths) or paths.flows is None:
            return None
        pictures = pictures_of(paths)
        cells: Cells = kernels.find_cells(pictures)
        return cells if kernels.estimate_active(pictures, levels(), cells) < BUSY else None

    def map(
        self,
        settle: Callable[[Candidates], Settled],
        paths: Paths,
        *,
        grids: Grids,
        levels: Levels,
        cells: Cells | None = None,
    ) -> Iterator[Settled]:
        """What a function makes of the candidates of each band of rows, from the top.

        Args:
            settle: called in the threads, so it must touch the pixels of its candidates only.
            paths: the pair.
            grids: when pixels are looked at.
            levels: what they compare with.
            cells: of `survey`, if there was one.
        """
        pictures, kernels = pictures_of(paths), find_compiled("candidates")
        if kernels is None:
            return iter(
                [settle(find_candidates(pictures, grids, levels, load_warp().warp_between))]
            )
        find_in_rows = kernels.find_in_rows
        cells = kernels.find_cells(pictures) if cells is None else cells

        surveyed = Surveyed(paths.prepared, cells)

        def settle_band(rows: tuple[int, int]) -> Settled:
            return settle(find_in_rows(pictures, grids, levels, surveyed, rows))

        threads = importlib.import_module("numba").get_num_threads()
        height = len(pictures.earlier)
        number = max(threads, math.ceil(pictures.earlier.size / BAND_PIXELS))
        step = math.ceil(height / number)
        bands = [(start, min(start + step, height)) for start in range(0, height, step)]
        if threads == 1 or len(bands) == 1:
            return map(settle_band, bands)
        self._threads = self._threads or ThreadPoolExecutor(threads)
        return self._threads.map(settle_band, bands)


def show_pixels(paths: Paths, index: int, pixel: Int64Array) -> Float32Array:
    """Luma of some pixels of a picture, [n], or of the later frame if it is past the last one.

    Args:
        paths: the pair.
        index: number of the picture.
        pixel: [n] flat indices.
    """
    if index == len(paths):
        return paths.later.reshape(-1)[pixel]
    kernels = find_compiled("candidates")
    if kernels is None:
        return paths.picture(index).reshape(-1)[pixel]
    shown: Float32Array = kernels.show_pixels(
        pictures_of(paths), paths.prepared, paths.positions[index], pixel
    )
    return shown


def pictures_of(paths: Paths) -> Pictures:
    """The arrays of a pair, as kernels take them."""
    nothing = np.empty((0, 0, 2), np.float32)
    flows = (nothing, nothing) if paths.flows is None else paths.flows
    return Pictures(paths.earlier, paths.later, *flows)


def one_grid(positions: Sequence[float]) -> Grids:
    """The grid whose inner pictures are at some positions, for all pixels."""
    inner: Float64Array = np.array([*positions, 1.0])[np.newaxis]
    endless = np.array([np.inf])
    return Grids(inner, np.array([inner.size]), endless, endless)
