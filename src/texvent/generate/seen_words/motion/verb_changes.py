"""Verbs that mean a change are shown only where it happens within the clip.

What arrives or stops has gone before and stands in the end, what departs stood before, what slows
down or accelerates is slower or faster than it was, what circles goes a good part of the round.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from texvent.generate.seen_words.picture import Picture
from texvent.scenes.description import Claim
from texvent.scenes.language.vocabulary.motion import DIRECTIONS
from texvent.scenes.language.words.english import list_verb_forms
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.claims.bodies import part_boxes

INSTANTS = 25
"""Instants of the clip, the first and the last among them."""
LEAST_SPEED = 0.1
"""Sizes per second at which something goes."""
AT_REST = 0.15
"""Share of its greatest speed up to which it has stopped."""
CHANGED = 0.7
"""Share of its speed before, or after, that what slows down or speeds up has at most."""
LEAST_ROUND_RAD = 1.5
"""Turn of its way that what circles makes at least."""
HUNG_M = 0.08
"""Height above the ground of what hangs, m."""


def judge_change(picture: Picture, claim: Claim, actors: Sequence[Actor]) -> str | None:
    """Why the change that a verb means is not seen, or None.

    Args:
        picture: of the staged scene.
        claim: a verb of an object.
        actors: the copies of the object.
    """
    check = _CHECKS.get(claim.word)
    if check is None or not actors:
        return None
    faults = [check(picture, one) for one in actors]
    return None if None in faults else faults[0]


def _speeds(picture: Picture, actor: Actor) -> Float64Array:
    """Its speed from instant to instant, in its own sizes per second."""
    times = np.linspace(0.0, picture.views[-1].time_s, INSTANTS)
    places = np.array([actor.middle(float(time_s)) for time_s in times])
    steps = np.linalg.norm(np.diff(places, axis=0), axis=1)
    return np.asarray(steps / (times[1] - times[0]) / max(actor.size_m, 1e-9))


def _stops(picture: Picture, actor: Actor) -> str | None:
    speeds = _speeds(picture, actor)
    name = actor.noun.name
    if speeds.max() < LEAST_SPEED:
        return f"{name} stands from the start"
    is_going = np.flatnonzero(speeds >= max(LEAST_SPEED, AT_REST * speeds.max()))
    rests = speeds[is_going[0] :] < max(AT_REST * speeds.max(), 0.5 * LEAST_SPEED)
    return None if rests.any() else f"{name} does not stop"


def _sets_off(picture: Picture, actor: Actor) -> str | None:
    speeds = _speeds(picture, actor)
    name = actor.noun.name
    if speeds[0] > max(AT_REST * speeds.max(), LEAST_SPEED):
        return f"{name} is going from the start"
    return None if speeds.max() >= LEAST_SPEED else f"{name} stays"


def _slows(picture: Picture, actor: Actor) -> str | None:
    speeds = _speeds(picture, actor)
    later = speeds[int(np.argmax(speeds)) :]
    return None if later.min() < CHANGED * speeds.max() else f"{actor.noun.name} does not slow down"


def _speeds_up(picture: Picture, actor: Actor) -> str | None:
    speeds = _speeds(picture, actor)
    earlier = speeds[: int(np.argmax(speeds)) + 1]
    is_faster = earlier.min() < CHANGED * speeds.max()
    return None if is_faster else f"{actor.noun.name} gets no faster"


def _circles(picture: Picture, actor: Actor) -> str | None:
    """The direction of its way turns, seen from above or from the camera."""
    times = np.linspace(0.0, picture.views[-1].time_s, INSTANTS)
    places = np.array([actor.middle(float(time_s)) for time_s in times])
    for first, second in ((0, 1), (0, 2), (1, 2)):
        ways = np.diff(places[:, [first, second]], axis=0)
        if np.linalg.norm(ways, axis=1).max() < 1e-6:
            continue
        headings = np.unwrap(np.arctan2(ways[:, 1], ways[:, 0]))
        if abs(headings[-1] - headings[0]) >= LEAST_ROUND_RAD:
            return None
    return f"{actor.noun.name} goes no round"


def _eights(picture: Picture, actor: Actor) -> str | None:
    """Its way turns to the one side and to the other, seen from above."""
    times = np.linspace(0.0, picture.views[-1].time_s, INSTANTS)
    ways = np.diff(np.array([actor.middle(float(time_s)) for time_s in times])[:, :2], axis=0)
    turns = np.diff(np.unwrap(np.arctan2(ways[:, 1], ways[:, 0])))
    least = 0.5 * min(turns[turns > 0.0].sum(), -turns[turns < 0.0].sum())
    return None if least >= 0.5 * LEAST_ROUND_RAD else f"{actor.noun.name} makes no eight"


def _hangs(picture: Picture, actor: Actor) -> str | None:
    low = part_boxes(actor, 0.5 * picture.views[-1].time_s).hull[0]
    return None if low[2] > HUNG_M else f"{actor.noun.name} stands on the ground"


_BY_BASE: Mapping[Callable[[Picture, Actor], str | None], tuple[str, ...]] = {
    _stops: ("stop", "halt", "arrive", "brake", "come to a stop", "come to rest", "slow to a stop",
             "slow to a halt", "screech to a halt", "screech to a stop", "grind to a halt",
             "roll to a stop", "brake to a stop"),
    _sets_off: ("depart",),
    _slows: ("slow down", "decelerate"),
    _speeds_up: ("accelerate", "speed up"),
    _circles: ("circle", "orbit"),
    _hangs: ("hang", "dangle"),
}  # fmt: skip
"""Check → bases of the verbs that need it."""
_PARTICIPLES = frozenset({"stopped", "halted"})
"""What they say holds from the start: "a stopped car"."""


def _list_forms() -> dict[str, Callable[[Picture, Actor], str | None]]:
    found = {}
    for check, bases in _BY_BASE.items():
        for base in bases:
            head, *tail = base.split()
            for form, _ in list_verb_forms(head):
                found[" ".join((form, *tail))] = check
    found |= dict.fromkeys(DIRECTIONS["circle"], _circles)
    found |= dict.fromkeys(DIRECTIONS["eight"], _eights)
    return {word: check for word, check in found.items() if word not in _PARTICIPLES}


_CHECKS = _list_forms()
"""Form of a verb → its check."""
