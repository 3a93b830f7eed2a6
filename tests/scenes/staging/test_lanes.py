"""Traffic queues in lanes."""

from __future__ import annotations

import itertools

from tests.scenes.sentences import parse_prompt

from texvent.scenes.staging.compose import compose_scene
from texvent.scenes.staging.placement.lanes import find_lanes
from texvent.sensor import SensorSize


def test_traffic_drives_both_ways_in_two_lanes_without_touching():
    scene = compose_scene(
        parse_prompt("highway traffic at night"), seed=0, size=SensorSize(64, 48), duration_s=2.0
    )
    lanes = find_lanes(scene.actors)
    assert [len(lane) for lane in lanes] == [3, 3]
    for time_s in (0.0, 1.0, 2.0):
        for lane in lanes:
            assert len({one.middle(time_s)[1] for one in lane}) == 1
            for one, other in itertools.combinations(lane, 2):
                gap = abs(one.middle(time_s)[0] - other.middle(time_s)[0])
                assert gap > 0.5 * (one.model.length + other.model.length)
    right, left = (lane[0].middle(0.0)[1] for lane in lanes)
    assert right < left


def test_two_cars_stay_where_they_are_placed():
    scene = compose_scene(
        parse_prompt("a car drives left and a bus drives right"),
        seed=0, size=SensorSize(64, 48), duration_s=2.0,
    )  # fmt: skip
    assert all(len(lane) == 1 for lane in find_lanes(scene.actors))


def test_a_jam_stands_in_the_lanes_of_a_road_with_its_subject_amid_it():
    scene = compose_scene(
        parse_prompt("a bus stuck in traffic"), seed=0, size=SensorSize(64, 48), duration_s=2.0
    )
    right, left = find_lanes(scene.actors)
    assert len(right) + len(left) == len(scene.actors)
    bus = next(one for one in right if one.noun.name == "bus")
    along = sorted(one.middle(0.0)[0] for one in right)
    assert along[0] < bus.middle(0.0)[0] < along[-1]
    assert abs(bus.middle(2.0)[0] - bus.middle(0.0)[0]) < 0.2
    assert not scene.not_shown
