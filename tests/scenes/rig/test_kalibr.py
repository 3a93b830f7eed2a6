"""Rig files: as Kalibr writes them, and by hand; what is wrong in them is named."""

import math
import warnings
from pathlib import Path
from tempfile import TemporaryDirectory

import cv2
import numpy as np
import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st
from tests.cli.running import refused

from texvent.errors import ConfigError, TexventWarning
from texvent.io.calibration import MODELS, read_lens
from texvent.lens import Lens
from texvent.runtime.progress import NO_PROGRESS
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent_scenes.rig.config import RigConfig
from texvent_scenes.rig.description import IMU_NOISES, NOISE_NAMES, ImuNoise, Rig, RigCamera
from texvent_scenes.rig.kalibr import camchain, imu_yaml, read_rig, stereo_rig
from texvent_scenes.rig.recording import prepare_recording

SIZE = SensorSize(346, 260)
KALIBR = """
cam0:
  T_cam_imu:
  - [0.0, -1.0, 0.0, 0.01]
  - [1.0, 0.0, 0.0, 0.02]
  - [0.0, 0.0, 1.0, 0.03]
  - [0.0, 0.0, 0.0, 1.0]
  cam_overlaps: [1]
  camera_model: pinhole
  distortion_coeffs: [-0.28, 0.07, 0.0002, 1.0e-05]
  distortion_model: radtan
  intrinsics: [458.654, 457.296, 367.215, 248.375]
  resolution: [752, 480]
  rostopic: /cam0/image_raw
  timeshift_cam_imu: 0.0
cam1:
  T_cn_cnm1:
  - [0.9999, -0.0023, -0.0139, -0.1100]
  - [0.0023, 0.9999, -0.0009, 0.0004]
  - [0.0139, 0.0009, 0.9999, -0.0008]
  - [0.0, 0.0, 0.0, 1.0]
  cam_overlaps: [0]
  camera_model: pinhole
  distortion_coeffs: [-0.28, 0.07, 0.0001, -3.5e-05]
  distortion_model: equidistant
  intrinsics: [457.587, 456.134, 379.999, 255.238]
  resolution: [752, 480]
  rostopic: /cam1/image_raw
  timeshift_cam_imu: 0.0
"""


def write(folder: Path, text: str, name: str = "rig.yaml") -> Path:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def test_a_file_of_kalibr_is_read(tmp_path):
    rig, noise = read_rig(write(tmp_path, KALIBR), SIZE)
    first, second = rig.cameras
    assert noise is None
    assert (first.name, first.size) == ("cam0", SensorSize(752, 480))
    assert first.lens == Lens(
        458.654, 457.296, 367.715, 248.875, "radtan", (-0.28, 0.07, 0.0002, 1e-5)
    )
    assert second.lens is not None
    assert second.lens.distortion == "equidistant"
    assert second.from_first[0, 3] == -0.11
    turn = second.from_first[:3, :3]
    np.testing.assert_allclose(turn @ turn.T, np.eye(3), atol=1e-12)
    assert rig.first_from_imu[:3, 3].tolist() == [0.01, 0.02, 0.03]


NUMBERS = st.lists(st.floats(-3.0, 3.0), min_size=6, max_size=6)


@given(steps=st.lists(NUMBERS, min_size=2, max_size=5), has_imu=st.booleans())
def test_of_any_cameras_each_is_written_by_the_one_before_and_reads_back(steps, has_imu):
    """The first step is from the IMU to the first camera, each other one from camera to camera."""
    maps = [np.eye(4) for _ in steps]
    for one, numbers in zip(maps, steps, strict=True):
        one[:3, :3], one[:3, 3] = cv2.Rodrigues(np.array(numbers[:3]))[0], numbers[3:]
    first_from_imu, *maps = maps
    lens = Lens(300.0, 301.0, 170.0, 131.0, "radtan", (-0.1, 0.01, 1e-4, 1e-5))
    cameras, from_first = [RigCamera("cam0", SIZE, lens)], np.eye(4)
    for number, one in enumerate(maps, start=1):
        from_first = one @ from_first
        cameras.append(RigCamera(f"cam{number}", SensorSize(240, 180), None, from_first))
    text = camchain(Rig(tuple(cameras), first_from_imu), {}, has_imu=has_imu)
    written, from_imu = yaml.safe_load(text), first_from_imu
    for number, one in enumerate([np.eye(4), *maps]):
        entry, from_imu = written[f"cam{number}"], one @ from_imu
        assert ("T_cn_cnm1" in entry, "T_cam_imu" in entry) == (number > 0, has_imu)
        np.testing.assert_allclose(entry.get("T_cn_cnm1", one), one, atol=1e-9)
        np.testing.assert_allclose(entry.get("T_cam_imu", from_imu), from_imu, atol=1e-9)
    with TemporaryDirectory() as folder, warnings.catch_warnings():
        warnings.simplefilter("ignore", TexventWarning)  # far apart
        again = read_rig(write(Path(folder), text), SensorSize(9, 9))[0]
    for one, other in zip(cameras, again.cameras, strict=True):
        assert (one.name, one.size, one.lens) == (other.name, other.size, other.lens)
        np.testing.assert_allclose(one.from_first, other.from_first, atol=1e-9)
    expected = first_from_imu if has_imu else np.eye(4)
    np.testing.assert_allclose(again.first_from_imu, expected, atol=1e-9)


def test_names_of_the_fields_are_kalibrs(tmp_path):
    rig, _ = read_rig(write(tmp_path, KALIBR), SIZE)
    written = yaml.safe_load(camchain(rig, {"cam0": "/a", "cam1": "/b"}, has_imu=True))
    given = yaml.safe_load(KALIBR)
    assert written["cam0"].keys() == given["cam0"].keys()
    assert written["cam1"].keys() == given["cam1"].keys() | {"T_cam_imu"}
    assert written["cam0"]["intrinsics"] == given["cam0"]["intrinsics"]
    alone = yaml.safe_load(camchain(rig, {}, has_imu=False))
    assert "T_cam_imu" not in alone["cam0"]


@pytest.mark.parametrize("sensor", [["--sensor", "64x48"], ["--sensor=64x48"]])
def test_a_sensor_beside_a_rig_file_is_refused_in_both_spellings(sensor, tmp_path, capsys):
    file, out = write(tmp_path, KALIBR), tmp_path / "out"
    line = refused(capsys, "rig", "a red ball bounces", *sensor, "--rig", file, "-o", out)
    assert line.startswith("--sensor 64x48 and --rig")
    assert not out.exists()


def test_imu_yaml_has_kalibrs_fields():
    noise = IMU_NOISES["adis16448"]
    written = yaml.safe_load(imu_yaml(noise, 200.0, "/imu0"))
    assert written == {
        "accelerometer_noise_density": 2.0e-3,
        "accelerometer_random_walk": 3.0e-3,
        "gyroscope_noise_density": 1.6968e-4,
        "gyroscope_random_walk": 1.9393e-5,
        "rostopic": "/imu0",
        "update_rate": 200.0,
    }


def test_without_distortion_radtan_with_zeros_is_written():
    rig = Rig((RigCamera("cam0", SIZE, Lens(300.0, 300.0, 173.0, 130.0)),))
    entry = yaml.safe_load(camchain(rig, {}, has_imu=False))["cam0"]
    assert (entry["distortion_model"], entry["distortion_coeffs"]) == ("radtan", [0.0] * 4)
    assert entry["intrinsics"] == [300.0, 300.0, 172.5, 129.5]


def test_short_forms_of_a_file_by_hand(tmp_path):
    """90° across 346 px: f = 173. The second camera is to the right and looks to the right."""
    text = """
    [cam0]
    field_of_view = 90
    [cam1]
    baseline = 0.12
    rotation = [0, 10, 0]
    resolution = [640, 480]
    [imu0]
    accelerometer_noise_density = 2e-3
    accelerometer_random_walk = 0
    gyroscope_noise_density = 1e-4
    gyroscope_random_walk = 0
    """
    rig, noise = read_rig(write(tmp_path, text, "rig.toml"), SIZE)
    first, second = rig.cameras
    assert first.lens is not None
    assert first.lens.fx == pytest.approx(173.0)
    assert (first.size, second.size, second.lens) == (SIZE, SensorSize(640, 480), None)
    assert noise == ImuNoise(2e-3, 0.0, 1e-4, 0.0)
    in_first = np.linalg.inv(second.from_first)
    np.testing.assert_allclose(in_first[:3, 3], [0.12, 0, 0], atol=1e-12)


@given(degrees=st.lists(st.floats(-170.0, 170.0), min_size=3, max_size=3))
def test_a_camera_is_turned_about_x_then_y_then_z_of_the_one_before(degrees):
    with TemporaryDirectory() as folder:
        text = f"cam0: {{}}\ncam1: {{rotation: {degrees}}}"
        second = read_rig(write(Path(folder), text), SIZE)[0].cameras[1]
    point = np.array([0.3, -0.2, 0.9])  # of the second camera
    seen = point
    for axis, angle in zip(np.eye(3), np.radians(degrees), strict=True):
        seen = cv2.Rodrigues(angle * axis)[0] @ seen
    np.testing.assert_allclose(np.linalg.inv(second.from_first)[:3, :3] @ point, seen, atol=1e-9)


STATED = ImuNoise(4e-3, 3e-3, 2e-4, 1e-4)
WRITTEN = {
    "imu.yaml": imu_yaml(STATED, 200.0, "/imu0"),
    "within.yml": yaml.safe_dump({"imu0": yaml.safe_load(imu_yaml(STATED, 9.0, ""))}),
    "imu.toml": "".join(f"{name} = {getattr(STATED, name)}\n" for name in NOISE_NAMES),
}


@pytest.mark.parametrize("imu0", [None, ImuNoise(1e-3, 2e-3, 5e-4, 6e-5)])
@pytest.mark.parametrize("name", [*IMU_NOISES, *WRITTEN])
def test_the_noise_is_that_of_the_file_or_name_and_then_of_the_rig(tmp_path, name, imu0):
    rig = {"cam0": {}, **({"imu0": vars(imu0)} if imu0 else {})}
    path = write(tmp_path, yaml.safe_dump(rig))
    said = str(write(tmp_path, WRITTEN[name], name)) if name in WRITTEN else name
    config = RigConfig(rig=path, imu=100.0, imu_noise=said)
    settings = resolve("generate", {"sensor": "32x24", "duration": 0.1})
    recording = prepare_recording("a ball", settings, config, progress=NO_PROGRESS)
    expected = IMU_NOISES.get(name, STATED)
    is_default = name == RigConfig().imu_noise
    assert recording.noise == (imu0 if imu0 and is_default else expected)
    assert [one.name for one in recording.rig.cameras] == ["cam0"]


def test_a_sensor_by_name_has_its_size(tmp_path):
    text = "cam0: {sensor: davis240c}\ncam1: {sensor: evk4, baseline: 0.1}"
    first, second = read_rig(write(tmp_path, text), SIZE)[0].cameras
    assert (first.size, first.sensor) == (SensorSize(240, 180), "davis240c")
    assert (second.size, second.sensor) == (SensorSize(1280, 720), "evk4")


def test_numbers_that_yaml_reads_as_text_are_numbers(tmp_path):
    text = KALIBR.replace("1.0e-05]", "1e-05]")
    assert read_rig(write(tmp_path, text), SIZE)[0].cameras[0].lens is not None


def test_places_by_the_imu_alone(tmp_path):
    chain = yaml.safe_load(KALIBR)
    chain["cam1"]["T_cam_imu"] = chain["cam0"]["T_cam_imu"]
    del chain["cam1"]["T_cn_cnm1"]
    rig, _ = read_rig(write(tmp_path, yaml.safe_dump(chain)), SIZE)
    np.testing.assert_allclose(rig.cameras[1].from_first, np.eye(4), atol=1e-15)


def test_stereo_puts_the_second_camera_to_the_right():
    second = stereo_rig(SIZE, 0.12).cameras[1]
    assert np.linalg.inv(second.from_first)[:3, 3].tolist() == [0.12, 0.0, 0.0]


def test_a_time_shift_is_named(tmp_path):
    text = KALIBR.replace("timeshift_cam_imu: 0.0", "timeshift_cam_imu: 0.004", 1)
    with pytest.warns(TexventWarning, match="one clock"):
        read_rig(write(tmp_path, text), SIZE)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("pinhole", "omni", "camera_model is 'omni'; only pinhole"),
        ("radtan", "fov", "distortion_model is 'fov'; it must be"),
        ("intrinsics: [458.654, 457.296,", "intrinsics: [458.654,", "must be 4 numbers"),
        ("458.654", "-458.654", "focal lengths are -458"),
        ("458.654", ".nan", "must be 4 finite numbers"),
        ("[-0.28, 0.07", "[-1.28, 0.07", "no ray reaches"),
        ("[752, 480]", "[752.5, 480]", "whole numbers"),
        ("[752, 480]", "[0, 480]", r"each side must be 1\.\."),
        ("rostopic", "rostopik", "unknown name 'rostopik'"),
        ("[0.9999, -0.0023", "[0.5, -0.0023", "no rigid motion"),
        ("  T_cn_cnm1:\n", "  baseline: 0.1\n  T_cn_cnm1:\n", "both state its place"),
        ("[0.0, -1.0, 0.0, 0.01]", "[0.0, -1.0, 0.0]", "must be 4 numbers"),
        ("cam0:", "cam/0:", "a camera's name must be"),
    ],
)
def test_what_is_wrong_is_named(tmp_path, old, new, words):
    assert old in KALIBR
    with pytest.raises(ConfigError, match=words):
        read_rig(write(tmp_path, KALIBR.replace(old, new, 1)), SIZE)


@given(st.sampled_from(sorted(MODELS)), st.lists(st.sampled_from([0.0, 1e-3, -2e-3]), max_size=7))
def test_every_coefficient_is_in_the_lens_or_is_refused(model, coefficients):
    """A fifth one of 0 and no one are none."""
    given, fifth = {"distortion_model": model, "distortion_coeffs": coefficients}, coefficients[4:]
    given |= {"intrinsics": [300.0, 301.0, 170.0, 131.0]}
    is_known = len(coefficients) in (0, 4) or fifth == [0.0]
    if not is_known or (MODELS[model] == "none" and any(coefficients)):
        message = (
            "without distortion_model" if is_known else f"{len(coefficients)} numbers; {model}"
        )
        with pytest.raises(ConfigError, match=message):
            read_lens(given, "a.yaml")
        return
    expected = (*coefficients, *4 * [0.0])[:4]
    assert read_lens(given, "a.yaml") == Lens(300.0, 301.0, 170.5, 131.5, MODELS[model], expected)


@pytest.mark.parametrize("name", sorted(MODELS))
@pytest.mark.parametrize("degrees", [20, 90, 150])
def test_a_field_of_view_reaches_from_edge_to_edge_whatever_the_model_is_called(
    tmp_path, name, degrees
):
    """The image's edges are rays that far apart, by OpenCV."""
    text = f"[cam0]\nfield_of_view = {degrees}\ndistortion_model = '{name}'\n"
    text += "" if name == "none" else "distortion_coeffs = [0.0, 0.0, 0.0, 0.0]\n"
    lens = read_rig(write(tmp_path, text, "rig.toml"), SIZE)[0].cameras[0].lens
    matrix = np.array([[lens.fx, 0, lens.cx - 0.5], [0, lens.fy, lens.cy - 0.5], [0, 0, 1]])
    middle = 0.5 * SIZE.height - 0.5
    edges = np.array([[[-0.5, middle]], [[SIZE.width - 0.5, middle]]])
    is_fisheye = MODELS[name] == "equidistant"
    undistort = cv2.fisheye.undistortPoints if is_fisheye else cv2.undistortPoints
    (left, _), (right, _) = undistort(edges, matrix, np.zeros(4))[:, 0]
    assert math.degrees(math.atan(right) - math.atan(left)) == pytest.approx(degrees, abs=0.01)


LENS = {"intrinsics": [110, 110, 120, 90], "resolution": [240, 180]}
ASIDE = [[1, 0, 0, -0.1], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({}, None),
        ({"resolution": [640, 480]}, "is far from the middle of 640x480"),
        ({"intrinsics": [110, 110, 200, 90]}, "is far from the middle of 240x180"),
        ({"T_cn_cnm1": [[1, 0, 0, -100], *ASIDE[1:]]}, "is 100 m from the first camera"),
    ],
)
@pytest.mark.parametrize("names", [("cam0", "cam1"), (1, 2)])
def test_cameras_have_any_names_and_numbers_that_hardly_fit_are_warned_of(
    tmp_path, names, changes, message
):
    path = tmp_path / "rig.yaml"
    first, second = names
    document = {first: LENS, second: {**LENS, "T_cn_cnm1": ASIDE, **changes}}
    path.write_text(yaml.safe_dump(document))
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        rig, _ = read_rig(path, SensorSize(9, 9))
    assert [camera.name for camera in rig.cameras] == [str(first), str(second)]
    told = [str(one.message) for one in caught]
    assert [message in one for one in told] == ([True] if message else [])
