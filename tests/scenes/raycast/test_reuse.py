"""Frames of which only some tiles are drawn anew are those that are drawn whole, bit by bit."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np
import pytest

from texvent.generate.procedural import ProceduralConfig, ProceduralGenerator
from texvent.scenes.raycast.render import render, world_and_shapes
from texvent.scenes.raycast.reuse import memory as changed
from texvent.scenes.raycast.reuse.memory import Drawn, FrameMemory, changed_tiles
from texvent.scenes.scene import Environment, Float64Array, Shape
from texvent.sensor import SensorSize

from ..hand_scenes import HandScene, MovingShape, day, lamp_row, look_at, moving, still
from .test_puffs import puff

SIZE = SensorSize(128, 96)
PARTS = ("_by_time", "_by_view", "_by_sun", "_by_puffs", "_by_lamps", "_by_glows")


@dataclass(frozen=True)
class LivelyScene(HandScene):
    """A scene by hand whose surroundings change."""

    around: Callable[[float], Environment] = field(default=lambda time: day())

    def environment(self, time_s: float) -> Environment:
        return replace(self.around(time_s), time_s=time_s)


def drawn(scene, time_s: float) -> Drawn:
    return Drawn(*world_and_shapes(scene, time_s, SIZE))


def share_changed(scene, *times: float) -> float:
    """Share of tiles drawn at the last of two instants; all of them are as when all are drawn."""
    memory = FrameMemory(scene, SIZE, samples=2, shadows=True)
    for time_s in times:
        whole = render(scene, time_s, SIZE)
        np.testing.assert_array_equal(memory.render(time_s), whole)
    tiles = changed_tiles(drawn(scene, times[-2]), drawn(scene, times[-1]))
    return 1.0 if tiles is None else float(tiles.mean())


def around(
    lamps: Callable[[float], list[Float64Array]] = lambda time: [],
    puffs: Callable[[float], list[Float64Array]] = lambda time: [],
    base: Environment | None = None,
    **changes,
) -> Callable[[float], Environment]:
    base = replace(day() if base is None else base, **changes)

    def at(time: float) -> Environment:
        rows, balls = lamps(time), puffs(time)
        found = replace(base, lamps=np.concatenate(rows)) if rows else base
        return replace(found, puffs=np.array(balls)) if balls else found

    return at


def high_camera(time: float):
    return look_at((0.0, -12.0, 6.0), (0.0, 0.0, 0.5))


BOX = MovingShape(Shape.BOX, (0.4, 0.4, 0.8), still(-1.0, 0.0, 0.8))
NIGHT = replace(day(), sun_colour=np.zeros(3, np.float32), ambient=np.full(3, 0.02, np.float32))
BLOCKER = MovingShape(Shape.BOX, (0.5, 0.5, 0.5), moving((1.0, 0.0, 3.0), (0.6, 0.0, 0.0)))


def beams(time: float) -> list[Float64Array]:
    place = (3.0 - time, 1.0, 0.8)
    cosines = (np.cos(0.2), np.cos(0.4))
    return [lamp_row(place, reach=6.0, beam=(-0.8, 0.0, -0.6), cosines=cosines, casts=True)]


def lone_lamp(time: float) -> list[Float64Array]:
    return [lamp_row((0.0, 0.0, 5.0), (20.0, 20.0, 20.0), reach=30.0, casts=True)]


SCENES = {
    "_by_time": LivelyScene((BOX,), environment_base=day(), around=around(clouds=0.6)),
    "_by_view": LivelyScene((BLOCKER,), high_camera, around=around(shadows=False)),
    "_by_sun": LivelyScene((BOX, BLOCKER), high_camera),
    "_by_puffs": LivelyScene(
        (BOX,), high_camera, around=around(puffs=lambda time: [puff((time, 0.0, 1.0))])
    ),
    "_by_lamps": LivelyScene((BOX,), high_camera, around=around(beams, base=NIGHT)),
    "_by_glows": LivelyScene(
        (BOX,),
        high_camera,
        around=around(
            lambda time: [lamp_row((time, 0.0, 2.0), (0.3,) * 3, reach=0.1, glows=True)], base=NIGHT
        ),
    ),
}
"""A scene for each thing that can change."""


@pytest.mark.parametrize("part", PARTS)
def test_what_changes_is_drawn_anew_and_little_else(part):
    assert 0.0 < share_changed(SCENES[part], 0.0, 0.5, 0.52) < 0.75


@pytest.mark.parametrize("part", PARTS)
def test_a_change_that_is_missed_is_found(part, monkeypatch):
    monkeypatch.setattr(
        changed, part, lambda pair: np.zeros(pair.directions.shape[:2], dtype=np.bool_)
    )
    with pytest.raises(AssertionError, match="not equal"):
        share_changed(SCENES[part], 0.0, 0.5)


def test_a_shadow_from_a_lamp_that_stands_still_is_followed(monkeypatch):
    scene = LivelyScene(
        (BOX, BLOCKER), high_camera, around=around(lone_lamp, base=NIGHT, shadows=False)
    )
    assert 0.0 < share_changed(scene, 0.0, 0.5, 0.52) < 0.75
    monkeypatch.setattr(changed, "shaded_from_lamp", lambda lamp, casters, balls: balls.radius < -9)
    with pytest.raises(AssertionError, match="not equal"):
        share_changed(scene, 0.0, 0.5)


@pytest.mark.parametrize(
    "prompt",
    ["a red car drives left at night", "smoke rises from a house",
     "a dog walks through a city street at night", "a candle burns on a table in a dark room"],
)  # fmt: skip
def test_embedded_scenes_are_drawn_as_if_whole(prompt):
    size = SensorSize(120, 90)
    video = ProceduralGenerator(ProceduralConfig(), seed=0, size=size).generate(prompt)
    for t_us in (0, 2_000, 300_000, 304_000):
        np.testing.assert_array_equal(
            video.at(t_us).pixels, render(video.scene, t_us / 1e6, size), strict=True
        )
