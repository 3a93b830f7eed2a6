"""Frames: blur is the mean of light over the exposure, rows of a rolling shutter follow in time."""

from dataclasses import replace
from fractions import Fraction
from itertools import combinations, product

import numpy as np
import pytest
from tests.scenes.hand_scenes import HandScene, MovingShape, day, look_at, moving, still

from texvent.camera import PosedCamera
from texvent.errors import ConfigError
from texvent.sensor import SensorSize
from texvent_scenes.raycast.optics import Optics
from texvent_scenes.raycast.render import PERFECT, render, render_light
from texvent_scenes.rendered_scene import Ground, Shape
from texvent_scenes.rig.config import RigConfig
from texvent_scenes.rig.shutter import (
    Shutter,
    count_instants,
    expose,
    expose_frames,
    fastest_px_s,
    frame_times_us,
    make_shutter,
)

SIZE = SensorSize(96, 64)
LEVEL = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
SPEED = 400.0
"""Of the edge, px/s: the board is 10 m away, the focal length 96 px."""


def board(light: float = 0.5) -> HandScene:
    """A bright board before a dark sky, whose left edge crosses the middle at t = 0."""
    grey, black = np.full(3, 0.1, dtype=np.float32), np.zeros(3, dtype=np.float32)
    dark = replace(
        day(Ground.NONE), sky_top=grey, sky_horizon=grey, ambient=black, sun_colour=black
    )
    place = moving((50.0, 10.0, 0.0), (SPEED * 10.0 / 96.0, 0.0, 0.0))
    shape = MovingShape(
        Shape.BOX, (50.0, 0.001, 50.0), place, colour=(light, light, light), emission=1.0
    )
    return HandScene((shape,), lambda time: PosedCamera(np.zeros(3), LEVEL, 1.0), dark)


def test_blur_of_a_moving_edge_is_a_ramp_in_linear_light() -> None:
    """20 ms at 400 px/s: 8 px. Over them, light falls linearly from the board's to the sky's."""
    shutter = Shutter(0.02, 0.0, SIZE.height)
    light = expose(board(), SIZE, shutter, 0.0, samples=2)[32, :, 1]
    sharp = render_light(board(), 0.0, SIZE)[32, :, 1]
    sky, board_light = sharp[0], sharp[-1]
    left = np.arange(SIZE.width)  # the edge goes from 44 to 52 px
    middle = np.clip((left + 0.5 - 44.0) / 8.0, 0.0, 1.0)
    share = 1.0 - (light - board_light) / (sky - board_light)
    np.testing.assert_allclose(share, middle, atol=0.02)


def test_a_short_exposure_is_one_instant_drawn_as_an_image_with_the_same_options() -> None:
    box = MovingShape(Shape.BOX, (1.0, 1.0, 1.0), moving((-1.0, 0.0, 1.0), (3.0, 0.0, 0.0)))
    zoom = look_at((0.0, -8.0, 3.0), (0.0, 0.0, 0.0))
    scene = HandScene((box,), lambda at: replace(zoom, focal=0.5 + 9.0 * at), day())
    shutter, drawn = Shutter(0.0, 0.0, SIZE.height), []
    for samples, shadows, optics in product(
        (1, 3), (False, True), (PERFECT, Optics(0.8, vignetting=True))
    ):
        options = {"samples": samples, "shadows": shadows, "optics": optics}
        (frame,) = expose_frames(scene, SIZE, shutter, [100_000], **options)
        drawn.append(render(scene, 0.1, SIZE, **options))
        np.testing.assert_allclose(frame.pixels, drawn[-1], atol=0.51)
    apart = [np.abs(one - other).max() for one, other in combinations(drawn, 2)]
    assert min(apart) > 1.0


def test_the_mean_is_of_instants_in_the_middle_of_equal_parts() -> None:
    shutter = Shutter(0.004, 0.0, 2)
    np.testing.assert_allclose(
        shutter.instants_s(4)[0], [-0.0015, -0.0005, 0.0005, 0.0015], atol=1e-12
    )
    exposed = expose(board(), SIZE, replace(shutter, height=SIZE.height), 0.0)
    count = count_instants(fastest_px_s(board(), SIZE, 0.0), 0.004)
    times = 0.004 * ((np.arange(count) + 0.5) / count - 0.5)
    mean = np.mean([render_light(board(), time, SIZE) for time in times], axis=0)
    np.testing.assert_allclose(exposed, mean, atol=1e-12)
    assert count == 3  # 1.6 px


def test_instants_grow_with_motion_up_to_a_bound() -> None:
    assert [count_instants(speed, 0.01) for speed in (0.0, 50.0, 1e3, 1e9)] == [1, 2, 11, 64]
    assert fastest_px_s(board(), SIZE, 0.0) == pytest.approx(SPEED, rel=1e-3)


def test_each_row_of_a_rolling_shutter_sees_its_own_instant() -> None:
    """Row r of the frame is row r of an image rendered at r's time, up to 1/128 px of motion."""
    shutter = make_shutter(RigConfig(frames=Fraction(30), shutter="rolling", readout=0.0126), SIZE)
    assert shutter.row_s == pytest.approx(2e-4)
    light = expose(board(), SIZE, shutter, 0.0)
    for row in (0, 1, 17, 40, 63):
        own = render_light(board(), (row - 31.5) * 2e-4, SIZE)[row]
        np.testing.assert_allclose(light[row], own, atol=0.5 / 128 + 0.5 / 64)
    edge = [np.interp(0.3, sorted(line), np.arange(96)) for line in light[..., 1]]
    slope = np.polyfit(np.arange(64), edge, 1)[0]
    assert slope == pytest.approx(SPEED * 2e-4, rel=0.05)


def test_rolling_and_exposure_together_blur_each_row_about_its_middle() -> None:
    shutter = make_shutter(
        RigConfig(frames=Fraction(30), shutter="rolling", readout=0.0126, exposure=0.01), SIZE
    )
    light = expose(board(), SIZE, shutter, 0.0)
    for row in (5, 50):
        alone = expose(board(), SIZE, Shutter(0.01, 0.0, SIZE.height), (row - 31.5) * 2e-4)[row]
        np.testing.assert_allclose(light[row], alone, atol=0.01)


def test_frames_say_when_their_rows_saw_light() -> None:
    shutter = Shutter(0.004, 1e-4, SIZE.height)
    frame, = expose_frames(
        HandScene((MovingShape(Shape.BOX, (1, 1, 1), still(0, 0, 1)),)),
        SIZE, shutter, [20_000], samples=1, shadows=False, optics=Optics(0.7),
    )  # fmt: skip
    assert frame.t_us == 20_000
    assert frame.pixels.dtype == np.uint8
    assert frame.first_row_s == pytest.approx(0.02 - 0.00515)
    assert frame.end_s == pytest.approx(0.02 + 0.00515)
    assert (frame.row_s, frame.exposure_s) == (1e-4, 0.004)


def test_only_exposures_within_the_recording_are_taken() -> None:
    fps = Fraction(10)
    assert frame_times_us(fps, Shutter(0.0, 0.0, 4), 300_000) == [0, 100_000, 200_000, 300_000]
    assert frame_times_us(fps, Shutter(0.02, 0.0, 4), 300_000) == [100_000, 200_000]
    assert frame_times_us(fps, Shutter(0.0, 0.01, 4), 310_000) == [100_000, 200_000]


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"exposure": 0.01}, "say how many"),
        ({"shutter": "rolling"}, "say how many"),
        ({"frames": Fraction(100), "exposure": 0.02}, "longer than the 0.01 s"),
        ({"frames": Fraction(200), "shutter": "rolling"}, "readout is 0.01 s, longer"),
        ({"stereo": 0.0}, "stereo is 0"),
        ({"imu": 2000.0}, r"imu is 2000; it must be 1\.\.1000"),
    ],
)
def test_options_that_do_not_go_together_are_refused(options: dict, words: str) -> None:
    with pytest.raises(ConfigError, match=words):
        RigConfig(**options)
