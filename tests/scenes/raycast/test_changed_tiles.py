"""Frames of which only some tiles are drawn anew are those that are drawn whole, bit by bit."""

from dataclasses import replace

import numpy as np
import pytest

from texvent.sensor import SensorSize
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator
from texvent_scenes.raycast import changed_tiles as changed
from texvent_scenes.raycast.changed_tiles import Drawn, changed_tiles
from texvent_scenes.raycast.incremental import IncrementalRenderer
from texvent_scenes.raycast.optics import Optics
from texvent_scenes.raycast.render import render, world_and_shapes
from texvent_scenes.rendered_scene import MEDIUM_RECORD, Shape, Texture

from ..hand_scenes import HandScene, MovingShape, day, look_at, moving, still

SIZE = SensorSize(128, 96)


def drawn(scene, time_s: float) -> Drawn:
    return Drawn(*world_and_shapes(scene, time_s, SIZE))


def share_changed(scene, *times: float) -> float:
    """Share of tiles drawn at the last of two instants; all of them are as when all are drawn."""
    optics = Optics(0.7, vignetting=True)
    renderer = IncrementalRenderer(scene, SIZE, samples=2, shadows=True, optics=optics)
    for time_s in times:
        whole = render(scene, time_s, SIZE, optics=optics)
        np.testing.assert_array_equal(renderer.render(time_s)[0], whole)
    tiles = changed_tiles(drawn(scene, times[-2]), drawn(scene, times[-1]))
    return 1.0 if tiles is None else float(tiles.mean())


def high_camera(time: float):
    return look_at((0.0, -12.0, 6.0), (0.0, 0.0, 0.5))


BOX = MovingShape(Shape.BOX, (0.4, 0.4, 0.8), still(-1.0, 0.0, 0.8))
BLOCKER = MovingShape(Shape.BOX, (0.5, 0.5, 0.5), moving((1.0, 0.0, 3.0), (0.6, 0.0, 0.0)))
PANE = MovingShape(Shape.BOX, (1.2, 0.1, 1.5), still(-1.0, 1.0, 1.5), texture=Texture.PANE)
BALL = MovingShape(Shape.ELLIPSOID, (0.8,) * 3, moving((-1.5, -3.3, 1.2), (0.3, 0.0, 0.0)))
MIRROR = replace(PANE, texture=Texture.MIRROR)
DULL = replace(day(), shadows=False)


class Drifting(HandScene):
    """A scene with a puff of smoke that moves."""

    def environment(self, time_s):
        puff = np.zeros(1, MEDIUM_RECORD)
        puff["to_world"][0] = np.column_stack([0.7 * np.eye(3), (1.0 + time_s, 0.0, 1.0)])
        puff["optical_depth"], puff["colour"] = 2.0, 0.5
        return replace(super().environment(time_s), media=puff)


NO_TILES = np.zeros((6, 8), dtype=np.bool_)
SCENES = {
    "clouds": HandScene((BOX,), environment_base=replace(day(), clouds=0.6)),
    "shapes": HandScene((BLOCKER,), high_camera, environment_base=DULL),
    "shadows": HandScene((BOX, BLOCKER), high_camera),
    "mirrored": HandScene((PANE, BALL), high_camera, environment_base=DULL),
    "sharply mirrored": HandScene((MIRROR, BALL), high_camera, environment_base=DULL),
    "media": Drifting((BOX,), high_camera, environment_base=DULL),
}
"""A scene for each kind of change."""
MISSES = {
    "clouds": ("_sky_tiles", lambda instant: NO_TILES),
    "shapes": ("changed_shapes", lambda *drawn: np.zeros(0, dtype=np.int64)),
    "shadows": ("shadow_windows", lambda *drawn: []),
    "mirrored": ("mirroring_shapes", lambda *drawn: np.zeros(0, dtype=np.int64)),
    "sharply mirrored": ("mirroring_shapes", lambda *drawn: np.zeros(0, dtype=np.int64)),
    "media": ("drifting_windows", lambda *drawn: []),
}
"""Function that finds a kind of change, and one that finds none."""


@pytest.mark.parametrize("kind", SCENES)
def test_what_changes_is_drawn_anew_and_little_else(kind):
    assert 0.0 < share_changed(SCENES[kind], 0.0, 0.5, 0.52) < 0.75


WET = HandScene((), high_camera, environment_base=replace(DULL, wetness=1.0))


@pytest.mark.parametrize("scene", [*SCENES.values(), WET], ids=[*SCENES, "wet, no shape"])
def test_nothing_is_drawn_anew_where_nothing_changes(scene):
    assert share_changed(scene, 0.5, 0.5) == 0.0


@pytest.mark.parametrize("kind", SCENES)
def test_a_change_that_is_missed_is_found(kind, monkeypatch):
    monkeypatch.setattr(changed, *MISSES[kind])
    with pytest.raises(AssertionError, match="not equal"):
        share_changed(SCENES[kind], 0.0, 0.5)


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
            video.at(t_us).pixels,
            render(video.scene, t_us / 1e6, size, optics=video.optics),
            strict=True,
        )
