"""Events that other programs made of the clips, and frames that are written for them."""

import json
import shutil

import cv2
import numpy as np
import pytest

import texvent
from texvent.errors import InputError
from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent_lab.bench.objects.clips import at_frames
from texvent_lab.commands.bench.bench import run

from .stand_in import write_frames, write_specifications, write_turntables

SIZE = SensorSize(128, 128)
THRESHOLDS = (0.1, 0.4)


@pytest.fixture
def words(tmp_path):
    """The command on a stand-in of the recordings, in a folder of its own."""
    write_specifications(tmp_path / "configs")
    write_frames(tmp_path / "recorded")
    write_turntables(tmp_path / "turntables")
    words = ["objects", str(tmp_path / "configs"), "--frames", str(tmp_path / "recorded")]
    words += ["--turntables", str(tmp_path / "turntables"), "--work", str(tmp_path / "work")]
    return [*words, "--steps", "2", "--seeds", "1", "--quiet"]


def simulate_all(frames, folder):
    """An event file per clip and threshold, of the frames that were written."""
    for threshold in THRESHOLDS:
        (folder / str(threshold)).mkdir(parents=True)
        for clip in sorted(frames.iterdir()):
            options = {"simulator": "esim", "contrast_threshold": threshold, "interpolate": "none"}
            events = texvent.simulate(str(clip), **options)
            events.save(folder / str(threshold) / f"{clip.name}.h5")


def test_events_are_moved_to_the_next_frame(tmp_path):
    times_us = np.array([0, 20_000, 50_000])
    np.savez(tmp_path / "a.npz", luma=np.zeros((3, 128, 128), np.float16), t_us=times_us)
    t = [1, 20_000, 20_001, 49_999, 50_001]
    events = EventStream([1, 2, 3, 4, 5], [6] * 5, t, [0, 1, 0, 1, 0], SIZE)
    late = at_frames(tmp_path / "a.npz", events)
    assert late.t.tolist() == [20_000, 20_000, 50_000, 50_000, 50_000]
    assert late.x.tolist() == [1, 2, 3, 4, 5]
    assert late.p.tolist() == events.p.tolist()


@pytest.mark.long
@pytest.mark.usefixtures("networks")
def test_events_of_another_program_are_an_arm_at_the_threshold_that_fits(words, tmp_path, capsys):
    run([*words, "--write-frames", str(tmp_path / "frames")])
    clips = sorted(one.name for one in (tmp_path / "frames").iterdir())
    assert [name.partition("-")[0] for name in clips] == ["table"] * 2 + ["turntable"] * 2
    assert "4 folders of frames" in capsys.readouterr().out
    images = sorted((tmp_path / "frames" / clips[0]).glob("*.png"))
    assert len(images) == 9
    assert cv2.imread(str(images[0]), cv2.IMREAD_UNCHANGED).shape[:2] == (128, 128)

    simulate_all(tmp_path / "frames", tmp_path / "events")
    given = f"Mine={tmp_path / 'events'}"
    run([*words, "--arms", "texvent", "--events", given, "-o", str(tmp_path / "a.json")])
    document = json.loads((tmp_path / "a.json").read_text())
    for test in ("table", "turntable"):
        rows = {one["arm"]: one for one in document[test]}
        assert list(rows)[:2] == ["texvent", "Mine"]
        assert rows["Mine"]["windows"]["windows"] == rows["texvent"]["windows"]["windows"]
        assert len(rows["Mine"]["difference"]) == 3

    # Each threshold alone: the one that was taken comes closer to the recorded share.
    shares = {}
    for threshold in THRESHOLDS:
        one = f"Mine={tmp_path / 'events' / str(threshold)}"
        run([*words, "--arms", "texvent", "--events", one, "-o", str(tmp_path / f"{threshold}")])
        alone = json.loads((tmp_path / f"{threshold}").read_text())["turntable"][1]["windows"]
        assert alone["threshold"] is None
        shares[threshold] = alone["share"]
    target = document["protocol"]["recorded share of pixels with an event"]["turntable"]
    chosen = document["turntable"][1]["windows"]
    assert chosen["share"] == shares[chosen["threshold"]]
    assert chosen["threshold"] == min(shares, key=lambda one: abs(shares[one] - target))


@pytest.mark.usefixtures("networks")
def test_files_that_are_not_of_the_clips_are_refused_before_any_work(words, tmp_path):
    run([*words, "--write-frames", str(tmp_path / "frames")])
    folder = tmp_path / "events"
    folder.mkdir()
    clips = sorted(one.name for one in (tmp_path / "frames").iterdir())
    for name in clips:
        EventStream([1, 2], [3, 4], [5, 399_999], [0, 1], SIZE).save(folder / f"{name}.h5")
    shutil.rmtree(tmp_path / "work")
    wrong = {
        "is 64x64|128x128": EventStream([1], [3], [5], [0], SensorSize(64, 64)),
        "from 0 to 400000 µs": EventStream([1, 2], [3, 4], [5, 500_000], [0, 1], SIZE),
    }
    for message, events in wrong.items():
        events.save(folder / f"{clips[0]}.h5", overwrite=True)
        with pytest.raises(InputError, match=message):
            run([*words, "--events", f"Mine={folder}"])
    (folder / f"{clips[0]}.h5").unlink()
    with pytest.raises(InputError, match=rf"not one event file each of {clips[0]}"):
        run([*words, "--events", f"Mine={folder}"])
    assert not (tmp_path / "work").exists()
