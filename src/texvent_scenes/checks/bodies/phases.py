"""Phase check: what a clip shows for a part of its time only, and acts that it does not show.

Each of several motions of an object has a phase of the clip. In it the body must be seen, and get
on, come to rest, rise, come down or turn, as the motion says.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from texvent.camera import PosedCamera, project
from texvent.sensor import SensorSize
from texvent_scenes.checks.clip.body_boxes import is_any_inside
from texvent_scenes.checks.clip.relations import Violation
from texvent_scenes.checks.clip.staged_clip import StagedClip
from texvent_scenes.description import Claim, SceneDescription, label_of
from texvent_scenes.models.activities import ACTIVITIES, MOUTH_ACTIVITIES, PERSON_NOUNS
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.rendered_scene import Float64Array, Ground
from texvent_scenes.spec.scene import SceneObject
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.compose import ComposedScene
from texvent_scenes.staging.tracks.phases import (
    GOING,
    PATH_KINDS,
    Phase,
    schedule,
    usual_speed,
)

_INSTANTS = 9
_LEAST_GONE, _LEAST_TURN, _MOST_SEEN = 0.1, 0.25, 0.5
"""Departure, in sizes of a body, that is a way, and above which it does not rest; least turn, rad;
share of its phase in which what goes nowhere is seen."""
_ON_GROUND = frozenset({"walk", "run", "drive", "roll", "slide", "crawl"})
"""Motions of which some instant is on the ground."""
_LEAST_CLIP_S = 1.0
"""Length of a clip, s, in which motions get so far that they are judged."""
_HURRIED, _STEPS = 0.75, 49
"""Share of a pace from which on it is reached; instants between which ways are measured."""
_RUNNING = 0.5
"""Share of its usual speed from which on a body runs."""
_DONE = 0.7
"""Share of an act from which on one sees that it is done."""
_LIFTED = 0.1
"""Rise of what is lifted, in its sizes."""
_TOLD, _SURELY = 4, 16
"""Points of the image from which on a body is no speck; those in its box of which one is surely on
it."""
_COVERED, _COUNTED = 0.25, 6
"""Share of what its copies show at best of which a copy that shows less is almost hidden; copies
that one counts."""

_TURNING, _ROUND = 0.02, 0.9
"""Shares of a round from which on a body goes round something, and up to which it is not one."""


def find_undone(
    description: SceneDescription,
    actors: Sequence[Actor],
    seen: Mapping[int, Sequence[int]],
    times: Sequence[float],
) -> Iterator[Violation]:
    """Motions, of objects with several, whose phase shows nothing of them.

    Args:
        description: the scene.
        actors: bodies of its objects.
        seen: instance id → points of the image that show it at each instant.
        times: these instants, s.
    """
    borne = {one.subject for one in description.relations}
    for index, said in enumerate(description.objects):
        own = [one for one in actors if one.object_index == index]
        is_loose = index not in borne and said.position_m is None and said.height_m is None
        is_judged = own and said.motions[1:] and times[-1] >= _LEAST_CLIP_S
        for phase in schedule(said.motions, times[-1]) if is_judged else ():
            within = [n for n, at in enumerate(times) if phase.start_s <= at <= phase.end_s]
            kind = phase.motion.kind
            line = f"the {label_of(description, index)}'s {kind}"
            if kind == "break":
                continue  # only pieces of it are left
            ends_s = [one.breaks_s for one in own if one.breaks_s is not None]
            within = [n for n in within if not ends_s or times[n] <= max(ends_s)]
            shown = [any(seen[one.instance][n] for one in own) for n in within] or [True]
            if not any(shown) or (kind not in GOING and np.mean(shown) < _MOST_SEEN):
                yield Violation("motion", kind, f"{line}: it is not in view then")
            elif not any(_is_done(one, said, phase, is_loose=is_loose) for one in own):
                yield Violation("motion", kind, f"{line}: it does not come to that")
            elif not any(_keeps_direction(one, phase) for one in own):
                direction = str(phase.motion.direction)
                yield Violation("direction", direction, f"{line} {direction}")


def find_unhurried(
    description: SceneDescription, actors: Sequence[Actor], times: Sequence[float]
) -> Iterator[Violation]:
    """Paces above the usual one that no copy reaches on its way: "at high speed"."""
    for index, said in enumerate(description.objects):
        own = [one for one in actors if one.object_index == index and one.track.anchor is None]
        motion = said.motion
        if not (own and motion and motion.pace > 1.0) or times[-1] < _LEAST_CLIP_S:
            continue
        least_m_s = _HURRIED * motion.pace * usual_speed(own[0].noun, motion.kind)
        if motion.kind in PATH_KINDS and max(_fastest(one, times) for one in own) < least_m_s:
            yield Violation("pace", "", f"the {label_of(description, index)}'s {motion.kind} at "
                            f"{motion.pace:g} times its usual speed: it is slower")  # fmt: skip


def find_unfinished(description: SceneDescription, duration_s: float) -> Iterator[Violation]:
    """Acts with a beginning and an end that are so slow that the clip is over before: "slowly"."""
    for index, said in enumerate(description.objects):
        is_judged = bool(said.motions) and duration_s >= _LEAST_CLIP_S
        for phase in schedule(said.motions, duration_s) if is_judged else ():
            kind, pace = phase.motion.kind, phase.motion.pace
            act = ACTIVITIES.get(kind) if said.noun in PERSON_NOUNS else None
            done = (phase.end_s - phase.start_s) * pace * (act.repeats_hz if act else 0.0)
            if 0.0 < done < _DONE and pace < 1.0:
                name = label_of(description, index)
                line = f"the {name}'s {kind}: the clip ends before it is done"
                yield Violation("motion", kind, line)


def find_unlifted(
    description: SceneDescription, actors: Sequence[Actor], duration_s: float
) -> Iterator[Violation]:
    """Things that are to be lifted, and are not yet when the clip ends."""
    for said in description.relations:
        if said.kind != "lift" or duration_s < _LEAST_CLIP_S:
            continue
        for one in (each for each in actors if each.object_index in said.targets):
            held_s = min(one.track.grab_s, duration_s)
            rise_m = one.middle(duration_s)[2] - one.middle(max(held_s, 0.0))[2]
            if one.track.anchor is not None and held_s > 0.0 and rise_m < _LIFTED * one.size_m:
                names = [label_of(description, n) for n in (said.subject, one.object_index)]
                line = f"the {names[0]} lifting the {names[1]}: it gets there after {held_s:.2g} s"
                yield Violation("relation", "lift", f"{line} of {duration_s:g}")
                break


def runs(staged: StagedClip, claim: Claim) -> bool:
    """Whether each body is faster at some instant than half a run, or half the pace of a trot.

    Of what is carried, climbs or is at a machine, such as a treadmill, its places do not tell.
    """
    objects, said = staged.description.objects, staged.description.relations
    own = [one for one in said if one.subject == claim.subject]
    targets = {objects[n].noun for one in own for n in one.targets}
    is_at_work = any(NOUNS[one].is_working for one in targets if one in NOUNS)
    is_climbing = any(one.kind in ("up", "down") for one in own)
    least = _RUNNING * min(float(claim.value or 1.0), 1.0)
    return is_at_work or is_climbing or all(
        one.track.anchor is not None
        or _fastest(one, staged.times) >= least * usual_speed(one.noun, "run")
        for one in staged.own(claim)
    )  # fmt: skip


def _fastest(one: Actor, times: Sequence[float]) -> float:
    """Greatest speed of a body, m/s."""
    fine = np.linspace(times[0], times[-1], _STEPS)
    steps = np.diff([one.middle(float(at)) for at in fine], axis=0)
    return float(np.linalg.norm(steps, axis=1).max() / (fine[1] - fine[0]))


def find_airborne_meals(
    description: SceneDescription, scene: ComposedScene, times: Sequence[float]
) -> Iterator[Violation]:
    """Meals of what stays in the air: its mouth is at nothing."""
    placed = {one.subject for one in description.relations}
    for index, said in enumerate(description.objects):
        own = [one for one in scene.actors if one.object_index == index]
        own = [one for one in own if one.noun.habitat == "air"]
        has_ground = scene.place.ground is not Ground.NONE
        kinds = {one.kind for one in said.motions} & MOUTH_ACTIVITIES
        is_loose = bool(own) and index not in placed
        is_fed = has_ground and any(_reaches_ground(one, times) for one in own)
        if kinds and is_loose and not is_fed:
            for kind in sorted(kinds):
                line = f"the {label_of(description, index)}'s {kind}: it is in the air"
                yield Violation("motion", kind, line)


def _reaches_ground(one: Actor, times: Sequence[float]) -> bool:
    """Whether a body is on the ground at some instant."""
    return min(map(one.lowest_m, times)) <= _LEAST_GONE * one.size_m


def _is_done(one: Actor, said: SceneObject, phase: Phase, *, is_loose: bool) -> bool:
    """Whether a body does what a motion says, in its phase; of most motions nothing is judged.

    What is loose, on nothing that the scene names, walks and rolls on the ground.
    """
    kind, least_m = phase.motion.kind, _LEAST_GONE * one.size_m
    times = [float(at) for at in np.linspace(phase.start_s, phase.end_s, _INSTANTS)]
    places = np.array([one.middle(at) for at in times])
    if one.track.anchor is not None or said.noun in nouns_with("flows"):
        return True
    is_based = kind in _ON_GROUND and is_loose and one.noun.habitat == "ground"
    if is_based and min(map(one.lowest_m, times)) > least_m:
        return False
    if kind in GOING:  # who climbs down does not run yet
        gone = (places - places[0])[:, : 2 if kind in _ON_GROUND else 3]
        return bool(np.linalg.norm(gone, axis=1).max() > least_m)
    if kind == "turn":
        yaws = np.unwrap([one.track.at(at).yaw for at in times])
        return bool(np.ptp(yaws) > _LEAST_TURN)
    if kind == "stand":
        return bool(np.linalg.norm(places[-1] - places[-3]) < least_m)
    return _comes_to_height(kind, places[:, 2], least_m)


def _comes_to_height(kind: str, height_m: Float64Array, least_m: float) -> bool:
    """Whether a motion up or down leads so far."""
    if kind == "climb":
        return bool(np.ptp(height_m) > least_m)
    if kind == "rise":
        return bool(height_m[-1] - height_m[0] > least_m)
    return kind not in ("sink", "fall") or bool(height_m[0] - height_m.min() > least_m)


def _keeps_direction(one: Actor, phase: Phase) -> bool:
    """Whether what flies or swims up or down does so."""
    sign = {"up": 1.0, "down": -1.0}.get(phase.motion.direction or "", 0.0)
    if not sign or phase.motion.kind not in ("fly", "glide", "swim"):
        return True
    risen_m = (one.middle(phase.end_s) - one.middle(phase.start_s))[2]
    return bool(sign * risen_m > _LEAST_GONE * one.size_m)


def list_departures(
    scene: ComposedScene, cameras: Sequence[PosedCamera], times: Sequence[float], size: SensorSize
) -> Iterator[str]:
    """Notes on what a static camera shows for a part of the clip only."""
    told = {one.name for one in scene.actors for note in scene.camera_path.notes
            if note.startswith(f"the {one.name} is fast")}  # fmt: skip
    for one in scene.actors:
        inside = [is_any_inside(one.corners(time_s), camera, size)
                  for time_s, camera in zip(times, cameras, strict=True)]  # fmt: skip
        if inside[0] and not inside[-1] and one.name not in told:
            last_s = times[len(inside) - 1 - inside[::-1].index(True)]
            yield f"the {one.name} leaves the view after {last_s:.2g} s"
        elif 0 < sum(inside) < 0.5 * len(inside) and one.name not in told:
            yield f"the {one.name} is in view for {sum(inside) / len(inside):.0%} of the clip"


def _area_px(corners: Float64Array, camera: PosedCamera, size: SensorSize) -> float:
    """Area of the box around points [n, 3], m, in the image, pixels; of some behind it none."""
    x, y, depth = project(camera, size, corners).T
    inside = np.clip(x, 0.0, size.width), np.clip(y, 0.0, size.height)
    return float(np.ptp(inside[0]) * np.ptp(inside[1])) if depth.min() > 0.0 else 0.0


def list_hidden(
    scene: ComposedScene, seen: Mapping[int, Sequence[int]], cameras: Sequence[PosedCamera],
    times: Sequence[float], size: SensorSize, point_px: int,
) -> Iterator[str]:  # fmt: skip
    """Notes on what something else hides for a part of the clip, such as a tunnel.

    Of what is so far away that the grid of points may miss it, nothing is told.

    Args:
        scene: the staged scene.
        seen: instance id → points of the grid that show it at each instant.
        cameras: of the instants.
        times: instants, s.
        size: of the image, pixels.
        point_px: pixels for each point of the grid.
    """
    least_px = _SURELY * point_px
    flashing = {one.actor.instance for one in scene.lamps.lit if one.flashes}
    told = [one for one in scene.actors if one.instance not in flashing]
    areas = {one.instance: [_area_px(one.corners(time_s), camera, size)
                            for time_s, camera in zip(times, cameras, strict=True)]
             for one in told}  # fmt: skip
    for one in told:
        counts = seen[one.instance]
        whole_s = math.inf if one.breaks_s is None else one.breaks_s
        copies = [other.instance for other in told if other.object_index == one.object_index]
        fullest = max((count / area for each in copies if 1 < len(copies) <= _COUNTED
                       for count, area in zip(seen[each], areas[each], strict=True)
                       if area >= least_px), default=0.0)  # fmt: skip
        is_in = [area >= least_px and time_s < whole_s
                 for area, time_s in zip(areas[one.instance], times, strict=True)]  # fmt: skip
        gone = [inside and not count for inside, count in zip(is_in, counts, strict=True)]
        covered = [inside and count <= _COVERED * fullest * area for inside, count, area
                   in zip(is_in, counts, areas[one.instance], strict=True)]  # fmt: skip
        if max(counts) >= _TOLD and sum(gone) > 1:
            yield f"the {one.name} is hidden for {sum(gone) / len(gone):.0%} of the clip"
        elif max(counts) >= _TOLD and 2 * sum(covered) > len(covered):
            yield (f"the {one.name} (1 of {len(copies)}) is almost hidden for "
                   f"{sum(covered) / len(covered):.0%} of the clip")  # fmt: skip


def list_rounds(
    description: SceneDescription, actors: Sequence[Actor], times: Sequence[float]
) -> Iterator[str]:
    """Notes of those who do not come once round in the clip, of which a sentence says it."""
    around = {one.subject for one in description.relations if one.kind == "around"}
    for one in actors if description.is_sentence else ():
        kinds = {each.kind for each in description.objects[one.object_index].motions}
        if "orbit" in kinds or (one.object_index in around and kinds & PATH_KINDS):
            instants = np.linspace(0.0, times[-1], _STEPS)
            ways = np.diff([one.middle(time)[:2] for time in instants], axis=0)
            turned = np.unwrap(np.arctan2(ways[:, 1], ways[:, 0]))
            share = abs(turned[-1] - turned[0]) / (2.0 * math.pi) * len(ways) / (len(ways) - 1)
            if _TURNING < share < _ROUND:
                yield f"the {one.name} goes {share:.0%} of the way round in the clip"
