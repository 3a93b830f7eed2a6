"""Whether objects move as the prompt says, and stand on something while they do."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from texvent.scenes.description import STANDING, ObjectMotion, SceneDescription
from texvent.scenes.evidence import Unmet
from texvent.scenes.inflection import pluralise
from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.scene import Environment, Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.acts import ACTS
from texvent.scenes.staging.acts.attached import HeldAt
from texvent.scenes.staging.camera.camera_path import CameraPath
from texvent.scenes.staging.claims.bodies import gap, part_boxes
from texvent.scenes.staging.surroundings.road import RoadLine
from texvent.scenes.staging.surroundings.wading import find_water
from texvent.scenes.staging.surroundings.waterside import WATERSIDE
from texvent.scenes.staging.trajectories.phases import PATH_KINDS
from texvent.scenes.staging.trajectories.schedule import Phase, schedule
from texvent.scenes.wording import describe_motion

_SAMPLES = 13
"""Instants of a phase."""
_LEAST_WAY = 0.15
"""Share of the way, or of the own size per second, that must go in the direction said."""
_TELLING_S = 0.5
"""Shorter turns, jumps and falls may be too small to tell, and count as shown."""
_LEAST_TURN = 0.35
_HALF_TURN = 2.0
_REST_SHARE = 0.1
"""Share of its size that what has stopped may still move."""
_CLEAR = 0.15
"""Share of its height at which a body on the ground may be above it."""
_CARRIED = frozenset({"on", "in", "above", "with", "hold", "around", "wear", "through", "under"})
"""Relations that may keep a body off the ground."""
_ON_GROUND = frozenset({"drive", "walk", "run", "roll", "crawl", "stand"})
_LEAST_CROSSED = 0.25
"""Share of a road's width that who crosses it goes at least, over its middle."""
_GOING = PATH_KINDS | {"enter", "leave", "reverse", "throw"}
_NO_GROUND = ("sky", "space", "underwater")
_ON_WATER = ("sea",)
_ROADS = ("road", "dirt road", "city")
_OWN_LIMBS = frozenset({"walk", "run", "climb", "crawl"})
"""Motions across a road, not across the picture."""


@dataclass(frozen=True)
class Stage:
    """What acts are checked against."""

    description: SceneDescription
    actors: Sequence[Actor]
    camera: CameraPath
    environment: Environment
    place: str
    duration_s: float


def list_acts_not_shown(stage: Stage) -> list[Unmet]:
    """Motions of the prompt that the scene does not show, such as "dog runs towards the camera".

    What rides, is ridden, kicked, carried or led has its motion from another one: relations check
    it.
    """
    missing = []
    relations = stage.description.relations
    bound = {target for one in relations if one.kind in ACTS for target in one.targets}
    bound |= {one.subject for one in relations if one.kind in _MOVED_BY_OTHERS}
    carried = {one.subject for one in relations if one.kind in _CARRIED} | bound
    carried |= {target for one in relations if one.kind in _CARRIED for target in one.targets}
    carried |= {one.subject for one in relations if one.way in _OVER_THINGS}
    for index, scene_object in enumerate(stage.description.objects):
        copies = [actor for actor in stage.actors if actor.object_index == index]
        if not copies:
            continue
        is_plural = scene_object.count > 1
        name = pluralise(scene_object.noun) if is_plural else scene_object.noun
        if scene_object.side == "lane" and not all(_is_on_road(stage, one) for one in copies):
            missing.append(Unmet(f"{name} on the road"))
        if index not in carried and not _has_support(stage, copies[0]):
            missing.append(Unmet(f"{name} on the ground"))
        if scene_object.motion is None or index in bound or _is_in_hand(copies[0]):
            continue
        said = (scene_object.motion, *scene_object.then)
        missing += [
            Unmet(f"{name} {motion.shore} the water")
            for motion in said
            if motion.shore and not all(_goes_to_water(stage, one, motion) for one in copies)
        ]
        if said == (STANDING,) and not _is_told(stage, index):
            continue
        for phase in schedule(said, stage.duration_s):
            if not _is_shown(stage, copies[0], phase, is_carried=index in carried):
                text = f"{name} {_describe(stage, phase.motion, is_plural=is_plural)}"
                number = next((n for n, one in enumerate(said) if one is phase.motion), 0)
                missing.append(Unmet(text, motion=(index, number)))
    return missing


def _is_told(stage: Stage, index: int) -> bool:
    """Whether a word of the prompt says what an object does, or that it rests."""
    claims = stage.description.claims
    return any(one.aspect == "motion" and index in one.things for one in claims)


_OVER_THINGS = frozenset({"off", "onto", "into", "out of", "through", "up", "down"})
"""Ways of which a relation says where they begin or end."""


def _is_in_hand(actor: Actor) -> bool:
    """Whether it goes with the hand of who eats it or plays it, which no word says."""
    return isinstance(actor.trajectory, HeldAt)


_SINGLE = tuple(name for name, act in ACTS.items() if act.is_single)
_MOVED_BY_OTHERS = ("ride", "ride along", "follow", *_SINGLE)


def _describe(stage: Stage, motion: ObjectMotion, *, is_plural: bool) -> str:
    """As in "walks across the road"; without its speed."""
    words = describe_motion(replace(motion, pace=1.0, speed_m_s=None), is_plural=is_plural)
    is_road = motion.kind in _OWN_LIMBS and stage.place in _ROADS
    return words.replace("across the picture", "across the road") if is_road else words


def _is_shown(stage: Stage, actor: Actor, phase: Phase, *, is_carried: bool) -> bool:
    """Whether a body moves as a phase says."""
    motion = phase.motion
    times = np.linspace(phase.start_s, phase.end_s, _SAMPLES)
    places = np.array([actor.middle(float(t)) for t in times])
    if motion.kind == "stand":
        late = places[2 * _SAMPLES // 3 :]
        is_still = float(np.linalg.norm(np.ptp(late, axis=0))) < _REST_SHARE * actor.size_m
        return is_carried or is_still
    if motion.kind == "climb":
        return _is_at_something(stage, actor, float(times[_SAMPLES // 2]))
    length_s = phase.end_s - phase.start_s
    if length_s < _TELLING_S and motion.kind in ("turn", "jump", "bounce", "rise", "fall", "sink"):
        return True
    if motion.kind == "turn":
        return _turns(actor, motion, times)
    if motion.kind in ("jump", "bounce"):
        low = [part_boxes(actor, float(t)).hull[0][2] for t in times]
        return float(np.ptp(low)) > 0.04 * actor.size_m
    if motion.kind in ("rise", "fall", "sink"):
        return _goes_up_or_down(stage, actor, motion, times)
    is_gesture = motion.kind == "throw" and actor.noun.name in PERSON_NOUNS
    if motion.kind not in _GOING or is_carried or is_gesture:
        return True
    return _goes(stage, actor, motion, places, times)


def _turns(actor: Actor, motion: ObjectMotion, times: Float64Array) -> bool:
    """Its heading changes to the side that is said; left is anticlockwise from above."""
    headings = np.unwrap([actor.trajectory.at(float(t)).yaw for t in times])
    change = headings - headings[0]
    if motion.direction == "left":
        return bool(change.max() > _LEAST_TURN)
    if motion.direction == "right":
        return bool(change.min() < -_LEAST_TURN)
    least = _HALF_TURN if motion.direction == "around" else _LEAST_TURN
    return bool(np.abs(change).max() > least)


def _goes_up_or_down(stage: Stage, actor: Actor, motion: ObjectMotion, times: Float64Array) -> bool:
    """Its middle or its top rises or falls; what falls over does so to the side that is said."""
    first, last = (part_boxes(actor, float(t)).hull for t in (times[0], times[-1]))
    sign = 1.0 if motion.kind == "rise" else -1.0
    change = max(sign * (last[1][2] - first[1][2]), 0.5 * sign * float((last[0] + last[1]
                 - first[0] - first[1])[2]))  # fmt: skip
    if motion.direction in ("left", "right"):
        right = stage.camera.at(float(times[0])).rotation[0]
        aside = 0.5 * float((last[0] + last[1] - first[0] - first[1]) @ right)
        if aside * (1.0 if motion.direction == "right" else -1.0) < 0.0:
            return False
    return bool(change > _LEAST_WAY * actor.model.height)


def _goes(
    stage: Stage, actor: Actor, motion: ObjectMotion, places: Float64Array, times: Float64Array
) -> bool:
    """It leaves its place, in the direction that is said, as the camera sees it."""
    way = float(np.sum(np.linalg.norm(np.diff(places, axis=0), axis=1)))
    length_s = min(1.0, float(times[-1] - times[0]))
    if motion.speed_m_s is None and way < _LEAST_WAY * actor.size_m * length_s:
        return False
    least = _LEAST_WAY * way
    shift = places[-1] - places[0]
    direction = motion.direction
    if direction in ("up", "down") and motion.kind in ("fly", "float", "swim"):
        return bool(shift[2] * (1.0 if direction == "up" else -1.0) > 0.0)
    if direction == "across" and motion.kind in _OWN_LIMBS:
        return _crosses(stage, actor)
    if any(move.kind in ("follow", "orbit", "travel") for move in stage.description.shot.moves):
        return True
    camera = stage.camera.at(float(times[len(times) // 2]))
    if direction in ("left", "right"):
        along = float(shift @ camera.rotation[0])
        return along * (1.0 if direction == "right" else -1.0) > least
    if direction in ("towards", "away"):
        near, far = (float(np.linalg.norm(places[n] - camera.position)) for n in (-1, 0))
        return (far - near) * (1.0 if direction == "towards" else -1.0) > least
    return True


def _crosses(stage: Stage, actor: Actor) -> bool:
    """Over the middle of a road, where there is one, by a clear share of its width."""
    if stage.place not in _ROADS:
        return True
    line = _road_of(stage)
    start, end = (line.across(actor.middle(t)[:2]) for t in (0.0, stage.duration_s))
    width = 2.0 * stage.environment.road_half_width
    return start * end < 0.0 and abs(end - start) > _LEAST_CROSSED * width


def _is_on_road(stage: Stage, actor: Actor) -> bool:
    """Whether its middle is over the roadway when the clip begins."""
    if stage.place not in _ROADS:
        return True
    aside = abs(_road_of(stage).across(actor.middle(0.0)[:2]))
    return aside < stage.environment.road_half_width


def _goes_to_water(stage: Stage, actor: Actor, motion: ObjectMotion) -> bool:
    """It is on land first and in the water in the end, or nearer to it; or the other way round."""
    if stage.place not in WATERSIDE:
        return stage.place in _ON_WATER and motion.shore == "in"
    line, shore = _road_of(stage), find_water(stage.place, stage.environment.road_half_width)
    start, end = (
        line.across(actor.middle(t)[:2]) - shore for t in (0.0, stage.duration_s)
    )  # fmt: skip
    way = motion.shore
    if way in ("out of", "away from"):
        start, end = end, start
    if way == "in":
        return start > 0.0 and end > 0.0
    if way in ("into", "out of"):
        return start < 0.0 < end
    return end - start > 0.2 * actor.size_m


def _road_of(stage: Stage) -> RoadLine:
    ground = stage.environment
    offset = (float(ground.road_offset[0]), float(ground.road_offset[1]))
    return RoadLine(ground.road_angle, offset, ground.road_curvature)


def _has_support(stage: Stage, actor: Actor) -> bool:
    """Whether what walks, drives, rolls or stands is on the ground or on another body."""
    scene_object = stage.description.objects[actor.object_index]
    motion = scene_object.motion
    kind = "stand" if motion is None else motion.kind
    is_bound = kind in _ON_GROUND and (motion is None or motion.direction not in ("up", "down"))
    if not is_bound or stage.place in _NO_GROUND or actor.tether is not None:
        return True
    if actor.noun.habitat in ("air", "water") and kind == "stand":
        return True
    begin = schedule((motion, *scene_object.then), stage.duration_s)[0] if motion else None
    time_s = 0.5 * (begin.start_s + begin.end_s) if begin else 0.0
    own = part_boxes(actor, time_s)
    low, high = own.hull
    is_up = low[2] > _CLEAR * (high[2] - low[2]) + 0.05
    is_on_water = stage.place in _ON_WATER and actor.noun.habitat == "ground"
    if not (is_up or is_on_water):
        return True
    return _is_at_something(stage, actor, time_s)


def _is_at_something(stage: Stage, actor: Actor, time_s: float) -> bool:
    """Whether it touches another body."""
    own, touch = part_boxes(actor, time_s), 0.05 * actor.size_m
    others = (other for other in stage.actors if other is not actor)
    return any(gap(own, part_boxes(other, time_s)) < touch for other in others)
