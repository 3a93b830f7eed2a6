"""Pixel models get linear or gamma-coded frames as they are defined for them."""

from fractions import Fraction

import numpy as np
import pytest

import texvent
from texvent.frames import Frame, MotionVectors, Video
from texvent.interpolate.flow import PairFlow
from texvent.interpolate.motion.interpolator import MotionPair
from texvent.pairs.instants import matching_levels
from texvent.pairs.scene_change import SceneChange, detect_scene_change
from texvent.transfer import Transfer, encode_srgb


def scene(place, brightest, lamp=None):
    """Texture in deep shade and a lamp, light with 1 as white.

    Both move to the right together, unless the lamp has a place of its own.
    """
    y, x = np.mgrid[:48, :64]
    shade = 0.004 + 0.02 * (np.sin((x - place) / 2.0) + np.cos(y / 3.0) + 2)
    lamp = place + 20 if lamp is None else lamp
    glare = brightest * np.exp(-((x - lamp) ** 2 + (y - 24) ** 2) / 16.0)
    return (shade + glare).astype(np.float32)


def video(count=4, brightest=30.0, highest=np.inf):
    """Linear frames, [N, H, W]."""
    light = np.stack([np.minimum(scene(2.0 * k, brightest), highest) for k in range(count)])
    times = [k * 10_000 for k in range(count)]
    return Video(255 * light, times, Fraction(100), {"transfer": "linear"})


def recoded(linear, curve):
    """The same light as frames of another coding, without its transfer."""
    return Video(curve(linear.pixels / 255), linear.times_us, linear.fps)


@pytest.mark.parametrize(
    ("simulator", "interpolate", "curve", "gamma"),
    [
        ("esim", "none", lambda light: 255 * light, {}),
        ("v2e", "none", lambda light: 255 * light, {}),
        ("physical", "none", lambda light: 255 * light, {"gamma": 1.0}),
        ("texvent", "flow", encode_srgb, {}),
    ],
)
def test_every_model_takes_linear_light_as_it_is_defined_for_it(
    simulator, interpolate, curve, gamma
):
    """As it is, without decoding it once more, or gamma-coded."""
    linear, options = video(), {"simulator": simulator, "interpolate": interpolate, "seed": 3}
    events = texvent.simulate(linear, **options)
    assert events == texvent.simulate(recoded(linear, curve), **options, **gamma)
    facts = events.metadata
    assert facts["settings"]["simulate"].get("gamma") == gamma.get("gamma")
    assert facts["source"].get("transfer") == (None if simulator == "texvent" else "linear")


def test_ordinary_levels_are_compared_as_they_are():
    for levels in (np.arange(256, dtype=np.uint8), np.linspace(0, 255, 99, dtype=np.float32)):
        assert matching_levels(levels, Transfer.GAMMA) is levels
    glare = matching_levels(np.array([254.0, 255.0, 256.0, 25_500.0]), Transfer.GAMMA)
    assert glare == pytest.approx([254, 255, 256, 255 * (1 + np.log(100))], abs=0.01)


def test_flow_is_found_in_the_shade_beside_a_lamp():
    # The lamp stands still, 10 000 times as bright as the shade that moves by 2 px.
    light = [scene(place, 300.0, lamp=12) for place in (0.0, 2.0)]

    def median_flow(transfer, gain):
        frames = [Frame(one * gain, k, transfer=transfer) for k, one in enumerate(light)]
        forward, _ = PairFlow().both_ways(*frames)
        return np.median(forward[:, 40:, 0])

    assert median_flow(Transfer.LINEAR, np.float32(255)) == pytest.approx(2.0, abs=0.2)
    # Levels in proportion to light, up to 255: the shade is flat to the search.
    assert abs(median_flow(Transfer.GAMMA, np.float32(255 / 301)) - 2.0) > 1


def test_a_cut_is_seen_in_dark_linear_frames():
    rng = np.random.default_rng(5)
    cells = [np.kron(rng.uniform(0.001, 0.08, (48, 64)), np.ones((2, 2))) for _ in range(2)]
    light = [np.float32(255 * one) for one in cells]
    linear = [Frame(one, k, transfer=Transfer.LINEAR) for k, one in enumerate(light)]
    assert detect_scene_change(*linear) is SceneChange.CUT
    assert detect_scene_change(*map(Frame, light, range(2))) is SceneChange.NONE


def test_known_motion_adds_light_up_and_stays_linear():
    motion = MotionVectors(np.zeros((48, 64, 2), np.float32), np.zeros((48, 64, 2), np.float32))
    frames = [
        Frame(one.pixels, one.t_us, motion=motion, transfer=Transfer.LINEAR) for one in video(2)
    ]
    image = MotionPair.of(frames[0], frames[0]).draw(0.5)
    assert image == pytest.approx(frames[0].pixels, rel=1e-5)
