"""Acts of a scene: motions that they imply, then bonds between the placed actors."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from texvent_scenes.description import STANDING, IndexedRelation, SceneDescription
from texvent_scenes.models.activities import (
    ACTIVITIES,
    AIMED,
    HAND_NOUNS,
    ON_TOP,
    PERSON_NOUNS,
)
from texvent_scenes.models.anchors import takes_in
from texvent_scenes.models.people.outfit import can_be_worn, list_props
from texvent_scenes.models.protocol import Noun, Pose
from texvent_scenes.models.shapes import compose, point
from texvent_scenes.models.tables import nouns_with, trait_value
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.spec.data import HANDLED, PLACING, SENT
from texvent_scenes.spec.scene import Direction, Motion, SceneObject
from texvent_scenes.staging.actors import Actor, seeded
from texvent_scenes.staging.interactions import handling, holding, machines, rally, striking
from texvent_scenes.staging.interactions.holding import hides_riders
from texvent_scenes.staging.interactions.sending import send_into
from texvent_scenes.staging.placement.apart import RESTING
from texvent_scenes.staging.placement.zones import are_driven
from texvent_scenes.staging.tracks.phases import PATH_KINDS, fits_in_hand
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


_ASIDE_DEG = (-20.0, 200.0)
"""Headings of who points at something: to the right or left, and a little to the camera."""
_SAME_WAY = ("follow", "overtake", "with")
"""Relations of two that go the same way, which one of them may say."""
_IDLE = frozenset({"stand", "sit", "sail", "drive"})
"""Motions of people that leave it open whether they ride."""


def settle_motions(
    description: SceneDescription, nouns: Mapping[str, Noun], seed: int
) -> SceneDescription:
    """The description with the motions that its acts imply.

    Who pushes walks; what is ridden moves and its rider sits; who kicks faces left or right.
    """
    objects = list(description.objects)
    relations = [
        _mounted(replace(one, targets=targets), objects, nouns)
        for one in in_hand(description.relations, objects)
        for targets in ([(t,) for t in one.targets] if one.kind == "wear" else [one.targets])
    ]
    relations += _implied_acts(objects, relations)
    relations = [_on_top(one, objects, relations) for one in relations]
    for relation in relations:
        if relation.kind in ACTS and relation.targets:
            _settle_act(relation, objects, relations, nouns, seed)
    for each in relations:
        if each.kind == "on" and objects[each.targets[0]].noun in nouns_with("across a road"):
            objects[each.subject] = _directed(objects[each.subject], "across")
        is_led = each.kind == "between" and not are_driven(objects[each.subject].noun)
        if is_led or (
            each.kind == "through" and objects[each.targets[0]].noun in nouns_with("passage")
        ):
            goes = is_led and any(one.kind == "travel" for one in description.camera.moves)
            way: Direction = "left" if goes else "towards"
            objects[each.subject] = _directed(objects[each.subject], way)
    for each in relations:
        who = objects[each.subject]
        is_aimed = bool({one.kind for one in who.motions} & AIMED) and each.kind == "towards"
        if is_aimed and who.heading_deg is None and len(who.motions) == 1:
            side = seeded(seed, "act", each.subject).random() < 0.5
            objects[each.subject] = replace(who, heading_deg=_ASIDE_DEG[side])
        pair = (each.subject, each.targets[0])
        ways = [one.motions[0].direction for one in (objects[n] for n in pair) if one.motions]
        said = [one for one in ways if one is not None] if each.kind in _SAME_WAY else []
        for number in pair if said else ():
            objects[number] = _directed(objects[number], said[0])
    return replace(description, objects=tuple(objects), relations=tuple(relations))


def _on_top(
    act: IndexedRelation, objects: Sequence[SceneObject], relations: Sequence[IndexedRelation]
) -> IndexedRelation:
    """An act of a person on a thing as that on a bench, where what is in its place stands by."""
    at_bench = ON_TOP.get(act.kind, "")
    if not at_bench or objects[act.subject].noun not in PERSON_NOUNS:
        return act
    nouns = {noun for prop in list_props(at_bench) for noun in prop.nouns}
    is_there = any(objects[n].noun in nouns for one in relations for n in one.targets
                   if one.subject == act.subject and one.kind == "beside")  # fmt: skip
    return replace(act, kind=at_bench) if is_there else act


def _settle_act(
    act: IndexedRelation, objects: list[SceneObject], relations: Sequence[IndexedRelation],
    nouns: Mapping[str, Noun], seed: int,
) -> None:  # fmt: skip
    """Give both bodies of an act the motions that it leaves them."""
    pair = act.subject, act.targets[0]
    direction = _choose_direction(objects, pair, seed)
    objects[pair[0]] = who = _swinging(act.kind, pair, objects, relations)
    if machines.grips(who.noun, act.kind):
        is_free = not any(one.subject == pair[1] for one in relations)
        settled = machines.fit_hand(who, objects[pair[1]], nouns, is_free=is_free)
    else:
        settled = _settle(act.kind, who, objects[pair[1]], nouns, direction)
    for index, one in zip(pair, settled, strict=True):
        objects[index] = one


def _directed(said: SceneObject, direction: Direction) -> SceneObject:
    """An actor whose way a relation decides, where no other is said.

    On a crosswalk it crosses the road; out of a tunnel, and between things that stand side by
    side, it comes towards the camera; it comes before one that goes along them.
    """
    first = said.motions[0] if said.motions else None
    if first is None or first.kind not in PATH_KINDS or first.direction is not None:
        return said
    return replace(said, motions=(replace(first, direction=direction), *said.motions[1:]))


def in_hand(
    relations: Sequence[IndexedRelation], objects: Sequence[SceneObject]
) -> Iterator[IndexedRelation]:
    """A person "with" small things wears what can be worn, and holds the first of the others.

    A hand holds what is "with" it.
    """
    free = ("hit", "wear")  # who wears a coat has hands for an umbrella
    holding = {one.subject for one in relations if one.kind in ACTS and one.kind not in free}
    for one in relations:
        thing, who = objects[one.targets[0]].noun, objects[one.subject].noun
        is_in_hand = thing in HAND_NOUNS and who not in PERSON_NOUNS | HAND_NOUNS
        if one.kind == "with" and is_in_hand:  # "a board with a hand"
            yield IndexedRelation("hold", one.targets[0], (one.subject,))
            continue
        small = nouns_with("in hand or on something") | nouns_with("held as a tool")
        is_small = thing in small and thing not in HAND_NOUNS
        if one.kind != "with" or not is_small or objects[one.subject].noun not in PERSON_NOUNS:
            yield one
        elif can_be_worn(thing):
            yield replace(one, kind="wear")
        elif one.subject not in holding:
            holding.add(one.subject)
            yield replace(one, kind="hold")
        else:
            yield one


def _settle(
    kind: str, subject: SceneObject, target: SceneObject, nouns: Mapping[str, Noun], to: Direction
) -> tuple[SceneObject, SceneObject]:
    """Subject and target of an act, with the motions that the act leaves them."""
    motion, still = subject.motion or STANDING, replace(target, motions=())
    if kind == "ride":
        sitting = replace(subject, motions=(Motion("sit"),))
        return sitting, _give_motion(subject, target, nouns)
    if kind == "collide":
        return _at_its_pace(subject), _at_its_pace(target)
    if kind == "knock over":
        return _at_its_pace(subject), still
    if kind in striking.IMPACTS:
        doing = striking.IMPACTS[kind].activity or (motion.kind if kind == "hit" else kind)
        return replace(subject, motions=(Motion(doing, to),)), still
    if kind in ("push", "pull"):
        if motion.kind in ("push", "stand"):
            walk = Motion("walk", motion.direction)
            subject = replace(subject, motions=(walk, *subject.motions[1:]))
        return subject, still
    if kind == "act on":
        return subject, target
    if kind in ("hold", "wear"):
        held = [one for one in target.motions if fits_in_hand(one, nouns[target.noun])]
        still = replace(target, motions=() if all(map(_is_rest, held)) else tuple(held))
    if kind == "wear":
        return subject, still
    return subject, _smaller(still, trait_value("carried size", target.noun) or 1.0)


def _is_rest(motion: Motion) -> bool:
    return motion.kind in ("stand", "hang", "sit", "lie")


def _smaller(said: SceneObject, share: float) -> SceneObject:
    return replace(said, size=share * said.size)


def _swinging(
    kind: str, pair: tuple[int, int], objects: Sequence[SceneObject],
    relations: Sequence[IndexedRelation],
) -> SceneObject:  # fmt: skip
    """Subject that hits, with the act of the implement in its hands, or of the usual one."""
    who, target = objects[pair[0]], objects[pair[1]].noun
    if kind != "hit":
        return who
    held = {objects[n].noun for one in relations if one.subject == pair[0] for n in one.targets
            if one.kind in ("hold", "with")}  # fmt: skip
    swung = [name for name, one in ACTIVITIES.items() if one.reach_m]
    used = [name for name in swung if held & {n for p in list_props(name) for n in p.nouns}]
    said = [one.kind for one in who.motions if one.kind in swung]
    usual = trait_value("struck with", target) or "swing bat"
    return replace(who, motions=(Motion([*used, *said, usual][0]),))


def _at_its_pace(said: SceneObject) -> SceneObject:
    """Body that collides, of whose motions speed and a turn are left: the act decides the rest."""
    motion = said.motion or STANDING
    kept = replace(STANDING, pace=motion.pace, speed_m_s=motion.speed_m_s)
    turns = tuple(one for one in said.motions if one.kind == "turn")[:1]
    return replace(said, motions=turns or (() if kept == STANDING else (kept,)))


def _mounted(
    relation: IndexedRelation, objects: Sequence[SceneObject], nouns: Mapping[str, Noun]
) -> IndexedRelation:
    """A person on a horse or a skateboard rides it; so do idle people in a boat or a vehicle."""
    person, target = objects[relation.subject], objects[relation.targets[0]].noun
    if relation.kind not in ("on", "in") or person.noun not in PERSON_NOUNS:
        return relation
    is_mount = trait_value("ridden", target) is not None and relation.kind == "on"
    is_carrier = trait_value("seats", target) or trait_value("ridden", target)
    is_closed = relation.kind == "in" and hides_riders(nouns[target])
    is_idle = (person.motion or STANDING).kind in _IDLE
    if is_mount or (is_idle and (is_carrier or is_closed)):
        return replace(relation, kind="ride")
    return relation


def _implied_acts(
    objects: Sequence[SceneObject], relations: Sequence[IndexedRelation]
) -> list[IndexedRelation]:
    """Relations that bind named instruments and tools to their players."""
    bound = {target for one in relations if one.kind in ACTS for target in one.targets}
    found: list[IndexedRelation] = []
    for index, person in enumerate(objects):
        motions = person.motions if person.noun in PERSON_NOUNS else ()
        props = [prop for motion in motions for prop in list_props(motion.kind)]
        for prop in props:
            free = [n for n, one in enumerate(objects) if one.noun in prop.nouns and n not in bound]
            if free and prop.anchor != "ground" and not prop.is_own:
                found.append(IndexedRelation("hold", index, (free[0],)))
                bound.add(free[0])
    return found


def _give_motion(rider: SceneObject, ridden: SceneObject, nouns: Mapping[str, Noun]) -> SceneObject:
    """Ridden object with the motion that the prompt gives to it or to its rider."""
    if ridden.noun in nouns_with("ridden in place"):
        return replace(
            ridden, motions=(Motion("work" if nouns[ridden.noun].is_working else "tilt"),)
        )
    said = ridden.motion if ridden.motion is not None and ridden.motion.is_moving else rider.motion
    usual = nouns[ridden.noun].motion
    if nouns[ridden.noun].habitat == "fixed" or usual == "roll":
        usual = "slide"
    if said is None:
        return replace(ridden, motions=(Motion(usual),))
    if said.kind in ("sit", "stand"):
        return ridden
    kind = said.kind if said.kind in ("run", "jump", "turn", "fly", "swim") else usual
    later = ridden.motions[1:] or rider.motions[1:]
    return replace(ridden, motions=(replace(said, kind=kind), *later))


def _choose_direction(
    objects: Sequence[SceneObject], pair: tuple[int, int], seed: int
) -> Direction:
    """Direction of a single act in the picture."""
    for motion in (objects[index].motion for index in pair):
        if motion is not None and motion.direction in ("left", "right", "towards", "away"):
            return motion.direction
    return "left" if seeded(seed, "act", pair[0]).random() < 0.5 else "right"


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
    _turn_queues(cast, description)
    acts = [one for one in description.relations if one.kind in ACTS and one.targets]
    for relation in sorted(acts, key=lambda one: list(ACTS).index(one.kind)):
        _perform(cast, relation, description, duration_s)
    sent = {one.subject: one for one in acts if one.kind in SENT}
    for each in description.relations:
        if each.kind == "towards" and each.subject in sent:
            _send_to(cast, sent[each.subject], description.objects, each.targets[0], duration_s)
    _bear_down(cast, description.relations)
    _swing_riders(cast, description.relations)
    _carry_along(cast, placed, description.relations)
    for person in list(cast.values()):
        nouns = {noun for prop in person.props if prop.anchor == "ground" or prop.is_own
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
    cast: dict[int, Actor], act: IndexedRelation, said: Sequence[SceneObject], goal: int,
    duration_s: float,
) -> None:  # fmt: skip
    """Send a kicked, thrown or rolled body back from what is fixed, or to who is alive."""
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
        elif wall.track.is_resting and said[goal].position_m is None:
            cast[thing], cast[goals[0]] = striking.deliver(
                cast[thing], wall, duration_s, is_thrown=act.kind == "throw"
            )


def _bear_down(cast: dict[int, Actor], relations: Sequence[IndexedRelation]) -> None:
    """Let what stands on a thing that is knocked over go down with it."""
    down = [one.targets[0] for one in relations if one.kind == "knock over"]
    for index in down:
        fallen = [one for one in cast.values() if one.object_index == index and one.is_mover]
        on = [one.subject for one in relations if one.kind == "on" and index in one.targets]
        for below, (number, one) in itertools.product(fallen[:1], list(cast.items())):
            if one.object_index in on:
                frame, own = (np.vstack([each.track.at(0.0).to_world(), [0.0, 0.0, 0.0, 1.0]])
                              for each in (below, one))  # fmt: skip
                path = attached(below.track, np.linalg.solve(frame, own)[:3])
                cast[number] = replace(one, track=path, is_mover=True)
        down += [one for one in on if one not in down]


def _carry_along(
    cast: dict[int, Actor], placed: Mapping[int, Actor], relations: Sequence[IndexedRelation]
) -> None:
    """Move bodies on or in a thing along with it where an act moves that."""
    starts = {n: one.track.at(0.0).to_world() for n, one in placed.items()}
    for each in (one for one in relations if one.kind in ("on", "in")):
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
    """Both bodies of an act, whose subject comes to a stated place of what it handles."""
    act, objects = ACTS[relation.kind], description.objects
    bodies = act(who, what, duration_s, turn)
    own, said = objects[who.object_index], objects[what.object_index]
    is_free = own.position_m is None and not any(
        one.subject == who.object_index and one.kind in RESTING for one in description.relations
    )
    if relation.kind in HANDLED and is_free and said.position_m is not None and bodies[1]:
        off = np.subtract(what.track.at(0.0).position, bodies[1].track.at(0.0).position)
        start = point(np.add(who.track.start, [*off[:2], 0.0]))
        who = replace(who, track=replace(who.track, start=start))
        bodies = act(who, what, duration_s, turn)
    return bodies


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
