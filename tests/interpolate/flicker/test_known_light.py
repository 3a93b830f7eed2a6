"""A lamp of known frequency is taken off source frames and put back between them."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import texvent
from texvent._registry import INTERPOLATORS
from texvent.config import InterpolateConfig
from texvent.errors import ConfigError
from texvent.interpolate.densify import densify
from texvent.interpolate.flicker.fit_reference import WINDOW_FRAMES
from texvent.interpolate.flicker.known_light import KnownLight, from_light, to_light
from texvent.interpolate.flicker.windows import can_be_seen, with_light
from texvent.transfer import Transfer
from texvent.video import Frame, Video, frame_time_us

FPS = Fraction(24)
WIDTH, HEIGHT = 48, 36


def light_at(t_us, hz, moving_texture, *, is_whole=False):
    """Linear light: a moving texture, and a lamp in a corner or over the whole image."""
    seconds = t_us / 1e6
    image = 1.0 * to_light(moving_texture(30 * seconds, width=WIDTH, height=HEIGHT), Transfer.GAMMA)
    wave = np.sin(2 * np.pi * hz * seconds)
    if is_whole:
        return 0.6 * image * (1 + 0.3 * wave)
    image[4:10, 4:10] = 120 + 80 * wave
    return image


def film(times_us, *scene, **options):
    lights = [light_at(t_us, *scene, **options) for t_us in times_us]
    return np.stack([from_light(light, Transfer.GAMMA) for light in lights])


def filmed(hz, moving_texture, number=13, **options):
    times_us = [frame_time_us(index, FPS) for index in range(number)]
    levels = film(times_us, hz, moving_texture, **options)
    return Video(levels.astype(np.uint8), times_us, FPS)


def dense(video, **options):
    config = InterpolateConfig(count="fixed", fixed_count=5, **options)
    interpolator = INTERPOLATORS.load(config.interpolate)(config, video)
    frames = densify(video, interpolator, config, balance=10.0, contrast_threshold=0.2)
    return [frame for frame in frames if not frame.is_source]


def error_of(frames, *scene, region=np.s_[:, :], **options):
    truth = film([frame.t_us for frame in frames], *scene, **options)
    shown = np.stack([frame.luma for frame in frames])
    return np.sqrt(np.mean((shown - truth)[:, *region] ** 2))


def test_a_lamp_beats_between_the_frames(moving_texture):
    video, lamp = filmed(37.0, moving_texture), np.s_[5:9, 5:9]
    assert error_of(dense(video), 37.0, moving_texture, region=lamp) > 20
    assert error_of(dense(video, lamp_hz=37.0), 37.0, moving_texture, region=lamp) < 2


def test_a_lamp_lights_all_that_moves(moving_texture):
    video = filmed(100.0, moving_texture, is_whole=True)
    blind = error_of(dense(video), 100.0, moving_texture, is_whole=True)
    assert error_of(dense(video, lamp_hz=100.0), 100.0, moving_texture, is_whole=True) < 0.4 * blind


def test_a_lamp_that_is_not_there_changes_nothing(moving_texture):
    video = filmed(37.0, moving_texture)
    with pytest.warns(texvent.TexventWarning, match="no part of the video follows a lamp of 90 Hz"):
        wrong = dense(video, lamp_hz=90.0)
    for one, other in zip(wrong, dense(video), strict=True):
        assert np.array_equal(one.luma, other.luma)


def test_source_frames_stay_as_they_are(moving_texture):
    video = filmed(37.0, moving_texture)
    assert [frame.t_us for frame, _ in with_light(video, 37.0)] == list(video.times_us)
    for (frame, light), index in zip(with_light(video, 37.0), range(13), strict=True):
        assert light is not None
        assert np.array_equal(frame.pixels, video.pixels[index])


@pytest.mark.parametrize("looks_ahead", [True, False])
def test_a_window_of_frames_slides_along(moving_texture, looks_ahead):
    read = 0

    def frames():
        nonlocal read
        for frame in filmed(37.0, moving_texture, number=40):
            read += 1
            yield frame

    most = 0
    for index, (_, light) in enumerate(with_light(frames(), 37.0, looks_ahead=looks_ahead)):
        most = max(most, read - index - 1)
        assert (light is not None) or (not looks_ahead and index < WINDOW_FRAMES)
    assert most == (WINDOW_FRAMES - 1 if looks_ahead else 0)


@given(
    level=st.floats(30.0, 200.0),
    swing=st.floats(-20.0, 20.0),
    gain=st.tuples(st.floats(-0.4, 0.4), st.floats(-0.4, 0.4)),
    t_us=st.integers(0, 2**52),
    transfer=st.sampled_from(Transfer),
)
def test_what_is_taken_off_comes_back(level, swing, gain, t_us, transfer):
    amplitude = np.array([[swing, -swing]], np.float32)
    light = KnownLight(120.0, max(0, t_us - 10**6), gain, np.array([1]), amplitude)
    frame = Frame(np.full((2, 3), max(level, 160.0), np.float32), t_us, transfer=transfer)
    (back,) = light.put_back([light.take_off(frame)])
    assert back.luma == pytest.approx(frame.luma, rel=1e-4)


def test_a_lamp_that_frames_cannot_show_is_told_once():
    with pytest.warns(texvent.TexventWarning, match="show light of 120 Hz as 0 Hz") as warnings:
        assert not can_be_seen(120.0, Fraction(24))
    assert len(warnings) == 1
    assert can_be_seen(100.0, Fraction(24))
    assert can_be_seen(120.0, None)


def test_a_lamp_makes_events(moving_texture):
    video = filmed(37.0, moving_texture)
    blind, known = (texvent.simulate(video, simulator="esim", lamp_hz=hz) for hz in (None, 37.0))

    def lamp(events):
        return int(((events.x >= 5) & (events.x < 9) & (events.y >= 5) & (events.y < 9)).sum())

    assert lamp(known) > 1.3 * lamp(blind)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"interpolate": "exact"}, "interpolate is exact"),
        ({"deflicker": True}, "deflicker removes"),
        ({"interpolate": "blend", "lamp_hz": -1.0}, "lamp_hz"),
    ],
)
def test_options_that_contradict_are_refused(options, message):
    with pytest.raises(ConfigError, match=message):
        InterpolateConfig(**{"lamp_hz": 100.0, **options})


def test_two_runs_are_the_same(moving_texture):
    video = filmed(37.0, moving_texture)
    first, second = (texvent.simulate(video, lamp_hz=37.0, seed=1) for _ in range(2))
    assert all(np.array_equal(getattr(first, one), getattr(second, one)) for one in "xytp")
