"""What is shown is where it is in the world: on asphalt, on a deck, on land, before the sky."""

from dataclasses import replace

import numpy as np
import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import stage_text

from texvent_scenes.checks.surroundings.placement import find_misplaced
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.scene_input import list_nouns, understand
from texvent_scenes.staging.surroundings.road_line import RoadLine

TIMES = np.linspace(0.0, 2.0, 21)
DRIVEN = ["car", "bus", "motorcycle", "truck", "van", "cyclist", "tractor"]


@for_every(DRIVEN)
def test_vehicles_that_turn_at_a_crossing_stay_on_its_roads_and_apart(noun):
    plural = (*NOUNS[noun].plurals, f"{noun}s")[0]
    _, scene = stage_text(f"three {plural} turning at an intersection")
    if len(scene.actors) < 3:
        return  # its plural is another one
    base = scene.environment(0.0)
    x, y = map(float, base.road_offset)
    road = RoadLine(base.road_angle, (x, y), tuple(map(tuple, base.road_crossings)))
    half_m = float(base.road_half_width)
    ways = np.array([[one.middle(float(at))[:2] for at in TIMES] for one in scene.actors])
    off_m = road.distance(ways.reshape(-1, 2)) - half_m
    assert off_m.max() < 0.4
    for first, second in ((0, 1), (0, 2), (1, 2)):
        gaps = np.linalg.norm(ways[first] - ways[second], axis=1)
        assert gaps.min() > 0.9 * scene.actors[0].model.width


@for_every([(who, bridge) for who in ("train", "car", "bus", "cyclist", "woman", "truck", "horse")
            for bridge in ("bridge", "stone bridge")])  # fmt: skip
def test_a_bridge_is_as_long_as_the_way_over_it(row):
    who, bridge = row
    _, scene = stage_text(f"a {who} goes over a {bridge}")
    actor, below = scene.actors[0], scene.actors[1]
    assert below.noun.name in nouns_with("has approaches")
    low, high = below.corners(0.0).min(axis=0), below.corners(0.0).max(axis=0)
    for at in TIMES:
        corners = actor.corners(float(at))
        assert (corners[:, :2] > low[:2] - 0.3).all()
        assert (corners[:, :2] < high[:2] + 0.3).all()
        assert abs(actor.lowest_m(float(at)) - actor.lowest_m(0.0)) < 0.3


def test_what_hangs_over_the_end_of_a_bridge_is_told():
    description, scene = stage_text("a train goes over a bridge")
    train, bridge = scene.actors
    short = replace(bridge, model=bridge.model.inner)
    surroundings = scene.environment(0.0)

    def faults(bodies):
        return [*find_misplaced(description, scene.place, surroundings, bodies, [0.0, 1.0, 2.0])]

    assert not [one for one in faults([train, bridge]) if one.kind == "support"]
    assert [one for one in faults([train, short]) if one.kind == "support"]


@pytest.mark.parametrize(("prompt", "place"), [
    ("kids building a sandcastle while the waves come in", "beach"),
    ("a dog runs while big waves roll in", "beach"),
    ("a mother teaches her son to swim", "beach"),
    ("a man swims while waves roll in", "sea"),
    ("a boat in big waves", "sea"),
    ("a drone hovering against a cloudy sky", "sky"),
    ("a palm tree against the sunset", "desert"),
])  # fmt: skip
def test_places_suit_what_is_there(prompt, place):
    assert understand(prompt, list_nouns()).place.name == place


@for_every(["thunderstorm", "lightning", "lightning storm"])
def test_lightning_comes_from_clouds_without_stars(word):
    _, scene = stage_text(f"{word} over a field")
    surroundings = scene.environment(0.0)
    assert surroundings.clouds > 0.9
    assert not surroundings.has_stars


@for_every(["the drone moves forward", "the drone follows it", "the drone circles it"])
def test_a_drone_that_films_is_not_in_the_picture(words):
    _, scene = stage_text(f"aerial view of a car on a road, {words}")
    assert "drone" not in {one.noun.name for one in scene.actors}
    assert scene.camera(1.0).position[2] > 3.0
