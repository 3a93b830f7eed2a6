"""Recordings as clips: windows from frame to frame, alone or beside simulated ones."""

import itertools
from pathlib import Path

import numpy as np
import pytest

from texvent.errors import InputError
from texvent_lab.frame_recordings import open_recording
from texvent_lab.train.reconstruction.recorded_clips import ExtendedClips, RecordedClips
from texvent_lab.train.reconstruction.recorded_clips import (
    write_recording as write_recording_of_windows,
)
from texvent_lab.train.reconstruction.sequences import SequenceData, WindowedClips, read_clip

from ...bench.reconstruction.synthetic_network import moving_bar, write_recording
from ..windowed_specification import write_sequence_data

FRAMES, LENGTH = 26, 6


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_recording(tmp_path_factory.mktemp("made") / "bar", moving_bar(frames=FRAMES))


@pytest.fixture
def data(recording: Path, tmp_path: Path) -> SequenceData:
    return SequenceData(recordings=(str(recording),), length=LENGTH, cache=tmp_path / "cache")


def test_a_window_holds_the_events_between_two_frames_and_the_second_one(data, recording):
    found = RecordedClips.open(data, "train").read(0, 0, 25)
    true = open_recording(recording)
    frames, events = list(true.frames), true.events.collect()
    assert found.edges_us.tolist() == [frame.t_us for frame in frames]
    for number, part in enumerate(found.events):
        assert part.equals(events.cut(frames[number].t_us, frames[number + 1].t_us))
        np.testing.assert_array_equal(found.targets["frame"][number], frames[number + 1].luma)


@pytest.mark.parametrize("offset_us", [0, 700, -9_000])
def test_frames_are_moved_by_their_offset_and_events_are_not(recording, tmp_path, offset_us):
    true = open_recording(recording)
    write_recording_of_windows(tmp_path / "one.h5", true, offset_us)
    found, events = read_clip(tmp_path / "one.h5", 0, 25, []), true.events.collect()
    edges = [frame.t_us + offset_us for frame in true.frames]
    assert found.edges_us.tolist() == edges
    for part, (start_us, stop_us) in zip(found.events, itertools.pairwise(edges), strict=True):
        assert part.equals(events.cut(start_us, stop_us))


def test_four_fifths_are_runs_to_train_on_and_the_rest_is_scored(data):
    trained = RecordedClips.open(data, "train")
    scored = RecordedClips.open(data, "validation")
    edges = [trained.read(number, 0, LENGTH).edges_us for number in range(len(trained))]
    assert len(edges) == 3
    assert all(a[-1] == b[0] for a, b in itertools.pairwise(edges))
    (rest,) = [scored.read(number) for number in range(len(scored))]
    assert edges[-1][-1] <= rest.edges_us[0]
    assert len(rest) == FRAMES - 1 - 20
    assert trained.draw(1, np.random.default_rng(0)).edges_us.tolist() == edges[1].tolist()
    drawn = {tuple(trained.draw(1, np.random.default_rng(seed), LENGTH - 2).edges_us.tolist())
             for seed in range(40)}  # fmt: skip
    assert drawn == {tuple(edges[1][first : first + LENGTH - 1].tolist()) for first in range(3)}


def test_a_recording_is_copied_once_and_again_when_it_changes(data, recording):
    first = RecordedClips.open(data, "train")
    (path,) = first.files
    before = path.stat().st_mtime_ns
    assert RecordedClips.open(data, "validation").files == [path]
    assert path.stat().st_mtime_ns == before
    (recording / "more.txt").touch()
    assert RecordedClips.open(data, "train").identity != first.identity
    (recording / "more.txt").unlink()


def test_simulated_clips_follow_the_recorded_ones(data, tmp_path):
    clips = RecordedClips.open(data, "train")
    more = WindowedClips.open(write_sequence_data(tmp_path, LENGTH), "train", ["frame"])
    both = ExtendedClips(clips, more, 2)
    assert len(both) == len(clips) + 2
    assert both.identity not in (clips.identity, more.identity)
    for number, true in ((1, clips.read(1, 0, 2)), (4, more.read(1, 0, 2))):
        found = both.read(number, 0, 2)
        assert found.edges_us.tolist() == true.edges_us.tolist()
        assert all(a.equals(b) for a, b in zip(found.events, true.events, strict=True))


def test_recordings_that_are_too_short_or_small_are_refused(data, recording, tmp_path):
    given = {"recordings": (str(recording),), "cache": tmp_path}
    with pytest.raises(InputError, match="no run of 40 frames to train on; make length smaller"):
        RecordedClips.open(SequenceData(length=40, **given), "train")
    with pytest.raises(InputError, match="crop is 16 px, but the sensor has 16x12"):
        RecordedClips.open(SequenceData(length=6, crop=16, **given), "train")
