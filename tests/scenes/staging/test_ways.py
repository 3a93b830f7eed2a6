"""Ways through, between, around and past: what the swept path shows, and what the image holds."""

import numpy as np
import pytest
from tests.scenes.staged import DURATION_S, SIZE, box, in_image, moved, stage_text
from tests.scenes.staging.test_containers import lost_relations
from tests.scenes.test_short_prompts import is_right, staged

from texvent_scenes.checks.in_view import find_unseen

TIMES_S = np.linspace(0.0, DURATION_S, 9)


@pytest.mark.parametrize(
    ("text", "shift"),
    [("a bus drives through a tunnel", (5.0, 0, 0)), ("a dog runs through a tunnel", (2.5, 0, 0)),
     ("a man rides a bicycle through a tunnel", (0, -40.0, 0))],
)  # fmt: skip
def test_who_goes_through_a_tunnel_keeps_clear_of_its_walls_and_is_seen_to_come_out(text, shift):
    said, scene = stage_text(text)
    assert lost_relations(said, scene) == []
    goer, tunnel = scene.actors[0], scene.actors[-1]
    (low, _), (least, _) = box(goer, DURATION_S), box(tunnel, 0.0)
    assert low[1] < least[1]  # it has come out, on the camera's side
    inside = in_image(scene, tunnel, 1.0)
    assert ((inside > -0.05) & (inside < 1.05)).all()
    assert "through" in lost_relations(said, moved(scene, tunnel, shift))


@pytest.mark.parametrize(
    "text", ["a dog runs between two trees", "a boy walks between two parked cars"]
)
def test_who_goes_between_two_things_crosses_the_line_between_them(text):
    said, scene = stage_text(text)
    goer, first, second = scene.actors
    assert lost_relations(said, scene) == []
    way = (second.middle(0.0) - first.middle(0.0))[:2]
    off = np.array([goer.middle(t) - first.middle(0.0) for t in TIMES_S])[:, :2]
    sides = np.sign(off @ [-way[1], way[0]])
    assert set(sides) >= {-1.0, 1.0}
    seen = find_unseen(scene, said, SIZE, DURATION_S)
    assert (seen.out_of_view, [one.line for one in seen.violations]) == ((), [])
    assert lost_relations(said, moved(scene, goer, 2.0 * np.array([*way, 0.0]))) != []


@pytest.mark.parametrize(
    "text", ["a girl runs around a tree", "a dog runs around a man", "a bee flies around a flower"]
)
def test_who_goes_around_something_is_on_all_sides_of_it(text):
    said, scene = stage_text(text)
    assert lost_relations(said, scene) == []
    goer, middle = scene.actors
    off = np.array([goer.middle(t) - middle.middle(t) for t in TIMES_S])
    angles = np.unwrap(np.arctan2(off[:, 1], off[:, 0]))
    assert np.ptp(angles) > np.pi
    assert lost_relations(said, moved(scene, middle, (30.0, 0, 0))) == ["around"]


@pytest.mark.parametrize("text", ["a man walks out of a house", "a dog runs out of a house"])
def test_who_comes_out_of_a_house_starts_in_it_and_comes_nearer(text):
    said, scene = stage_text(text)
    assert lost_relations(said, scene) == []
    one, house = scene.actors
    (low, high), start = box(house, 0.0), one.middle(0.0)
    assert (low < start).all()
    assert (start < high).all()
    ways = [np.linalg.norm(one.middle(t) - scene.camera(t).position) for t in TIMES_S]
    assert (np.diff(ways) < 1e-9).all()
    assert ways[-1] < ways[0] - 1.0


@pytest.mark.parametrize("text", ["a row of parked cars", "two parked cars", "five parked trucks",
                                  "a row of trees", "a row of houses", "six ducks in a row",
                                  "three men stand in a line"])  # fmt: skip
def test_rows_and_parked_vehicles_stand_on_a_line_at_even_gaps(text):
    actors = stage_text(text)[1].actors
    places = np.array([one.middle(0.0)[:2] for one in actors])
    reach = max(actors[0].model.width, actors[0].model.length)
    assert np.ptp(places[:, 1]) < 0.3 * reach
    gaps = np.diff(np.sort(places[:, 0]))
    assert gaps.min() > 0.8 * reach
    assert gaps.max() < 1.3 * gaps.min()


@pytest.mark.parametrize(
    "text",
    ["a white square moves diagonally", "a bird flies diagonally",
     "a dog runs diagonally across a field"],
)  # fmt: skip
def test_what_goes_diagonally_goes_along_two_axes_of_the_picture(text):
    actor = staged(text)[0].actors[0]
    way = np.sort(np.abs(actor.middle(2.0) - actor.middle(0.0)))
    assert way[1] > 0.3 * way[2] > way[0] - 1e-6
    assert is_right(text)


@pytest.mark.parametrize(
    "text",
    ["a toy train going around a circular track", "a toy train on a round track",
     "a toy train drives along a loop of track"],
)  # fmt: skip
def test_what_goes_round_on_a_track_keeps_to_it_and_is_nearest_at_half_time(text):
    train, track = staged(text)[0].actors
    way = np.array([train.middle(at) - track.middle(0.0) for at in np.linspace(0.0, 2.0, 9)])
    np.testing.assert_allclose(np.linalg.norm(way[:, :2], axis=1), 0.55, atol=1e-6)
    np.testing.assert_allclose(way[4, 0], 0.0, atol=1e-6)
    assert way[4, 1] < 0.0
    assert is_right(text)
