import numpy as np
import pytest

from texvent.cli.app import main
from texvent.events import EventStream
from texvent.run.settings import resolve
from texvent.simulate.physical.config import PhysicalConfig
from texvent.simulate.physical.simulator import PhysicalSimulator
from texvent.video import Video


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


@pytest.mark.parametrize(
    ("more", "message"),
    [
        (("--start-preset", "davis34"), "did you mean 'davis346'"),
        (("--seconds", "0"), "seconds"),
        (("--events", "nowhere.npz"), "no such file"),
        (("--frames-gamma", "-1"), "gamma"),
    ],
)
def test_calibrate_refuses_in_one_line(recording, tmp_path, capsys, more, message):
    assert main(words(recording, tmp_path / "x.toml", *more)) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1
    assert not (tmp_path / "x.toml").exists()
