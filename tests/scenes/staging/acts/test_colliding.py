"""Bodies that collide: they touch at one instant, and what is fixed stays."""

import numpy as np
import pytest

from texvent.scenes.description import ObjectMotion, Relation, SceneDescription, SceneObject
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.striking import contact_time
from texvent.scenes.staging.body_boxes import gap, part_boxes
from texvent.scenes.staging.compose import compose_scene
from texvent.sensor import SensorSize

DURATION_S = 2.0


def stage(*objects: SceneObject, target: int) -> tuple[Actor, ...]:
    acts = (Relation("collide", 0, (target,)),)
    description = SceneDescription("hand-built", objects, acts)
    return compose_scene(description, seed=0, size=SensorSize(96, 72), duration_s=DURATION_S).actors


def middle(actor: Actor, time_s: float) -> np.ndarray:
    lift = 0.0 if actor.is_centred else 0.5 * actor.model.height
    return actor.trajectory.at(time_s).to_world() @ np.array([0.0, 0.0, lift, 1.0])


def apart(actors: tuple[Actor, ...], time_s: float) -> float:
    return gap(part_boxes(actors[0], time_s), part_boxes(actors[1], time_s))


@pytest.mark.parametrize(
    ("nouns", "moves"),
    [(("car", "car"), (True, True)), (("ball", "box"), (True, False)),
     (("tree", "car"), (False, True))],
)  # fmt: skip
def test_bodies_that_collide_touch_at_one_instant(
    nouns: tuple[str, str], moves: tuple[bool, bool]
) -> None:
    actors = stage(*(SceneObject(noun) for noun in nouns), target=1)
    contact_s = contact_time(DURATION_S, 0.5)

    mover = next(actor for actor in actors if actor.noun.habitat != "fixed")
    assert apart(actors, 0.0) > 0.5 * min(actor.model.length for actor in actors)
    assert apart(actors, contact_s) == pytest.approx(0.0, abs=0.15 * mover.model.length)
    assert apart(actors, contact_s - 0.2) > 0.0
    way = [float(np.linalg.norm(middle(actors[0], t) - middle(actors[1], t)))
           for t in np.linspace(0.0, DURATION_S, 41)]  # fmt: skip
    assert min(way) > 0.75 * float(
        np.linalg.norm(middle(actors[0], contact_s) - middle(actors[1], contact_s))
    )
    gone = [
        float(np.linalg.norm(middle(actor, contact_s) - middle(actor, 0.0))) for actor in actors
    ]
    assert tuple(way > 0.1 for way in gone) == moves


def test_a_front_is_turned_to_what_comes_and_an_arrow_stays_in_it() -> None:
    arrow, target = stage(SceneObject("arrow"), SceneObject("wall"), target=1)
    contact_s = contact_time(DURATION_S, 0.5)
    assert apart((arrow, target), 0.0) > arrow.model.length
    assert apart((arrow, target), contact_s + 0.1) == 0.0
    end = arrow.trajectory.at(contact_s + 0.1)
    assert arrow.trajectory.at(DURATION_S).position == pytest.approx(end.position, abs=0.01)
    front = target.trajectory.at(0.0).yaw
    assert np.cos(front - end.yaw) == pytest.approx(-1.0)
    low, high = part_boxes(target, 0.0).hull
    assert end.position[2] == pytest.approx(0.5 * (low + high)[2], abs=0.2)


def test_what_cannot_go_flies_and_falls_off_but_a_ball_that_rolls_stays_down() -> None:
    contact_s = contact_time(DURATION_S, 0.5)
    rock, window = stage(SceneObject("rock"), SceneObject("window"), target=1)
    heights = [middle(rock, time_s)[2] for time_s in (0.0, contact_s, DURATION_S)]
    assert heights[0] == pytest.approx(heights[1])
    assert heights[1] > 0.5
    assert heights[2] == pytest.approx(0.5 * rock.model.height, abs=0.12)
    assert apart((rock, window), DURATION_S) > 0.0
    thrown, _ = stage(SceneObject("ball"), SceneObject("wall"), target=1)
    rolling = SceneObject("ball", motion=ObjectMotion("roll"))
    rolled, wall = stage(rolling, SceneObject("wall"), target=1)
    assert middle(thrown, 0.0)[2] > 0.5
    assert {round(float(middle(rolled, t)[2]), 3) for t in (0.0, 0.5, contact_s)} == {0.25}
    assert apart((rolled, wall), contact_s) == pytest.approx(0.0, abs=0.03)


def test_the_copies_of_one_object_collide_in_pairs() -> None:
    actors = stage(SceneObject("ball", count=3), target=0)
    contact_s = contact_time(DURATION_S, 0.5)
    places = [middle(actor, contact_s) for actor in actors]
    assert abs(places[0] - places[1])[0] == pytest.approx(actors[0].model.length, rel=0.1)
    assert middle(actors[2], contact_s) == pytest.approx(middle(actors[2], 0.0))
