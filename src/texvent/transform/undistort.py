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
from texvent.lens import Lens, straight_pixels
from texvent.sensor import SensorSize, warn_of_far_centre
from texvent.transform.packets import Recording, move_events, note_edit, packets_of

FEWEST_PIXELS = 0.01
"""Share of the sensor's pixels that get the events of any, whatever the lens."""
USUAL_LOSS = 0.25
"""Share of the events that may land outside before a warning is due."""
Places = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Calibration:
    """A camera's lens, or the map of its pixels."""

    lens: Lens | Places
    """The lens, or a map, [H, W, 2]: x and y of each pixel without it."""
    size: SensorSize | None = None
    """Sensor size, pixels, where the calibration states it."""

    def undistorted(self, size: SensorSize) -> NDArray[np.int64]:
        """Undistorted place of each pixel, (x, y), rounded, [height, width, 2]; −1: nowhere.

        Raises:
            InputError: the calibration is of another sensor, or leaves hardly a pixel.

        Warns:
            TexventWarning: its centre is far from that of the sensor.
        """
        if self.size is not None and self.size != size:
            raise InputError(f"the calibration is of a {self.size} sensor, the events are {size}")
        if isinstance(self.lens, Lens):
            warn_of_far_centre(self.lens.intrinsics[2:], size, "the calibration")
            source = "focal lengths, in pixels, and its coefficients"
            places = straight_pixels(self.lens, size)
        else:
            places, source = self.lens, "rectify_map"
        is_found = np.asarray(((places > -0.5) & (places < np.array(size) - 0.5)).all(axis=-1))
        rounded = np.where(is_found[..., None], np.rint(np.nan_to_num(places)), -1.0)
        is_hit = np.zeros(size.shape, np.bool_)
        is_hit[tuple(rounded[is_found].astype(np.int64).T[::-1])] = True
        if is_hit.mean() < FEWEST_PIXELS:
            raise InputError(
                f"the calibration leaves {is_hit.mean():.0%} of the pixels on a {size} sensor; "
                f"check its {source}"
            )
        return rounded.astype(np.int64)

    @property
    def facts(self) -> dict[str, Any]:
        """Numbers of the calibration, as metadata hold them."""
        if not isinstance(self.lens, Lens):
            return {"map": "rectify_map"}
        facts: dict[str, Any] = {"intrinsics": list(self.lens.intrinsics)}
        facts["coefficients"] = list(self.lens.coefficients)
        return facts | ({"model": "equidistant"} if self.lens.distortion == "equidistant" else {})


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

    if isinstance(events, EventStream):
        return note_edit(next(changed()), events, undistort=calibration.facts)
    moved = EventPackets(LazyPackets(changed), events.size, events.metadata)
    return note_edit(moved, events, undistort=calibration.facts)
