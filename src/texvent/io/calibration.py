"""Calibrations of lenses in files.

A calibration is one of

    text           `fx fy cx cy k1 k2 p1 p2 k3`, as in the Event Camera Dataset: pixels, and the
                   coefficients of Brown and Conrady (radtan, OpenCV's)
    Kalibr's yaml  cam0, cam1 ...: intrinsics, distortion_model radtan, equidistant or none
    DSEC's HDF5    rectify_map [H, W, 2]: x and y of each pixel in the rectified image
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, InputError, few, one_line, shown
from texvent.io.hdf5.storage import check_claims, open_hdf5
from texvent.runtime.memory import check_claim
from texvent.runtime.yaml_text import load_yaml
from texvent.sensor import checked_size
from texvent.transform.undistort import Calibration

MAX_TEXT = 65_536
TEXT_HELP = "a calibration is nine numbers: fx fy cx cy k1 k2 p1 p2 k3"
MODELS = ("radtan", "equidistant", "none")
SMALLEST_SCALE = 0.01
"""Area of a pixel in a map, and one over the largest: no rectified image is so small or large."""


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
    except (ValueError, TypeError, OverflowError) as error:
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
    cameras: Any = load_yaml(text)
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
    fx, fy, cx, cy = map(_number, facts["intrinsics"])
    lens = tuple(map(_number, facts.get("distortion_coeffs") or ()))
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


def _number(value: Any) -> float:
    """A number of a YAML file; neither a text nor a truth value."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise TypeError(f"{shown(value)} is no number")
    return float(value)
