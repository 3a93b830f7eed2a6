"""Other takes of a scene whose picture loses things that the prompt names.

What is lost says what to try: what is too small is drawn larger, and seen from nearer; what is
hidden is seen from higher up, what is cut off from further away. A take counts only if it shows
more of the prompt's words and loses none.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from texvent.generate.seen_things import Findings, judge_findings, look_at_scene
from texvent.scenes.description import SceneDescription
from texvent.scenes.evidence import Evidence, report_on
from texvent.scenes.language.defaults import let_sway
from texvent.scenes.projection import project
from texvent.scenes.report import PromptReport
from texvent.scenes.staging.camera.main_actor import choose_main
from texvent.scenes.staging.compose import ComposedScene
from texvent.scenes.staging.take import USUAL, Take
from texvent.sensor import SensorSize

MOST = 3
"""Takes that are tried beside the usual one."""
MOST_BODIES = 24
"""Bodies that are staged again for all of them together; of more, one take is tried."""
LARGEST_M = 0.7
"""Size up to which things are drawn larger, m."""
NEAREST, NEARER, FURTHER, FURTHEST = 0.6, 0.85, 1.35, 1.7
"""Distances of the camera, as multiples of the usual one."""
RISE_RAD = 0.45
"""How far the camera goes up."""
LEAST_CHANGE_PER_S = 0.048
"""Share of the picture's points that show something else after a second, at least, where the camera
rests: below it, prompts of a development set gave .2 events per pixel and second at most."""
LEAST_MOVING = 0.03
"""Share of them that shows things that move, at least."""
LONGEST_STEP_S = 0.25
"""Time over which changes add up."""
_INSTANTS = 5
_KEPT = 0.92
"""Share of the subject's box in the image that a take keeps, of that in the usual one."""
_LEAST_EXTENT = 0.25
"""Share of the image's width or height over which a take that goes away leaves the subject."""
_SMALL = frozenset({"too small"})
_HIDDEN = frozenset({"hidden", "mostly hidden"})
_OUTSIDE = frozenset({"cut off", "out of view", "in view too briefly"})
_COUNTED = re.compile(r"\d+ of \d+ ")
"""Begin of "1 of 3 dogs (hidden)", which names no word."""
_REASON = re.compile(r" \([^()]*\)$")


class Filmed(NamedTuple):
    """A take and what it shows."""

    scene: ComposedScene
    found: Findings
    evidence: Evidence
    report: PromptReport


def film(
    description: SceneDescription,
    stage: Callable[[SceneDescription, Take], ComposedScene],
    size: SensorSize,
    duration_s: float,
) -> Filmed:
    """The scene from the take that shows most of what the prompt says; the usual one of equals.

    Where hardly anything of the picture changes, the camera sways, unless the prompt says what it
    does: a picture at rest has no events.

    Args:
        description: what the prompt says.
        stage: builds the scene of a take.
        size: of the image, pixels.
        duration_s: of the clip, s.
    """

    def judge(scene: ComposedScene, found: Findings) -> Filmed:
        evidence = judge_findings(scene, description, size, found)
        return Filmed(scene, found, evidence, report_on(description, evidence))

    def look(scene: ComposedScene) -> Findings:
        return look_at_scene(scene, description, size, duration_s)

    scene = stage(description, USUAL)
    best = usual = judge(scene, look(scene))
    is_named = _is_subject_named(description, usual.scene)
    larger = _list_larger(description, usual)
    takes = list_takes(
        description, usual.evidence, larger,
        is_subject_named=is_named, is_place_lost=bool(usual.found.places),
    )  # fmt: skip
    for take in takes[: min(MOST, max(1, MOST_BODIES // max(1, len(scene.actors))))]:
        scene = stage(description, take)
        found = look(scene)
        if _count_lost(found) >= _count_lost(best.found):
            continue
        other = judge(scene, found)
        is_whole = not is_named or _keeps_subject(description, usual.scene, scene, size)
        if is_whole and shows_more(other, best):
            best = other
        if not any(_list_reasons(best.evidence)) and not best.found.places:
            break
    if is_at_rest(description, best.found):
        return film(let_sway(description), stage, size, duration_s)
    eased = judge_findings(best.scene, description, size, best.found, is_eased=True)
    return best._replace(evidence=eased, report=report_on(description, eased))


def is_at_rest(description: SceneDescription, found: Findings) -> bool:
    """Whether hardly a point of the picture changes: what moves is small, and moves little.

    Not where the prompt says what the camera does, or lights, particles or weather make events.
    """
    views = found.views
    changes_by_itself = (
        bool(description.effects)
        or description.light.flicker_hz is not None
        or description.surroundings.weather in ("rain", "snow")
        or any(one.blink_hz is not None for one in description.objects)
    )
    if description.shot.moves or changes_by_itself or len(views) < 2:
        return False
    shares = [float(np.mean(one.number != other.number)) for one, other in pairwise(views)]
    step_s = (views[-1].time_s - views[0].time_s) / (len(views) - 1)
    is_little = float(np.mean(shares)) < LEAST_CHANGE_PER_S * min(step_s, LONGEST_STEP_S)
    at_rest = [0, *found.still]
    moving = [float(np.mean(~np.isin(view.instance, at_rest))) for view in views]
    return is_little and float(np.mean(moving)) < LEAST_MOVING


def list_takes(
    description: SceneDescription,
    evidence: Evidence,
    larger: frozenset[int] = frozenset(),
    *,
    is_subject_named: bool = True,
    is_place_lost: bool = False,
) -> list[Take]:
    """What may show more of the things that a scene loses, the likeliest first.

    Args:
        description: what the prompt says.
        evidence: what the usual take shows.
        larger: objects that may be drawn larger.
        is_subject_named: whether the prompt names what the camera is about; it does not name who
            shuffles cards in "shuffling cards".
        is_place_lost: whether a place is named that the picture does not tell.
    """
    shot = description.shot
    if any(move.kind == "travel" for move in shot.moves):
        return []
    reasons = set(_list_reasons(evidence))
    is_small, is_hidden = bool(reasons & _SMALL), bool(reasons & _HIDDEN)
    is_open = shot.framing is None
    is_outside = bool(reasons & _OUTSIDE) and is_open
    is_still = all(move.kind in ("static", "handheld") for move in shot.moves)
    may_come = is_small and is_open
    choices = [
        (is_small and bool(larger), Take()),
        (is_outside, Take(distance=FURTHER)),
        (is_outside and is_still, Take(is_whole=True)),
        ((is_hidden or is_place_lost) and shot.view is None, Take(rise_rad=RISE_RAD)),
        (may_come, Take(distance=NEARER)),
        (may_come and not is_subject_named, Take(distance=NEAREST, aim=_list_small(evidence))),
        (is_outside or (is_place_lost and is_open), Take(distance=FURTHEST)),
    ]
    return [take._replace(larger=larger) for may, take in choices if may]


def _list_small(evidence: Evidence) -> frozenset[int]:
    """Objects of which a copy is too small."""
    return frozenset(one for one, faults in evidence.faults.items() if _SMALL.intersection(faults))


def _list_larger(description: SceneDescription, usual: Filmed) -> frozenset[int]:
    """Those that may be drawn larger: nothing large, nothing worn, nothing that is called small.

    What is in a thing grows with it.
    """
    fitting = {
        one.object_index
        for one in usual.scene.actors
        if max(one.model.length, one.model.width, one.model.height) <= LARGEST_M
    }
    fitting &= {index for index, one in enumerate(description.objects) if one.scale >= 1.0}
    found = fitting & _list_small(usual.evidence)
    for relation in description.relations:
        if relation.kind == "wear":
            found -= set(relation.targets)
        elif relation.kind == "in" and relation.subject in found:
            around = set(relation.targets)
            found = found | around if around <= fitting else found - {relation.subject}
    return frozenset(found)


def _is_subject_named(description: SceneDescription, scene: ComposedScene) -> bool:
    if not scene.actors:
        return True
    main = choose_main(description, scene.actors).object_index
    return any(one.aspect == "name" and main in one.things for one in description.claims)


def _count_lost(found: Findings) -> int:
    """Things and places that are not seen."""
    return len(found.places) + sum(fault is not None for fault in found.faults.values())


def _list_reasons(evidence: Evidence) -> Iterator[str]:
    """Why copies of things are not seen."""
    for faults in evidence.faults.values():
        yield from (one for one in faults if one in _SMALL | _HIDDEN | _OUTSIDE)


def shows_more(take: Filmed, than: Filmed) -> bool:
    """Whether a take shows more of the prompt's words, and all that the other one shows of it."""
    words, known = (
        {_REASON.sub("", one) for one in some.report.not_shown if not _COUNTED.match(one)}
        for some in (take, than)
    )
    doubts, unsure = (
        {_REASON.sub("", one) for one in some.report.in_doubt} for some in (take, than)
    )
    copies, before = (_count_unseen(some.evidence) for some in (take, than))
    if not doubts <= unsure | known or any(n > before[index] for index, n in copies.items()):
        return False
    return words < known


def _count_unseen(evidence: Evidence) -> dict[int, int]:
    """Object → copies that are not seen."""
    return {
        index: sum(fault is not None for fault in faults)
        for index, faults in evidence.faults.items()
    }


def _keeps_subject(
    description: SceneDescription, usual: ComposedScene, other: ComposedScene, size: SensorSize
) -> bool:
    """Whether as much of the subject is in the picture as usual, and no less than is well seen."""
    (share, extent), (kept, left) = (
        _measure_subject(description, one, size) for one in (usual, other)
    )
    return kept >= _KEPT * share and left >= min(_LEAST_EXTENT, extent)


def _measure_subject(
    description: SceneDescription, scene: ComposedScene, size: SensorSize
) -> tuple[float, float]:
    """Share of the subject's box that is in the picture, and how large it is there.

    Both are means over the clip; the size is a share of the image's width or height, the greater.
    """
    main = choose_main(description, scene.actors)
    edge = np.array([size.width, size.height], dtype=np.float64)
    found = []
    for time in np.linspace(0.0, scene.camera_path.duration_s, _INSTANTS):
        seen = project(scene.camera(float(time)), size, main.corners(float(time)))
        low, high = seen[:, :2].min(axis=0), seen[:, :2].max(axis=0)
        inner = np.clip(high, 0.0, edge) - np.clip(low, 0.0, edge)
        share = float(np.prod(inner / np.maximum(high - low, 1e-9)))
        is_ahead = bool(seen[:, 2].min() > 0.0)
        found.append((share, float((inner / edge).max())) if is_ahead else (0.0, 0.0))
    share, extent = np.mean(found, axis=0)
    return float(share), float(extent)
