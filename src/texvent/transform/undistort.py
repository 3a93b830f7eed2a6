"""Events where a lens without distortion would have put them.

A calibration is one of

    text           `fx fy cx cy k1 k2 p1 p2 k3`, as in the Event Camera Dataset: pixels, and the
                   coefficients of Brown and Conrady (radtan, OpenCV's)
    Kalibr's yaml  cam0, cam1 ...: intrinsics, distortion_model radtan, equidistant or none
    DSEC's HDF5    rectify_map [H, W, 2]: x and y of each pixel in the rectified image
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, InputError, one_line, shown
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.runtime.yaml_text import load_yaml
from texvent.sensor import SensorSize
from texvent.transform.packets import map_packets, move_events, note_edit

ITERATIONS = 50
"""Of the fixed-point search; it stops earlier where it has settled."""
SETTLED = 1e-9
"""Change of normalised coordinates below which the search has settled."""
MAX_TEXT = 65_536
TEXT_HELP = "a calibration is nine numbers: fx fy cx cy k1 k2 p1 p2 k3"
MODELS = ("radtan", "equidistant", "none")
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
            InputError: the calibration is of another sensor.
        """
        if self.size is not None and self.size != size:
            raise InputError(f"the calibration is of a {self.size} sensor, the events are {size}")
        places = self._search(size) if self.places is None else self.places
        is_found = np.asarray((np.abs(places) < 2**31).all(axis=-1))
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


def read_calibration(path: Path) -> Calibration:
    """The calibration in a file; `FILE:cam1` is the second camera of one of Kalibr's.

    Raises:
        InputError: no such file, or it holds several cameras and none is named.
        FileFormatError: it is no calibration.
    """
    camera = re.fullmatch(r"(.+):(cam\d+)", str(path))
    path = Path(camera[1]) if camera is not None else path
    if not path.is_file():
        raise InputError(f"no such file: {path}; {TEXT_HELP}, Kalibr's yaml or DSEC's rectify_map")
    if h5py.is_hdf5(path):
        return _read_map(path)
    text = path.read_bytes()[:MAX_TEXT]
    if path.suffix.lower() in (".yaml", ".yml"):
        return _read_kalibr(path, text, None if camera is None else camera[2])
    try:
        numbers = [float(word) for word in text.split()]
    except ValueError as error:
        raise FileFormatError(f"{path} is not a calibration: {one_line(error)}") from error
    if len(numbers) != 9 or not np.isfinite(numbers).all() or min(numbers[:2]) <= 0:
        raise FileFormatError(f"{path} holds {len(numbers)} numbers; {TEXT_HELP}")
    fx, fy, cx, cy, *lens = numbers
    return Calibration((fx, fy, cx, cy), tuple(lens))


def _read_map(path: Path) -> Calibration:
    with h5py.File(path, "r") as file:
        stored = file.get("rectify_map")
        is_map = isinstance(stored, h5py.Dataset) and stored.ndim == 3 and stored.shape[2] == 2
        if not is_map or stored.dtype.kind != "f":
            raise FileFormatError(f"{path} is not a calibration: it has no rectify_map [H, W, 2]")
        places = np.asarray(stored[()], np.float64)
    return Calibration(size=SensorSize(places.shape[1], places.shape[0]), places=places)


def _read_kalibr(path: Path, text: bytes, camera: str | None) -> Calibration:
    try:
        cameras: Any = load_yaml(text)
    except ValueError as error:
        raise FileFormatError(f"{path} is not a calibration: {one_line(error)}") from error
    found = cameras.items() if isinstance(cameras, dict) else ()
    names = [name for name, facts in found if isinstance(facts, dict) and "intrinsics" in facts]
    if not names or (camera is not None and camera not in names):
        what = f"{camera} with intrinsics" if camera else "camera with intrinsics"
        raise FileFormatError(f"{path} is not a calibration of Kalibr: it has no {what}")
    if camera is None and len(names) > 1:
        raise InputError(f"{path} holds {', '.join(names)}; choose one: {path}:{names[0]}")
    facts = cameras[camera or names[0]]
    model = facts.get("distortion_model", "none")
    if facts.get("camera_model", "pinhole") != "pinhole" or model not in MODELS:
        raise FileFormatError(
            f"{path}: {facts.get('camera_model')} with distortion {shown(model)} is not read; "
            f"texvent reads pinhole cameras with {', '.join(MODELS)}"
        )
    try:
        fx, fy, cx, cy = (float(value) for value in facts["intrinsics"])
        lens = tuple(float(value) for value in facts.get("distortion_coeffs") or ())
        sides = facts.get("resolution")
        size = None if sides is None else SensorSize(*(int(side) for side in sides))
    except (TypeError, ValueError) as error:
        raise FileFormatError(f"{path} is not a calibration: {one_line(error)}") from error
    known = () if model == "none" else lens
    if model != "none" and len(lens) != 4:
        raise FileFormatError(f"{path}: {model} has four coefficients, not {len(lens)}")
    return Calibration((fx, fy, cx, cy), known, model == "equidistant", size)


def undistort(events: EventPackets, calibration: Calibration) -> EventPackets:
    """Every event in the pixel where a lens without distortion would have put it.

    Places are rounded to whole pixels, so some pixels get the events of two and some none;
    events that land outside the sensor are left out.
    """
    places = calibration.undistorted(events.size)

    def move(packet: EventStream) -> EventStream:
        moved = places[packet.y, packet.x]
        return move_events(packet, moved[:, 0], moved[:, 1], packet.size)

    facts: dict[str, Any] = {"intrinsics": list(calibration.intrinsics)}
    facts["coefficients"] = list(calibration.coefficients)
    if calibration.is_equidistant:
        facts["model"] = "equidistant"
    facts = facts if calibration.places is None else {"map": "rectify_map"}
    return note_edit(map_packets(events, move), events, undistort=facts)
