"""Windows of simulated clips: equal to what the simulation gives, stored once, read in parts."""

import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from texvent.dataset.simulated_samples import record_clip, target_of
from texvent.errors import ConfigError, InputError
from texvent_lab.train.reconstruction.sequences import SequenceData, WindowedClips
from texvent_lab.train.reconstruction.simulated_clips import SimulatedClips

from ..windowed_specification import SLICE_US, TEXT, write_sequence_data, write_specification

TARGETS = ("frame", "flow", "depth")


@pytest.fixture
def data(tmp_path: Path) -> SequenceData:
    return write_sequence_data(tmp_path, length=3)


@pytest.fixture(scope="module")
def clips(tmp_path_factory: pytest.TempPathFactory) -> WindowedClips:
    data = write_sequence_data(tmp_path_factory.mktemp("clips"), length=3)
    return WindowedClips.open(data, "train", TARGETS)


def stored(data: SequenceData) -> set[str]:
    assert data.cache is not None
    return {path.name for path in data.cache.iterdir()}


def test_windows_are_those_of_the_simulation(clips: WindowedClips, data: SequenceData) -> None:
    simulated = SimulatedClips(data.specification, split="train", variant="paper")
    assert len(clips) == len(simulated) == 2
    for number in range(2):
        clip = record_clip(simulated.simulation(number), SLICE_US)
        windows = clips.read(number)
        assert len(windows) == len(clip.windows) == 6
        assert windows.edges_us.tolist() == [clip.start_us, *(end for _, end in clip.windows)]
        for place, window in enumerate(clip.windows):
            assert windows.events[place].equals(clip.events.cut(*window))
            for target in TARGETS:
                np.testing.assert_array_equal(
                    windows.targets[target][place], target_of(clip, target, window)
                )
    assert sum(len(one) for one in windows.events) > 0


def test_a_part_is_that_part_of_the_whole(clips: WindowedClips) -> None:
    whole, part = clips.read(1), clips.read(1, 2, 2)
    assert all(a.equals(b) for a, b in zip(whole.events[2:4], part.events, strict=True))
    assert part.edges_us.tolist() == whole.edges_us[2:5].tolist()
    for target in TARGETS:
        np.testing.assert_array_equal(part.targets[target], whole.targets[target][2:4])


def test_a_random_run_depends_on_chance_alone_and_reaches_both_ends(clips: WindowedClips) -> None:
    starts = set()
    for seed in range(20):
        one, other = (clips.draw(0, np.random.default_rng(seed)) for _ in range(2))
        assert one.edges_us.tolist() == other.edges_us.tolist()
        assert len(one) == 3
        starts.add(int(one.edges_us[0]) // SLICE_US)
    assert starts == {0, 1, 2, 3}


@pytest.mark.long
def test_a_clip_is_simulated_once_and_a_changed_specification_anew(data: SequenceData) -> None:
    WindowedClips.open(data, "train", TARGETS)
    (first,) = stored(data)
    before = (data.cache / first).stat().st_mtime_ns
    WindowedClips.open(data, "train", reversed(TARGETS))
    assert stored(data) == {first}
    assert (data.cache / first).stat().st_mtime_ns == before
    write_specification(data.specification.parent, TEXT.replace("0.2", "0.3"))
    WindowedClips.open(data, "train", TARGETS)
    WindowedClips.open(replace(data, variant="esim"), "train", TARGETS)
    WindowedClips.open(replace(data, slice_us=10_000), "train", TARGETS)
    WindowedClips.open(data, "train", ["frame"])
    WindowedClips.open(data, "validation", TARGETS)
    assert len(stored(data)) == 6


def test_a_changed_video_is_simulated_anew(data: SequenceData, tmp_path: Path) -> None:
    video = tmp_path / "video.npy"
    frames = np.full((6, 12, 16), 200, np.uint8)
    frames[::2, 4:8] = 20
    np.save(video, frames)
    text = f'name = "v"\noptions = {{fps = 50}}\n[[sources]]\nvideos = ["{video}"]\n'
    write_specification(tmp_path, text)
    data = replace(data, variant=None, length=2)
    clips = WindowedClips.open(data, "train", TARGETS)
    assert clips.targets == ("frame",)
    assert set(clips.read(0).targets) == {"frame"}
    np.testing.assert_array_equal(clips.read(0).targets["frame"][0], frames[1])
    os.utime(video, ns=(0, 0))
    WindowedClips.open(data, "train", TARGETS)
    assert len(stored(data)) == 2


def test_short_clips_large_crops_and_wrong_names_are_refused(data: SequenceData) -> None:
    with pytest.raises(InputError, match=r"clip 0 of split train has 6 windows of 20000 µs, fewer"):
        WindowedClips.open(replace(data, length=7), "train", TARGETS)
    with pytest.raises(InputError, match="less than one slice of 200000 µs"):
        WindowedClips.open(replace(data, slice_us=200_000), "train", TARGETS)
    with pytest.raises(InputError, match=r"crop is 25 px, but .* sensor of 32x24; give at most 24"):
        WindowedClips.open(replace(data, crop=25), "train", TARGETS)
    with pytest.raises(ConfigError, match="unknown split 'test'"):
        WindowedClips.open(data, "test", TARGETS)
    with pytest.raises(ConfigError, match="length is 0"):
        replace(data, length=0)
