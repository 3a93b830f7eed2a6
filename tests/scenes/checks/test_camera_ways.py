"""Ways and turns of the camera: of each, which prepositions it shows of a body of 1 m at the
origin."""

import numpy as np
import pytest

from texvent_scenes.checks.views.camera_ways import _CAMERA_WAYS

SHARE = np.linspace(0.0, 1.0, 9)[:, None]


def straight(start, end):
    """[t, 3] Places of a camera from one to another."""
    return np.array(start) + SHARE * np.subtract(end, start)


def turned(start_deg, end_deg, radius=1.0, height=0.0):
    """[t, 3] Places on an arc; 0 is along x."""
    angle = np.radians(start_deg + SHARE[:, 0] * (end_deg - start_deg))
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), height + 0.0 * angle], axis=1)


def at_it(places):
    """[t, 3] Sight of a camera that looks at the body."""
    return -places / np.linalg.norm(places, axis=1, keepdims=True)


NEARING, CIRCLING = straight((0, -9, 1), (0, -3, 1)), turned(-90, 0, 5.0, 1.0)
STAYING, ABOVE = straight((0, -4, 1), (0, -4, 1)), straight((0, 0, 5), (0, 0, 5))
AHEAD, DOWN = straight((0, 1, 0), (0, 1, 0)), straight((0, 0, -1), (0, 0, -1))
WAYS = {
    "nears it": (NEARING, at_it(NEARING), {"towards", "to", "before", "past"}),
    "nears it and looks aside": (NEARING, straight((1, 0, 0), (1, 0, 0)), {"towards", "to"}),
    "draws back": (NEARING[::-1], at_it(NEARING[::-1]), {"away from", "before", "past"}),
    "goes by": (straight((-5, -4, 1), (5, -4, 1)), AHEAD, {"past", "around"}),
    "flies over it": (straight((-5, 0, 3), (5, 0, 3)), DOWN, {"past", "above", "around"}),
    "flies over what is beside it": (straight((-5, 2, 3), (5, 2, 3)), DOWN, {"past", "around"}),
    "flies through it": (straight((-5, 0, 0.2), (5, 0, 0.2)), AHEAD, {"around"}),
    "rises over it": (straight((-5, 0, 0.2), (5, 0, 3)), AHEAD, {"away from", "around"}),
    "sinks over it": (straight((-5, 0, 3), (5, 0, 0.2)), AHEAD, {"towards", "to", "around"}),
    "circles": (CIRCLING, at_it(CIRCLING), {"past", "before", "around"}),
    "stays": (STAYING, at_it(STAYING), {"before"}),
    "stays and looks away": (STAYING, -at_it(STAYING), set()),
    "pans over it": (STAYING, turned(60, 120), {"past", "above", "before"}),
    "stays above it": (ABOVE, DOWN, {"before", "over"}),
}


@pytest.mark.parametrize("way", WAYS)
def test_a_way_of_the_camera_shows_its_own_prepositions_alone(way):
    off, sight, expected = WAYS[way]
    assert {one for one, rule in _CAMERA_WAYS.items() if rule(off, sight, np.ones(3))} == expected
