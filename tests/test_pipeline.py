"""The overlapped pipeline: the serial path's events, errors in their place, no thread left."""

import threading
from fractions import Fraction

import numpy as np
import pytest

from texvent._registry import INTERPOLATORS, SIMULATORS
from texvent.errors import InputError
from texvent.frames import Video, frame_time_us
from texvent.interpolate.count_policy import CountPolicy
from texvent.interpolate.pairing import pair_frames
from texvent.pairs.scene_change import SceneChange
from texvent.pipeline import select_events, video_to_events
from texvent.settings.resolution import resolve
from texvent.simulation.build import benefits_from_denser_frames


def moving_clip(count=8, *, height=40, width=48, colour=True):
    """A textured square that moves over noise, with a flash in the middle."""
    rng = np.random.default_rng(3)
    background = rng.integers(60, 90, (2, height, width, 3))
    pixels = np.empty((count, height, width, 3), np.uint8)
    for index in range(count):
        pixels[index] = background[index * 2 // count] + 60 * (index * 2 // count)
        pixels[index, 10:26, 4 + 2 * index : 20 + 2 * index] = rng.integers(150, 255, (16, 16, 3))
    fps = Fraction(25)
    chosen = pixels if colour else pixels[..., 0]
    return Video(np.ascontiguousarray(chosen), [frame_time_us(i, fps) for i in range(count)], fps)


def serial_steps(video, settings):
    """The definition: one frame after the other, in one thread."""
    run, config = settings.run, settings.interpolate
    simulator = SIMULATORS.load(run.simulator)(settings.simulate, seed=run.seed)
    interpolator = INTERPOLATORS.load(config.interpolate)(config, video)
    policy = CountPolicy(
        config,
        video,
        interpolator,
        balance=simulator.balance,
        contrast_threshold=simulator.contrast_threshold,
        counts_motion=benefits_from_denser_frames(simulator),
    )
    pairs = pair_frames(video, interpolator, config, policy)
    dense = (frame for pair in pairs for frame in pair.frames)
    return [(frame, select_events(simulator.step(frame), run)) for frame in dense]


@pytest.mark.parametrize(
    ("interpolate", "simulator", "colour"),
    [("none", "texvent", True), ("blend", "esim", False), ("flow", "texvent", False)],
)
def test_events_and_frames_equal_the_serial_path(interpolate, simulator, colour):
    video = moving_clip(colour=colour)
    settings = resolve("simulate", {"interpolate": interpolate, "simulator": simulator, "seed": 5})
    steps = list(video_to_events(video, settings).steps())
    expected = serial_steps(video, settings)
    assert len(steps) == len(expected)
    for (frame, packet), (frame_alone, packet_alone) in zip(steps, expected, strict=True):
        assert (frame.t_us, frame.is_source) == (frame_alone.t_us, frame_alone.is_source)
        np.testing.assert_array_equal(frame.pixels, frame_alone.pixels)
        for name, column in packet_alone.columns().items():
            np.testing.assert_array_equal(packet.columns()[name], column)


def test_scene_changes_are_told_in_the_readers_thread_before_the_frames_that_show_them():
    settings = resolve("simulate", {"interpolate": "blend"})
    video, seen = moving_clip(), []

    def note(change, t_us):
        seen.append((change, t_us, threading.current_thread()))

    for frame, _ in video_to_events(video, settings).steps(note):
        if frame.is_source:
            assert len(seen) == (frame.t_us >= video.times_us[4])
    assert seen == [(SceneChange.FLASH, video.times_us[4], threading.main_thread())]


def test_a_source_that_breaks_gives_its_events_first_and_leaves_no_thread():
    class Broken(Video):
        def __iter__(self):
            yield self[0]
            yield self[1]
            raise InputError("the third frame is damaged")

    whole = moving_clip()
    settings = resolve("simulate", {"interpolate": "none"})
    steps = video_to_events(Broken(whole.pixels, whole.times_us), settings).steps()
    assert [next(steps)[0].t_us, next(steps)[0].t_us] == list(whole.times_us[:2])
    with pytest.raises(InputError, match="the third frame is damaged"):
        next(steps)
    assert not threads_of_the_pipeline()


def test_a_reader_that_stops_leaves_no_thread_and_closes_the_source():
    closed = []

    class Watched(Video):
        def __iter__(self):
            try:
                yield from super().__iter__()
            finally:
                closed.append(True)

    video = moving_clip()
    settings = resolve("simulate", {"interpolate": "flow"})
    steps = video_to_events(Watched(video.pixels, video.times_us), settings).steps()
    next(steps)
    assert threads_of_the_pipeline()
    steps.close()
    assert closed == [True]
    assert not threads_of_the_pipeline()


def test_a_live_source_is_read_only_when_its_next_frame_is_asked_for():
    read = []

    class Live(Video):
        is_live = True

        def __iter__(self):
            for frame in super().__iter__():
                read.append(frame.t_us)
                yield frame

    video = moving_clip()
    settings = resolve("simulate", {"interpolate": "none"})
    for frame, _ in video_to_events(Live(video.pixels, video.times_us), settings).steps():
        assert read[-1] == frame.t_us


def threads_of_the_pipeline():
    return [one for one in threading.enumerate() if one.name.startswith("texvent-prefetch")]
