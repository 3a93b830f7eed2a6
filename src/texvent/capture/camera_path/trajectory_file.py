"""Camera paths in text files: positions in pixels over time."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.capture.camera_path.motion import CameraPose2D
from texvent.errors import FileFormatError, InputError, one_line
from texvent.io.text_files import parse_table
from texvent.runtime.file_names import usable_path
from texvent.video import LATEST_US, MICROSECONDS

Float64Array = NDArray[np.float64]

COLUMNS = "t [s], x, y [px] and perhaps roll [degrees] and zoom"
MAX_ROWS = 1_000_000
MOST = 1e6
"""Larger numbers are no px or degrees of a camera path."""


@dataclass(frozen=True, eq=False)
class PathFile:
    """A path through the rows of a file, in px of the sensor.

    Between rows it is cubic, with slopes at a row from its neighbours; before the first row and
    after the last, that row is held.
    """

    times_us: NDArray[np.int64]
    """[n], increasing, n >= 2."""
    values: Float64Array
    """[n, 4] x, y, px; roll, radians; natural logarithm of the zoom."""

    @property
    def start_us(self) -> int:
        """Time of the first row, µs."""
        return int(self.times_us[0])

    @property
    def seconds(self) -> float:
        """From the first row to the last, s."""
        return float(self.times_us[-1] - self.times_us[0]) / MICROSECONDS

    @property
    def facts(self) -> Mapping[str, Any]:
        """The kind of file."""
        return {"camera": "positions"}

    def __call__(self, t_us: float) -> CameraPose2D:
        """The pose at `t_us`.

        Source: cubic Hermite splines, slopes by differences of second order.
        """
        times = self.times_us
        t_us = min(max(t_us, int(times[0])), int(times[-1]))
        row = min(int(np.searchsorted(times, t_us, side="right")) - 1, len(times) - 2)
        span = float(times[row + 1] - times[row])
        u = (t_us - float(times[row])) / span
        first, last = max(row - 1, 0), row + 3
        near = (times[first:last] - times[row]).astype(np.float64)
        slopes = np.gradient(self.values[first:last], near, axis=0)
        here = row - first
        start, stop = self.values[row], self.values[row + 1]
        bend = 2 * (start - stop) + span * (slopes[here] + slopes[here + 1])
        rise = 3 * (stop - start) - span * (2 * slopes[here] + slopes[here + 1])
        found = start + u * (span * slopes[here] + u * (rise + u * bend))
        x, y, roll, log_zoom = map(float, found)
        return CameraPose2D(x, y, roll, math.exp(log_zoom))


def read_trajectory(path: Path) -> PathFile:
    """A path from a text file, one instant per line.

    Args:
        path: columns are separated by spaces, tabs or commas; lines that begin with # and a first
            line of names do not count. The columns are t x y [roll [zoom]] in s, px of the
            sensor, degrees and a factor.

    Raises:
        InputError: there is no such file, or it has fewer than two rows.
        FileFormatError: a row has other columns, something that is no number, a time that does not
            increase, or a zoom that is not above 0.
    """
    table = _read_table(path)
    if len(table) < 2:
        raise InputError(f"{path} has {len(table)} row(s); a camera path needs at least two")
    if not 3 <= table.shape[1] <= 5:
        raise FileFormatError(f"{path} has rows of {table.shape[1]} columns; allowed: {COLUMNS}")
    times, values = table[:, 0] * MICROSECONDS, table[:, 1:]
    _refuse_rows(
        path, ~(np.abs(times) <= LATEST_US), "a time that is no number of s below 285 years"
    )
    _refuse_rows(
        path, ~(np.abs(values) <= MOST).all(axis=1), f"a number that is not within ±{MOST:g}"
    )
    times_us = np.rint(times).astype(np.int64)
    later = np.diff(times_us, prepend=times_us[0] - 1) <= 0
    _refuse_rows(path, later, "a time that is not at least 1 µs after the one before")
    whole = np.zeros((len(table), 4))
    whole[:, 3] = 1.0
    whole[:, : values.shape[1]] = values
    whole[:, 2] = np.radians(whole[:, 2])
    _refuse_rows(path, whole[:, 3] <= 0, "a zoom that is not above 0")
    whole[:, 3] = np.log(whole[:, 3])
    return PathFile(times_us, whole)


def _read_table(path: Path) -> Float64Array:
    """The numbers of a text, without comments and a first line of names."""
    try:
        text = usable_path(path).read_text(encoding="utf-8-sig").replace(",", " ")
    except FileNotFoundError:
        raise InputError(f"no such camera path: {path}; check `camera`") from None
    except (OSError, UnicodeDecodeError) as error:
        raise FileFormatError(
            f"camera path {path} cannot be read ({one_line(error)}); it must be a text of rows of "
            f"{COLUMNS}"
        ) from error
    lines = [line for line in text.split("\n") if line.strip() and not line.strip().startswith("#")]
    if len(lines) > MAX_ROWS:
        raise FileFormatError(f"{path} has {len(lines):,} lines; at most {MAX_ROWS:,} are read")
    if lines and not any(map(_is_number, lines[0].split())):  # names of columns
        lines = lines[1:]
    return parse_table("\n".join(lines).encode(), path, rows=f"a camera path of rows {COLUMNS}")


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


def _refuse_rows(path: Path, is_wrong: Any, what: str) -> None:
    if is_wrong.any():
        raise FileFormatError(f"{path}, row {int(np.argmax(is_wrong)) + 1}, has {what}")
