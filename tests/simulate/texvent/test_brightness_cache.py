"""The brightness cache: when each policy renews the reference, and where events move it."""

import numpy as np
import pytest

from texvent.simulate.texvent.brightness_cache import BrightnessCache
from texvent.simulate.texvent.fired_pixels import EventFrame


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
        ("global", {"reset_pairs": 2}, [1, 1, 1, 1, 5]),
        ("leaky", {"leak": 0.5}, [1, 1, 2, 2, 3.5]),
        ("leaky", {"leak": 0.5, "reset_pairs": 2}, [1, 1, 2, 2, 5]),
    ],
)
def test_reference_of_a_resting_pixel_over_frames_1_to_5(policy, options, expected):
    """Frames 1, 3 and 5 are source frames; nothing fires."""
    cache = BrightnessCache(levels(1), policy=policy, **options)
    seen = []
    for level in range(1, 6):
        seen.append(float(cache.calibrate(levels(level), is_source=level % 2 == 1)[0, 0]))
        cache.update(nothing_fired(), levels(level + 1), step=None)
    assert seen == expected


def test_eq5_only_pixels_that_fired_change_their_reference():
    fired = EventFrame(np.array([0, 2]), np.array([0.5, -0.7]), np.array([2, 3]))
    brightness = levels(0.5, 0.1, -0.7)
    to_current = BrightnessCache(levels(0, 0, 0), policy="global")
    to_current.update(fired, brightness, step=None)
    assert to_current.calibrate(brightness, is_source=False).tolist() == [[0.5, 0, -0.7]]
    by_steps = BrightnessCache(levels(0, 0, 0), policy="global")
    by_steps.update(fired, brightness, step=0.2)
    assert by_steps.calibrate(brightness, is_source=False)[0] == pytest.approx([0.4, 0, -0.6])


def test_the_cache_keeps_its_own_copy():
    first = levels(1, 2)
    cache = BrightnessCache(first, policy="local")
    reference = cache.calibrate(first, is_source=True)
    reference += 1
    assert first.tolist() == [[1, 2]]
