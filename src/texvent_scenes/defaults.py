"""Defaults: what objects do, and where they are, in a scene that leaves it open.

Scenes of files and of sentences go the same way. What a scene says stays as it is; a note tells
what was decided.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from texvent_scenes.default_places import (
    AFLOAT_MOTIONS,
    AT_HAND,
    choose_place,
    lead_along,
    set_far,
    strike_far,
)
from texvent_scenes.default_work import (
    AT_REST,
    aligned,
    is_work,
    list_swung,
    list_work,
    stands_still,
    work_of,
    works_by_turns,
)
from texvent_scenes.description import (
    SPIN_RATE_HZ,
    STANDING,
    IndexedRelation,
    SceneDescription,
    label_of,
)
from texvent_scenes.models.activities import HAND_NOUNS, PERSON_NOUNS, TRAVELLING
from texvent_scenes.models.effects import LAMPS
from texvent_scenes.models.places import PLACES, is_room
from texvent_scenes.models.protocol import Noun
from texvent_scenes.models.tables import nouns_with, trait_value
from texvent_scenes.rendered_scene import Ground
from texvent_scenes.spec.data import ACTED, SPACED
from texvent_scenes.spec.scene import CameraMove, Motion, SceneObject

NO_PLACE = "no place is said"
"""Begins the note about it."""
SWAY = CameraMove("handheld", pace=0.4)
"""Move of the camera where nothing else moves: a still image has no events."""
_RESTING = frozenset({"behind", "front", "beside", "between", "under", "left of", "right of",
                      "around"})  # fmt: skip
"""Relations that an object would undo by moving off."""
_GOING = {"stand": "slide", "float": "fly"}
_UPRIGHT = {"up": "rise", "down": "sink"}
_VERTICAL = {**_UPRIGHT, "up and down": "fly"}
"""Direction of what goes by no means of its own → its motion."""
_FLYING = {"fly", "glide", "rise", "sink", "hover"}
_GO = Motion("go")
_ROCKING = 0.5
"""Pace at which what floats rocks on waves, as a share of that of a sway."""
_DARK_EFFECTS = frozenset({"fireworks", "fireflies"})
_GOES = frozenset({"drive", "fly", "sail", "paddle", "slide", "roll", "reverse"})
_ROUTES = frozenset({"past", "overtake", "through", "towards", "away from", "from", "follow"})
"""Relations of what goes somewhere."""


def complete(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """The description with every object's motion and the place decided.

    What lives in the air or in water moves unless it is said to rest. When nothing moves, the
    first object that can move does what it usually does; when none can, the camera sways.
    """
    at_rest = {n for n, one in enumerate(description.objects) if stands_still(one, nouns[one.noun])}
    swung = list_swung(description)
    for n in swung:
        label = label_of(description, n)
        note = f"no motion is said of the {label}, so it swings who is on it"
        description = _note(description, note)
    description = _move(description, dict.fromkeys(swung, Motion("work")))
    description = _set_on_routes(description, nouns)
    description = _rest(_set_down(strike_far(set_far(_ground(description)))), nouns)
    objects = tuple(
        replace(
            one,
            motions=(AT_REST,)
            if n in at_rest
            else decide_motions(one.motions, nouns[one.noun], one.heading_deg),
        )
        for n, one in enumerate(description.objects)
    )
    description = _lead_companions(replace(description, objects=objects), nouns)
    description = _darken(_move_others(description, nouns))
    place = choose_place(description, nouns)
    if description.place.name is None:
        description = _note(description, f"{NO_PLACE}: {place} is chosen")
    description = replace(description, place=replace(description.place, name=place))
    if PLACES[place].corridor_m:
        description = lead_along(description, nouns)
    if description.place.has_snow or PLACES[place].ground is Ground.SNOW:
        description = _snow_over(description)
    if PLACES[place].has_surface:
        description = _set_afloat(description, nouns)
    for note in _list_floored(description, place):
        description = _note(description, note)
    for n, one in enumerate(description.objects):
        if waits_to_fall(one):
            note = f"the {label_of(description, n)} hangs on a thread until it falls"
            description = _note(description, note)
    if not _has_motion(description, nouns):
        description = _set_in_motion(description, nouns)
    everything = range(len(description.objects))
    return _park(_move(description, dict.fromkeys(everything, STANDING)), nouns)


def _ground(description: SceneDescription) -> SceneDescription:
    """The place over which things are in the sky: "a plane in the sky above a city"."""
    said = description.place
    if said.name != "sky" or not said.backdrops:
        return description
    name, *others = said.backdrops
    return replace(description, place=replace(said, name=name, backdrops=tuple(others)))


def _snow_over(description: SceneDescription) -> SceneDescription:
    """Hills without a colour of their own, under the snow that lies on all."""
    new = {n: replace(one, colour="white") for n, one in enumerate(description.objects)
           if one.colour is None and one.noun in nouns_with("of ground")}  # fmt: skip
    return description.replaced(new)


def _set_afloat(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """Things of no air that hover over water float on it."""
    new = {
        n: replace(one, motions=tuple(
            replace(each, kind="float") if each.kind == "hover" else each for each in one.motions
        ))
        for n, one in enumerate(description.objects)
        if nouns[one.noun].habitat in ("ground", "fixed") and one.height_m is None
    }  # fmt: skip
    return description.replaced(new)


def _set_down(description: SceneDescription) -> SceneDescription:
    """Small things stand on the usual support of their kind, as what they stand beside does."""
    relations = [*description.relations]
    for n, usual in _list_loose(description):
        nouns = [one.noun for one in description.objects]
        found = [nouns.index(name) for name in usual if name in nouns]
        relations += [IndexedRelation("on", n, (found[0],))] if found else []
    return replace(description, relations=tuple(relations))


def _list_loose(description: SceneDescription) -> Iterator[tuple[int, Sequence[str]]]:
    """Small things of which nothing says what bears them, and what usually does."""
    bound = {n for one in description.relations if one.kind not in (*SPACED, "at")
             for n in (one.subject, *one.targets)}  # fmt: skip
    for n, one in enumerate(description.objects):
        usual = trait_value("usual support", one.noun)
        is_put = one.position_m is not None or one.height_m is not None or one.placement is not None
        if usual and n not in bound and not is_put and not any(m.is_moving for m in one.motions):
            yield n, usual


def _list_floored(description: SceneDescription, place: str) -> Iterator[str]:
    """Notes on small things that a scene leaves on the floor of a room."""
    nouns = {one.noun for one in description.objects}
    for n, _ in _list_loose(description) if is_room(place) else ():
        noun = description.objects[n].noun
        if not (nouns & PERSON_NOUNS and noun in nouns_with("in hand or on something")):
            yield f"nothing carries the {noun}: it stands on the floor"


def waits_to_fall(one: SceneObject) -> bool:
    """Whether it is in the air at first, and falls later."""
    first = next((each.kind for each in one.motions if each.kind != "stand"), "")
    is_late = bool(one.motions) and (one.motions[0].kind == "stand" or one.motions[0].start_s)
    return first == "fall" and bool(is_late) and one.noun not in nouns_with("falls over")


def _note(description: SceneDescription, note: str) -> SceneDescription:
    return replace(description, notes=(*description.notes, note))


def _move(description: SceneDescription, motions: Mapping[int, Motion]) -> SceneDescription:
    """The description with motions of objects that have none."""
    objects = description.objects
    new = {n: replace(objects[n], motions=(one,)) for n, one in motions.items()
           if not objects[n].motions}  # fmt: skip
    return description.replaced(new)


def _lead_companions(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """Companions on foot, of whom one walks or runs: the other does so too."""
    objects, led = description.objects, dict[int, Motion]()
    said = [(one.subject, to) for one in description.relations if one.kind == "with"
            for to in one.targets]  # fmt: skip
    back = [(to, subject) for subject, to in said
            if {objects[to].noun, objects[subject].noun} <= PERSON_NOUNS]  # fmt: skip
    for subject, to in (*said, *back):
        motion = objects[subject].motion
        on_foot = all(nouns[objects[n].noun].motion == "walk" for n in (subject, to))
        if motion is not None and motion.kind in ("walk", "run") and on_foot:
            led[to] = Motion(motion.kind, motion.direction)
    return _move(description, led)


def _set_on_routes(
    description: SceneDescription, nouns: Mapping[str, Noun]
) -> SceneDescription:  # fmt: skip
    """Objects that a file sends on a route without a motion go; followers do in the same legs.

    Who has or handles something that goes towards or comes from somewhere stays.
    """
    objects = description.objects
    sends = {one.subject for one in description.relations if one.kind in ACTED | AT_HAND}
    routes = (one for one in description.relations
              if one.kind in _ROUTES
              and not (one.kind in ("towards", "from") and one.subject in sends))  # fmt: skip
    for one in routes:
        thing, to = objects[one.subject], objects[one.targets[0]]
        noun, leader = nouns[thing.noun], nouns[to.noun]
        bends = len(to.motions) > 1 or [each.kind for each in to.motions] == ["turn"]
        is_led = one.kind == "follow" and bends and all(map(_is_plain, thing.motions))
        is_said = thing.motions and not is_led
        if is_said or noun.speed_m_s <= 0.0 or noun.habitat == "fixed":
            continue
        motions: tuple[Motion, ...] = (Motion(_GOING.get(noun.motion, noun.motion)),)
        if one.kind == "follow":
            led = decide_motions(to.motions, leader)
            motions = tuple(_after(each, noun, leader) for each in led)
            own = thing.heading_deg
            thing = replace(thing, heading_deg=to.heading_deg if own is None else own)
        new = replace(thing, motions=motions)
        objects = tuple(new if n == one.subject else each for n, each in enumerate(objects))
    return replace(description, objects=objects)


def _is_plain(motion: Motion) -> bool:
    """Whether a motion says no more than that something goes."""
    return motion.kind in TRAVELLING | _GOES | {"move"} and replace(motion, kind="go") == _GO


def _after(motion: Motion, noun: Noun, leader: Noun) -> Motion:
    """A leg of who follows, as fast as that of its leader; it goes as it usually does."""
    if motion.kind not in TRAVELLING and motion.kind not in _GOES:
        return (
            motion
            if motion.kind in ("stand", "turn")
            else replace(STANDING, start_s=motion.start_s)
        )
    speed = motion.speed_m_s
    if speed is None:
        own = trait_value("speeds", leader.name) or {}
        speed = own.get(motion.kind, leader.speed_m_s) * motion.pace
    is_on_foot = noun.motion == "walk" and motion.kind in ("walk", "run")
    kind = motion.kind if is_on_foot else _GOING.get(noun.motion, noun.motion)
    pace = motion.pace if motion.end_pace is not None else 1.0
    return replace(motion, kind=kind, speed_m_s=speed, pace=pace)


def decide_motions(
    motions: Sequence[Motion], noun: Noun, heading_deg: float | None = None
) -> tuple[Motion, ...]:
    """Motions as they are staged, of one object by itself."""
    motions = aligned(motions, noun, heading_deg)
    if works_by_turns(motions, noun):
        return list_work(motions, noun)
    later = [_at_rate(one, noun) for one in motions[1:]]
    if [one.kind for one in motions] == ["break"] and _falls_to_break(noun):
        return (Motion("fall", start_s=motions[0].start_s), replace(motions[0], start_s=None))
    return (*_decide_motion(motions[0] if motions else None, noun), *later)


def _falls_to_break(noun: Noun) -> bool:
    """Whether what breaks does so on the floor: no balloon, no window."""
    stays = noun.habitat == "air" or noun.name in nouns_with("upright")
    return not stays and trait_value("pieces", noun.name) is not None


def _decide_motion(motion: Motion | None, noun: Noun) -> tuple[Motion, ...]:
    """The usual motion for "move", and for what always moves."""
    if noun.is_working and is_work(motion, noun):
        return (work_of(motion, noun),)
    if motion is None and noun.name in HAND_NOUNS:
        return (STANDING,)
    if motion is None:
        lives_there = noun.habitat in ("air", "water") and noun.motion != "stand"
        return (Motion(noun.motion),) if lives_there else ()
    if motion.kind == "move":
        is_lifted = motion.direction in _VERTICAL and noun.motion in ("stand", "roll")
        usual = "slide" if is_lifted else _GOING.get(noun.motion, noun.motion)
        motion = replace(motion, kind=usual)
    else:
        is_lifted = motion.kind == "slide" and noun.name in nouns_with("flat pattern")
    if motion.kind in ("hover", "float") and motion.direction in _UPRIGHT:
        motion = replace(motion, kind=_UPRIGHT[motion.direction], direction=None)
    if motion.kind in ("hover", "float") and noun.motion in AFLOAT_MOTIONS:
        motion = replace(motion, kind="sway", pace=_ROCKING * motion.pace)
    if is_lifted:  # what is flat goes in its own plane
        kind = _VERTICAL.get(motion.direction or "")
        way = motion.direction if kind in (None, "fly") else None
        motion = replace(motion, kind=kind or motion.kind, direction=way)
    if motion.kind == "turn" and noun.habitat == "fixed":
        motion = replace(motion, kind="spin", pace=0.5 * motion.pace)
    return (_at_rate(motion, noun),)


def _at_rate(motion: Motion, noun: Noun) -> Motion:
    """A spin at the pace that its turns per second are; only hands rotate, all else spins."""
    turns = motion.kind == "spin" or (motion.kind == "rotate" and noun.name not in HAND_NOUNS)
    if not turns or motion.rate_hz is None:
        return motion
    return replace(motion, kind="spin", pace=motion.rate_hz / SPIN_RATE_HZ)


def _rest(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """Rest for objects that relations only place, and for bicycles without a rider."""
    motions: dict[int, Motion] = {}
    for one in description.relations:
        motions.update(_rest_of(one, description.objects, nouns))
    is_plain = description.place.name is None and not description.camera.is_moving
    resting = nouns_with("lies still") | (
        nouns_with("parked unless ridden") if is_plain else frozenset()
    )
    ridden = _list_ridden(description)
    for n, thing in enumerate(description.objects):
        if thing.noun in resting and n not in ridden:
            motions.setdefault(n, STANDING)
    return _move(description, motions)


def _rest_of(
    relation: IndexedRelation, objects: Sequence[SceneObject], nouns: Mapping[str, Noun]
) -> dict[int, Motion]:
    """People on seats or at tables sit; objects whose motion would break a relation stand."""
    kind, target = relation.kind, objects[relation.targets[0]]
    is_person = objects[relation.subject].noun in PERSON_NOUNS
    seats = nouns_with("seat") | nouns_with("sat on")
    if kind == "at" or (kind in ("on", "in") and is_person and target.noun in seats):
        return {relation.subject: Motion("sit")}
    if kind == "in" or (kind == "on" and target.motion is None):
        return {relation.subject: STANDING}
    if kind == "through" and "stand open" in nouns[target.noun].acts:
        return {relation.targets[0]: Motion("stand open")}
    if kind in ("wear", "act on") or (kind == "hold" and is_person):
        return {relation.targets[0]: STANDING}
    if kind not in _RESTING:
        return {}
    members = {n: nouns[objects[n].noun] for n in (relation.subject, *relation.targets)}
    motion = objects[relation.subject].motion
    are_walkers = {one.motion for one in members.values()} == {"walk"}
    if kind == "beside" and motion and motion.kind in ("walk", "run", "move") and are_walkers:
        return dict.fromkeys(relation.targets, Motion(motion.kind, motion.direction))
    rests = (
        n for n, one in members.items() if one.habitat == "ground" or one.motion in AFLOAT_MOTIONS
    )
    return dict.fromkeys(rests, STANDING)


def _move_others(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """Motion for objects that are followed or overtaken; runners on a belt stay in place."""
    motions: dict[int, Motion] = {}
    new: dict[int, SceneObject] = {}
    kinds = [nouns[one.noun] for one in description.objects]
    for one in description.relations:
        target = one.targets[0]
        if one.kind in ("follow", "overtake") and kinds[target].speed_m_s > 0.0:
            motions[target] = Motion(kinds[target].motion)
        rider = description.objects[one.subject]
        runs = rider.motion is not None and rider.motion.kind in ("walk", "run")
        if one.kind == "on" and kinds[target].is_working and rider.motion and runs:
            done = replace(rider.motion, kind="run in place", direction=None)
            new[one.subject] = replace(rider, motions=(done, *rider.motions[1:]))
    if any(move.kind == "follow" for move in description.camera.moves):
        movers = [n for n, noun in enumerate(kinds) if noun.speed_m_s > 0.0]
        aim = description.index(description.camera.target)
        for n in movers[:1] if aim is None else {aim}.intersection(movers):
            motions[n] = Motion(kinds[n].motion)
    return _move(description.replaced(new), motions)


def _has_motion(description: SceneDescription, nouns: Mapping[str, Noun]) -> bool:
    moved = (
        one.blink_hz is not None
        or one.switch_s is not None
        or _flickers(one, nouns[one.noun])
        or len(one.motions) > 1
        or one.noun in nouns_with("flows")
        or (one.motion is not None and one.motion.is_moving and one.motion.kind != "sit")
        for one in description.objects
    )
    acts = any(one.kind in ACTED for one in description.relations)
    return description.camera.is_moving or bool(description.effects) or acts or any(moved)


def _flickers(thing: SceneObject, noun: Noun) -> bool:
    """Whether a lamp of what stays in its place changes by itself: a flame, a traffic light."""
    lamps = LAMPS.get(noun.name, ()) if thing.is_lit is not False and noun.motion == "stand" else ()
    return any(one.always_on and (one.blink_hz or one.own_hz or one.turns_hz) for one in lamps)


def _set_in_motion(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """Let the first object that can move do so, or else the camera."""
    held = {n for one in description.relations if one.kind in AT_HAND
            for n in (one.subject, *one.targets)}  # fmt: skip
    able = () if _stays_together(description, nouns) else tuple(enumerate(description.objects))
    for n, one in able:
        usual = _usual_motion(description, nouns[one.noun])
        if one.motion is None and usual != "stand" and n not in held:
            name = label_of(description, n)
            note = f"no motion is said of the {name}, so it does what it usually does"
            return _note(_move(description, {n: Motion(usual)}), note)
    light = description.light
    is_seen = any(one is not None for one in (light.flicker_hz, *(
        lamp.frequency_hz for lamp in light.lamps)))  # fmt: skip
    if is_seen or description.place.weather in ("rain", "snow"):
        return description
    if description.camera.moves:
        note = "nothing moves in the prompt and the camera is static: there will be no events"
        return _note(description, note)
    camera = replace(description.camera, moves=(SWAY,))
    note = "nothing moves in the prompt, so the camera sways a little, as in a hand"
    return _note(replace(description, camera=camera), note)


def _stays_together(description: SceneDescription, nouns: Mapping[str, Noun]) -> bool:
    """Whether one object that goes off would leave the others behind."""
    others = [nouns[one.noun] for one in description.objects if one.noun not in PERSON_NOUNS]
    if len(others) == len(description.objects):
        return len(others) > 1
    return bool(others) and all(noun.habitat == "fixed" for noun in others)


def _usual_motion(description: SceneDescription, noun: Noun) -> str:
    """Motion of a noun if nothing else moves: people stay in a close shot, cars in a room."""
    place, is_person = description.place.name, noun.name in PERSON_NOUNS
    if is_person and (place == "space" or description.camera.framing in ("close", "medium")):
        return "hover" if place == "space" else "stand"
    is_parked = place is None or is_room(place)
    return "stand" if noun.motion == "drive" and is_parked else noun.motion


def _list_ridden(description: SceneDescription) -> set[int]:
    """Objects with a rider or a person on them, and those that collide: they are on the way."""
    relations, objects = description.relations, description.objects
    ridden = {n for one in relations for n in one.targets if one.kind == "ride"
              or (one.kind == "on" and objects[one.subject].noun in PERSON_NOUNS)}  # fmt: skip
    return ridden | {one.subject for one in relations if one.kind in ("collide", "knock over")}


def _park(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """Vehicles that only stand have no rider; birds have their wings spread as they fly.

    A note names animals that have no such form: a penguin that flies.
    """
    ridden, new, grounded = _list_ridden(description), {}, dict.fromkeys("")
    for n, one in enumerate(description.objects):
        kinds = {motion.kind for motion in one.motions}
        is_parked = n not in ridden and kinds == {"stand"}
        variants = {f"parked {one.noun}"} if is_parked else set()
        variants |= {f"flying {one.noun}"} if kinds & _FLYING else set()
        for each in nouns.keys() & variants:
            new[n] = replace(one, noun=each)
        noun, is_aloft = nouns[one.noun], bool(kinds & {"fly", "glide"})
        if is_aloft and n not in new and noun.motion == "walk" and noun.name not in PERSON_NOUNS:
            grounded[noun.name] = None
    for each in grounded:
        told = f"the {each} has no wings to fly with, and is drawn as it stands"
        description = _note(description, told)
    return description.replaced(new)


def _darken(description: SceneDescription) -> SceneDescription:
    """Lights of sentences flash or blink in the dark, unless they say otherwise."""
    objects, patterns = description.objects, nouns_with("flat pattern")
    is_seen = any(one.kind in _DARK_EFFECTS for one in description.effects)
    is_seen |= any(one.noun in nouns_with("seen in the dark") for one in objects)
    is_seen |= any(one.blink_hz is not None and one.noun not in patterns for one in objects)
    if description.light.kind is not None or not (is_seen and description.is_sentence):
        return description
    description = replace(description, light=replace(description.light, kind="night"))
    return _note(description, "it is dark, so that the light that changes is seen")
