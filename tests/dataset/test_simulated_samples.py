from itertools import pairwise

import cv2
import numpy as np
import pytest
from tests.dataset.conftest import CLIP

import texvent
from texvent.dataset.simulated_samples import SimulatedSamples
from texvent.errors import ConfigError, InputError
from texvent.represent.voxel_grid import voxel_e2vid

PROMPTS = ["a red ball flies left", "a dog runs right"]
TINY = {"sensor": "32x24", "duration": 0.125, "samples": 1, "shadows": False}
EDGES = [0, 40_000, 80_000, 120_000]


@pytest.fixture(scope="module")
def samples():
    targets = ("frame", "flow", "depth", "instance")
    return SimulatedSamples(prompts=PROMPTS, slice_us=40_000, targets=targets, simulation=TINY)


@pytest.fixture(scope="module")
def sample(samples):
    return samples.make(3)


def test_a_sample_is_what_the_api_makes_with_its_seed(samples, sample):
    assert sample["source"] == 1
    assert sample["number"] == 3
    assert sample["seed"] == samples.seed_of(3)
    events = texvent.generate(PROMPTS[1], seed=samples.seed_of(3), **TINY)
    assert len(events) > 0
    expected = [voxel_e2vid(events.between(*window)) for window in pairwise(EDGES)]
    np.testing.assert_array_equal(sample["representation"], expected)
    assert sample["stop_us"].tolist() == EDGES[1:]


def test_targets_lie_where_they_say(samples, sample):
    from texvent._registry import GENERATORS

    generator = GENERATORS.load("procedural")
    config = generator.config_type(duration=0.125, samples=1, shadows=False)
    size = texvent.SensorSize(32, 24)
    video = generator(config, seed=samples.seed_of(3), size=size).generate(PROMPTS[1])
    np.testing.assert_array_equal(sample["frame"][1], video.at(80_000).luma)
    np.testing.assert_array_equal(sample["depth"][1], video.ground_truth(80_000, 80_000).depth)
    np.testing.assert_array_equal(
        sample["instance"][1], video.ground_truth(80_000, 80_000).instance
    )
    flow = video.ground_truth(40_000, 80_000).flow
    np.testing.assert_array_equal(sample["flow"][1], np.moveaxis(flow, -1, 0))
    shapes = {name: sample[name].shape for name in ("frame", "flow", "depth", "instance")}
    assert shapes == {
        "frame": (3, 24, 32),
        "flow": (3, 2, 24, 32),
        "depth": (3, 24, 32),
        "instance": (3, 24, 32),
    }


def test_a_sample_depends_on_its_number_alone_and_passes_differ(samples):
    again = SimulatedSamples(prompts=PROMPTS, simulation=TINY, representation="event-frame")
    first, later = again.make(4), again.make(2)
    np.testing.assert_array_equal(again.make(4)["representation"], first["representation"])
    assert first["source"] == later["source"] == 0
    assert not np.array_equal(first["representation"], later["representation"])
    seeds = {SimulatedSamples(prompts=PROMPTS, seed=seed).seed_of(0) for seed in range(3)}
    assert len(seeds | {again.seed_of(number) for number in range(50)}) == 52


@pytest.mark.parametrize("slice_us", [7_000, 20_000, 30_000, 33_333, 50_000, 99_999, 100_000])
def test_videos_give_the_last_frame_of_each_slice(slice_us):
    samples = SimulatedSamples(
        videos=[CLIP],
        slice_us=slice_us,
        targets=["frame"],
        simulation={"fps": 50, "interpolate": "none"},
    )
    sample = samples.make(0)
    # Frames lie at 0, 20, .. 100 ms; a frame at the very end of a slice is its last.
    ends = range(slice_us, 100_001, slice_us)
    assert sample["stop_us"].tolist() == [*ends]
    np.testing.assert_array_equal(sample["frame"], CLIP[[end // 20_000 for end in ends]])


def test_a_folder_stands_for_the_videos_in_it(tmp_path):
    clips = [CLIP, CLIP[::-1]]
    for name, clip in zip(("left", "right"), clips, strict=True):
        (tmp_path / name).mkdir()
        np.save(tmp_path / name / "0.npy", clip)
    options = {"fps": 50, "interpolate": "none"}
    samples, given = (
        SimulatedSamples(videos=videos, simulation=options)
        for videos in ([tmp_path / "left", str(tmp_path / "right")], clips)
    )
    assert samples.count == SimulatedSamples(videos=[tmp_path]).count == 2
    for number in range(2):
        wanted = given.make(number)["representation"]
        np.testing.assert_array_equal(samples.make(number)["representation"], wanted)


def test_images_of_a_folder_are_frames_or_with_a_camera_samples(tmp_path):
    for number in range(3):
        cv2.imwrite(str(tmp_path / f"{number}.png"), np.full((24, 32), number, np.uint8))
    for options, count in (({"fps": 50}, 1), ({"camera": "shake", "duration": 0.1}, 3)):
        assert SimulatedSamples(videos=[tmp_path], simulation=options).count == count


def test_a_clip_shorter_than_a_slice_and_a_negative_number_are_refused():
    samples = SimulatedSamples(videos=[CLIP], slice_us=10**6, simulation={"fps": 50})
    with pytest.raises(InputError, match="lasts 100000 µs, less than one slice of 1000000 µs"):
        samples.make(0)
    with pytest.raises(InputError, match="sample number is -1"):
        samples.make(-1)


def test_ground_truth_of_a_recorded_video_is_refused():
    samples = SimulatedSamples(videos=[CLIP], targets=["depth"], simulation={"fps": 50})
    with pytest.raises(ConfigError, match="target 'depth' needs a source that knows its scene"):
        samples.make(0)
    with pytest.raises(ConfigError, match="'frame' of slices of events needs a source that is"):
        samples.represented(slice_events=20).with_targets("frame")
