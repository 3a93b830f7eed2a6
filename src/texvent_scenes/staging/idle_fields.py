"""Fields of a scene that change nothing: those of objects are found by leaving them out.

Each motion is put on its body twice, with a field and without it, and what is drawn is compared. So
no table says which motion of which noun reads which field, and none can be wrong. Camera moves,
places and light have tables: `READ_BY_MOVES`, and the conditions below.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import fields, replace
from functools import lru_cache
from itertools import islice
from typing import Any, get_args

import numpy as np

from texvent.errors import few, shown
from texvent_scenes.colours import rgb_of
from texvent_scenes.default_work import stays_put
from texvent_scenes.defaults import decide_motions
from texvent_scenes.description import STANDING, to_description
from texvent_scenes.models.effects import LAMPS
from texvent_scenes.models.materials import PATTERNED, in_material
from texvent_scenes.models.nouns import MOTIONS
from texvent_scenes.models.people.outfit import CLOTHES
from texvent_scenes.models.protocol import Model, Noun, Pose
from texvent_scenes.models.tables import nouns_with, trait_values
from texvent_scenes.spec.data import PLACING, scene_from_data, scene_to_data, steps_of
from texvent_scenes.spec.scene import (
    Material,
    Motion,
    MoveDirection,
    MoveKind,
    Scene,
    SceneObject,
    object_ids,
)
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.idle_surroundings import MOST_NAMED, Idle, idle_light, idle_place
from texvent_scenes.staging.interactions.settling import in_hand
from texvent_scenes.staging.tracks.choose_track import choose_track
from texvent_scenes.staging.tracks.keys import GRAVITY_M_S2
from texvent_scenes.staging.tracks.motion_plan import plan_motion
from texvent_scenes.staging.tracks.phases import PATH_KINDS, YAWS, fits_in_hand, rests_in_hand
from texvent_scenes.staging.tracks.track import TO_CAMERA

RESTS = frozenset({"stand", "stand open", "stand closed", "sit", "lie", "hang", "move"})
"""Motions that say no more than a noun does anyway."""
_ALIKE = (
    ("left", "right", "towards", "away", "forward", "backward", "up", "down"),
    ("clockwise", "counter-clockwise"),
)
"""Directions of travel and of turns: if one of them changes something, each says something."""
_OPPOSITE = (("left", "right"), ("towards", "away"), ("forward", "backward"), ("up", "down"))
TURNS = ("left", "right", "clockwise", "counter-clockwise", "towards", "away", "around", "backward")
"""Directions of a turn: left and right are the driver's, "towards" and "away" where it then heads.
"""
_SHARES = (0.0, 0.07, 0.13, 0.21, 0.29, 0.41, 0.5, 0.6, 0.71, 0.83, 0.97)
"""Instants at which bodies are compared, as shares of the time up to the last start, and after."""
_UPRIGHT = {"rise": "up", "sink": "down"}
_USUAL_S = 2.0
_ALIKE_M = 1e-9
"""Most difference between what is alike; comparing costs a quarter of what `np.allclose` does."""
_MOST_KINDS = 12
"""Most kinds of motion that an error names."""
_LANDING_S = 0.02
"""Most difference between a stated time of a landing and that by gravity, s."""
_TURNS, _SHIFTS = (
    frozenset({"direction", "pace", "rate_deg_s"}),
    frozenset({"direction", "pace", "speed_m_s"}),
)
READ_BY_MOVES: Mapping[MoveKind, frozenset[str]] = {
    "static": frozenset(), "follow": frozenset(), "handheld": frozenset({"direction", "pace"}),
    **dict.fromkeys(("pan", "tilt", "roll", "orbit", "zoom"), _TURNS),
    **dict.fromkeys(("dolly", "truck", "pedestal"), _SHIFTS),
    "travel": _SHIFTS | {"means"},
}  # fmt: skip
"""Kind of camera move → its fields, beside those of time, that it reads."""
DIRECTIONS_OF_MOVES: Mapping[MoveKind, tuple[MoveDirection, ...]] = {
    "pan": ("left", "right"), "truck": ("left", "right"),
    "orbit": ("left", "right", "clockwise", "counter-clockwise"),
    "roll": ("left", "right", "clockwise", "counter-clockwise"),
    "tilt": ("up", "down"), "pedestal": ("up", "down"),
    "zoom": ("in", "out"), "dolly": ("in", "out", "forward", "backward"),
    "travel": ("forward", "backward"), "handheld": ("all axes",),
}  # fmt: skip
"""Kind of camera move → directions that it goes."""


@lru_cache(maxsize=128)
def _model(noun: Noun) -> Model:
    return noun.build(colour=None, scale=1.0, seed=0)


class _Body:
    """A noun's model, on which motions are tried out."""

    def __init__(self, noun: Noun, *, is_held: bool = False) -> None:
        self.noun, self.is_held = noun, is_held
        self._actors: dict[tuple[SceneObject, float], Actor] = {}

    def _put_on(self, one: SceneObject, duration_s: float) -> Actor:
        """An object on its track; each field is compared with the same few."""
        actor = self._actors.get((one, duration_s))
        if actor is None:
            actor = self._actors[one, duration_s] = self._track(one, duration_s)
        return actor

    def _track(self, one: SceneObject, duration_s: float) -> Actor:
        motions = decide_motions(one.motions, self.noun, one.heading_deg) or (STANDING,)
        rng, model = np.random.default_rng(0), _model(self.noun)
        plan = plan_motion(
            motions, self.noun, model, duration_s, rng, one.height_m, one.heading_deg
        )  # fmt: skip
        track = choose_track(plan, model, (0.0, 0.0, one.height_m or 1.0), rng)
        crosses = motions[0].direction == "across"
        return Actor(0, self.noun, model, track, True, 1, goes_across=crosses)

    def shows_front(self, one: SceneObject) -> bool:
        """Whether its front is at the camera at time 0."""
        track = self._put_on(one, _USUAL_S).track
        return track.is_facing or abs(math.remainder(track.at(0.0).yaw - TO_CAMERA, math.tau)) < 0.1

    def differ(self, one: SceneObject, other: SceneObject) -> bool:
        """Whether what is drawn of two objects is not the same."""
        starts = (each.start_s or 0.0 for each in (*one.motions, *other.motions))
        start_s = max(starts, default=0.0)
        duration_s = _USUAL_S + start_s
        actors = [self._put_on(each, duration_s) for each in (one, other)]
        first, second = actors
        times = [start_s + share * _USUAL_S for share in _SHARES]
        times += [share * start_s for share in _SHARES if start_s]
        if first.goes_across != second.goes_across or any(map(_is_apart(*actors), times)):
            return True
        return any(not _look_alike(first, second, time_s) for time_s in times)

    def reads(self, one: SceneObject, number: int, name: str) -> bool:
        """Whether a field of a motion changes anything, at its value or at others of its kind."""
        if one.motions[number].kind == "break":
            return name in ("pace", "start_s")
        usual = Motion("stand")
        without = _with(one, number, **{name: getattr(usual, name)})
        given = getattr(one.motions[number], name)
        tried = probes(given)
        is_turn = one.motions[number].kind == "turn"
        is_headed = one.heading_deg is not None and not is_turn
        # It may go to and fro along one way, or turn to either side of it.
        if name == "direction" and (self.noun.is_working or is_headed):
            tried = next((pair for pair in _OPPOSITE if given in pair), tried)
        return any(self.differ(_with(one, number, **{name: probe}), without) for probe in tried)

    def lands_at(self, one: SceneObject, number: int) -> float | None:
        """Instant at which it is down before it bounces, s; None where nothing falls before."""
        before = one.motions[number - 1] if number else None
        if one.motions[number].kind != "bounce" or before is None or before.kind != "fall":
            return None
        track = self._put_on(one, _USUAL_S + (one.motions[number].start_s or 0.0)).track
        begin_s = 0.0
        for key in track.keys:
            if key.restitution is not None:
                drop_m = max(track.at(begin_s).position[2] - track.floor_m, 0.0)
                return begin_s + math.sqrt(2.0 * drop_m / GRAVITY_M_S2)
            begin_s += key.duration_s
        return None

    def does(self, one: SceneObject, number: int) -> bool:
        """Whether a motion of it is any other than rest, or, at the end of a list, than none."""
        motion = one.motions[number]
        if motion.kind == "break":
            return self.noun.name in trait_values("pieces")
        decided = decide_motions(one.motions, self.noun, one.heading_deg)
        works = self.noun.is_working and decided[0].kind == "work"
        if not number and (motion.kind in RESTS or works):
            return True
        if motion.kind in RESTS:
            shorter = (*one.motions[:number], *one.motions[number + 1 :])
            return self.differ(one, replace(one, motions=shorter))
        return self.differ(one, _with(one, number, kind="stand", direction=None))


def _is_apart(one: Actor, other: Actor) -> Callable[[float], bool]:
    """Whether two bodies are at different places at an instant, or turned differently."""

    def check(time_s: float) -> bool:
        a, b = (each.track.at(time_s).to_world() for each in (one, other))
        return not np.abs(a - b).max() <= _ALIKE_M

    return check


def _look_alike(one: Actor, other: Actor, time_s: float) -> bool:
    first, second = one.pose(time_s), other.pose(time_s)
    return first == second or all(
        a.emission == b.emission and np.abs(a.to_body - b.to_body).max() <= _ALIKE_M
        for a, b in zip(one.own_parts(first), other.own_parts(second), strict=True)
    )


def _with(one: SceneObject, number: int, **changes: Any) -> SceneObject:
    """An object with other fields of one of its motions."""
    motions = list(one.motions)
    motions[number] = replace(motions[number], **changes)
    return replace(one, motions=tuple(motions))


def probes(given: Any) -> Iterable[Any]:
    """The value of a field, and others that say something of the same kind."""
    if isinstance(given, str):
        alike = [kind for kinds in _ALIKE if given in kinds for kind in kinds]
        return dict.fromkeys((given, *alike))
    return (given, 1.7 * given + 0.3)


def list_idle(scene: Scene, decided: Scene, nouns: Mapping[str, Noun]) -> Iterator[Idle]:
    """Fields of a scene that change nothing, and why; the place is that of the decided scene."""
    ids = object_ids(scene)
    bound = {
        id for one, own in zip(scene.objects, ids, strict=True)
        for each in one.relations if each.kind not in PLACING for id in (own, *each.to)
    }  # fmt: skip
    held = dict(_list_held(scene, ids))
    for number, one in enumerate(scene.objects):
        holder = held.get(ids[number])
        where, body = f"objects[{number}]", _Body(nouns[one.noun], is_held=holder is not None)
        yield from _idle_looks(where, one, body.noun)
        # What an act, a route or a companion makes of a motion is not seen on one body alone.
        if holder is not None:
            yield from _idle_in_hand(where, one, body, holder)
        elif ids[number] not in bound:
            yield from _idle_motions(where, one, body)
    yield from _idle_moves(scene)
    yield from idle_light(scene)
    yield from idle_place(scene, decided.place.name or "")


def leave_out(scene: Scene, idle: Iterable[Idle]) -> Scene:
    """The scene without these fields; a motion that a noun does not do is rest, if it can rest."""
    data = scene_to_data(scene)
    for path in (one.path for one in idle):
        *way, last = steps_of(path)
        place: Any = data
        for step in way:
            place = place[step]
        if last == "kind":
            kept = {name: place[name] for name in ("start_s",) if name in place}
            rest = {} if place["kind"] in RESTS else {"kind": "stand", **kept}
            place.clear()
            place |= rest
        else:
            place.pop(last, None)
    for one in data.get("objects", ()):
        if "motions" in one:
            one["motions"] = [motion for motion in one["motions"] if motion]
    return scene_from_data(data)


def _idle_looks(where: str, one: SceneObject, noun: Noun) -> Iterator[Idle]:
    """Fields that would change the looks of an object."""

    def build(colour: str | None, material: str | None) -> list[tuple[Any, ...]]:
        paint = rgb_of(colour)
        model = noun.build(colour=paint, scale=1.0, seed=0)
        parts = in_material(model, material, paint).parts(Pose(0.0, 0.0, 0.0, "stand"))
        return [(each.colour, each.second_colour, each.texture, each.mesh) for each in parts]

    if one.colour is not None:
        tried = [build(each, one.material) for each in (one.colour, "red", "blue")]
        if all(each == tried[0] for each in tried):
            yield Idle(f"{where}.colour", f"a {one.noun} has colours of its own")
    is_mesh = any(mesh is not None for *_, mesh in build(None, None))
    kept = one.colour if is_mesh else None
    usual = build(kept, None)
    if one.material is not None and build(kept, one.material) == usual:
        others = (each for each in get_args(Material) if build(None, each) != usual)
        is_usual = not is_mesh and next(others, None) is not None
        why = f"a {one.noun} is of it anyway, or cannot be of any other"
        why = "a model of a file has only the colour of a material" if is_mesh else why
        yield Idle(f"{where}.material", why, is_usual)
    if one.second_colour is not None and one.material not in PATTERNED:
        why = f"only what is {' or '.join(PATTERNED)} has two colours: give it such a material"
        yield Idle(f"{where}.second_colour", why)
    for name in ("blink_hz", "switch_s", "is_lit"):
        has_light = noun.name in LAMPS or noun.name in nouns_with("own effect")
        has_light |= name == "blink_hz" and noun.name in nouns_with("flat pattern")
        if getattr(one, name) is not None and not has_light:
            known = few(sorted(LAMPS), MOST_NAMED)
            why = f"a {one.noun} has no lamp; these have: {known}"
            yield Idle(f"{where}.{name}", why, getattr(one, name) is False)
    yield from _idle_parts(where, one, noun)
    if one.placement is not None and one.position_m is not None:
        yield Idle(f"{where}.placement", "position_m takes its place; leave one of them out")


def _idle_parts(where: str, one: SceneObject, noun: Noun) -> Iterator[Idle]:
    """Numbers and colours of parts that a noun does not have, or not so many."""
    for number, own in enumerate(one.parts):
        path, choice = f"{where}.parts[{number}]", noun.find_choice(own.name)
        before = [each.name for each in one.parts[:number]]
        if choice is None or choice.name != own.name or own.name in before:
            known = few([each.name for each in noun.choices], MOST_NAMED) or "no others"
            yield Idle(f"{path}.name", f"a {one.noun} may have, each given once: {known}")
            continue
        if own.count is not None and own.count > choice.most:
            most = f"1 to {choice.most}" if choice.most else "always as many"
            yield Idle(f"{path}.count", f"a {one.noun} has {most} {own.name}")
        if own.colour is not None and not choice.is_coloured:
            yield Idle(f"{path}.colour", f"{own.name} of a {one.noun} have the colour of the whole")


def _idle_motions(where: str, one: SceneObject, body: _Body) -> Iterator[Idle]:
    for number, motion in enumerate(one.motions):
        path = f"{where}.motions[{number}]"
        if motion.kind == "move" and stays_put(motion, body.noun):
            why = f"a {one.noun} stays where it is; 'work' runs its belt to the left or right"
            yield Idle(f"{path}.kind", f"{why} at speed_m_s, 'slide' moves all of it")
            continue
        if not body.does(one, number):
            is_aside = motion.kind == "move" and None not in (motion.direction, one.heading_deg)
            is_usual = motion.kind in RESTS
            is_usual &= not is_aside or body.reads(one, number, "direction")
            yield Idle(f"{path}.kind", _why_not_done(body, one, motion.kind), is_usual)
            continue
        for each in fields(Motion):
            given, usual = getattr(motion, each.name), each.default
            if each.name == "kind" or given == usual or motion.kind in RESTS - {"move"}:
                continue
            is_no_turn = motion.kind == "turn" and each.name == "direction"
            if is_no_turn and given not in TURNS:
                yield Idle(f"{path}.direction", f"a turn goes: {', '.join(TURNS)}")
            elif not body.reads(one, number, each.name):
                why = _who_reads(body, one, number, each.name)
                yield Idle(f"{path}.{each.name}", why, _is_usual(body, one, number, each.name))
    if one.heading_deg is not None:
        yield from _idle_heading(f"{where}.heading_deg", one, one.heading_deg, body)


def _idle_heading(path: str, one: SceneObject, said_deg: float, body: _Body) -> Iterator[Idle]:
    bare = replace(one, heading_deg=None)
    turned = (replace(one, heading_deg=angle) for angle in (said_deg, 17.0, 101.0))
    if any(body.differ(each, bare) for each in turned):
        return
    why = f"the motion of a {one.noun} decides where it heads"
    if body.shows_front(one):
        why = f"a {one.noun} shows its front to the camera then: its heading is -90"
    yield Idle(path, why, abs(math.remainder(said_deg + 90.0, 360.0)) < 1e-9)


def _list_held(scene: Scene, ids: Sequence[str]) -> Iterator[tuple[str, str]]:
    """Id of each thing that is in a hand or worn → id of who has it."""
    for one in in_hand(to_description(scene).relations, scene.objects):
        if one.kind in ("hold", "wear"):
            held = one.targets if one.kind == "wear" else one.targets[:1]
            yield from ((ids[number], ids[one.subject]) for number in held)


def _idle_in_hand(where: str, one: SceneObject, body: _Body, holder: str) -> Iterator[Idle]:
    """Fields of what is held that its holder decides, and of its motions in the hand."""
    why = f"it is held: its place is that of {shown(holder)}, to which the field belongs"
    for name in ("position_m", "height_m", "heading_deg", "placement"):
        if getattr(one, name) is not None:
            yield Idle(f"{where}.{name}", why)
    is_clothing = one.noun in CLOTHES
    unfit = [number for number, motion in enumerate(one.motions)
             if not rests_in_hand(motion, body.noun)
             and (is_clothing or not fits_in_hand(motion, body.noun))]  # fmt: skip
    for number in unfit:
        kind = one.motions[number].kind
        yield Idle(
            f"{where}.motions[{number}].kind",
            f"a {one.noun} that is held does not {kind}; give {shown(holder)} the motion, or leave "
            "out the relation; in a hand it can tilt, sway, rotate, spin",
        )
    if not unfit:
        yield from _idle_motions(where, one, body)


def _why_not_done(body: _Body, one: SceneObject, kind: str) -> str:
    """Why a motion of an object has no effect, and which have one."""
    if kind in RESTS:
        return f"a {one.noun} goes on with what it did"
    if len(one.motions) > 1 and body.does(replace(one, motions=(Motion(kind),)), 0):
        return f"a {one.noun} has done that before, or has no time for it; leave it out"
    kinds = _name_kinds(body, lambda other: body.does(other, 0))
    return f"a {one.noun} does not do that, it shows: {kinds}"


def _name_kinds(body: _Body, holds: Callable[[SceneObject], bool]) -> str:
    """The first kinds of motion of a noun for which something holds, its usual one before all."""
    usual = [body.noun.motion, *sorted(body.noun.acts)]
    kinds = [kind for kind in dict.fromkeys((*usual, *sorted(MOTIONS))) if kind not in RESTS
             and not (body.is_held and not fits_in_hand(Motion(kind), body.noun))]  # fmt: skip
    does = (kind for kind in kinds
            if holds(SceneObject(body.noun.name, motions=(Motion(kind),))))  # fmt: skip
    named = list(islice(does, _MOST_KINDS + 1))
    more = " and others of `texvent scenes`" if len(named) > _MOST_KINDS else ""
    return ", ".join(named[:_MOST_KINDS]) + more


def _who_reads(body: _Body, one: SceneObject, number: int, name: str) -> str:
    """Why a field of a motion has no effect, and what would give it one."""
    motion = one.motions[number]
    if name == "pace" and motion.speed_m_s is not None:
        return "speed_m_s takes its place; leave one of them out"
    bare = replace(one, heading_deg=None)
    if name == "direction" and bare != one and body.reads(bare, number, name):
        return "heading_deg takes its place; leave one of them out"
    if name == "direction" and motion.kind in _UPRIGHT:
        straight = f"{shown(motion.kind)} of a {one.noun} goes straight {_UPRIGHT[motion.kind]}"
        return f"{straight}; leave it out, or give that direction a motion of its own"
    given = getattr(motion, name)
    if name == "start_s" and (landing_s := body.lands_at(one, number)) is not None:
        return (f"what falls bounces as soon as it is down, at {landing_s:.3f} s; leave it out, or "
                "change the height or the start of the fall")  # fmt: skip
    alone = replace(one, motions=(motion,))
    if number and body.reads(alone, 0, name):
        before = shown(one.motions[number - 1].kind)
        return (f"after {before}, {shown(motion.kind)} of a {one.noun} does not read it, for "
                f"{before} decides; leave it out")  # fmt: skip
    readers = _name_kinds(
        body, lambda other: _keeps_place(body.noun, other.motions[0])
        and body.reads(_with(other, 0, **{name: given}), 0, name),
    )  # fmt: skip
    if name == "rate_hz" and motion.kind in PATH_KINDS:
        readers = f'{readers}; or direction "to and fro"'
    left = f"these do: {readers}" if readers else f"no motion of a {one.noun} does"
    if not readers and (read := [*_list_read(body, one, number)]):
        if name in read:
            along = "" if one.heading_deg is None else f" with a heading_deg of {one.heading_deg:g}"
            return (f"{shown(motion.kind)} of a {one.noun}{along} takes another {name} than "
                    f"{shown(given)}; leave it out")  # fmt: skip
        left = f"it reads {', '.join(read)}"
    return f"{shown(motion.kind)} of a {one.noun} does not read it; {left}"


def _keeps_place(noun: Noun, motion: Motion) -> bool:
    """Whether a motion leaves a noun where it belongs: machines work, others go too."""
    return not noun.is_working or motion.kind == "work"


def _list_read(body: _Body, one: SceneObject, number: int) -> Iterator[str]:
    """Fields that a motion reads, its times left out."""
    usual = {"direction": ("left", "clockwise"), "pace": (0.5,), "end_pace": (0.0,),
             "speed_m_s": (0.3,), "rate_hz": (1.3,)}  # fmt: skip
    for name, values in usual.items():
        tried = (_with(one, number, **{name: value}) for value in values)
        if any(body.reads(each, number, name) for each in tried):
            yield name


def _is_usual(body: _Body, one: SceneObject, number: int, name: str) -> bool:
    """Whether a field without effect says what is so anyway."""
    motion = one.motions[number]
    if name == "direction" and _UPRIGHT.get(motion.kind) == motion.direction:
        return True
    if name == "direction" and one.heading_deg is not None and motion.direction in YAWS:
        turn = one.heading_deg - math.degrees(YAWS[motion.direction])
        return abs(math.remainder(turn, 360.0)) < 1e-9
    if name != "start_s" or motion.start_s is None:
        return False
    landing_s = body.lands_at(one, number)
    return landing_s is not None and abs(motion.start_s - landing_s) <= _LANDING_S


def _idle_moves(scene: Scene) -> Iterator[Idle]:
    camera = scene.camera
    for number, move in enumerate(camera.moves):
        path, read = f"camera.moves[{number}]", READ_BY_MOVES[move.kind]
        for name in ("direction", "pace", "means", "speed_m_s", "rate_deg_s"):
            if getattr(move, name) in (None, 1.0):
                continue
            if name not in read:
                kinds = ", ".join(kind for kind, known in READ_BY_MOVES.items() if name in known)
                yield Idle(f"{path}.{name}", f"{shown(move.kind)} does not read it; "
                           f"these do: {kinds}")  # fmt: skip
            elif name == "direction" and move.direction not in DIRECTIONS_OF_MOVES[move.kind]:
                known = ", ".join(DIRECTIONS_OF_MOVES[move.kind])
                yield Idle(f"{path}.{name}", f"{shown(move.kind)} goes: {known}")
            elif name == "pace" and (move.speed_m_s, move.rate_deg_s) != (None, None):
                yield Idle(f"{path}.pace", "the stated speed takes its place; leave one out")
    chosen = "position_m" if camera.position_m is not None else None
    chosen = "travel" if any(one.kind == "travel" for one in camera.moves) else chosen
    for name in ("framing", "view") if chosen == "position_m" else ("framing",) if chosen else ():
        if getattr(camera, name) is not None:
            yield Idle(f"camera.{name}", f"{chosen} decides what is in the picture")
