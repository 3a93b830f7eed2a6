"""Rig files: cameras as Kalibr's camchain.yaml has them, read and written.

    cam0:
      resolution: [346, 260]                  or  sensor: davis346
      camera_model: pinhole
      intrinsics: [fu, fv, pu, pv]            or  field_of_view: 65   (degrees across)
      distortion_model: radtan                or equidistant, none
      distortion_coeffs: [k1, k2, p1, p2]
      T_cam_imu: 4x4                          coordinates in the IMU → in the camera
    cam1:
      T_cn_cnm1: 4x4                          coordinates in the camera before → in this one
                                              or  baseline: 0.12  and  rotation: [0, 5, 0]
      ...
    imu0:                                     as in imu.yaml; may be left out
      gyroscope_noise_density: 1.7e-4         ...

A calibration that Kalibr wrote is such a file; short forms are for files written by hand:
`baseline` is the camera's place in the camera before, m (one number: to its right), `rotation` how
it is turned about that camera's x, then y, then z axis, degrees. TOML holds the same names.

Source: Kalibr's documentation, "YAML formats".
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from texvent._registry import suggest
from texvent.errors import ConfigError, shown, warn
from texvent.io.calibration import MODELS, read_lens, read_numbers, read_size
from texvent.lens import HALF_PIXEL, Lens, lens_reach
from texvent.sensor import SENSORS, SensorSize, find_sensor, warn_of_far_centre
from texvent.settings.config_files import read_document
from texvent_scenes.rig.description import NOISE_NAMES, Float64Array, ImuNoise, Rig, RigCamera

MOST_CAMERAS = 16
_IGNORED = ("rostopic", "cam_overlaps", "timeshift_cam_imu", "time_offset", "model")
_CAMERA_KEYS = (
    "camera_model", "intrinsics", "field_of_view", "distortion_model", "distortion_coeffs",
    "resolution", "sensor", "T_cn_cnm1", "T_cam_imu", "baseline", "rotation",
)  # fmt: skip
_IMU = re.compile(r"imu\d*")
USUAL_M, FARTHEST_M = 10.0, 1e4
"""Distance between cameras from which on a warning is due, and the largest."""
_NOT_RIGID = 1e-3
"""Most that a rotation's entries may be off, as rounding in a file is."""


def read_rig(path: Path, size: SensorSize) -> tuple[Rig, ImuNoise | None]:
    """The rig of a file.

    Args:
        path: YAML or TOML, as Kalibr writes it or by hand.
        size: of cameras whose resolution the file does not state, pixels.

    Returns:
        The rig, and the noise of its IMU where the file states it.

    Raises:
        InputError: the file cannot be read.
        ConfigError: it is not such a file, or a value does not fit; names camera and key.
    """
    document = {str(name): entry for name, entry in read_document(path).items()}
    names = [name for name in document if not _IMU.fullmatch(name)]
    if not names or len(names) > MOST_CAMERAS:
        raise ConfigError(
            f"{path} describes {len(names)} cameras; give 1 to {MOST_CAMERAS}, as cam0: ..., "
            "cam1: ..."
        )
    cameras: list[RigCamera] = []
    from_imu: Float64Array | None = None
    for name in names:
        where = f"{path}, {shown(name)}"
        entry = _entry(document[name], name, where)
        from_first = _from_first(entry, cameras, from_imu, where)
        _check_distance(math.hypot(*from_first[:3, 3]), where)
        own = _map(entry["T_cam_imu"], f"{where}: T_cam_imu") if "T_cam_imu" in entry else None
        if not cameras:
            from_imu = own
        resolution = _resolution(entry, size, where)
        lens = _lens(entry, resolution, where)
        cameras.append(RigCamera(name, resolution, lens, from_first, entry.get("sensor")))
    rig = Rig(tuple(cameras), np.eye(4) if from_imu is None else from_imu)
    entries = [document[name] for name in document if _IMU.fullmatch(name)]
    return rig, read_noise(entries[0], str(path)) if entries else None


def read_noise(entry: Any, where: str) -> ImuNoise:
    """Densities of a Kalibr imu.yaml.

    Raises:
        ConfigError: one is missing, or not a number of at least 0.
    """
    if not isinstance(entry, Mapping):
        raise ConfigError(f"{where}: the IMU is {shown(entry)}; it must hold densities by name")
    values = []
    for name in NOISE_NAMES:
        if name not in entry:
            raise ConfigError(
                f"{where}: the IMU has no {name}; give all of {', '.join(NOISE_NAMES)}"
            )
        value = read_numbers([entry[name]], 1, f"{where}: {name}")[0]
        if value < 0.0:
            raise ConfigError(f"{where}: {name} is {value:g}; it must be at least 0")
        values.append(value)
    return ImuNoise(*values)


def stereo_rig(size: SensorSize, baseline_m: float) -> Rig:
    """Two like cameras that look the same way, the second `baseline_m` to the right."""
    first_in_second = np.eye(4)
    first_in_second[0, 3] = -baseline_m
    return Rig((RigCamera("cam0", size, None), RigCamera("cam1", size, None, first_in_second)))


def camera_entries(
    rig: Rig, topics: Mapping[str, str], *, has_imu: bool
) -> dict[str, dict[str, Any]]:
    """The rig's cameras by the names of Kalibr's camchain.yaml; `topics`: name → topic."""
    document: dict[str, dict[str, Any]] = {}
    before = np.eye(4)
    for number, camera in enumerate(rig.cameras):
        entry: dict[str, Any] = {}
        if has_imu:
            entry["T_cam_imu"] = (camera.from_first @ rig.first_from_imu).tolist()
        if number:
            entry["T_cn_cnm1"] = (camera.from_first @ np.linalg.inv(before)).tolist()
        entry["cam_overlaps"] = [one for one in range(len(rig.cameras)) if one != number]
        entry["camera_model"] = "pinhole"
        entry |= _intrinsics(camera)
        entry["resolution"] = list(camera.size)
        if camera.name in topics:
            entry["rostopic"] = topics[camera.name]
        if has_imu:
            entry["timeshift_cam_imu"] = 0.0
        document[f"cam{number}"] = entry
        before = camera.from_first
    return document


def camchain(rig: Rig, topics: Mapping[str, str], *, has_imu: bool) -> str:
    """The rig as Kalibr's camchain.yaml, or camchain-imucam.yaml with an IMU."""
    document = camera_entries(rig, topics, has_imu=has_imu)
    return yaml.safe_dump(document, default_flow_style=None, sort_keys=False, width=200)


def _intrinsics(camera: RigCamera) -> dict[str, Any]:
    lens = camera.lens
    if lens is None:
        return {}
    return {
        "distortion_coeffs": list(lens.coefficients),
        # Kalibr's readers expect four coefficients; radtan with zeros is no distortion.
        "distortion_model": "radtan" if lens.distortion == "none" else lens.distortion,
        "intrinsics": list(lens.intrinsics),
    }


def imu_yaml(noise: ImuNoise, rate_hz: float, topic: str) -> str:
    """The noise as Kalibr's imu.yaml."""
    entry = {name: getattr(noise, name) for name in NOISE_NAMES}
    return yaml.safe_dump({**entry, "rostopic": topic, "update_rate": rate_hz}, sort_keys=False)


def _entry(value: Any, name: str, where: str) -> Mapping[str, Any]:
    """One camera's table, its names known."""
    if not re.fullmatch(r"[A-Za-z0-9_-]{1,32}", name):
        raise ConfigError(f"{where}: a camera's name must be 1..32 letters, digits, _ or -")
    if not isinstance(value, Mapping):
        raise ConfigError(
            f"{where} is {shown(value)}; it must hold values by name, as in Kalibr's yaml"
        )
    for key in value:
        if key not in (*_CAMERA_KEYS, *_IGNORED):
            raise ConfigError(
                f"{where}: unknown name {shown(key)}; {suggest(str(key), _CAMERA_KEYS)}"
            )
    shift = value.get("timeshift_cam_imu", 0.0)
    if shift:
        warn(
            f"{where}: timeshift_cam_imu is {shown(shift)} s; a simulated rig has one clock, so it "
            "is 0 here"
        )
    return value


def _resolution(entry: Mapping[str, Any], size: SensorSize, where: str) -> SensorSize:
    sensor = entry.get("sensor")
    if sensor is not None:
        known = find_sensor(sensor) if isinstance(sensor, str) else None
        if known is None:
            raise ConfigError(
                f"{where}: no sensor {shown(sensor)}; {suggest(str(sensor), tuple(SENSORS))}"
            )
        size = known.size
    stated = read_size(entry, where)
    if sensor is not None and stated not in (None, size):
        raise ConfigError(f"{where}: resolution is {stated}, but sensor {sensor} has {size}")
    return stated or size


def _lens(entry: Mapping[str, Any], size: SensorSize, where: str) -> Lens | None:
    if "field_of_view" in entry and "intrinsics" not in entry:
        focal = _focal(entry, size, where)
        middle = [0.5 * side - HALF_PIXEL for side in size]
        entry = {**entry, "intrinsics": [focal, focal, *middle]}
    lens = read_lens(entry, where)
    if lens is None:
        return None
    try:
        with np.errstate(all="ignore"):
            lens_reach(lens, size)
    except ConfigError as error:
        raise ConfigError(f"{where}: {error}") from error
    warn_of_far_centre((lens.cx, lens.cy), size, where)
    return lens


def _focal(entry: Mapping[str, Any], size: SensorSize, where: str) -> float:
    """Focal length in pixels of a field of view across the image, before coefficients count."""
    degrees = read_numbers([entry["field_of_view"]], 1, f"{where}: field_of_view")[0]
    if not 1.0 <= degrees <= 170.0:
        raise ConfigError(
            f"{where}: field_of_view is {degrees:g}°; it must be 1..170, across the image"
        )
    half = math.radians(0.5 * degrees)
    is_equidistant = MODELS.get(str(entry.get("distortion_model"))) == "equidistant"
    return 0.5 * size.width / (half if is_equidistant else math.tan(half))


def _from_first(
    entry: Mapping[str, Any],
    cameras: Sequence[RigCamera],
    first_from_imu: Float64Array | None,
    where: str,
) -> Float64Array:
    """[4, 4] coordinates in the first camera → in this one."""
    given = [name for name in ("T_cn_cnm1", "baseline", "rotation") if name in entry]
    if not cameras:
        if given:
            raise ConfigError(
                f"{where}: {given[0]} is the place in the camera before; the first has none"
            )
        return np.eye(4)
    before = cameras[-1].from_first
    if "T_cn_cnm1" in entry:
        if len(given) > 1:
            raise ConfigError(f"{where}: T_cn_cnm1 and {given[1]} both state its place; give one")
        return _map(entry["T_cn_cnm1"], f"{where}: T_cn_cnm1") @ before
    if given:
        return _placed(entry, where) @ before
    if first_from_imu is not None and "T_cam_imu" in entry:
        return _map(entry["T_cam_imu"], f"{where}: T_cam_imu") @ np.linalg.inv(first_from_imu)
    raise ConfigError(
        f"{where} does not say where it is; give T_cn_cnm1, or baseline: 0.12 (m to the right)"
    )


def _check_distance(distance_m: float, where: str) -> None:
    """Refuse a place out of every scene; warn of one that was perhaps given in millimetres."""
    if not distance_m < FARTHEST_M:
        raise ConfigError(
            f"{where} is {distance_m:g} m from the first camera; at most {FARTHEST_M:g}"
        )
    if distance_m > USUAL_M:
        warn(f"{where} is {distance_m:g} m from the first camera; places are in metres")


def _placed(entry: Mapping[str, Any], where: str) -> Float64Array:
    """[4, 4] coordinates in the camera before → in this one, of `baseline` and `rotation`."""
    given = entry.get("baseline", 0.0)
    place = read_numbers(
        [given, 0.0, 0.0] if isinstance(given, int | float) else given, 3, f"{where}: baseline"
    )
    angles = np.radians(read_numbers(entry.get("rotation", [0.0] * 3), 3, f"{where}: rotation"))
    (ca, cb, cc), (sa, sb, sc) = np.cos(angles), np.sin(angles)
    about_x = np.array([[1, 0, 0], [0, ca, -sa], [0, sa, ca]])
    about_y = np.array([[cb, 0, sb], [0, 1, 0], [-sb, 0, cb]])
    about_z = np.array([[cc, -sc, 0], [sc, cc, 0], [0, 0, 1]])
    in_before = np.eye(4)
    in_before[:3, :3], in_before[:3, 3] = about_z @ about_y @ about_x, place
    return np.asarray(np.linalg.inv(in_before), dtype=np.float64)


def _map(value: Any, where: str) -> Float64Array:
    """A [4, 4] rigid map; rounding in its rotation is mended."""
    rows = value if isinstance(value, Sequence) and not isinstance(value, str) else []
    if len(rows) != 4:
        raise ConfigError(f"{where} is {shown(value)}; it must be four rows of four numbers")
    matrix = np.array([read_numbers(row, 4, where) for row in rows])
    left, stretch, right = np.linalg.svd(matrix[:3, :3])
    turn = left @ right
    is_rigid = np.abs(stretch - 1.0).max() < _NOT_RIGID and np.linalg.det(turn) > 0.0
    if not is_rigid or np.abs(matrix[3] - [0.0, 0.0, 0.0, 1.0]).max() > 1e-9:
        raise ConfigError(
            f"{where} is no rigid motion: its 3x3 part must be a rotation, its last row 0 0 0 1"
        )
    matrix[:3, :3] = turn
    return matrix
