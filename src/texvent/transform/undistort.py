"""Events where a lens without distortion would have put them.

The calibration is the text of the Event Camera Dataset: `fx fy cx cy k1 k2 p1 p2 k3`, pixels and
the coefficients of the Brown-Conrady model (those of OpenCV), separated by blanks.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, InputError, one_line
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.transform.packets import map_packets, move_events, note_edit

ITERATIONS = 50
"""Of the fixed-point search; it stops earlier where it has settled."""
SETTLED = 1e-9
"""Change of normalised coordinates below which the search has settled."""
MAX_TEXT = 4096


@dataclass(frozen=True)
class Calibration:
    """A pinhole camera with lens distortion."""

    fx: float
    """Focal lengths, pixels."""
    fy: float
    cx: float
    """Centre, pixels."""
    cy: float
    k1: float
    """Radial and tangential coefficients of Brown and Conrady."""
    k2: float
    p1: float
    p2: float
    k3: float


def read_calibration(path: Path) -> Calibration:
    """The calibration in a text file.

    Raises:
        InputError: no such file.
        FileFormatError: it does not hold nine numbers.
    """
    if not path.is_file():
        raise InputError(f"no such file: {path}; give a calibration as fx fy cx cy k1 k2 p1 p2 k3")
    words = path.read_bytes()[:MAX_TEXT].split()
    try:
        numbers = [float(word) for word in words]
    except ValueError as error:
        raise FileFormatError(f"{path} is not a calibration: {one_line(error)}") from error
    if len(numbers) != 9 or not np.isfinite(numbers).all() or min(numbers[:2]) <= 0:
        raise FileFormatError(
            f"{path} holds {len(numbers)} numbers; a calibration is nine: "
            "fx fy cx cy k1 k2 p1 p2 k3"
        )
    return Calibration(*numbers)


def undistort(events: EventPackets, calibration: Calibration) -> EventPackets:
    """Every event in the pixel where a lens without distortion would have put it.

    Places are rounded to whole pixels, so some pixels get the events of two and some none;
    events that land outside the sensor are left out.
    """
    places = undistorted_pixels(events.size, calibration)

    def move(packet: EventStream) -> EventStream:
        moved = places[packet.y, packet.x]
        return move_events(packet, moved[:, 0], moved[:, 1], packet.size)

    return note_edit(map_packets(events, move), events, undistort=asdict(calibration))


def undistorted_pixels(size: SensorSize, calibration: Calibration) -> NDArray[np.int64]:
    """Where each pixel belongs, (x, y), rounded, [height, width, 2]; -1 where no place is found.

    The distortion has no inverse in closed form; a fixed point of
    `place = (distorted - tangential(place)) / radial(place)` is searched.
    """
    y, x = np.mgrid[: size.height, : size.width].astype(np.float64)
    seen_u, seen_v = (x - calibration.cx) / calibration.fx, (y - calibration.cy) / calibration.fy
    u, v = seen_u.copy(), seen_v.copy()
    with np.errstate(all="ignore"):
        for _ in range(ITERATIONS):
            radial, du, dv = _distortion(u, v, calibration)
            next_u, next_v = (seen_u - du) / radial, (seen_v - dv) / radial
            change = np.nanmax(np.maximum(np.abs(next_u - u), np.abs(next_v - v)))
            u, v = next_u, next_v
            if change < SETTLED:
                break
        radial, du, dv = _distortion(u, v, calibration)
        error = np.hypot(u * radial + du - seen_u, v * radial + dv - seen_v)
        places = np.stack(
            [u * calibration.fx + calibration.cx, v * calibration.fy + calibration.cy], axis=-1
        )
    # Strong lenses have corners that no straight ray reaches.
    is_found = (error * calibration.fx < 0.5) & (np.abs(places) < 2**31).all(axis=-1)
    return np.where(is_found[..., None], np.rint(places), -1.0).astype(np.int64)


def _distortion(
    u: NDArray[np.float64], v: NDArray[np.float64], calibration: Calibration
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Radial factor and tangential shift at normalised coordinates."""
    c = calibration
    r2 = u * u + v * v
    radial = 1 + r2 * (c.k1 + r2 * (c.k2 + r2 * c.k3))
    du = 2 * c.p1 * u * v + c.p2 * (r2 + 2 * u * u)
    dv = c.p1 * (r2 + 2 * v * v) + 2 * c.p2 * u * v
    return radial, du, dv
