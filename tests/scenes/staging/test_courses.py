"""Going to, from and round something, and facing it, checked copy by copy."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
from texvent.scenes.staging.claims.courses import approaches, comes_from, faces, goes_round

from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.trajectories.trajectory import Circle, Stationary, Straight, Trajectory


def actor(noun: str, path: Trajectory, instance: int = 1) -> Actor:
    model = NOUNS[noun].build(colour=None, scale=1.0, seed=0)
    return Actor(instance, NOUNS[noun], model, path, True, instance)


TREE = actor("tree", Stationary((6.0, 0.0, 0.0)), 2)


@pytest.mark.parametrize(("yaw", "is_there"), [(0.0, True), (math.pi, False), (1.57, False)])
def test_who_comes_nearer_must_look_there(yaw: float, is_there: bool) -> None:
    walker = actor("man", Straight((0.0, 0.0, 0.0), yaw, 1.4, 0.0))
    assert approaches([walker], [TREE], 2.0) is is_there


def test_who_walks_backwards_does_not_run_toward_it() -> None:
    back = actor("man", replace(Straight((0.0, 0.0, 0.0), 0.0, 1.4, 0.0), facing_rad=math.pi))
    assert not approaches([back], [TREE], 2.0)
    ball = actor("ball", back.trajectory)
    assert approaches([ball], [TREE], 2.0)


def test_one_that_stays_behind_spoils_it() -> None:
    near, away = (actor("man", Straight((x, 0.0, 0.0), yaw, 1.4, 0.0)) for x, yaw in
                  ((0.0, 0.0), (1.0, math.pi)))  # fmt: skip
    assert not approaches([near, away], [TREE], 2.0)


def test_what_comes_from_something_begins_at_it() -> None:
    walker = actor("man", Straight((7.0, -1.5, 0.0), 0.0, 1.4, 0.0))
    assert comes_from([walker], [TREE], 2.0)
    assert not comes_from([replace(walker, trajectory=Straight((15.0, 0.0, 0.0), 0.0, 1.4, 0.0))],
                          [TREE], 2.0)  # fmt: skip
    assert not comes_from([replace(walker, trajectory=Straight((9.0, 0.0, 0.0), 3.1, 1.4, 0.0))],
                          [TREE], 2.0)  # fmt: skip


def test_round_something_needs_a_way_round_or_several_sides() -> None:
    middle = (6.0, 0.0, 0.0)
    assert goes_round([actor("dog", Circle(middle, 3.0, 1.0))], [TREE], 2.0)
    assert not goes_round([actor("dog", Circle(middle, 3.0, 0.3))], [TREE], 2.0)
    ring = [actor("dog", Stationary((6.0 + 3.0 * math.cos(a), 3.0 * math.sin(a), 0.0)))
            for a in (0.0, 2.0, 4.0)]  # fmt: skip
    assert goes_round(ring, [TREE], 2.0)
    assert not goes_round(ring[:1], [TREE], 2.0)


def test_who_faces_each_other_has_the_front_to_the_other() -> None:
    one = actor("man", Stationary((0.0, 0.0, 0.0), 0.0))
    other = actor("woman", Stationary((2.0, 0.0, 0.0), math.pi), 3)
    assert faces([one], [other], 1.0)
    assert faces([other], [one], 1.0)
    assert not faces([replace(other, trajectory=Stationary((2.0, 0.0, 0.0), 0.0))], [one], 1.0)
