"""Acts of a scene: motions that they imply, then bonds between the placed actors."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from texvent_scenes.description import IndexedRelation, SceneDescription
from texvent_scenes.models.activities import (
    AIMED,
    PERSON_NOUNS,
)
from texvent_scenes.models.anchors import takes_in
from texvent_scenes.models.protocol import Pose
from texvent_scenes.models.shapes import compose, point
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.spec.data import PLACING, SENT
from texvent_scenes.spec.scene import SceneObject
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.interactions import handling, holding, machines, rally, striking
from texvent_scenes.staging.interactions.sending import send_into
from texvent_scenes.staging.placement.apart import RESTING
from texvent_scenes.staging.tracks.track import attached

_Act = Callable[[Actor, Actor, float, int], tuple[Actor | None, Actor | None]]
ACTS: Mapping[str, _Act] = {
    "push": lambda who, what, *_: holding.push(who, what),
    "pull": lambda who, what, *_: holding.pull(who, what),
    "ride": lambda who, what, *_: holding.board(who, what),
    **{kind: partial(striking.strike, kind) for kind in striking.IMPACTS},
    "move over": partial(striking.strike, "lift"),
    "rally": lambda who, what, *_: (who, what),
    "act on": lambda who, what, _, number: handling.handle(who, what, number),
    "hold": lambda who, what, *_: holding.hold(who, what),
    "wear": lambda who, what, *_: holding.wear(who, what),
}
"""Relations that are acts of the subject on its first target → the bodies as they leave them. What
moves bodies comes before what hangs on them. Targets of one kind have numbers."""


def perform_acts(
    description: SceneDescription, actors: Sequence[Actor], duration_s: float
) -> list[Actor]:
    """The actors with every act's bodies bound together.

    Args:
        description: the prompt, its motions settled.
        actors: all actors, each where it was placed.
        duration_s: length of the clip, s.

    Returns:
        The actors in the same order, numbered anew, without those whose part a model plays itself:
        the rider of a bicycle, and what that rider has; a piano that comes with an activity.
    """
    cast = dict(enumerate(actors))
    placed = dict(cast)
    _turn_to_goals(cast, description.relations)
    _turn_to_receivers(cast, description)
    _turn_queues(cast, description)
    acts = [one for one in description.relations if one.kind in ACTS and one.targets]
    for relation in sorted(acts, key=lambda one: list(ACTS).index(one.kind)):
        _perform(cast, relation, description, duration_s)
    sent = {one.subject: one for one in acts if one.kind in SENT}
    for each in description.relations:
        if each.kind == "towards" and each.subject in sent:
            _send_to(cast, sent[each.subject], each, description.objects, duration_s)
    _swing_riders(cast, description.relations)
    _carry_along(cast, placed, description.relations)
    for person in list(cast.values()):
        nouns = {noun for prop in person.props if prop.is_below or prop.is_own
                 for noun in prop.nouns}  # fmt: skip
        for number, thing in list(cast.items()):
            if thing.noun.name in nouns and thing.object_index != person.object_index:
                del cast[number]
    return [replace(actor, instance=number) for number, actor in enumerate(cast.values(), start=1)]


def _turn_to_goals(cast: dict[int, Actor], relations: Sequence[IndexedRelation]) -> None:
    """Turn those who point or wave, and stay where they are, to what it is for."""
    aims = {one.subject: one.targets[0] for one in relations if one.kind == "towards"}
    for number, one in cast.items():
        goal = aims.get(one.object_index, -1)
        goals = [each for each in cast.values() if each.object_index == goal]
        if goals and one.track.is_resting and one.track.at(0.0).activity.split()[0] in AIMED:
            x, y = (goals[0].middle(0.0) - one.middle(0.0))[:2]
            cast[number] = replace(one, track=replace(one.track, yaw=float(np.arctan2(y, x))))


def _turn_to_receivers(cast: dict[int, Actor], description: SceneDescription) -> None:
    """Turn those who send something to who stands at a stated place, where they may be turned."""
    objects, relations = description.objects, description.relations
    sending = {one.subject for one in relations if one.kind in SENT and one.direction is None}
    for each in relations:
        goal, is_said = each.targets[0], objects[each.subject].heading_deg is not None
        is_sent = each.kind == "towards" and each.subject in sending
        if is_said or not is_sent or objects[goal].position_m is None:
            continue
        goals = [one for one in cast.values() if one.object_index == goal]
        own = [n for n, one in cast.items() if one.object_index == each.subject]
        for number in own if goals else ():
            x, y = (goals[0].middle(0.0) - cast[number].middle(0.0))[:2]
            track = replace(cast[number].track, yaw=math.atan2(y, x))
            cast[number] = replace(cast[number], track=track)


def _turn_queues(cast: dict[int, Actor], description: SceneDescription) -> None:
    """Turn those who stand in a queue to what it is for."""
    queues = {one.subject for one in description.claims
              if (one.kind, one.value) == ("row", "queue")}  # fmt: skip
    for said in (one for one in description.relations if one.subject in queues):
        goals = [one for one in cast.values() if one.object_index == said.targets[0]]
        own = [n for n, one in cast.items() if one.object_index == said.subject]
        for number in own if goals and said.kind in PLACING else ():
            one, middle = cast[number], cast[own[len(own) // 2]].middle(0.0)
            yaw = 0.0 if goals[0].middle(0.0)[0] >= middle[0] else math.pi
            if one.track.is_resting and one.noun.motion == "walk":
                cast[number] = replace(one, track=replace(one.track, yaw=yaw))


def _send_to(
    cast: dict[int, Actor], act: IndexedRelation, way: IndexedRelation,
    said: Sequence[SceneObject], duration_s: float,
) -> None:  # fmt: skip
    """Send a kicked, thrown or rolled body back from what is fixed, or to who is alive."""
    goal = way.targets[0]
    things, goals = ([n for n, one in cast.items() if one.object_index == index]
                     for index in (act.targets[0], goal))  # fmt: skip
    for thing in things if goals else ():
        wall = cast[goals[0]]
        if takes_in(wall.noun.name) and said[goal].position_m is None:
            cast[thing], cast[goals[0]] = send_into(
                cast[thing], wall, duration_s, is_turned=said[goal].heading_deg is None
            )
        elif wall.noun.habitat == "fixed":
            cast[thing], cast[goals[0]] = striking.rebound(
                cast[thing], wall, is_turned=said[goal].heading_deg is None,
                is_moved=said[goal].position_m is None,
            )  # fmt: skip
        elif wall.track.is_resting:
            cast[thing], cast[goals[0]] = striking.deliver(
                cast[thing], wall, duration_s,
                is_thrown=act.kind == "throw" or (way.is_caught and act.kind != "roll"),
                is_placed=said[goal].position_m is not None, is_taken=way.is_caught,
            )  # fmt: skip


def _carry_along(
    cast: dict[int, Actor], placed: Mapping[int, Actor], relations: Sequence[IndexedRelation]
) -> None:
    """Move bodies on or in a thing along with it where an act moves that, and those on these."""
    starts = {n: one.track.at(0.0).to_world() for n, one in placed.items()}
    said = [one for one in relations if one.kind in ("on", "in")]
    for each in said * len(said):  # what bears a thing may be borne itself, and be named later
        below = [n for n, one in cast.items() if one.object_index in each.targets]
        own = [n for n, one in cast.items() if one.object_index == each.subject]
        for number in own if below else ():
            off = {n: float(np.linalg.norm(starts[n][:, 3] - starts[number][:, 3])) for n in below}
            under = min(below, key=off.__getitem__)
            is_left = cast[number].track is placed[number].track
            if is_left and cast[under].track is not placed[under].track:
                frame, at = (np.vstack([starts[n], [0.0, 0.0, 0.0, 1.0]]) for n in (under, number))
                path = attached(cast[under].track, np.linalg.solve(frame, at)[:3])
                cast[number] = replace(cast[number], track=path, is_mover=True)


def _swing_riders(cast: dict[int, Actor], relations: Sequence[IndexedRelation]) -> None:
    """Let people go with the seats that they swing on."""
    for each in relations:
        seats = [n for n, one in cast.items() if one.object_index in each.targets]
        riders = [n for n, one in cast.items() if one.object_index == each.subject]
        places = itertools.cycle(seats)  # as `relations._line_up` shares them out
        for rider, below in zip(riders, places, strict=False) if each.kind == "on" else ():
            is_swing = cast[below].noun.name in nouns_with("swings")
            if is_swing and cast[rider].noun.name in PERSON_NOUNS:
                _swing_along(cast, rider, below)


def _swing_along(cast: dict[int, Actor], rider: int, below: int) -> None:
    """Rider of a swing, who goes with its seat, the last of its parts."""
    one, swing = cast[rider], cast[below]
    seat = swing.own_parts(Pose(0.0, 0.0, 0.0, "stand"))[-1].to_body
    home, frame = one.track.at(0.0), swing.track.at(0.0).to_world()
    start = np.linalg.solve(*(np.vstack([each, [0.0, 0.0, 0.0, 1.0]]) for each in
                              (compose(frame, seat), home.to_world())))[:3]  # fmt: skip

    def axes(time_s: float) -> Float64Array:
        return compose(frame, swing.own_parts(swing.pose(time_s))[-1].to_body)

    track = attached(swing.track, start, home.activity, axes)
    cast[rider] = replace(one, track=track, is_mover=True)


def _act_where_stated(
    relation: IndexedRelation, description: SceneDescription, who: Actor, what: Actor,
    duration_s: float, turn: int,
) -> tuple[Actor | None, Actor | None]:  # fmt: skip
    """Both bodies of an act; the one without a stated place comes to the place of the other."""
    act, objects = ACTS[relation.kind], description.objects
    if relation.start_s is not None:
        contact_s = relation.start_s + striking.LEAD_S
        who = replace(who, track=replace(who.track, contact_s=contact_s))
    runs = relation.kind in ("collide", "knock over")
    if runs and relation.direction in ("left", "right"):
        who, what = _facing(who, what, is_right=relation.direction == "right")
    pair, acting = (who, what), act(who, what, duration_s, turn)
    is_stated = [objects[one.object_index].position_m is not None for one in pair]
    resting = {one.subject for one in description.relations if one.kind in RESTING}
    is_bound = [one or each.object_index in resting
                for one, each in zip(is_stated, pair, strict=True)]  # fmt: skip
    kept = is_stated.index(True) if any(is_stated) else 0
    there = acting[kept]
    if not is_stated[kept] or is_bound[1 - kept] or there is None or relation.kind == "ride":
        return acting
    here = pair[kept].track.at(0.0).position
    off = [*np.subtract(here, there.track.at(0.0).position)[:2], 0.0]
    who, what = (
        replace(one, track=replace(one.track, start=point(np.add(one.track.start, off))))
        for one in pair
    )
    return act(who, what, duration_s, turn)


def _facing(who: Actor, what: Actor, *, is_right: bool) -> tuple[Actor, Actor]:
    """Both, in each other's places if one would run away from the other."""
    here, there = who.track.start, what.track.start
    if here[0] == there[0] or (here[0] < there[0]) == is_right:
        return who, what
    changed = ((who, (there[0], *here[1:])), (what, (here[0], *there[1:])))
    first, second = (replace(one, track=replace(one.track, start=at)) for one, at in changed)
    return first, second


def _perform(
    cast: dict[int, Actor], relation: IndexedRelation, description: SceneDescription,
    duration_s: float,
) -> None:  # fmt: skip
    """An act of each subject on a target of its own."""
    if relation.kind == "rally":
        return rally.play(cast, relation, description)
    if machines.grips(description.objects[relation.subject].noun, relation.kind):
        return machines.perform_grip(cast, relation, description, duration_s)
    subjects, targets = (
        [number for number, actor in cast.items() if actor.object_index == index]
        for index in (relation.subject, relation.targets[0])
    )
    if relation.kind == "ride":
        pairs = zip(subjects, targets, strict=False)
    elif relation.kind == "collide" or subjects == targets:
        met = list(dict.fromkeys([*subjects, *targets]))
        pairs = zip(met[::2], met[1::2], strict=False)
    else:
        for target in targets if not subjects else ():
            del cast[target]
        pairs = zip(itertools.cycle(subjects), targets, strict=False)
    most = 1 if relation.kind == "knock over" else None  # the first of several
    for place, (one, other) in enumerate(itertools.islice(pairs, most)):
        if one != other:
            turn = place // max(len(subjects), 1)
            act = partial(_act_where_stated, relation, description)
            bodies = act(cast[one], cast[other], duration_s, turn)
            for number, body in zip((one, other), bodies, strict=True):
                if body is None:
                    del cast[number]
                else:
                    cast[number] = body
