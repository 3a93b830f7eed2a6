"""Bodies that collide: they touch at one instant, and what is fixed stays."""

import numpy as np
import pytest

from texvent.scenes.description import Relation, SceneDescription, SceneObject
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.striking import contact_time
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

    def gap(time_s: float) -> float:
        spans = [actor.corners(time_s)[:, 0] for actor in actors]
        left, right = sorted(spans, key=lambda span: float(span.mean()))
        return float(right.min() - left.max())

    assert gap(0.0) > 0.5 * min(actor.model.length for actor in actors)
    assert gap(contact_s) == pytest.approx(0.0, abs=0.15 * actors[0].model.length)
    assert min(gap(time_s) for time_s in np.linspace(0.0, DURATION_S, 41)) > (
        -0.25 * max(actor.model.length for actor in actors if actor.noun.habitat != "fixed")
    )
    gone = [
        float(np.linalg.norm(middle(actor, contact_s) - middle(actor, 0.0))) for actor in actors
    ]
    assert tuple(way > 0.1 for way in gone) == moves


def test_the_copies_of_one_object_collide_in_pairs() -> None:
    actors = stage(SceneObject("ball", count=3), target=0)
    contact_s = contact_time(DURATION_S, 0.5)
    places = [middle(actor, contact_s) for actor in actors]
    assert abs(places[0] - places[1])[0] == pytest.approx(actors[0].model.length, rel=0.1)
    assert middle(actors[2], contact_s) == pytest.approx(middle(actors[2], 0.0))
