"""Events where a lens without distortion would have put them.

A calibration is one of

    text           `fx fy cx cy k1 k2 p1 p2 k3`, as in the Event Camera Dataset: pixels, and the
                   coefficients of Brown and Conrady (radtan, OpenCV's)
    Kalibr's yaml  cam0, cam1 ...: intrinsics, distortion_model radtan, equidistant or none
    DSEC's HDF5    rectify_map [H, W, 2]: x and y of each pixel in the rectified image
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import yaml
from numpy.typing import NDArray

from texvent.errors import FileFormatError, InputError, few, one_line, shown, warn
from texvent.event_packets import EventPackets, LazyPackets
from texvent.events import EventStream
from texvent.io.hdf5.storage import check_claims, open_hdf5
from texvent.runtime.memory import check_claim
from texvent.scenes.lens import warn_of_far_centre
from texvent.sensor import SensorSize, checked_size
from texvent.transform.packets import move_events, note_edit

ITERATIONS = 50
"""Of the fixed-point search; it stops earlier where it has settled."""
SETTLED = 1e-9
"""Change of normalised coordinates below which the search has settled."""
MAX_TEXT = 65_536
TEXT_HELP = "a calibration is nine numbers: fx fy cx cy k1 k2 p1 p2 k3"
MODELS = ("radtan", "equidistant", "none")
SMALLEST_SCALE = 0.01
"""Area of a pixel in a map, and one over the largest: no rectified image is so small or large."""
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
            raise InputError(
                f"the calibration leaves {is_found.mean():.0%} of the pixels on a {size} sensor; "
                "check its focal lengths, in pixels, and its coefficients"
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


def read_calibration(path: Path) -> Calibration:
    """The calibration in a file; `FILE:cam1` is the second camera of one of Kalibr's.

    Raises:
        InputError: no such file, or it holds several cameras and none is named.
        FileFormatError: it is no calibration.
    """
    whole, _, camera = str(path).rpartition(":")
    if path.is_file() or not Path(whole).is_file():
        whole, camera = str(path), ""
    path = Path(whole)
    if not path.is_file():
        raise InputError(f"no such file: {path}; {TEXT_HELP}, Kalibr's yaml or DSEC's rectify_map")
    if h5py.is_hdf5(path):
        return read_rectify_map(path)
    text = path.read_bytes()[:MAX_TEXT]
    try:
        is_kalibr = path.suffix.lower() in (".yaml", ".yml")
        found = _read_kalibr(path, text, camera) if is_kalibr else _read_numbers(path, text)
    except InputError:
        raise
    except (yaml.YAMLError, ValueError, TypeError, OverflowError, RecursionError) as error:
        raise FileFormatError(f"{path} is not a calibration: {one_line(error)}") from error
    numbers = (*found.intrinsics, *found.coefficients)
    if not np.isfinite(numbers).all() or min(found.intrinsics[:2]) <= 0:
        raise FileFormatError(
            f"{path} is not a calibration: its numbers must be finite and its focal lengths above "
            f"0; it holds {shown(numbers)}"
        )
    return found


def _read_numbers(path: Path, text: bytes) -> Calibration:
    numbers = [float(word) for word in text.split()]
    if len(numbers) != 9:
        raise FileFormatError(f"{path} holds {len(numbers)} numbers; {TEXT_HELP}")
    fx, fy, cx, cy, *lens = numbers
    return Calibration((fx, fy, cx, cy), tuple(lens))


def read_rectify_map(path: Path) -> Calibration:
    """DSEC's map, which places may be NaN in.

    Raises:
        FileFormatError: the file is damaged, or the map is no map of pixels.
    """
    with open_hdf5(path) as file:
        stored = file.get("rectify_map")
        is_map = isinstance(stored, h5py.Dataset) and stored.ndim == 3 and stored.shape[2] == 2
        if not is_map or stored.dtype.kind != "f":
            raise FileFormatError(f"{path} is not a calibration: it has no rectify_map [H, W, 2]")
        size = checked_size(stored.shape[1], stored.shape[0])
        check_claims(stored, path)
        check_claim(stored.nbytes, path, copies=4)
        places = np.asarray(stored[()], np.float64)
    steps = [np.diff(places, axis=axis).reshape(-1, 2) for axis in (1, 0)]
    if all(np.isfinite(one).all(axis=1).any() for one in steps):
        _check_steps(np.array([np.nanmedian(one, axis=0) for one in steps]), path)
    return Calibration(size=size, places=places)


def _check_steps(steps: NDArray[np.float64], path: Path) -> None:
    """Refuse a map of steps, [along, of], far from a pixel, or with x and y exchanged.

    A map may turn the image; only an exchange mirrors it about its diagonal.
    """
    scale = float(np.linalg.det(steps))
    is_exchanged = scale < 0 and abs(steps[0, 0]) < abs(steps[0, 1])
    if is_exchanged or not SMALLEST_SCALE < abs(scale) < 1 / SMALLEST_SCALE:
        raise FileFormatError(
            f"{path}: from one pixel to the next, its rectify_map moves by "
            f"({steps[0, 0]:.3g}, {steps[0, 1]:.3g}) along a row and ({steps[1, 0]:.3g}, "
            f"{steps[1, 1]:.3g}) along a column; it must hold x, then y, in pixels"
        )


def _read_kalibr(path: Path, text: bytes, camera: str) -> Calibration:
    if any(getattr(event, "value", None) == "<<" for event in yaml.parse(text)):
        raise FileFormatError(f"{path}: entries merged by << are not read; write them out")
    cameras: Any = yaml.safe_load(text)
    found = cameras.items() if isinstance(cameras, dict) else ()
    known = {str(name): one for name, one in found if isinstance(one, dict) and "intrinsics" in one}
    if not known or (camera and camera not in known):
        what = f"{shown(camera)} with intrinsics" if camera else "camera with intrinsics"
        raise FileFormatError(f"{path} is not a calibration of Kalibr: it has no {what}")
    first = next(iter(known))
    if not camera and len(known) > 1:
        raise InputError(f"{path} holds {few(list(known))}; choose one: {path}:{first}")
    facts = known[camera or first]
    shape, model = facts.get("camera_model", "pinhole"), facts.get("distortion_model", "none")
    if shape != "pinhole" or model not in MODELS:
        raise FileFormatError(
            f"{path}: {shown(shape)} with distortion {shown(model)} is not read; "
            f"texvent reads pinhole cameras with {', '.join(MODELS)}"
        )
    fx, fy, cx, cy = (float(value) for value in facts["intrinsics"])
    lens = tuple(float(value) for value in facts.get("distortion_coeffs") or ())
    if (model == "none" and any(lens)) or (model != "none" and len(lens) != 4):
        count = "no" if model == "none" else "four"
        raise FileFormatError(f"{path}: {model} has {count} coefficients, not {shown(lens)}")
    size = None
    if (sides := facts.get("resolution")) is not None:
        width, height = (float(side) for side in sides)
        if not (width.is_integer() and height.is_integer()):
            raise FileFormatError(f"{path}: the resolution is {shown(sides)}; give whole numbers")
        size = checked_size(int(width), int(height))
    known_lens = () if model == "none" else lens
    return Calibration((fx, fy, cx, cy), known_lens, model == "equidistant", size)


def undistort(events: EventPackets, calibration: Calibration) -> EventPackets:
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
        for packet in events:
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
    moved = EventPackets(LazyPackets(changed), events.size, events.metadata)
    return note_edit(moved, events, undistort=facts)
