"""Who goes off, onto, into, out of, through, up or down a thing follows its shape."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

from texvent.scenes.description import STANDING, ObjectMotion, Relation, SceneDescription
from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.acts import ACTS
from texvent.scenes.staging.acts.cast import Cast
from texvent.scenes.staging.acts.riding import CLOSED
from texvent.scenes.staging.acts.transits.crowns import CROWNED, fall_from_crown
from texvent.scenes.staging.acts.transits.openings import OPENINGS, pass_opening
from texvent.scenes.staging.acts.transits.slopes import SLOPED, go_on_slope
from texvent.scenes.staging.acts.transits.tops import aside, come_onto, leave_top
from texvent.scenes.staging.acts.transits.vessels import go_into
from texvent.scenes.staging.trajectories.legs import Legs
from texvent.scenes.staging.trajectories.trajectory import Stationary

_GATES = frozenset({"tunnel", "arch", "gate"})
_NO_VESSELS = CLOSED | {"house", "building", "barn", "tree", "bush", "car", "truck", "bus"}
"""What nothing can be seen to go into."""
_RESTING = frozenset({"stand", "sit", "lie", "climb", "rise"})
_HIGHEST_M = 4.0
"""Height up to which one jumps or rolls off things."""


def go_over(cast: Cast, description: SceneDescription, duration_s: float) -> None:
    """Give those who go off or onto a thing a way that begins or ends on it.

    Args:
        cast: the actors; who goes is replaced, and a thing that turns for it.
        description: the prompt, its motions settled.
        duration_s: length of the clip, s.
    """
    bound = {
        one for r in description.relations if r.kind in ACTS for one in (r.subject, *r.targets)
    }
    for relation in description.relations:
        motion = description.objects[relation.subject].motion or STANDING
        ends = (relation.subject, relation.targets[0])
        if motion.kind in _RESTING or bound.intersection(ends) or len(relation.targets) > 1:
            continue
        targets = cast.copies(ends[1])
        lead = _choose(relation, cast.get(targets[0])) if targets else None
        if lead is None or not _stays(cast.get(targets[0])):
            continue
        subjects = cast.copies(ends[0])
        for number, at in enumerate(subjects):
            target = targets[number % len(targets)]
            turn = number / max(len(subjects) - 1, 1)
            moved, thing = lead(cast.get(at), cast.get(target), motion, duration_s, turn)
            path, wide = moved.trajectory, 1.15 * moved.model.width
            is_queue = thing.noun.name == "conveyor belt"
            if isinstance(path, Legs) and relation.way in _SIDE_BY_SIDE and not is_queue:
                path = aside(path, wide * (number - 0.5 * (len(subjects) - 1)))
                moved = replace(moved, trajectory=path)
            cast.put(at, moved)
            cast.put(target, thing)


_SIDE_BY_SIDE = frozenset({"off", "onto", "up", "down"})
_Lead = Callable[[Actor, Actor, ObjectMotion, float, float], tuple[Actor, Actor]]


def _choose(relation: Relation, target: Actor) -> _Lead | None:
    """How a way leads; None = it is none of these."""
    name, way = target.noun.name, relation.way
    if way in ("up", "down") and name in SLOPED:
        return partial(go_on_slope, is_up=way == "up")
    if way == "off" and relation.kind in ("from", "on"):
        return leave_top
    if way == "onto":
        return come_onto
    if relation.kind == "through" and name in OPENINGS:
        return pass_opening
    if name in CROWNED and relation.kind == "from":
        return fall_from_crown
    if way in ("into", "out of") and relation.kind in ("in", "from"):
        if name in OPENINGS | _GATES:
            return partial(pass_opening, is_out=way == "out of", is_half=True)
        return partial(go_into, is_out=way == "out of") if name not in _NO_VESSELS else None
    return None


def _stays(target: Actor) -> bool:
    is_thing = target.noun.name not in PERSON_NOUNS and target.noun.motion not in ("walk", "run")
    is_low = target.model.height < _HIGHEST_M or target.noun.name in CROWNED | _GATES
    is_still = isinstance(target.trajectory, Stationary) and is_low
    return is_thing and is_still
