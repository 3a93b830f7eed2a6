"""Applies the acts of a prompt: what comes before placing, and what binds placed actors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from texvent.scenes.description import (
    RIDES,
    STANDING,
    ObjectMotion,
    Relation,
    SceneDescription,
    SceneObject,
)
from texvent.scenes.models.animals.four_legged.clothing import has_fitting_head
from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.models.people.creatures.names import OF_UPRIGHT
from texvent.scenes.models.people.props import PROPS
from texvent.scenes.models.protocol import Noun
from texvent.scenes.models.wrapped.opening import OPENS
from texvent.scenes.staging.actors import Actor, Tether, seeded
from texvent.scenes.staging.acts import colliding, striking
from texvent.scenes.staging.acts.acts import ACTS
from texvent.scenes.staging.acts.attached import MovedAlong, Performed
from texvent.scenes.staging.acts.boarding import board, is_stowed, load, stow
from texvent.scenes.staging.acts.cargo import take_along
from texvent.scenes.staging.acts.cast import Cast
from texvent.scenes.staging.acts.crews import put_to_work
from texvent.scenes.staging.acts.facing import face_each_other, hand_over, lean_on, look_at
from texvent.scenes.staging.acts.holding import (
    HELD_SCALE,
    IN_ITS_COLOUR,
    arm_reach,
    each_worn,
    is_person,
    shoulder_height,
    size_of,
)
from texvent.scenes.staging.acts.named_props import name_all_props
from texvent.scenes.staging.acts.on_body import ON_BODY, hold, lead, put_on_body, wear
from texvent.scenes.staging.acts.riding import CLOSED, MOUNTS, SEATS_OF
from texvent.scenes.staging.acts.transits.transit import go_over
from texvent.scenes.staging.trajectories.trajectory import Vector

_ORDER = (
    "push", "pull", "kick", "throw", "catch", "hit", "collide", "work on", "give", "hold",
    "carry", "on head", "on shoulder", "on back", "on lap", "wear",
)  # fmt: skip
"""What moves bodies comes before what hangs on them."""


def settle_motions(
    description: SceneDescription, nouns: Mapping[str, Noun], seed: int
) -> SceneDescription:
    """The description with the motions that its acts imply.

    Who pushes walks; what is ridden moves and its rider sits; who kicks faces left or right.
    """
    objects = list(description.objects)
    stays: set[int] = set()
    relations = [_mounted(one, objects, nouns, stays) for one in each_worn(description.relations)]
    relations = [_thrown_to(relation, relations) for relation in relations]
    relations += _implied_acts(objects, relations)
    relations = _hit_with(objects, relations)
    for relation in relations:
        if relation.kind not in ACTS or not relation.targets:
            continue
        subject, target = relation.subject, relation.targets[0]
        if relation.kind in RIDES:
            objects[target] = _give_motion(objects[subject], objects[target], nouns)
            objects[subject] = replace(objects[subject], motion=ObjectMotion("sit"), then=())
        elif relation.kind in ("push", "pull"):
            motion = objects[subject].motion
            if motion is None or motion.kind in ("push", "pull", "stand"):
                way = motion.direction if motion is not None else None
                objects[subject] = replace(objects[subject], motion=ObjectMotion("walk", way))
            objects[target] = _still(objects[target])
        elif relation.kind in ("work on", "give", "collide"):
            objects[subject] = _before_meeting(objects[subject], relation.kind)
            objects[target] = _opened_or_still(objects[target])
        elif ACTS[relation.kind].is_single:
            way = _choose_way(objects[subject], objects[target], seed, subject)
            objects[subject] = replace(
                objects[subject], motion=ObjectMotion(relation.kind, way), then=()
            )
            objects[target] = _still(objects[target])
        elif relation.kind == "wear":
            objects[subject] = _in_colour_of(objects[target], objects[subject], nouns)
            objects[target] = _still(objects[target])
        else:
            held = _still(objects[target])
            objects[target] = replace(held, scale=held.scale * HELD_SCALE.get(held.noun, 1.0))
    return replace(description, objects=tuple(objects), relations=tuple(relations))


def _mounted(
    relation: Relation, objects: list[SceneObject], nouns: Mapping[str, Noun], stays: set[int]
) -> Relation:
    """A person on a horse or a skateboard rides it; so do people in a boat or an open vehicle.

    Who is said to stand, lie or do something else there does that.
    """
    person, target = objects[relation.subject], objects[relation.targets[0]].noun
    if relation.kind not in ("on", "in") or person.noun not in PERSON_NOUNS:
        return relation
    is_idle = relation.subject not in stays and (person.motion or STANDING).kind in _IDLE
    is_carrier = target in SEATS_OF or (nouns[target].motion == "sail" and target != "ship")
    is_aboard = is_carrier and target not in CLOSED and is_idle
    if is_aboard or (relation.kind == "on" and target in MOUNTS):
        return replace(relation, kind="ride")
    return relation


def _in_colour_of(
    garment: SceneObject, wearer: SceneObject, nouns: Mapping[str, Noun]
) -> SceneObject:
    """Clothes are drawn by the colour of who wears them; that of a bicycle is its frame's.

    An animal's is its coat.
    """
    noun = nouns[wearer.noun]
    is_animal = wearer.noun in OF_UPRIGHT or has_fitting_head(noun)
    is_drawn = garment.noun in IN_ITS_COLOUR and noun.motion != "drive" and not is_animal
    return replace(wearer, colour=garment.colour or wearer.colour) if is_drawn else wearer


def _before_meeting(one: SceneObject, kind: str) -> SceneObject:
    """The way to what it meets is planned with that; what rolls there does not fly."""
    rolls = one.motion is not None and one.motion.kind == "roll"
    return one if rolls or kind != "collide" else _still(one)


_IDLE = frozenset({"stand", "sit", "sail", "drive"})


def _thrown_to(relation: Relation, relations: list[Relation]) -> Relation:
    """A throw towards something is for that to catch."""
    if relation.kind != "throw" or len(relation.targets) != 1:
        return relation
    own = (relation.subject, relation.targets[0])
    goals = [each.targets for each in relations if each.kind == "towards" and each.subject in own]
    return replace(relation, targets=relation.targets + goals[0][:1]) if goals else relation


def _hit_with(objects: list[SceneObject], relations: list[Relation]) -> list[Relation]:
    """Who holds a racket and hits a ball hits it with the racket."""
    found = list(relations)
    for hit in relations:
        if hit.kind != "hit" or len(hit.targets) != 1:
            continue
        for held in relations:
            is_tool = held.kind == "hold" and objects[held.targets[0]].noun in striking.TOOLS
            if is_tool and held.subject == hit.subject and held in found and hit in found:
                found.remove(held)
                found[found.index(hit)] = replace(hit, targets=hit.targets + held.targets[:1])
    return found


_ACT_OF_ACTIVITY = {
    "kick": "kick", "throw": "throw", "catch": "catch", "swing bat": "hit", "swing racket": "hit",
    "swing club": "hit",
}  # fmt: skip
_BALLS = frozenset({"ball", "football", "basketball", "volleyball", "baseball", "tennis ball",
                    "golf ball", "american football", "shuttlecock", "frisbee"})  # fmt: skip


def _implied_acts(objects: list[SceneObject], relations: list[Relation]) -> list[Relation]:
    """Who plays a guitar that the prompt names holds that one; who kicks kicks its ball."""
    bound = {target for relation in relations if relation.kind in ACTS
             for target in relation.targets}  # fmt: skip
    holds = []
    for index, person in enumerate(objects):
        if person.noun not in PERSON_NOUNS or person.motion is None:
            continue
        act = _ACT_OF_ACTIVITY.get(person.motion.kind)
        if act is not None and not any(
            one.subject == index and one.kind in ACTS and not _is_at_hand(one, objects)
            for one in relations
        ):
            ball = next((n for n, thing in enumerate(objects) if thing.noun in _BALLS
                         and n not in bound), None)  # fmt: skip
            if ball is not None:
                holds.append(Relation(act, index, (ball,)))
                bound.add(ball)
        said = (person.motion, *person.then)
        for prop in (one for motion in said for one in PROPS.get(motion.kind, ())):
            for number, thing in enumerate(objects):
                is_held = prop.anchor != "ground" and not prop.is_own
                if thing.noun in prop.nouns and number not in bound and is_held:
                    holds.append(Relation("hold", index, (number,)))
                    bound.add(number)
    return holds


def _is_at_hand(one: Relation, objects: Sequence[SceneObject]) -> bool:
    """What one wears, or holds to hit with, leaves the ball to be hit."""
    is_tool = objects[one.targets[0]].noun in striking.TOOLS
    return one.kind == "wear" or (one.kind == "hold" and is_tool)


def _opened_or_still(scene_object: SceneObject) -> SceneObject:
    motion = scene_object.motion
    return scene_object if motion is not None and motion.kind in OPENS else _still(scene_object)


def _still(scene_object: SceneObject) -> SceneObject:
    return replace(scene_object, motion=None, then=())


def _give_motion(rider: SceneObject, ridden: SceneObject, nouns: Mapping[str, Noun]) -> SceneObject:
    """What is ridden, with the motion that the prompt gives to it or to its rider."""
    said = ridden.motion if ridden.motion is not None and ridden.motion.is_moving else rider.motion
    usual = nouns[ridden.noun].motion
    if nouns[ridden.noun].habitat == "fixed" or usual == "roll":
        usual = "slide"
    if said is None:
        return replace(ridden, motion=ObjectMotion(usual))
    if said.kind in ("sit", "stand"):
        return ridden
    kind = said.kind if said.kind in ("run", "jump", "turn", "fly", "swim") else usual
    return replace(ridden, motion=replace(said, kind=kind), then=ridden.then or rider.then)


def _choose_way(subject: SceneObject, target: SceneObject, seed: int, index: int) -> str:
    for motion in (subject.motion, target.motion):
        if motion is not None and motion.direction in ("left", "right", "towards", "away"):
            return str(motion.direction)
    return "left" if seeded(seed, "act", index).random() < 0.5 else "right"


def perform_acts(
    description: SceneDescription, actors: list[Actor], duration_s: float
) -> list[Actor]:
    """The actors with every act's bodies bound together.

    Args:
        description: the prompt, its motions settled.
        actors: all actors, each where it was placed.
        duration_s: length of the clip, s.

    Returns:
        The actors in the same order, without those whose part a model plays itself: the rider of
        a bicycle.
    """
    cast = Cast(actors)
    bound = {
        one for r in description.relations if r.kind in ACTS for one in (r.subject, *r.targets)
    }
    free = [n for n, one in enumerate(actors) if one.object_index not in bound]
    look_at(cast, description.relations, duration_s)
    face_each_other(cast, free)
    lean_on(cast, description.relations)
    relations = [r for r in description.relations if r.kind in ACTS and r.targets]
    ridden = {r.targets[0] for r in relations if r.kind in RIDES}
    towed = [r for r in relations if r.kind in ("push", "pull") and r.targets[0] in ridden]
    for relation in towed:
        _perform(cast, relation, duration_s)
    board(cast, relations)
    relations = [r for r in relations if r not in towed]
    load(cast, description.relations)
    for kind in _ORDER:
        if kind == "work on":
            put_to_work(cast, relations, description.relations)
            continue
        for relation in relations:
            if relation.kind == kind:
                _perform(cast, relation, duration_s)
    _lead_all(cast, description.relations)
    go_over(cast, description, duration_s)
    name_all_props(description, cast, len(actors))
    _take_off_doubles(cast, actors)
    take_along(cast, description.relations, actors)
    return [_tied_to_ground(actor) for actor in cast.actors()]


def _lead_all(cast: Cast, relations: tuple[Relation, ...]) -> None:
    """Who walks a dog has it on a leash."""
    for relation in relations:
        if relation.kind != "with" or relation.way != "lead" or not relation.targets:
            continue
        walkers = cast.copies(relation.subject)
        for turn, number in enumerate(cast.copies(relation.targets[0])):
            walker = walkers[turn % len(walkers)]
            person = cast.get(walker)
            if is_person(person) and turn < len(walkers):
                person, animal = lead(person, cast.get(number))
                cast.put(walker, person)
                cast.put(number, animal)


def _tied_to_ground(actor: Actor) -> Actor:
    """A kite that no person holds is flown from out of the picture."""
    if actor.noun.name != "kite" or actor.tether is not None:
        return actor
    x, y, z = actor.trajectory.at(0.0).position
    flier = (x + 0.8 * z, y - 1.2 * z, 0.0)
    return replace(actor, tether=Tether(flier, "", (0.0, 0.0, 0.0), 0.008))


def _take_off_doubles(cast: Cast, actors: list[Actor]) -> None:
    """A piano, a desk or a board that comes with an activity is not shown twice."""
    for number, actor in enumerate(actors):
        nouns = {noun for prop in cast.props(number) if prop.anchor == "ground" or prop.is_own
                 for noun in prop.nouns}  # fmt: skip
        for other, thing in enumerate(actors):
            if thing.noun.name in nouns and actor is not thing:
                cast.put(other, None)
                nouns.discard(thing.noun.name)


def _perform(cast: Cast, relation: Relation, duration_s: float) -> None:
    subjects = cast.copies(relation.subject)
    targets = cast.copies(relation.targets[0])
    if relation.kind == "collide":
        met = list(dict.fromkeys([*subjects, *targets]))
        for one, two in zip(met[::2], met[1::2], strict=False):
            first, second = colliding.collide(cast.get(one), cast.get(two), duration_s)
            cast.put(one, first)
            cast.put(two, second)
        return
    others = cast.copies(relation.targets[1]) if len(relation.targets) > 1 else []
    if is_stowed(cast, relation):
        stow(cast, relation, cast.stood_in[relation.subject])
        return
    for turn, target in enumerate(targets):
        if not subjects:
            return
        subject = subjects[turn % len(subjects)]
        if subject not in cast.copies(relation.subject) or subject == target:
            continue
        other = others[turn] if turn < len(others) else None
        _bind(cast, relation.kind, (subject, target, other), duration_s)


def _bind(cast: Cast, kind: str, who: tuple[int, int, int | None], duration_s: float) -> None:
    subject_at, target_at, other_at = who
    subject, target = cast.get(subject_at), cast.get(target_at)
    other = None if other_at is None else cast.get(other_at)
    if kind in ("push", "pull"):
        subject, target = _move_along(kind, subject, target)
    elif kind == "kick":
        subject, target = striking.kick(subject, target, duration_s)
    elif kind == "throw":
        subject, target, other = striking.throw(subject, target, other, duration_s)
    elif kind == "catch":
        subject, target = striking.catch(subject, target, duration_s)
    elif kind == "hit":
        subject, target, other = striking.hit(subject, target, other, duration_s)
    elif kind == "give" and other is not None:
        subject, target, other = hand_over(subject, target, other)
    elif kind in ON_BODY:
        subject, target = put_on_body(kind, subject, target)
    elif kind == "wear":
        subject, worn = wear(subject, target)
        cast.put(target_at, worn)
        return
    else:
        subject, target = hold(subject, target)
    cast.put(subject_at, subject)
    cast.put(target_at, target)
    if other_at is not None and other is not None:
        cast.put(other_at, other)


_HITCH_M = 0.5
"""Between a vehicle and what it tows."""


def _move_along(kind: str, subject: Actor, target: Actor) -> tuple[Actor, Actor]:
    """Hands at the thing's back, or a rope to it; both move together."""
    size, model = size_of(subject.model), target.model
    floor = subject.trajectory.at(0.0).position[2]
    lift = 0.5 * model.height if target.is_centred else 0.0
    grips: tuple[tuple[str, Vector], ...]
    if kind == "push":
        height = min(0.85 * model.height, 0.95 * shoulder_height(subject))
        height = max(height, 0.64 * shoulder_height(subject))
        reach = arm_reach(subject, height)
        along = reach + 0.02 + 0.5 * model.length
        side = min(0.16 * size, 0.45 * model.width)
        grips = (("left hand", (reach, side, height)), ("right hand", (reach, -side, height)))
    else:
        along = -(0.9 * size + 0.5 * model.length)
        if subject.noun.motion == "drive":
            along = -(0.5 * subject.model.length + 0.5 * model.length + _HITCH_M)
        grips = (("right hand", (-0.34 * size, -0.20 * size, 0.92 * size)),)
    if is_person(subject):
        path = Performed(subject.trajectory, f"{kind} along", grips)
        subject = replace(subject, trajectory=path)
    moved = MovedAlong(subject.trajectory, along, floor + lift)
    target = replace(target, trajectory=moved, lead_m=subject.lead_m, is_mover=subject.is_mover)
    if kind == "pull":
        end = (0.5 * model.length, 0.0, 0.5 * model.height - lift)
        target = replace(target, tether=Tether(subject, "right hand", end, 0.025))
    return subject, target
