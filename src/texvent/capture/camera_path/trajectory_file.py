"""Camera paths in text files: positions in pixels, or poses in space as TUM writes them."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.capture.camera_path.motion import CameraPose2D, Pose
from texvent.errors import FileFormatError, InputError, one_line, shown
from texvent.options.values import parse_fraction
from texvent.runtime.file_names import usable_path
from texvent.video import LATEST_US, MICROSECONDS

Float64Array = NDArray[np.float64]

POSE_COLUMNS = 8
"""t tx ty tz qx qy qz qw."""
PLACE_COLUMNS = (3, 4, 5)
"""t x y, then perhaps roll and zoom."""
COLUMNS = (
    "t [s], x, y [px] and perhaps roll [degrees] and zoom; or t [s], tx, ty, tz [m], qx, qy, qz, qw"
)
MAX_ROWS = 1_000_000
MOST = 1e6
"""Larger numbers are no px, degrees or metres of a camera path."""
UNIT_TOLERANCE = 0.1
"""Quaternions may differ this much from length 1: they are rounded in files."""


@dataclass(frozen=True, eq=False)
class SmoothRows:
    """Numbers between rows: cubic pieces whose slopes at a row come from its neighbours.

    Before the first row and after the last, that row is held.
    """

    times_us: NDArray[np.int64]
    """[n], increasing, n >= 2."""
    values: Float64Array
    """[n, k]"""

    def __call__(self, t_us: float) -> Float64Array:
        """The numbers at `t_us`, [k].

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
        return np.asarray(start + u * (span * slopes[here] + u * (rise + u * bend)))


@dataclass(frozen=True, eq=False)
class PlaceFile:
    """A path in pixels of the sensor."""

    rows: SmoothRows
    """x, y, px; roll, radians; natural logarithm of the zoom."""

    @property
    def start_us(self) -> int:
        """Time of the first row, µs."""
        return int(self.rows.times_us[0])

    @property
    def seconds(self) -> float:
        """From the first row to the last, s."""
        return _seconds(self.rows)

    @property
    def facts(self) -> Mapping[str, Any]:
        """What kind of file it is."""
        return {"camera": "positions"}

    def __call__(self, t_us: float) -> CameraPose2D:
        """Between two rows."""
        x, y, roll, log_zoom = map(float, self.rows(t_us))
        return CameraPose2D(x, y, roll, math.exp(log_zoom))


@dataclass(frozen=True, eq=False)
class PoseFile:
    """A path in space. Poses count from the first one: there the image was taken."""

    rows: SmoothRows
    """Position, m, and unit quaternion x, y, z, w of camera-to-world."""

    @property
    def start_us(self) -> int:
        """Time of the first row, µs."""
        return int(self.rows.times_us[0])

    @property
    def seconds(self) -> float:
        """From the first row to the last, s."""
        return _seconds(self.rows)

    @property
    def facts(self) -> Mapping[str, Any]:
        """What kind of file it is."""
        return {"camera": "poses"}

    @property
    def moves(self) -> bool:
        """Whether the camera changes its position, not only its direction."""
        positions = self.rows.values[:, :3]
        return bool((positions != positions[0]).any())

    def __call__(self, t_us: float) -> Pose:
        """Between two rows; the quaternion is brought to length 1 again."""
        first, now = self.rows.values[0], self.rows(t_us)
        to_first = _rotation(first[3:]).T
        return Pose(to_first @ _rotation(now[3:]), to_first @ (now[:3] - first[:3]))


def read_trajectory(path: Path) -> PlaceFile | PoseFile:
    """A path from a text file, one instant per line.

    Args:
        path: columns are separated by spaces, tabs or commas; lines that begin with # and a first
            line of names do not count. 3 to 5 columns are t x y [roll [zoom]] in s, px of the
            sensor, degrees and a factor; 8 are poses of the TUM layout, camera-to-world, camera
            axes x right, y down, z forward.

    Raises:
        InputError: there is no such file, or it has fewer than two rows.
        FileFormatError: a row has other columns, something that is no number, a time that does not
            increase, a zoom that is not above 0, or a quaternion whose length is not 1.
    """
    rows = list(_rows(path))
    if len(rows) < 2:
        raise InputError(f"{path} has {len(rows)} row(s); a camera path needs at least two")
    times, values = np.array([t for t, _ in rows], np.int64), np.array([one for _, one in rows])
    if values.shape[1] == POSE_COLUMNS - 1:
        return PoseFile(SmoothRows(times, _unit_quaternions(path, values)))
    whole = np.zeros((len(rows), 4))
    whole[:, 3] = 1.0
    whole[:, : values.shape[1]] = values
    whole[:, 2] = np.radians(whole[:, 2])
    if not (whole[:, 3] > 0).all():
        number = int(np.argmin(whole[:, 3]))
        raise FileFormatError(
            f"{path}, row {number + 1}: zoom is {whole[number, 3]:g}; it must be above 0"
        )
    whole[:, 3] = np.log(whole[:, 3])
    return PlaceFile(SmoothRows(times, whole))


def _rows(path: Path) -> Iterator[tuple[int, Sequence[float]]]:
    """Time in µs and the other columns of each row, checked."""
    columns, last_us, is_first = 0, None, True
    for number, line in enumerate(_lines(path), start=1):
        words = line.replace(",", " ").split()
        if not words or words[0].startswith("#"):
            continue
        where = f"{path}, line {number}"
        if is_first and not any(map(_is_number, words)):  # names of columns
            is_first = False
            continue
        is_first = False
        columns = columns or len(words)
        if len(words) != columns or columns not in (*PLACE_COLUMNS, POSE_COLUMNS):
            expected = f", those before {columns}" if len(words) != columns else ""
            raise FileFormatError(f"{where} has {len(words)} columns{expected}; allowed: {COLUMNS}")
        t_us, values = _time_us(words[0], where), [_number(word, where) for word in words[1:]]
        if last_us is not None and t_us <= last_us:
            raise FileFormatError(
                f"{where}: the time {shown(words[0])} s does not come after the one before "
                f"({last_us / MICROSECONDS:g} s); times must increase by at least 1 µs"
            )
        last_us = t_us
        yield t_us, values


def _lines(path: Path) -> list[str]:
    try:
        lines = list(StringIO(usable_path(path).read_text(encoding="utf-8-sig")))
    except FileNotFoundError:
        raise InputError(f"no such camera path: {path}; check `camera`") from None
    except (OSError, UnicodeDecodeError) as error:
        raise FileFormatError(
            f"camera path {path} cannot be read ({one_line(error)}); it must be a text of rows of "
            f"{COLUMNS}"
        ) from error
    if len(lines) > MAX_ROWS:
        raise FileFormatError(f"{path} has {len(lines):,} lines; at most {MAX_ROWS:,} are read")
    return lines


def _time_us(word: str, where: str) -> int:
    """Seconds as whole µs, from the exact decimal number."""
    try:
        t_us = round(parse_fraction(word) * MICROSECONDS)
    except (ValueError, ZeroDivisionError):
        raise FileFormatError(f"{where}: {shown(word)} is no time in s") from None
    if abs(t_us) > LATEST_US:
        raise FileFormatError(f"{where}: {shown(word)} s is too far away; at most 285 years")
    return t_us


def _number(word: str, where: str) -> float:
    try:
        value = float(word)
    except ValueError:
        raise FileFormatError(f"{where}: {shown(word)} is no number; columns: {COLUMNS}") from None
    if not abs(value) <= MOST:
        raise FileFormatError(
            f"{where}: {shown(word)} is not allowed; it must be ±{MOST:g} or less"
        )
    return value


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


def _unit_quaternions(path: Path, values: Float64Array) -> Float64Array:
    """The rows with quaternions of length 1, signs chosen so that neighbours are near."""
    lengths = np.linalg.norm(values[:, 3:], axis=1)
    if not (np.abs(lengths - 1) <= UNIT_TOLERANCE).all():
        number = int(np.argmax(np.abs(lengths - 1)))
        raise FileFormatError(
            f"{path}, row {number + 1}: the quaternion qx qy qz qw has length {lengths[number]:g}; "
            "it must be 1"
        )
    unit = values[:, 3:] / lengths[:, None]
    turns = np.where((unit[1:] * unit[:-1]).sum(axis=1) < 0, -1.0, 1.0)
    unit[1:] *= np.cumprod(turns)[:, None]
    return np.concatenate([values[:, :3], unit], axis=1)


def _rotation(quaternion: Float64Array) -> Float64Array:
    """[3, 3] of a quaternion (x, y, z, w) of any length."""
    x, y, z, w = quaternion / np.linalg.norm(quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def _seconds(rows: SmoothRows) -> float:
    return float(rows.times_us[-1] - rows.times_us[0]) / MICROSECONDS
