"""Who goes off, onto, into, out of, through, up or down a thing does so on its shape."""

from __future__ import annotations

import pytest
from tests.scenes.sentences import parse_prompt
from texvent.scenes.staging.trajectories.legs import Leg, Legs, flight_s

from texvent.scenes.staging.compose import compose_scene
from texvent.sensor import SensorSize


@pytest.mark.parametrize(
    "prompt",
    [
        "a cat jumps off a table", "two balls roll off a table", "a cup falls off a table",
        "boxes fall off a conveyor belt", "a cat jumps onto a sofa", "a bird flies off a fence",
        "a ball rolls into a box", "a cat jumps out of a box", "a rabbit jumps out of a hat",
        "a ball rolls down a ramp", "a ball bounces down the stairs", "a dog walks up stairs",
        "a dog runs through a hoop", "a train enters a tunnel", "an apple falls from a tree",
    ],
)  # fmt: skip
def test_what_goes_over_a_thing_begins_or_ends_there(prompt: str) -> None:
    description = parse_prompt(prompt)
    scene = compose_scene(description, seed=0, size=SensorSize(64, 48), duration_s=2.0)
    assert description.not_understood == ()
    assert any(one.way or one.kind in ("from", "through") for one in description.relations)
    assert scene.not_shown == ()


def test_a_flight_is_a_parabola() -> None:
    path = Legs((0.0, 0.0, 1.0), 0.0, (Leg((1.0, 0.0, 0.0), 1.0, is_flight=True),))
    # z = 1 - t + g t (1 - t) / 2
    assert path.at(0.5).position == pytest.approx((0.5, 0.0, 0.5 + 9.81 / 8.0))
    assert path.at(2.0).position == (1.0, 0.0, 0.0)


def test_what_rolls_turns_as_far_as_it_goes() -> None:
    path = Legs((0.0, 0.0, 0.0), 0.0, (Leg((3.0, 0.0, 0.0), 1.0),), radius_m=0.5, pivot_m=0.5)
    assert path.at(1.0).pitch == pytest.approx(6.0)


def test_a_flight_lasts_as_long_as_up_and_down() -> None:
    assert flight_s(0.0, 1.0, 1.0) == pytest.approx((2.0 / 9.81) ** 0.5)


@pytest.mark.parametrize("prompt", ["two men facing each other", "a woman opposite a man"])
def test_who_face_each_other_are_turned_to_each_other(prompt: str) -> None:
    scene = compose_scene(parse_prompt(prompt), seed=0, size=SensorSize(64, 48), duration_s=2.0)
    one, other = (actor.trajectory.at(1.0) for actor in scene.actors)
    way = other.position[0] - one.position[0]
    fronts = [state.to_world()[0, 0] for state in (one, other)]
    assert fronts[0] * way > 0.0 > fronts[1] * way
