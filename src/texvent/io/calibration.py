"""Calibrations of lenses in files, and the cameras of Kalibr's for rigs too.

A calibration is one of

    text           `fx fy cx cy k1 k2 p1 p2 k3`, as in the Event Camera Dataset: pixels, and the
                   coefficients of Brown and Conrady (radtan, OpenCV's)
    Kalibr's yaml  cam0, cam1 ...: intrinsics, distortion_model radtan, equidistant or none;
                   pixels count from the middle of the first one
    DSEC's HDF5    rectify_map [H, W, 2]: x and y of each pixel in the rectified image
"""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from texvent.errors import ConfigError, FileFormatError, InputError, few, one_line, shown
from texvent.io.hdf5.storage import check_claims, open_hdf5
from texvent.lens import HALF_PIXEL, Distortion, Lens
from texvent.runtime.files.yaml_text import load_yaml
from texvent.runtime.memory import check_claim
from texvent.sensor import SensorSize, checked_size
from texvent.transform.undistort import Calibration

MAX_TEXT = 65_536
TEXT_HELP = "a calibration is nine numbers: fx fy cx cy k1 k2 p1 p2 k3"
MODELS: dict[str, Distortion] = {
    "radtan": "radtan",
    "plumb_bob": "radtan",
    "equidistant": "equidistant",
    "equi": "equidistant",
    "none": "none",
}
"""Names of models in files of Kalibr's and of ROS → our models."""
SMALLEST_SCALE = 0.01
"""Area of a pixel in a map, and one over the largest: no rectified image is so small or large."""


def read_calibration(path: Path) -> Calibration:
    """The calibration in a file; `FILE:cam1` is the second camera of one of Kalibr's.

    Raises:
        InputError: no such file, it is no calibration, or it holds several cameras and none is
            named.
    """
    whole, _, camera = str(path).rpartition(":")
    if path.is_file() or not Path(whole).is_file():
        whole, camera = str(path), ""
    path = Path(whole)
    if not path.is_file():
        raise InputError(f"no such file: {path}; {TEXT_HELP}, Kalibr's yaml or DSEC's rectify_map")
    if h5py.is_hdf5(path):
        places = read_rectify_map(path)
        return Calibration(places, SensorSize(places.shape[1], places.shape[0]))
    text = path.read_bytes()[:MAX_TEXT]
    try:
        is_kalibr = path.suffix.lower() in (".yaml", ".yml")
        return _read_kalibr(path, text, camera) if is_kalibr else _read_numbers(path, text)
    except InputError:
        raise
    except (ValueError, TypeError, OverflowError) as error:
        raise FileFormatError(f"{path} is not a calibration: {one_line(error)}") from error


def _read_numbers(path: Path, text: bytes) -> Calibration:
    numbers = [float(word) for word in text.split()]
    if len(numbers) != 9:
        raise FileFormatError(f"{path} holds {len(numbers)} numbers; {TEXT_HELP}")
    return Calibration(_made_lens(numbers[:4], "radtan", numbers[4:], str(path)))


def read_rectify_map(path: Path) -> NDArray[np.float64]:
    """DSEC's map, [H, W, 2]: x and y of each pixel without the lens; may be NaN.

    Raises:
        FileFormatError: the file is damaged, or the map is no map of pixels.
    """
    with open_hdf5(path) as file:
        stored = file.get("rectify_map")
        is_map = isinstance(stored, h5py.Dataset) and stored.ndim == 3 and stored.shape[2] == 2
        if not is_map or stored.dtype.kind != "f":
            raise FileFormatError(f"{path} is not a calibration: it has no rectify_map [H, W, 2]")
        checked_size(stored.shape[1], stored.shape[0])
        check_claims(stored, path)
        check_claim(stored.nbytes, path, copies=4)
        places = np.asarray(stored[()], np.float64)
    steps = [np.diff(places, axis=axis).reshape(-1, 2) for axis in (1, 0)]
    if all(np.isfinite(one).all(axis=1).any() for one in steps):
        _check_steps(np.array([np.nanmedian(one, axis=0) for one in steps]), path)
    return places


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
    cameras: Any = load_yaml(text)
    found = cameras.items() if isinstance(cameras, dict) else ()
    known = {str(name): one for name, one in found if isinstance(one, dict) and "intrinsics" in one}
    if not known or (camera and camera not in known):
        what = f"{shown(camera)} with intrinsics" if camera else "camera with intrinsics"
        raise FileFormatError(f"{path} is not a calibration of Kalibr: it has no {what}")
    first = next(iter(known))
    if not camera and len(known) > 1:
        raise InputError(f"{path} holds {few(list(known))}; choose one: {path}:{first}")
    name = camera or first
    entry, where = known[name], f"{path}, {shown(name)}"
    lens = read_lens(entry, where)
    if lens is None or (lens.distortion != "none" and not entry.get("distortion_coeffs")):
        raise FileFormatError(f"{where}: its distortion has no distortion_coeffs")
    return Calibration(lens, read_size(entry, where))


def read_lens(entry: Mapping[str, Any], where: str) -> Lens | None:
    """The lens of a camera of Kalibr's, without coefficients an ideal one; None: it states none.

    Raises:
        ConfigError: a model is not known, or a value does not fit it.
    """
    shape, model = entry.get("camera_model", "pinhole"), entry.get("distortion_model", "none")
    if shape != "pinhole":
        raise ConfigError(
            f"{where}: camera_model is {shown(shape)}; only pinhole is known, with distortion "
            "radtan or equidistant"
        )
    if not isinstance(model, str) or model not in MODELS:
        raise ConfigError(
            f"{where}: distortion_model is {shown(model)}; it must be radtan, equidistant or none"
        )
    distortion, given = MODELS[model], entry.get("distortion_coeffs") or [0.0] * 4
    count = len(given) if isinstance(given, Sequence) else 4
    coefficients = read_numbers(given, count, f"{where}: distortion_coeffs")
    if len(coefficients) == 5 and coefficients[4] == 0.0:
        coefficients = coefficients[:4]
    if len(coefficients) != 4:
        raise ConfigError(
            f"{where}: distortion_coeffs has {len(coefficients)} numbers; {model} takes 4"
        )
    if distortion == "none" and any(coefficients):
        raise ConfigError(
            f"{where}: distortion_coeffs without distortion_model; say radtan or equidistant"
        )
    if "intrinsics" in entry:
        intrinsics = read_numbers(entry["intrinsics"], 4, f"{where}: intrinsics")
        return _made_lens(intrinsics, distortion, coefficients, where)
    if any(coefficients) or distortion == "equidistant":
        raise ConfigError(
            f"{where}: distortion needs intrinsics, [fu, fv, pu, pv] in pixels, or field_of_view"
        )
    return None


def read_size(entry: Mapping[str, Any], where: str) -> SensorSize | None:
    """The resolution of a camera of Kalibr's; None: it states none.

    Raises:
        ConfigError: it is no size of a sensor.
    """
    if entry.get("resolution") is None:
        return None
    width, height = read_numbers(entry["resolution"], 2, f"{where}: resolution")
    if width != int(width) or height != int(height):
        raise ConfigError(f"{where}: resolution is {width:g} x {height:g}; give whole numbers")
    return checked_size(int(width), int(height))


def read_numbers(value: Any, count: int, where: str) -> list[float]:
    """A list of finite numbers; texts and truth values are none.

    Raises:
        ConfigError: it is something else.
    """
    if not isinstance(value, Sequence) or isinstance(value, str) or len(value) != count:
        raise ConfigError(f"{where} is {shown(value)}; it must be {count} numbers")
    for one in value:
        is_number = isinstance(one, int | float) and not isinstance(one, bool)
        if not is_number or not abs(one) <= sys.float_info.max:
            raise ConfigError(f"{where} holds {shown(one)}; it must be {count} finite numbers")
    return [float(one) for one in value]


def _made_lens(
    intrinsics: Sequence[float], distortion: Distortion, coefficients: Sequence[float], where: str
) -> Lens:
    fx, fy, cx, cy = intrinsics
    try:
        return Lens(fx, fy, cx + HALF_PIXEL, cy + HALF_PIXEL, distortion, tuple(coefficients))
    except ConfigError as error:
        raise ConfigError(f"{where} is not a calibration: {error}") from error
