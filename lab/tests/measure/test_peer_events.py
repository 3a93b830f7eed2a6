"""Events of other programs: the frames that they are given, and the times of what they make."""

import sys
from types import SimpleNamespace

import numpy as np
import pytest

from texvent.frames import Frame
from texvent.io.files import open_events
from texvent.view.video_writer import write_clips
from texvent_lab.measure import peer_events

TIMES_US = (1_000_000, 1_010_000, 1_040_000)


@pytest.fixture
def given(monkeypatch):
    """What eventcv, which knows a rate alone, is given; it fires in the middle of each interval."""
    found = {}

    def simulate(pixels, *, fps, **_):
        found["pixels"] = pixels
        t = (np.arange(len(pixels) - 1) + 0.5) * 1e6 / fps
        rows = np.stack([0 * t, 0 * t, t, 0 * t + 1], axis=1).astype(np.uint64)
        return SimpleNamespace(numpy=lambda: rows)

    monkeypatch.setitem(sys.modules, "eventcv", SimpleNamespace(simulate=simulate))
    monkeypatch.setattr(peer_events.metadata, "version", {"eventcv": "1.2.3"}.__getitem__)
    return found


def run(monkeypatch, *arguments):
    monkeypatch.setattr(sys, "argv", ["peer_events", "eventcv", *map(str, arguments)])
    return peer_events.main()


def test_frames_go_in_grey_and_events_come_back_on_the_clock_of_uneven_frames(
    given, tmp_path, monkeypatch
):
    colours = np.random.default_rng(0).integers(0, 256, (3, 6, 8, 3)).astype(np.uint8)
    frames = [Frame(*pair) for pair in zip(colours, TIMES_US, strict=True)]
    write_clips([("clip", frames)], tmp_path / "frames", overwrite=False)
    assert run(monkeypatch, tmp_path / "frames", tmp_path / "out") == 0
    grey = np.stack([np.rint(frame.luma) for frame in frames])
    assert given["pixels"].dtype == np.uint8
    assert np.array_equal(given["pixels"], grey)
    events = open_events(tmp_path / "out" / "0.05" / "clip.h5").collect()
    assert events.size == (8, 6)
    assert events.t.tolist() == [1_005_000, 1_025_000]
    assert events.metadata["simulator"] == "eventcv"
    assert (events.metadata["version"], events.metadata["contrast_threshold"]) == ("1.2.3", 0.05)


def test_folders_without_frames_are_named_in_a_line(given, tmp_path, monkeypatch, capsys):
    (tmp_path / "empty").mkdir()
    (tmp_path / "short" / "clip").mkdir(parents=True)
    write_clips(
        [("one", [Frame(np.zeros((2, 2), np.uint8), 0)])], tmp_path / "one", overwrite=False
    )
    for name in ("none", "empty", "short", "one"):
        assert run(monkeypatch, tmp_path / name, tmp_path / "out") == 2
        (line,) = capsys.readouterr().err.splitlines()
        assert line.startswith("error: ")
        assert name in line
    assert not (tmp_path / "out").exists()


def test_noise_of_v2e_is_its_preset_at_a_rate_that_no_other_program_takes(
    given, tmp_path, monkeypatch, capsys
):
    made = []

    class EventEmulator:
        def __init__(self, **options):
            made.append(options)

        def generate_events(self, pixels, t_s):
            return np.array([[t_s, 1, 0, 1]]) if t_s else None

    monkeypatch.setitem(sys.modules, "v2ecore", SimpleNamespace())
    monkeypatch.setitem(
        sys.modules, "v2ecore.emulator", SimpleNamespace(EventEmulator=EventEmulator)
    )
    frames = [Frame(np.zeros((2, 3), np.uint8), t_us) for t_us in (0, 500_000)]
    for noise_hz in (None, 0.3):
        x, y, t_us, p = peer_events.load_v2e(noise_hz)(frames, 0.2)
        assert (x.tolist(), y.tolist(), t_us.tolist(), p.tolist()) == ([1], [0], [500_000], [1])
    assert made[0].items() < made[1].items()
    assert made[1]["shot_noise_rate_hz"] == 0.3
    assert made[1]["cutoff_hz"] == 30  # of its preset
    with pytest.raises(SystemExit):
        run(monkeypatch, tmp_path / "frames", tmp_path / "out", "--noise-hz", "1")
    assert "--noise-hz is for v2e" in capsys.readouterr().err
