"""Defaults: what objects do, and where they are, in a scene that leaves it open.

Scenes of files and of sentences go the same way. What a scene says stays as it is; a note tells
what was decided.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from texvent.scenes.description import (
    RIDES,
    SPIN_RATE_HZ,
    STANDING,
    CameraMove,
    ObjectMotion,
    Relation,
    SceneDescription,
    SceneObject,
)
from texvent.scenes.models.people.activities import HAND_NOUNS, PERSON_NOUNS
from texvent.scenes.models.places import is_room
from texvent.scenes.models.protocol import Noun
from texvent.scenes.models.traits import nouns_with, trait_value

MAX_BODIES = 60
"""Most bodies in a scene; copies beyond it are left out, and a note says so."""
SWAY = CameraMove("handheld", pace=0.4)
"""Move of the camera where nothing else moves: a still image has no events."""
_ACTS = frozenset({"push", "pull", "kick", "hit", "throw", "catch", "collide"})
"""Relations in which something moves."""
_RESTING = frozenset({"behind", "front", "beside", "between", "under", "left of", "right of",
                      "around", "look at"})  # fmt: skip
"""Relations that an object would undo by moving off."""
_BESIDE = frozenset({"beside", "left of", "right of"})
_AT_HAND = frozenset({"hold", "carry", "wear"})
_AFLOAT = ("sail", "paddle")
_IN_WATER = ("swim", "surf")
_ALOFT = frozenset({"fly", "hover", "float", "fall", "rise", "sink", "throw", "blow", "orbit"})
_DARK_EFFECTS = frozenset({"lightning", "fireworks", "blinking lights"})
_LANES = ("corridor", "road tunnel")
"""Places between two walls: what goes there comes towards the camera."""
_PARKING = ("garage", "warehouse", "workshop", "parking lot")
"""Places in which vehicles stand."""
_PLACES_OF_TRAVEL = {"drive": "road", "cycle": "road", "sail": "sea", "swim": "underwater"}
_WATERS = ("sea", "lake", "river")
_NO_GROUND = ("sky", "space", "underwater")
_FAST_FLYER_M_S = 4.0
"""Speed above which what flies is shown in the sky, far from the ground."""


def complete(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """The description with every object's motion and the place decided.

    What lives in the air or in water moves unless it is said to rest. When nothing moves, the
    first object that can move does what it usually does; when none can, the camera sways.
    """
    is_still = _is_still_life(description)
    description = _set_far(_limit_bodies(_add_source(description)))
    description = _rest(description, nouns)
    objects = tuple(
        replace(one, motion=STANDING)
        if one.motion is None and is_still and nouns[one.noun].motion == "fly"
        else _decide_motion(one, nouns[one.noun])
        for one in description.objects
    )
    description = _move_others(replace(description, objects=objects), nouns)
    description = _darken(description)
    place = _choose_place(description, nouns)
    if description.surroundings.place is None:
        description = _note(description, f"no place is said: {place} is chosen")
    surroundings = replace(description.surroundings, place=place)
    description = replace(description, surroundings=surroundings)
    if not _has_motion(description):
        description = _set_in_motion(description, nouns)
    return _park(_go_along(_stand(description)), nouns)


def _note(description: SceneDescription, note: str) -> SceneDescription:
    return replace(description, notes=(*description.notes, note))


def _change(description: SceneDescription, changed: Mapping[int, SceneObject]) -> SceneDescription:
    """The description with some objects replaced."""
    objects = tuple(changed.get(n, one) for n, one in enumerate(description.objects))
    return replace(description, objects=objects)


def _moved(description: SceneDescription, motions: Mapping[int, ObjectMotion]) -> SceneDescription:
    """The description with motions for objects that have none."""
    objects = description.objects
    return _change(
        description,
        {n: replace(objects[n], motion=motion) for n, motion in motions.items()
         if objects[n].motion is None},
    )  # fmt: skip


# What is there


def _add_source(description: SceneDescription) -> SceneDescription:
    """What an effect comes from, in a scene without objects or a place."""
    if len(description.effects) != 1 or description.objects or description.surroundings.place:
        return description
    effect = description.effects[0]
    noun = trait_value("source of effect", effect.kind)
    if noun is None or noun in description.absent:
        return description
    description = _note(description, f"no source of the {effect.kind} is said: {noun} is chosen")
    return replace(description, objects=(SceneObject(noun),), effects=(replace(effect, source=0),))


def _limit_bodies(description: SceneDescription) -> SceneDescription:
    """At most `MAX_BODIES` bodies in all; at least one of each object."""
    room = MAX_BODIES - len(description.objects)
    objects = []
    for one in description.objects:
        shown = 1 + max(0, min(one.count - 1, room))
        room -= shown - 1
        objects.append(replace(one, count=shown))
    if tuple(objects) == description.objects:
        return description
    description = replace(description, objects=tuple(objects))
    return _note(description, f"no more than {MAX_BODIES} bodies are shown")


def _set_far(description: SceneDescription) -> SceneDescription:
    """Towering objects stand in the background of others that they are not related to."""
    towering = nouns_with("towering")
    related = {n for one in description.relations for n in (one.subject, *one.targets)}
    if all(one.noun in towering for one in description.objects):
        return description
    return _change(
        description,
        {
            n: replace(one, side="far")
            for n, one in enumerate(description.objects)
            if one.noun in towering
            and one.side is None
            and n not in related
            and n != description.shot.target
        },
    )


def _is_still_life(description: SceneDescription) -> bool:
    """Whether several things are side by side, with nobody, and none is said to move."""
    objects = description.objects
    return (
        len(objects) > 1
        and not any(one.noun in PERSON_NOUNS for one in objects)
        and all(one.kind in _BESIDE for one in description.relations)
        and all(one.motion is None and one.count == 1 for one in objects)
        and not description.shot.is_moving
        and description.surroundings.place not in ("sky", "space")
    )


# Motions


def _decide_motion(one: SceneObject, noun: Noun) -> SceneObject:
    """The usual motion for "move", and for what always moves."""
    motion = one.motion
    if noun.is_working and _is_work(motion, noun):
        return replace(one, motion=_work(motion, noun))
    if motion is not None and motion.kind == "move":
        kind = noun.motion if noun.motion != "stand" else "slide"
        motion = replace(motion, kind=kind)
    elif motion is None and noun.name in HAND_NOUNS:
        motion = STANDING
    elif motion is None and noun.habitat in ("air", "water") and noun.motion != "stand":
        motion = ObjectMotion(noun.motion)
    if motion is not None and motion.kind == "turn" and noun.habitat == "fixed":
        motion = replace(motion, kind="spin", pace=0.5 * motion.pace)
    if motion is not None and motion.kind == "spin" and motion.rate_hz is not None:
        motion = replace(motion, pace=motion.rate_hz / SPIN_RATE_HZ, rate_hz=None)
    return replace(one, motion=motion)


def _is_work(motion: ObjectMotion | None, noun: Noun) -> bool:
    """Whether a motion is that of the parts of a noun, which stays where it is."""
    if motion is None or motion.kind in ("stand", "swing", "spin", "turn", "work", "sway"):
        return True
    is_flat = noun.name in nouns_with("flat pattern") | nouns_with("carries")
    return motion.kind == "move" and (motion.direction is None or is_flat)


def _work(motion: ObjectMotion | None, noun: Noun) -> ObjectMotion:
    rests = motion is None or motion.kind == "stand"
    if rests and noun.name in nouns_with("works on demand"):
        return STANDING
    if motion is None:
        return ObjectMotion("work")
    way = motion.direction
    kept = way if way in ("clockwise", "counter-clockwise", "left", "right") else None
    pace, own_hz = motion.pace, trait_value("turns per second", noun.name)
    if motion.rate_hz is not None and own_hz is not None:
        pace = motion.rate_hz / own_hz
    elif motion.kind in ("spin", "turn", "swing"):
        pace = pace if own_hz is None and pace > 1.0 else max(pace, 1.0)
    return ObjectMotion("work", kept, pace, end_pace=motion.end_pace)


def _rest(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """What is only said to be somewhere stays there; who is on a seat or at a table sits."""
    motions: dict[int, ObjectMotion] = {}
    for one in description.relations:
        motions.update(_rest_of(one, description, nouns))
    description = _moved(description, motions)
    resting, ridden = nouns_with("lies still"), _list_ridden(description)
    is_plain = description.surroundings.place is None and not description.shot.is_moving
    resting |= nouns_with("ridden") if is_plain else frozenset()
    still = {n: STANDING for n, one in enumerate(description.objects) if one.noun in resting}
    return _moved(description, {n: one for n, one in still.items() if n not in ridden})


def _rest_of(
    relation: Relation, description: SceneDescription, nouns: Mapping[str, Noun]
) -> dict[int, ObjectMotion]:
    objects = description.objects
    subject, target = objects[relation.subject], objects[relation.targets[0]]
    is_person = subject.noun in PERSON_NOUNS
    if relation.kind == "at" or (
        relation.kind == "on"
        and is_person
        and target.noun in nouns_with("seat") | nouns_with("sat on")
    ):
        return {relation.subject: ObjectMotion("sit")}
    if relation.kind == "in" or (relation.kind == "on" and target.motion is None):
        return {relation.subject: STANDING}
    if relation.kind == "wear" or (relation.kind == "hold" and is_person):
        return {relation.targets[0]: STANDING}
    if relation.kind in _RESTING:
        return {
            n: STANDING
            for n in (relation.subject, *relation.targets)
            if nouns[objects[n].noun].habitat == "ground"
            or nouns[objects[n].noun].motion in _AFLOAT
        }
    return {}


def _move_others(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """What is followed or overtaken moves, a belt runs, and a treadmill keeps one in place."""
    motions: dict[int, ObjectMotion] = {}
    changed: dict[int, SceneObject] = {}
    for one in description.relations:
        target, rider = description.objects[one.targets[0]], description.objects[one.subject]
        noun = nouns[target.noun]
        if one.kind in ("follow", "overtake") and noun.speed_m_s > 0.0:
            pace = 0.5 if one.kind == "overtake" else 1.0
            motions[one.targets[0]] = ObjectMotion(noun.motion, pace=pace)
        if one.kind == "on" and rider.motion is not None:
            changed.update(_carry(one, rider, target))
    if any(move.kind == "follow" for move in description.shot.moves):
        aim = description.shot.target
        speeds = [nouns[one.noun].speed_m_s for one in description.objects]
        if aim is None:
            aim = next((n for n, speed in enumerate(speeds) if speed > 0.0), None)
        if aim is not None and speeds[aim] > 0.0:
            motions[aim] = ObjectMotion(nouns[description.objects[aim].noun].motion)
    return _moved(_change(description, changed), motions)


def _carry(relation: Relation, rider: SceneObject, target: SceneObject) -> dict[int, SceneObject]:
    """What moves under, or on, something that moves by itself."""
    motion = rider.motion
    assert motion is not None
    if target.noun in nouns_with("moves under feet") and motion.kind in ("walk", "run"):
        pace = motion.pace * (0.7 if motion.kind == "walk" else 1.0)
        done = replace(motion, kind="run in place", pace=pace, direction=None)
        return {relation.subject: replace(rider, motion=done)}
    if target.noun in nouns_with("carries") and motion.direction in ("left", "right"):
        run = ObjectMotion("work", motion.direction, motion.pace)
        return {relation.targets[0]: replace(target, motion=run)}
    return {}


def _has_motion(description: SceneDescription) -> bool:
    return (
        description.shot.is_moving
        or bool(description.effects)
        or any(one.kind in _ACTS for one in description.relations)
        or any(
            one.blink_hz is not None
            or one.noun in nouns_with("flows")
            or bool(one.then)
            or (one.motion is not None and one.motion.kind not in ("stand", "hang", "sit"))
            for one in description.objects
        )
    )


def _set_in_motion(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """Let the first object that can move do so, or else the camera."""
    held = {n for one in description.relations if one.kind in _AT_HAND
            for n in (one.subject, *one.targets)}  # fmt: skip
    able = () if _stays_together(description, nouns) else tuple(enumerate(description.objects))
    for n, one in able:
        usual = _usual_motion(description, nouns[one.noun])
        if one.motion is None and usual != "stand" and n not in held:
            description = _moved(description, {n: ObjectMotion(usual)})
            return _note(
                description, f"no motion is said of the {one.noun}, so it does what it usually does"
            )
    is_seen = description.light.flicker_hz is not None or description.is_timelapse
    if is_seen or description.surroundings.weather in ("rain", "snow"):
        return description
    if description.shot.moves:
        return _note(
            description,
            "nothing moves in the prompt and the camera is static: there will be no events",
        )
    is_aerial = not description.objects and description.shot.view == "aerial"
    move = CameraMove("travel") if is_aerial else SWAY
    what = "flies on" if is_aerial else "sways a little, as in a hand"
    shot = replace(description.shot, moves=(move,))
    note = f"nothing moves in the prompt, so the camera {what}"
    return _note(replace(description, shot=shot), note)


def _stays_together(description: SceneDescription, nouns: Mapping[str, Noun]) -> bool:
    """Whether one object that goes off would leave the others behind."""
    objects = description.objects
    people = {n for n, one in enumerate(objects) if one.noun in PERSON_NOUNS}
    others = [one for n, one in enumerate(objects) if n not in people]
    if not people:
        return len(others) > 1
    near = _BESIDE | _AT_HAND | {"with"}
    are_near = all(
        one.kind in near or not people & {one.subject, *one.targets}
        for one in description.relations
    )
    return bool(others) and are_near and all(nouns[one.noun].habitat == "fixed" for one in others)


def _usual_motion(description: SceneDescription, noun: Noun) -> str:
    """What it does if nothing else moves: people stay in a close shot, cars in a garage."""
    place = description.surroundings.place
    if noun.name in PERSON_NOUNS and place == "space":
        return "hover"
    is_close = description.shot.framing in ("close", "medium")
    stays = noun.name in PERSON_NOUNS and is_close
    return "stand" if stays or (noun.motion == "drive" and place in _PARKING) else noun.motion


def _stand(description: SceneDescription) -> SceneDescription:
    return _moved(description, dict.fromkeys(range(len(description.objects)), STANDING))


def _go_along(description: SceneDescription) -> SceneDescription:
    """What goes in a lane comes towards the camera, unless the scene says which way."""
    if description.surroundings.place not in _LANES or description.shot.view in ("side", "top"):
        return description

    def turned(motion: ObjectMotion) -> ObjectMotion:
        goes = motion.kind in ("walk", "run", "drive", "crawl", "roll", "slide", "skate")
        is_open = motion.direction is None
        return replace(motion, direction="towards") if goes and is_open else motion

    objects = tuple(
        replace(one, motion=turned(one.motion), then=tuple(map(turned, one.then)))
        if one.motion is not None
        else one
        for one in description.objects
    )
    return replace(description, objects=objects)


def _list_ridden(description: SceneDescription) -> set[int]:
    """Objects that have a rider, and those that collide: they are on the way."""
    relations = description.relations
    ridden = {n for one in relations if one.kind in RIDES for n in one.targets}
    return ridden | {one.subject for one in relations if one.kind == "collide"}


def _park(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """What only stands there has no rider; a bird that walks has a model that flies."""
    ridden = _list_ridden(description)
    changed = {}
    for n, one in enumerate(description.objects):
        kinds = {motion.kind for motion in (one.motion, *one.then) if motion is not None}
        parked, flying = f"parked {one.noun}", f"flying {one.noun}"
        if parked in nouns and n not in ridden and kinds == {"stand"}:
            changed[n] = replace(one, noun=parked)
        elif flying in nouns and kinds & {"fly", "hover", "rise", "orbit", "sink"}:
            changed[n] = replace(one, noun=flying)
    return _change(description, changed)


# Place and light


def _darken(description: SceneDescription) -> SceneDescription:
    """Lights that flash or blink do so in the dark, unless the scene says otherwise."""
    is_seen = any(one.kind in _DARK_EFFECTS for one in description.effects) or any(
        one.blink_hz is not None or trait_value("lamps", one.noun) == ["firework"]
        for one in description.objects
    )
    if description.light.kind is not None or not is_seen:
        return description
    light = replace(description.light, kind="night")
    note = "it is dark, so that the light that changes is seen"
    return _note(replace(description, light=light), note)


def _choose_place(description: SceneDescription, nouns: Mapping[str, Noun]) -> str:
    """The place that is said, or the usual one of the objects."""
    held = {n for one in description.relations if one.kind in _AT_HAND for n in one.targets}
    members = [nouns[one.noun] for n, one in enumerate(description.objects) if n not in held]
    said = description.surroundings
    swims = bool(members) and all(
        noun.habitat == "water" and noun.motion not in _AFLOAT for noun in members
    )
    leaps = any(one.motion is not None and one.motion.kind == "jump" for one in description.objects)
    if said.place in (None, *_WATERS) and swims and not leaps:
        return "underwater"
    if said.place == "sky" and _needs_ground(description, nouns):
        usual = _usual_place(members, description)
        return "grass" if is_room(usual) or usual in _NO_GROUND else usual
    if said.place == "sea" and members and not _is_at_sea(description, members):
        return "beach"
    if said.place is not None:
        return said.place
    for move in description.shot.moves:
        if move.kind == "travel" and move.means in _PLACES_OF_TRAVEL:
            return _PLACES_OF_TRAVEL[move.means]
    return "snow" if said.has_snow or said.weather == "snow" else _usual_place(members, description)


def _needs_ground(description: SceneDescription, nouns: Mapping[str, Noun]) -> bool:
    """Whether something stands, which no sky can hold."""
    borne = {
        n
        for n, one in enumerate(description.objects)
        if nouns[one.noun].habitat in ("air", "water")
        or (one.motion is not None and one.motion.kind in _ALOFT)
    }
    for one in description.relations:
        if one.kind in ("in", "on", *RIDES) and borne.intersection(one.targets):
            borne.add(one.subject)
    return len(borne) < len(description.objects)


def _is_at_sea(description: SceneDescription, members: Sequence[Noun]) -> bool:
    """Whether all that is there floats, flies, swims or stands in the water."""
    in_water = any(one.motion is not None and one.motion.kind in (*_IN_WATER, *_AFLOAT)
                   for one in description.objects)  # fmt: skip
    return in_water or all(noun.habitat in ("air", "water", "fixed") for noun in members)


def _usual_place(members: Sequence[Noun], description: SceneDescription) -> str:
    kinds = [one.motion.kind for one in description.objects if one.motion is not None]
    is_outdoors = description.surroundings.weather in ("rain", "snow") or any(
        noun.name in nouns_with("outdoors") for noun in members
    )
    if any(kind in _IN_WATER for kind in kinds) and all(
        noun.habitat == "ground" for noun in members
    ):
        return "sea"
    if {noun.habitat for noun in members} == {"water"}:
        return "sea"
    if any(noun.motion in _AFLOAT for noun in members):
        at_sea = any(trait_value("usual place", noun.name) == "sea" for noun in members)
        return "sea" if at_sea else "lake"
    of_acts = [place for kind in kinds if (place := trait_value("place of activity", kind))]
    of_nouns = [trait_value("usual place", noun.name) or noun.place for noun in members]
    has_ground = any(noun.habitat == "ground" for noun in members)
    for place in (*of_nouns, *of_acts):
        if (
            place
            and not (is_outdoors and is_room(place))
            and not (has_ground and place in _NO_GROUND)
        ):
            return str(place)
    flies = bool(members) and all(
        noun.habitat == "air" and noun.speed_m_s >= _FAST_FLYER_M_S for noun in members
    )
    rests = all(kind in ("stand", "sit", "lie", "rise", "sink") for kind in kinds)
    return "sky" if flies and not rests else "grass"
