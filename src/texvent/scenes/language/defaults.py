"""Defaults for what a prompt leaves open, each with a note."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from texvent.scenes.description import (
    RIDES,
    STANDING,
    CameraMove,
    ObjectMotion,
    SceneDescription,
    SceneObject,
)
from texvent.scenes.language.belts import BELT, run_belts
from texvent.scenes.language.default_place import choose_place, report_place, with_snow
from texvent.scenes.language.lanes import go_along
from texvent.scenes.language.left_out import (
    add_crew,
    add_sources,
    give_usual_work,
    is_still_life,
    land,
    ride_waves,
    stays_together,
)
from texvent.scenes.language.place_cues import NO_CUES, PlaceCues
from texvent.scenes.language.posing import list_posing
from texvent.scenes.language.unridden import leave_unridden, park
from texvent.scenes.language.vocabulary.objects import MAX_BODIES
from texvent.scenes.models.objects.patterns import FACING
from texvent.scenes.models.people.activities import HAND_NOUNS, PERSON_NOUNS, SEATS
from texvent.scenes.models.protocol import Noun

SWAY = CameraMove("handheld", pace=0.4)
"""What the camera does where nothing else moves: a still image has no events."""


def complete_description(
    description: SceneDescription, nouns: Mapping[str, Noun], cues: PlaceCues = NO_CUES
) -> SceneDescription:
    """The description with every object's motion decided and something that moves.

    Objects that live in the air or water always move unless the prompt says that they rest. When
    nothing moves, objects that can move do what they usually do; when none can, the camera sways.
    """
    is_at_rest = is_still_life(description)
    description = _wheel_seats(ride_waves(add_sources(add_crew(description, nouns))))
    description = _limit_bodies(_move_to_background(description, nouns))
    description = _rest_in_place(_rest_on_bodies(description, nouns), nouns)
    description = leave_unridden(description)
    objects = tuple(
        replace(scene_object, motion=STANDING)
        if is_at_rest and nouns[scene_object.noun].motion == "fly"
        else _decide_motion(land(index, description), nouns[scene_object.noun])
        for index, scene_object in enumerate(description.objects)
    )
    description = run_belts(_move_followed(replace(description, objects=objects), nouns))
    objects = description.objects
    description = _darken(description)
    description = with_snow(description)
    place = choose_place(description, nouns, cues)
    description = report_place(description, place)
    said = replace(description.surroundings, place=place)
    description = give_usual_work(replace(description, surroundings=said))
    objects = description.objects
    is_active = any(relation.kind in ACTIVE for relation in description.relations)
    if (
        description.shot.is_moving
        or is_active
        or description.effects
        or any(_is_moving(scene_object) for scene_object in objects)
    ):
        description = _run_in_place(description)
    else:
        description = _set_in_motion(description, nouns)
    return park(_rest_the_others(go_along(description)), nouns)


_IN_THE_DARK = frozenset({"lightning", "stage lights", "lasers", "blinking lights", "fireworks"})
"""Effects that are seen in the dark."""
_FIREWORK = "firework"


def _darken(description: SceneDescription) -> SceneDescription:
    """Lights that flash or blink do so in the dark, unless the prompt says otherwise."""
    is_lit = any(effect.kind in _IN_THE_DARK for effect in description.effects)
    is_lit = is_lit or any(
        one.blink_hz is not None or one.noun == _FIREWORK for one in description.objects
    )
    if description.light.kind is not None or not is_lit:
        return description
    note = "it is dark, so that the light that changes is seen"
    light = replace(description.light, kind="night")
    return replace(description, light=light, notes=(*description.notes, note))


_WHEELED_SEATS = frozenset({"wheelchair", "stroller"})
_GOING = ("walk", "run", "move", "drive", "roll", "slide")


def _wheel_seats(description: SceneDescription) -> SceneDescription:
    """Who goes somewhere in a wheelchair sits, and the wheelchair goes."""
    objects = list(description.objects)
    for one in description.relations:
        seat, who = one.targets[0], objects[one.subject]
        is_there = one.kind in ("in", "on") and objects[seat].noun in _WHEELED_SEATS
        if is_there and who.motion is not None and who.motion.kind in _GOING:
            objects[seat] = replace(objects[seat], motion=replace(who.motion, kind="roll"))
            objects[one.subject] = replace(who, motion=ObjectMotion("sit"))
    return replace(description, objects=tuple(objects))


def _run_in_place(description: SceneDescription) -> SceneDescription:
    """Who walks or runs on a treadmill does so in place."""
    objects = list(description.objects)
    for one in description.relations:
        motion = objects[one.subject].motion
        is_there = one.kind == "on" and objects[one.targets[0]].noun == "treadmill"
        if is_there and motion is not None and motion.kind in ("walk", "run", "move"):
            pace = motion.pace * (0.7 if motion.kind == "walk" else 1.0)
            done = replace(motion, kind="run in place", pace=pace, direction=None)
            objects[one.subject] = replace(objects[one.subject], motion=done)
    return replace(description, objects=tuple(objects))


TOWERING = frozenset(
    {"crane", "building", "mountain", "windmill", "wind turbine", "ship", "bridge", "pyramid"}
)
"""Nouns that stand far behind smaller objects, unless the prompt relates them."""
_MAX_COMPANIONS = 6


def _move_to_background(
    description: SceneDescription, nouns: Mapping[str, Noun]
) -> SceneDescription:
    """Move towering objects to the background; let animals that surround something go with it.

    Animals are not scenery, because scenery stands still.
    """
    objects = list(description.objects)
    relations = []
    for relation in description.relations:
        target = relation.targets[0]
        if (
            relation.kind in ("surround", "among")
            and nouns[objects[target].noun].habitat != "fixed"
        ):
            objects[target] = replace(
                objects[target], count=min(objects[target].count, _MAX_COMPANIONS)
            )
            relation = replace(relation, kind="with")
        relations.append(relation)
    related = {i for relation in relations for i in (relation.subject, *relation.targets)}
    is_mixed = any(scene_object.noun not in TOWERING for scene_object in objects)
    for index, scene_object in enumerate(objects):
        is_free = index not in related and index != description.shot.target
        if is_mixed and is_free and scene_object.noun in TOWERING and scene_object.side is None:
            objects[index] = replace(scene_object, side="far")
    return replace(description, objects=tuple(objects), relations=tuple(relations))


def _limit_bodies(description: SceneDescription) -> SceneDescription:
    """At most `MAX_BODIES` bodies in all; at least one of each object."""
    room = MAX_BODIES - len(description.objects)
    objects = []
    for scene_object in description.objects:
        shown = 1 + min(scene_object.count - 1, room)
        room -= shown - 1
        objects.append(replace(scene_object, count=shown))
    if tuple(objects) == description.objects:
        return description
    note = f"no more than {MAX_BODIES} bodies are shown"
    return replace(description, objects=tuple(objects), notes=(*description.notes, note))


def _move_followed(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """Let a followed object move, if it can and the prompt does not say that it rests."""
    objects = list(description.objects)
    for relation in description.relations:
        target = relation.targets[0]
        noun = nouns[objects[target].noun]
        usual = "roll" if "ball" in noun.name.split() else noun.motion
        is_passed = relation.kind == "overtake" and noun.speed_m_s > 0.0
        if is_passed and objects[target].motion is None:
            objects[target] = replace(objects[target], motion=ObjectMotion(usual, pace=0.5))
        if relation.kind == "follow" and objects[target].motion is None and usual != "stand":
            objects[target] = replace(objects[target], motion=ObjectMotion(usual))
    aim = description.shot.target
    follows = any(move.kind == "follow" for move in description.shot.moves)
    if aim is None and follows:  # "tracking shot of a runner"
        aim = next((n for n, one in enumerate(objects) if nouns[one.noun].speed_m_s > 0.0), None)
    if aim is not None and follows:
        noun = nouns[objects[aim].noun]
        if objects[aim].motion is None and noun.speed_m_s > 0.0:
            objects[aim] = replace(objects[aim], motion=ObjectMotion(noun.motion))
    return replace(description, objects=tuple(objects))


ACTIVE = frozenset({"push", "pull", "kick", "hit", "throw", "catch", "collide", "give"})
"""Acts in which something moves."""


_FLOWING = ("waterfall", "sprinkler")
"""Nouns that water flows from, whatever they do."""


def _is_moving(scene_object: SceneObject) -> bool:
    return (
        scene_object.blink_hz is not None
        or scene_object.noun in _FLOWING
        or bool(scene_object.then)
        or (
            scene_object.motion is not None
            and scene_object.motion.is_moving
            and not scene_object.motion.is_stuck
            and scene_object.motion.kind != "sit"
        )
    )


_KEEPS_PLACE = frozenset(
    {"behind", "front", "beside", "between", "under", "left of", "right of", "around", "look at"}
)
"""Relations that what moves off would undo."""


_ON_BODIES = ("on lap", "on shoulder", "on head", "on back")


def _rest_on_bodies(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """Who has something on the lap sits, and an animal there does."""
    objects = list(description.objects)
    for relation in description.relations:
        if relation.kind not in _ON_BODIES:
            continue
        who, thing = relation.subject, relation.targets[0]
        rest = ObjectMotion("sit") if relation.kind == "on lap" else STANDING
        own = ObjectMotion("sit") if nouns[objects[thing].noun].motion == "walk" else STANDING
        for index, motion in ((who, rest), (thing, own)):
            if objects[index].motion is None:
                objects[index] = replace(objects[index], motion=motion)
    return replace(description, objects=tuple(objects))


def _rest_in_place(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """What the prompt only says the place of stays there: "a dog behind a fence".

    What flies or swims rests in or on something only.
    """
    objects = list(description.objects)
    for relation in description.relations:
        subject, target = (objects[each] for each in (relation.subject, relation.targets[0]))
        if relation.kind in ("in", "on", "at"):
            if _sits_down(description, relation.kind, subject, target):
                objects[relation.subject] = replace(subject, motion=ObjectMotion("sit"))
            elif subject.motion is None and (relation.kind == "in" or target.motion is None):
                objects[relation.subject] = replace(subject, motion=STANDING)
        elif relation.kind in ("hold", "carry"):
            if target.motion is None and nouns[target.noun].motion in ("sail", "paddle"):
                objects[relation.targets[0]] = replace(target, motion=STANDING)
        elif relation.kind in _KEEPS_PLACE:
            for index in (relation.subject, *relation.targets):
                each = objects[index]
                noun = nouns[each.noun]
                floats = noun.motion in ("sail", "paddle")
                if each.motion is None and (noun.habitat == "ground" or floats):
                    objects[index] = replace(each, motion=STANDING)
    return replace(description, objects=tuple(objects))


def _sits_down(
    description: SceneDescription, kind: str, subject: SceneObject, target: SceneObject
) -> bool:
    """Whether a person is on a seat, or at a table, and the prompt does not say that it stands."""
    if kind == "at":
        return subject.motion is None
    if subject.noun not in PERSON_NOUNS or target.noun not in SEATS:
        return False
    is_said = any(word.startswith("stand") for word in description.shown)
    return subject.motion is None or (subject.motion == STANDING and not is_said)


_KEPT = frozenset({"clockwise", "counter-clockwise", "left", "right"})
"""Which way a disc turns or a belt runs."""
_AT_REST = frozenset({"bell", "door"})
"""Nouns with moving parts that rest until a person moves them."""


def _decide_motion(scene_object: SceneObject, noun: Noun) -> SceneObject:
    motion = scene_object.motion
    if noun.is_working and (
        motion is None
        or motion.kind in ("stand", "swing", "spin", "work")
        or (motion.kind == "move" and (motion.direction is None or noun.name == BELT))
        or noun.name in FACING
    ):
        if noun.name in _AT_REST and (motion is None or motion.kind == "stand"):
            return replace(scene_object, motion=STANDING)
        pace = 1.0 if motion is None else motion.pace
        way = motion.direction if motion is not None and motion.direction in _KEPT else None
        end = None if motion is None else motion.end_pace
        return replace(scene_object, motion=ObjectMotion("work", way, pace, end_pace=end))
    if motion is None and noun.name in HAND_NOUNS:
        return replace(scene_object, motion=STANDING)
    if motion is None and noun.habitat in ("air", "water") and noun.motion != "stand":
        return replace(scene_object, motion=ObjectMotion(noun.motion))
    if motion is not None and motion.kind == "move":
        kind = noun.motion if noun.motion != "stand" else "slide"
        return replace(scene_object, motion=replace(motion, kind=kind))
    return scene_object


def _set_in_motion(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """Let the first object that can move do so, or else the camera.

    Several things without people, or people with things that only stand there, are a still life:
    one that goes off would leave the others behind.
    """
    resting = {relation.subject for relation in description.relations if relation.kind in RIDES}
    resting |= list_posing(description)
    able = () if stays_together(description, nouns) else description.objects
    for index, scene_object in enumerate(able):
        usual = _usual_motion(description, nouns[scene_object.noun])
        if scene_object.motion is None and usual != "stand" and index not in resting:
            moved = replace(scene_object, motion=ObjectMotion(usual))
            objects = (*description.objects[:index], moved, *description.objects[index + 1 :])
            note = f"no motion is said of the {scene_object.noun}, so it does what it usually does"
            return replace(description, objects=objects, notes=(*description.notes, note))
    light, weather = description.light, description.surroundings.weather
    if light.flicker_hz is not None or weather in ("rain", "snow"):
        return description
    if description.shot.moves:
        if description.is_timelapse:
            return description
        note = "nothing moves in the prompt and the camera is static: there will be no events"
        return replace(description, notes=(*description.notes, note))
    if not description.objects and description.shot.view == "aerial":
        shot = replace(description.shot, moves=(CameraMove("travel"),))
        note = "nothing moves in the prompt, so the camera flies on"
        return replace(description, shot=shot, notes=(*description.notes, note))
    return let_sway(description, "nothing moves in the prompt")


def let_sway(
    description: SceneDescription, reason: str = "hardly anything moves in the picture"
) -> SceneDescription:
    """The description with a camera that sways, and a note why."""
    shot = replace(description.shot, moves=(SWAY,))
    note = f"{reason}, so the camera sways a little, as in a hand"
    return replace(description, shot=shot, notes=(*description.notes, note))


_PARKED_IN = frozenset({"garage", "warehouse", "workshop", "museum", "driveway", "parking lot"})
"""Places in which vehicles stand."""


_USUAL_ACTS = {
    "boxer": "box", "fencer": "fence", "archer": "archery", "golfer": "swing club",
    "tennis player": "swing racket", "basketball player": "dribble",
    "baseball player": "swing bat", "baseball batter": "swing bat", "cricketer": "swing bat",
    "ballerina": "ballet",
    "flamenco dancer": "dance", "photographer": "photograph", "singer": "sing",
    "conductor": "conduct", "painter": "paint", "carpenter": "saw", "blacksmith": "forge",
    "welder": "weld", "chef": "cook", "fisherman": "fish", "lumberjack": "chop wood",
    "janitor": "mop", "miner": "dig",
}  # fmt: skip
"""People with a model of their own, who are known by what they do → that, if nothing else moves.
Words that are shown as any person are in `acts.doers`: nothing but the act tells who is meant."""


def _usual_motion(description: SceneDescription, noun: Noun) -> str:
    """What it does if nothing else moves: people stay in a close shot, cars in a garage."""
    if noun.name in PERSON_NOUNS and description.surroundings.place == "space":
        return "hover"
    if noun.name in PERSON_NOUNS and description.shot.framing in ("close", "medium"):
        return "stand"
    if noun.motion == "drive" and description.surroundings.place in _PARKED_IN:
        return "stand"
    return _USUAL_ACTS.get(noun.name, noun.motion)


def _rest_the_others(description: SceneDescription) -> SceneDescription:
    objects = tuple(
        scene_object if scene_object.motion is not None else replace(scene_object, motion=STANDING)
        for scene_object in description.objects
    )
    return replace(description, objects=objects)
