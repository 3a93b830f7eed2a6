"""Thresholds of each pixel of one sensor, as `texvent calibrate --flicker-hz` measures them.

The file is a NumPy archive of two arrays, `on` and `off`, [H, W] float16: thresholds over the mean
of all pixels. NaN marks a pixel that was not measured.
"""

from __future__ import annotations

import zipfile
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, InputError
from texvent.io.atomic import atomic_file
from texvent.runtime.files.file_names import usable_path
from texvent.simulation.random.mismatch import LOWEST_THRESHOLD, NominalThresholds

Float64Array = NDArray[np.float64]


class ThresholdMap(NamedTuple):
    """Thresholds over their mean, [H, W] each; NaN where a pixel was not measured."""

    on: Float64Array
    off: Float64Array

    def thresholds(
        self, drawn: tuple[Float64Array, Float64Array], nominal: NominalThresholds
    ) -> tuple[Float64Array, Float64Array]:
        """ON and OFF thresholds of a sensor with these pixels, log units.

        Args:
            drawn: thresholds for pixels that were not measured, [H, W] each.
            nominal: the means.

        Raises:
            InputError: the map is of a sensor of another size.
        """
        if drawn[0].shape != self.on.shape:
            (height, width), (high, wide) = self.on.shape, drawn[0].shape
            raise InputError(
                f"the threshold map is of {width}x{height} pixels, the frames have {wide}x{high}; "
                f"use sensor={width}x{height}, or leave out threshold_map"
            )
        means = nominal.contrast_threshold_on, nominal.contrast_threshold_off
        on, off = (
            np.where(np.isnan(one), other, np.maximum(one * mean, LOWEST_THRESHOLD))
            for one, other, mean in zip(self, drawn, means, strict=True)
        )
        return on, off


def read_threshold_map(path: Path) -> ThresholdMap:
    """Read a file of `write_threshold_map`.

    Raises:
        InputError: there is no such file, or no file can have that name.
        FileFormatError: it holds something else.
    """
    path = usable_path(path)
    if not path.is_file():
        raise InputError(f"there is no threshold map {path}; texvent calibrate --flicker-hz "
                         "--threshold-map=FILE writes one")  # fmt: skip
    try:
        with np.load(path, allow_pickle=False) as arrays:
            on, off = (np.asarray(arrays[name], np.float64) for name in ThresholdMap._fields)
    except (OSError, ValueError, KeyError, TypeError, EOFError, zipfile.BadZipFile) as error:
        raise FileFormatError(
            f"{path} is no threshold map of texvent calibrate: it must hold the arrays on and off"
        ) from error
    known = np.concatenate([one[~np.isnan(one)] for one in (on, off)])
    if on.ndim != 2 or on.shape != off.shape or not (np.isfinite(known) & (known > 0)).all():
        raise FileFormatError(
            f"{path} is no threshold map: on and off must be [H, W] of one shape, above 0 or NaN"
        )
    return ThresholdMap(on, off)


def write_threshold_map(found: ThresholdMap, path: Path, *, overwrite: bool = False) -> Path:
    """Write the thresholds of each pixel.

    Raises:
        OutputError: the file exists already, or cannot be written.
    """
    arrays = {name: one.astype(np.float16) for name, one in found._asdict().items()}
    with atomic_file(path, overwrite=overwrite) as part, part.open("wb") as file:
        np.savez_compressed(file, **arrays)
    return Path(path)
