"""The overlapped pipeline: the serial path's events, errors in their place, no thread left."""

import threading
from fractions import Fraction

import numpy as np
import pytest

from texvent._registry import INTERPOLATORS, SIMULATORS
from texvent.capture.fit_to_sensor import fit_pixels
from texvent.errors import InputError
from texvent.frames import Frame, Video, frame_time_us
from texvent.interpolate.count_policy import CountPolicy
from texvent.interpolate.pairing import pair_frames
from texvent.pairs.scene_change import SceneChange
from texvent.pipeline import fit_to_sensor, select_events, video_to_events
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
    return video_of(pixels if colour else pixels[..., 0])


def video_of(pixels):
    """25 frames per second."""
    fps = Fraction(25)
    times_us = [frame_time_us(index, fps) for index in range(len(pixels))]
    return Video(np.ascontiguousarray(pixels), times_us, fps)


def faint_clip(moving_texture):
    """A texture that moves by more pixels than its brightness changes by thresholds."""
    return video_of(np.stack([90 + moving_texture(7 * index) / 4 for index in range(3)]))


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
    ("interpolate", "simulator"),
    [("none", "texvent"), ("blend", "esim"), *(("flow", one) for one in SIMULATORS.builtin)],
)
@pytest.mark.parametrize("clip", ["colour", "grey", "faint"])
def test_events_and_frames_equal_the_serial_path(interpolate, simulator, clip, moving_texture):
    video = faint_clip(moving_texture) if clip == "faint" else moving_clip(colour=clip == "colour")
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


class Known(Video):
    """Frames of which every instant between is known too."""

    def at(self, t_us):
        share = np.interp(t_us, self.times_us, range(len(self)))
        return Frame(self.pixels[int(share)].astype(np.float32), t_us, is_source=False)

    def with_motion(self):
        return self

    def between(self, first, second, times_us):
        return map(self.at, times_us)


@pytest.mark.parametrize("kind", [Known, Video])
@pytest.mark.parametrize("options", [{}, {"deflicker": True}])
def test_what_is_known_at_any_instant_is_neither_cut_nor_steadied(kind, options):
    gains = np.array([1, 0.8, 1.1, 0.9, 2, 1.8, 2.2, 2.4])[:, None, None]
    clip = video_of((moving_clip(colour=False).pixels[:1] * 0.4 * gains).astype(np.uint8))
    interpolate = "motion" if kind is Known else "blend"
    settings = resolve("simulate", {"interpolate": interpolate, **options})
    changes = []
    video = kind(clip.pixels, clip.times_us)
    steps = video_to_events(video, settings).steps(lambda *change: changes.append(change))
    found = np.stack([frame.pixels for frame, _ in steps if frame.is_source])
    is_known = kind is Known
    assert (changes == []) is (is_known or bool(options))
    assert np.array_equal(found, clip.pixels) is (is_known or not options)


@pytest.mark.parametrize("first_step_us", [40_000, 20_000_000])
def test_a_live_source_is_read_only_when_its_next_frame_is_asked_for(first_step_us):
    read = []

    class Live(Video):
        is_live = True

        def __iter__(self):
            for frame in super().__iter__():
                read.append(frame.t_us)
                yield frame

    video = moving_clip()
    times_us = (0, *(t_us - 40_000 + first_step_us for t_us in video.times_us[1:]))
    settings = resolve("simulate", {"interpolate": "none", "preset": "paper"})
    for frame, _ in video_to_events(Live(video.pixels, times_us), settings).steps():
        assert read[-1] == frame.t_us


@pytest.mark.parametrize("fit", ["cover", "contain", "stretch"])
@pytest.mark.parametrize("sensor", ["20x16", "48x40"])
def test_a_video_that_is_made_is_fitted_as_its_options_say(fit, sensor):
    video = moving_clip(2)
    settings = resolve("simulate", {"sensor": sensor, "fit": fit})
    for frame, fitted in zip(video, fit_to_sensor(video, settings), strict=True):
        assert np.array_equal(fitted.pixels, fit_pixels(frame.pixels, settings.size, fit))


def threads_of_the_pipeline():
    return [one for one in threading.enumerate() if one.name.startswith("texvent-prefetch")]
