"""People sit around tables, stand in rows and rings, and face those they talk to."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.scenes.sentences import parse_prompt

from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.staging.compose import ComposedScene, compose_scene
from texvent.scenes.staging.placement.tables.at_table import list_places, turned_to
from texvent.sensor import SensorSize

TABLE = NOUNS["table"].build(colour=None, scale=1.0, seed=0)


def stage(prompt: str) -> ComposedScene:
    return compose_scene(parse_prompt(prompt), seed=0, size=SensorSize(173, 130), duration_s=1.0)


@pytest.mark.parametrize("count", range(1, 7))
def test_places_lie_around_the_table_and_head_for_it(count) -> None:
    """The table is 1.6 m wide across the image and 0.9 m deep."""
    places = list_places(TABLE, -0.5 * math.pi, count, 0.3)
    assert len(places) == len({(round(x, 3), round(y, 3)) for x, y, _ in places}) == count
    for x, y, yaw in places:
        assert turned_to((x, y, 0.0), yaw, np.array([0.4 * x, 0.0]))
        assert max(abs(x) / 0.8, abs(y) / 0.45) > 1.3
    near = [y for _, y, _ in places if y < -0.6]
    assert len(near) == max(0, count - 4)


def test_one_sits_behind_a_table_and_two_at_its_ends() -> None:
    ((x, y, yaw),) = list_places(TABLE, -0.5 * math.pi, 1, 0.3)
    assert (x, y, yaw) == pytest.approx((0.0, 0.75, -0.5 * math.pi))
    (left, *_), (right, *_) = list_places(TABLE, -0.5 * math.pi, 2, 0.3)
    assert (left, right) == pytest.approx((-1.1, 1.1))


@pytest.mark.parametrize(
    ("prompt", "people"),
    [
        ("four people eat at a table", 4),
        ("a woman sits at a desk and reads", 1),
        ("six friends sit around a table and talk", 6),
        ("students sit at their desks", 3),
    ],
)
def test_people_at_a_table_sit_on_chairs_and_the_relation_holds(prompt, people) -> None:
    scene = stage(prompt)
    seated = [one for one in scene.actors if one.props]
    assert len(seated) == people
    for one in seated:
        assert one.trajectory.at(0.0).activity.startswith("sit")
        assert any(prop.furniture == "chair" for prop in one.props)
    assert not [one for one in scene.not_shown if "at the" in one]


def test_who_stands_at_a_table_and_who_is_named_with_a_chair_gets_none() -> None:
    for prompt in ("a man stands at a table", "a man sits on a chair"):
        props = [prop for one in stage(prompt).actors for prop in one.props]
        assert not any(prop.furniture == "chair" for prop in props)


def test_a_row_is_straight_and_a_ring_is_round() -> None:
    for prompt in ("five chairs stand in a row", "a row of trees"):
        places = np.array([one.middle(0.0)[:2] for one in stage(prompt).actors])
        assert np.ptp(places[:, 1]) == pytest.approx(0.0)
        assert np.diff(places[:, 0]).min() > 0.3
    places = np.array([one.middle(0.0)[:2] for one in stage("children sit in a circle").actors])
    radii = np.linalg.norm(places - places.mean(axis=0), axis=1)
    assert radii == pytest.approx(radii[0])


def test_two_who_talk_are_turned_to_each_other_and_to_the_camera() -> None:
    left, right = (one.trajectory.at(0.0) for one in stage("two men talk").actors)
    assert turned_to(left.position, left.yaw, np.array(right.position))
    assert turned_to(right.position, right.yaw, np.array(left.position))
    assert left.position[1] == right.position[1]
    assert math.sin(left.yaw) < 0.0
    assert math.sin(right.yaw) < 0.0


def test_what_watches_from_a_chair_is_on_it() -> None:
    (relation,) = parse_prompt("a cat watches from a chair").relations
    assert relation.kind == "on"


def test_who_brings_a_table_works_at_the_named_one() -> None:
    description = parse_prompt("Two men play chess at a stone table")
    scene = compose_scene(description, seed=0, size=SensorSize(96, 72), duration_s=1.0)
    assert [actor.noun.name for actor in scene.actors] == ["man", "man"]


def test_a_painting_hangs_on_the_face_of_a_wall() -> None:
    painting, wall = stage("A painting hangs on a wall").actors
    low, high = (painting.corners(0.0)[:, 2].min(), painting.corners(0.0)[:, 2].max())
    assert low > 0.3
    assert high < wall.model.height
    assert stage("A painting hangs on a wall").unmet == ()
