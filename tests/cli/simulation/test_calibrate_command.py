import numpy as np
import pytest
from tests.calibrate.known_scenes import simulate_flicker, simulate_static

from texvent.cli.app import main
from texvent.events import EventStream
from texvent.frames import Video
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent.simulation.physical.config import PhysicalConfig
from texvent.simulation.physical.simulator import PhysicalSimulator
from texvent.simulation.physical.threshold_map import read_threshold_map


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    folder = tmp_path_factory.mktemp("recording")
    y, x = np.mgrid[:16, :20]
    pixels = np.stack(
        [
            np.exp(3.5 + np.sin(0.6 * (x - i)) + np.sin(0.5 * (y + 0.6 * i))).astype(np.uint8)
            for i in range(70)
        ]
    )
    frames = Video(pixels, [i * 20_000 for i in range(70)])
    sensor = PhysicalSimulator(PhysicalConfig(gamma=1.0, contrast_threshold=0.35), seed=3)
    EventStream.concat([sensor.step(frame) for frame in frames]).save(folder / "events.npz")
    np.save(folder / "frames.npy", pixels)
    return folder


def words(folder, out, *more):
    return [
        "calibrate",
        *("--frames", str(folder / "frames.npy"), "--fps", "50", "--interpolate", "none"),
        *("--events", str(folder / "events.npz"), "-o", str(out), "--seconds", "0.3", *more),
    ]


def test_calibrate_writes_a_preset_and_says_how_good_it_is(recording, tmp_path, capsys):
    out = tmp_path / "my.toml"
    assert main(words(recording, out)) == 0
    said = capsys.readouterr()
    assert said.out == f"{out}\n"
    assert "held out" in said.err
    found = resolve("simulate", {}, config=out).simulate
    assert found.contrast_threshold == pytest.approx(0.35, rel=0.25)
    assert main(words(recording, out)) == 3
    assert "exists" in capsys.readouterr().err


SMALL = SensorSize(32, 24)


@pytest.fixture(scope="module")
def scenes(tmp_path_factory):
    """A scene at rest and a flickering field of one sensor."""
    folder = tmp_path_factory.mktemp("scenes")
    noise = {"noise_curve": "128:2", "noise_scale": 1.0}
    sensor = PhysicalConfig(gamma=1.0, contrast_threshold=0.3, **noise)
    simulate_static(sensor, SMALL, 6.0, seed=1).save(folder / "rest.npz")
    simulate_flicker(sensor, SMALL, 5.0, ratio=6.0, number=6, seed=1).save(folder / "flicker.npz")
    return folder


def test_events_alone_are_measured_one_scene_after_the_other(scenes, tmp_path, capsys):
    rest, both = tmp_path / "rest.toml", tmp_path / "both.toml"
    first = ["calibrate", "--events", str(scenes / "rest.npz")]
    assert main([*first, "-o", str(rest)]) == 0
    said = capsys.readouterr()
    assert said.out == f"{rest}\n"
    assert "found noise_rate_hz" in said.err
    second = ["calibrate", "--events", str(scenes / "flicker.npz")]
    light = ["--flicker-hz", "5", "--flicker-ratio", "6", "--start-preset", str(rest)]
    pixels = tmp_path / "pixels.npz"
    more = ["--threshold-map", str(pixels), "-q"]
    assert main([*second, *light, "-o", str(both), *more]) == 0
    found = resolve("simulate", {}, config=both).simulate
    assert found.contrast_threshold == pytest.approx(0.3, rel=0.1)
    assert float(found.noise_curve.partition(":")[2]) == pytest.approx(2.0, rel=0.1)
    assert "# found contrast_threshold" in both.read_text()
    assert found.threshold_map == pixels
    assert capsys.readouterr().out.splitlines()[1] == str(pixels)
    assert read_threshold_map(pixels).on.shape == SMALL.shape
