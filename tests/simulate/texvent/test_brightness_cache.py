"""The brightness cache: when each policy renews the reference, and where events move it."""

import math

import numpy as np
import pytest

from texvent.simulate.texvent.event_frame import LEAST_SHARE, BrightnessCache, EventFrame


def levels(*values) -> np.ndarray:
    return np.array([values], np.float64)


def nothing_fired() -> EventFrame:
    return EventFrame(np.empty(0, np.int64), np.empty(0), np.empty(0, np.int64))


@pytest.mark.parametrize(
    ("policy", "options", "expected"),
    [
        ("none", {}, [1, 2, 3, 4, 5]),
        ("local", {}, [1, 1, 3, 3, 5]),
        ("global", {}, [1, 1, 1, 1, 1]),
        # Half of the way after one second.
        ("global", {"decay_hz": math.log(2)}, [1, 1, 2, 2, 3.5]),
    ],
)
def test_reference_of_a_resting_pixel_over_frames_1_to_5(policy, options, expected):
    """Frames 1, 3 and 5 are source frames, a second apart; nothing fires."""
    cache = BrightnessCache(levels(1), policy=policy, **options)
    seen = []
    for level in range(1, 6):
        reference = cache.calibrate(levels(level), 500_000 * level, is_source=level % 2 == 1)
        seen.append(float(reference[0, 0]))
        cache.update(nothing_fired(), levels(level + 1), step=None)
    assert seen == pytest.approx(expected)


def test_a_reference_decays_as_far_at_any_frame_rate():
    """1/e is left of a step of brightness after 1 / decay_hz, however many frames show it."""
    for frames in (3, 30, 480):
        cache = BrightnessCache(levels(0), policy="global", decay_hz=4.0)
        cache.calibrate(levels(0), 0, is_source=True)
        for index in range(1, frames + 1):
            t_us = round(250_000 * index / frames)
            reference = cache.calibrate(levels(1), t_us, is_source=True)
        assert reference[0, 0] == pytest.approx(1 - math.exp(-1), abs=LEAST_SHARE)


def test_eq5_only_pixels_that_fired_change_their_reference():
    fired = EventFrame(np.array([0, 2]), np.array([0.5, -0.7]), np.array([2, 3]))
    brightness = levels(0.5, 0.1, -0.7)
    to_current = BrightnessCache(levels(0, 0, 0), policy="global")
    to_current.update(fired, brightness, step=None)
    assert to_current.calibrate(brightness, 0, is_source=False).tolist() == [[0.5, 0, -0.7]]
    by_steps = BrightnessCache(levels(0, 0, 0), policy="global")
    by_steps.update(fired, brightness, step=0.2)
    assert by_steps.calibrate(brightness, 0, is_source=False)[0] == pytest.approx([0.4, 0, -0.6])
