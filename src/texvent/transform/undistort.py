"""Events where a lens without distortion would have put them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError, warn
from texvent.event_packets import EventPackets, LazyPackets
from texvent.events import EventStream
from texvent.sensor import SensorSize, warn_of_far_centre
from texvent.transform.packets import Recording, move_events, note_edit, packets_of

ITERATIONS = 50
"""Of the fixed-point search; it stops earlier where it has settled."""
SETTLED = 1e-9
"""Change of normalised coordinates below which the search has settled."""
FEWEST_PIXELS = 0.01
"""Share of the pixels that any lens leaves on the sensor."""
USUAL_LOSS = 0.25
"""Share of the events that may land outside before a warning is due."""
Places = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Calibration:
    """A pinhole camera with lens distortion, or the map of its pixels."""

    intrinsics: tuple[float, float, float, float] = (1.0, 1.0, 0.0, 0.0)
    """Focal lengths and centre fx, fy, cx, cy, pixels."""
    coefficients: tuple[float, ...] = ()
    """k1, k2, p1, p2, k3 of Brown and Conrady, or k1 .. k4 of the equidistant model."""
    is_equidistant: bool = False
    size: SensorSize | None = None
    """Sensor size, pixels, where the calibration states it."""
    places: Places | None = None
    """[H, W, 2]: x and y of each pixel without the lens, where the calibration is a map."""

    def undistorted(self, size: SensorSize) -> NDArray[np.int64]:
        """Where each pixel belongs, (x, y), rounded, [height, width, 2]; −1: nowhere.

        Raises:
            InputError: the calibration is of another sensor, or leaves hardly a pixel.

        Warns:
            TexventWarning: its centre is far from that of the sensor.
        """
        if self.size is not None and self.size != size:
            raise InputError(f"the calibration is of a {self.size} sensor, the events are {size}")
        if self.places is None:
            warn_of_far_centre(self.intrinsics[2:], size, "the calibration")
        places = self._search(size) if self.places is None else self.places
        is_found = np.asarray(((places > -0.5) & (places < np.array(size) - 0.5)).all(axis=-1))
        if is_found.mean() < FEWEST_PIXELS:
            what = "focal lengths, in pixels, and its coefficients"
            raise InputError(
                f"the calibration leaves {is_found.mean():.0%} of the pixels on a {size} sensor; "
                f"check its {what if self.places is None else 'rectify_map'}"
            )
        return np.where(is_found[..., None], np.rint(np.nan_to_num(places)), -1.0).astype(np.int64)

    def _search(self, size: SensorSize) -> Places:
        """Undistorted place of each pixel, [H, W, 2]; NaN in corners that no straight ray reaches.

        The distortion has no inverse in closed form; a fixed point is searched.
        """
        fx, fy, cx, cy = self.intrinsics
        y, x = np.mgrid[: size.height, : size.width].astype(np.float64)
        seen = np.stack([(x - cx) / fx, (y - cy) / fy], axis=-1)
        place = seen.copy()
        with np.errstate(all="ignore"):
            for _ in range(ITERATIONS):
                radial, shift = self._distortion(place)
                following = (seen - shift) / radial[..., None]
                change = np.nanmax(np.abs(following - place))
                place = following
                if change < SETTLED:
                    break
            radial, shift = self._distortion(place)
            error = np.linalg.norm(place * radial[..., None] + shift - seen, axis=-1)
            place[~(error * fx < 0.5)] = np.nan
        return np.asarray(place * (fx, fy) + (cx, cy), np.float64)

    def _distortion(self, place: Places) -> tuple[NDArray[np.float64], Places]:
        """Radial factor, and shift by tangential distortion, at normalised coordinates."""
        u, v = place[..., 0], place[..., 1]
        r2 = u * u + v * v
        if self.is_equidistant:
            r = np.sqrt(r2)
            angle = np.arctan(r)
            power = angle * angle
            k1, k2, k3, k4 = self.coefficients
            bent = angle * (1 + power * (k1 + power * (k2 + power * (k3 + power * k4))))
            return np.where(r > 0, bent / np.where(r > 0, r, 1), 1.0), np.zeros_like(place)
        k1, k2, p1, p2, k3 = (*self.coefficients, *[0.0] * (5 - len(self.coefficients)))
        radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3))
        du = 2 * p1 * u * v + p2 * (r2 + 2 * u * u)
        dv = p1 * (r2 + 2 * v * v) + 2 * p2 * u * v
        return radial, np.stack([du, dv], axis=-1)


def undistort(events: Recording, calibration: Calibration) -> Recording:
    """Every event in the pixel where a lens without distortion would have put it.

    Places are rounded to whole pixels, so some pixels get the events of two and some none;
    events that land outside the sensor are left out.

    Raises:
        InputError: see `Calibration.undistorted`.

    Warns:
        TexventWarning: more than `USUAL_LOSS` of the events are left out.
    """
    places = calibration.undistorted(events.size)

    def changed() -> Iterator[EventStream]:
        given = kept = 0
        for packet in packets_of(events):
            moved = places[packet.y, packet.x]
            following = move_events(packet, moved[:, 0], moved[:, 1], packet.size)
            given, kept = given + len(packet), kept + len(following)
            yield following
        if kept < (1 - USUAL_LOSS) * given:
            warn(
                f"{1 - kept / given:.0%} of the events land outside the sensor without their lens "
                "and are left out; if that is too much, check the calibration"
            )

    facts: dict[str, Any] = {"intrinsics": list(calibration.intrinsics)}
    facts["coefficients"] = list(calibration.coefficients)
    if calibration.is_equidistant:
        facts["model"] = "equidistant"
    facts = facts if calibration.places is None else {"map": "rectify_map"}
    if isinstance(events, EventStream):
        return note_edit(next(changed()), events, undistort=facts)
    moved = EventPackets(LazyPackets(changed), events.size, events.metadata)
    return note_edit(moved, events, undistort=facts)
