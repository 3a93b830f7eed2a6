"""Gaps far beyond the usual step are found before anything is made of them."""

import itertools

import numpy as np
import pytest

import texvent
from texvent.errors import InputError, TexventWarning
from texvent.frames import Frame
from texvent.pairs.time_jump import watch_steps
from texvent.run.check import check_source

S = 1_000_000
PIXELS = np.zeros((2, 2), np.uint8)


def times_of(steps):
    return [0, *itertools.accumulate(steps)]


def watch(steps, *, is_live=False):
    frames = (Frame(PIXELS, t_us) for t_us in times_of(steps))
    return [frame.t_us for frame in watch_steps(frames, is_live=is_live)]


@pytest.mark.parametrize(
    "steps",
    [
        [33_000] * 5,
        [10 * S] * 4,  # a slide show
        [86_400 * S] * 4,  # an image a day
        [300 * S, 280 * S, 900 * S, 310 * S],
        [33_000, 33_000, 5 * S, 33_000],  # a pause
        [40 * S],
        [],
    ],
)
def test_long_steps_that_are_usual_are_no_jump(steps):
    assert watch(steps) == times_of(steps)


@pytest.mark.parametrize("steps", [[33_000] * 3 + [20 * S, 33_000], [20 * S, 33_000, 33_000]])
def test_a_pause_of_a_screen_recorder_is_warned_of(steps):
    with pytest.warns(TexventWarning, match="20 s later, far beyond"):
        assert watch(steps) == times_of(steps)


@pytest.mark.parametrize("steps", [[33_000] * 3 + [86_400 * S], [86_400 * S, 33_000], [7200 * S]])
@pytest.mark.parametrize("is_live", [False, True])
def test_a_jump_of_hours_is_refused_also_as_the_first_step(steps, is_live):
    with pytest.raises(InputError, match=r"hours; times are µs.*rate \(`fps`\).*reset\(\)"):
        watch(steps, is_live=is_live)


def test_every_way_to_simulate_and_check_finds_a_jump():
    images = np.random.default_rng(0).integers(0, 255, (6, 16, 16), np.uint8)
    times_us = times_of([33_000, 33_000, 86_400 * S, 33_000, 33_000])
    for options in ({}, {"simulator": "esim", "interpolate": "none"}):
        with pytest.raises(InputError, match=r"24\.0 hours"):
            texvent.simulate(images, t_us=times_us, **options)
    with pytest.raises(InputError, match=r"24\.0 hours"):
        texvent.simulate(texvent.Video(images, times_us))
    report = check_source(texvent.Video(images, times_us), progress=False).report
    assert "time jump" in report.remarks
    assert report.measurements["longest_jump_s"] == 86_400
    camera = texvent.EventCamera((16, 16))
    camera.step(images[0], 0)
    camera.step(images[1], 33_000)
    with pytest.warns(TexventWarning, match="noise fills the pause"):
        camera.step(images[2], 20 * S)
