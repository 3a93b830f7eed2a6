"""Motions of laboratories: flat shapes, rates, belts, occlusion, a camera with six axes."""

import math

import numpy as np
import pytest
from tests.scenes.sentences import parse_prompt

from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.compose import compose_scene
from texvent.sensor import SensorSize

DURATION_S = 1.0
TIMES = (0.0, 0.3, 0.7, 1.0)


def first_actor(prompt: str) -> Actor:
    scene = compose_scene(
        parse_prompt(prompt), seed=0, size=SensorSize(64, 48), duration_s=DURATION_S
    )
    return scene.actors[0]


@pytest.mark.parametrize(
    "prompt",
    [
        "a disc moves left and then moves right",
        "a square moves in a circle",
        "a square moves in a figure of eight",
        "a white bar rotates",
        "the letter K rotates",
        "a checkerboard moves from side to side",
        "a triangle moves up",
    ],
)
def test_a_flat_shape_faces_the_camera_all_along(prompt: str) -> None:
    path = first_actor(prompt).trajectory
    fronts = [path.at(time).to_world()[:, 0] for time in TIMES]
    np.testing.assert_allclose(fronts, [[0.0, -1.0, 0.0]] * len(TIMES), atol=1e-9)


def test_a_flat_shape_turns_clockwise_for_the_viewer() -> None:
    path = first_actor("a square rotates clockwise").trajectory
    up = path.at(0.2).to_world()[:, 2] - path.at(0.0).to_world()[:, 2]
    assert up[0] > 0.1  # its upper edge goes to the right


def test_a_round_of_a_flat_shape_stands_upright() -> None:
    actor = first_actor("a triangle moves in a circle")
    places = np.array([actor.middle(time) for time in np.linspace(0.0, DURATION_S, 9)])
    extent = np.ptp(places, axis=0)
    assert extent[1] == pytest.approx(0.0, abs=1e-9)
    assert min(extent[0], extent[2]) > 0.5


def test_what_slows_down_turns_less_in_the_end() -> None:
    path = first_actor("a square spins and slows down").trajectory
    angles = [path.at(time).roll for time in (0.0, 0.2, 0.8, 1.0)]
    assert abs(angles[1] - angles[0]) > 2.0 * abs(angles[3] - angles[2]) > 0.0


def test_what_moves_up_and_down_at_a_rate_stays_above_the_ground() -> None:
    actor = first_actor("a ball moves up and down at 2 Hz")
    heights = [actor.trajectory.at(time).position[2] for time in np.linspace(0.0, 1.0, 41)]
    assert min(heights) >= -1e-9
    turns = np.count_nonzero(np.diff(np.sign(np.diff(heights))))
    assert turns == 4


def test_a_disc_turns_the_way_that_is_said() -> None:
    turns = {
        way: first_actor(f"a dotted disc rotating {way}").trajectory.at(0.5).tempo
        for way in ("clockwise", "counterclockwise")
    }
    assert turns["clockwise"] == -turns["counterclockwise"] != 0.0


def test_what_goes_to_a_side_crosses_the_picture_of_a_camera_that_rests() -> None:
    scene = compose_scene(
        parse_prompt("a sphere accelerates to the right"),
        seed=0, size=SensorSize(64, 48), duration_s=2.0,
    )  # fmt: skip
    places = []
    for time in (0.0, 2.0):
        camera = scene.camera_path.at(time)
        seen = camera.rotation @ (scene.actors[0].middle(time) - camera.position)
        places.append(camera.focal * seen[0] / seen[2])
    assert places[1] - places[0] > 0.15
    assert math.isfinite(places[0])


def test_boxes_ride_to_the_left_on_a_belt_that_runs_to_the_left() -> None:
    actor = first_actor("boxes move from right to left on a conveyor belt")
    assert actor.middle(1.0)[0] < actor.middle(0.0)[0]


@pytest.mark.parametrize(
    "prompt", ["a dog runs behind a box", "a girl walks behind a tree and reappears"]
)
def test_what_passes_behind_something_is_seen_on_both_sides_of_it(prompt: str) -> None:
    scene = compose_scene(
        parse_prompt(prompt), seed=0, size=SensorSize(64, 48), duration_s=DURATION_S
    )
    mover, screen = scene.actors[:2]
    aside = [mover.middle(time)[0] - screen.middle(0.0)[0] for time in (0.0, 0.5, 1.0)]
    assert aside[0] * aside[2] < 0.0
    assert min(abs(aside[0]), abs(aside[2])) > 0.5 * mover.model.length
    assert mover.middle(0.5)[1] > screen.middle(0.5)[1]


def test_a_camera_with_six_degrees_of_freedom_shifts_and_rolls() -> None:
    scene = compose_scene(
        parse_prompt("6-DoF camera motion above two boxes"),
        seed=0, size=SensorSize(64, 48), duration_s=DURATION_S,
    )  # fmt: skip
    cameras = [scene.camera(time) for time in np.linspace(0.0, DURATION_S, 9)]
    shifts = np.ptp([one.position for one in cameras], axis=0)
    rolls = [one.rotation[0, 2] for one in cameras]
    assert min(shifts) > 0.02
    assert np.ptp(rolls) > 0.05


def test_a_diagonal_goes_to_a_side_and_up() -> None:
    actor = first_actor("a disc moves diagonally")
    way = actor.middle(DURATION_S) - actor.middle(0.0)
    assert min(abs(way[0]), way[2]) > 0.2
    np.testing.assert_allclose(
        actor.trajectory.at(0.5).to_world()[:, 0], [0.0, -1.0, 0.0], atol=1e-9
    )


def test_flat_shapes_stand_side_by_side() -> None:
    scene = compose_scene(
        parse_prompt("three squares move left"),
        seed=0, size=SensorSize(64, 48), duration_s=DURATION_S,
    )  # fmt: skip
    places = sorted(one.middle(0.5)[0] for one in scene.actors)
    assert min(np.diff(places)) > scene.actors[0].model.width
