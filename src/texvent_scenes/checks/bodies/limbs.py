"""Limb check: acts in place of which the image shows too little to tell them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from texvent.camera import PosedCamera, project
from texvent.sensor import SensorSize
from texvent_scenes.checks.clip.body_boxes import is_any_inside
from texvent_scenes.checks.clip.relations import Violation
from texvent_scenes.description import SceneDescription, label_of
from texvent_scenes.models.activities import (
    ACTIVITIES,
    ANIMAL_ACTIVITIES,
    HAND_GESTURES,
    HAND_NOUNS,
    MOUTH_ACTIVITIES,
    PERSON_NOUNS,
    TRAVELLING,
    motion_of,
)
from texvent_scenes.models.protocol import Pose
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.staging.actors import Actor

_LEAST_SHARE = 0.03
"""Way of a limb, as a share of the height of the image, from which on an act is seen."""
_POSTURES = frozenset({"stand", "sit", "lie", "kneel", "crouch", "look", "jump"})
"""Acts that the whole body shows."""
_BY_HEAD = MOUTH_ACTIVITIES | {"look"}
"""Acts that the head shows."""
_OF_LIGHTS = frozenset(
    one for one in ANIMAL_ACTIVITIES if "signal" in str(motion_of("animal_activities", one))
)
"""Acts of lamps, which have no limbs."""
_ACTS = (ACTIVITIES.keys() | HAND_GESTURES.keys()) - TRAVELLING
_REST = Pose(0.0, 0.0, 0.0, "stand")


def find_tiny(
    description: SceneDescription,
    actors: Sequence[Actor],
    cameras: Sequence[PosedCamera],
    times: Sequence[float],
    size: SensorSize,
) -> Iterator[Violation]:
    """Acts in place whose limbs go less far in the image than a viewer sees, by all who do them.

    Args:
        description: the scene.
        actors: bodies of its objects.
        cameras: the camera at each instant.
        times: these instants, s.
        size: of the image, pixels.
    """
    for index, said in enumerate(description.objects):
        kinds, name = {one.kind for one in said.motions}, label_of(description, index)
        own = [one for one in actors if one.object_index == index]
        if own and said.noun in PERSON_NOUNS and kinds & _BY_HEAD and not _has_head(
            own, cameras, times, size
        ):  # fmt: skip
            for kind in sorted(kinds & _BY_HEAD):
                yield Violation("motion", kind, f"the {name}'s {kind}: its head is cut off")
            continue
        able = own[0].noun.acts if own and own[0].noun.speed_m_s > 0.0 else frozenset()
        able |= _ACTS if said.noun in PERSON_NOUNS | HAND_NOUNS else frozenset()
        if not (own and kinds and kinds <= able - _POSTURES - _OF_LIGHTS - TRAVELLING):
            continue
        most = max(_limb_way(one, cameras, times, size) for one in own)
        if most < _LEAST_SHARE * size.height:
            for kind in sorted(kinds):
                line = f"the {name}'s {kind}: too small to be seen ({most:.1f} pixels)"
                yield Violation("motion", kind, line)


def find_ageless(
    description: SceneDescription, actors: Sequence[Actor], cameras: Sequence[PosedCamera],
    times: Sequence[float], size: SensorSize,
) -> Iterator[Violation]:  # fmt: skip
    """People whose face or whole height tells their age, of whom the head is not in the image."""
    for index, said in enumerate(description.objects):
        own = [one for one in actors if one.object_index == index]
        is_told = said.noun in nouns_with("told by the head")
        if own and is_told and not _has_head(own, cameras, times, size):
            line = f"the {said.noun}: the head is out of the picture, a part of a body is in it"
            yield Violation("noun", said.noun, line)


def list_headless(
    description: SceneDescription,
    actors: Sequence[Actor],
    cameras: Sequence[PosedCamera],
    times: Sequence[float],
    size: SensorSize,
) -> Iterator[str]:
    """Notes of people of whom only a part without the head is in the image."""
    for index, said in enumerate(description.objects):
        own = [one for one in actors if one.object_index == index]
        is_noted = said.noun in PERSON_NOUNS - {"person"} - nouns_with("told by the head")
        if own and is_noted and not _has_head(own, cameras, times, size):
            yield f"the head of the {said.noun} is out of the picture"


def _has_head(
    own: Sequence[Actor], cameras: Sequence[PosedCamera], times: Sequence[float], size: SensorSize
) -> bool:
    """Whether some instant has the head of some body in the image."""
    return any(
        is_any_inside(one.anchor("head", time_s)[None, :, 3], camera, size)
        for one in own for time_s, camera in zip(times, cameras, strict=True)
    )  # fmt: skip


def _limb_way(
    one: Actor, cameras: Sequence[PosedCamera], times: Sequence[float], size: SensorSize
) -> float:
    """The farthest that a part in the image is from where it is at first, or at rest, pixels."""
    states = [_corners(one, one.pose(time_s)) for time_s in times]
    bases = [each for each in (states[0], _corners(one, _REST)) if each.shape == states[0].shape]
    ways = []
    for state, camera, time_s in zip(states, cameras, times, strict=True):
        middle = one.middle(time_s)
        seen = project(camera, size, np.array([middle, middle + np.array([0.0, 0.0, 1.0])]))
        per_m = float(np.linalg.norm(seen[1, :2] - seen[0, :2]))
        same = [each for each in bases if each.shape == state.shape]
        to_world = one.track.at(time_s).to_world()
        x, y, _ = project(camera, size, state @ to_world[:, :3].T + to_world[:, 3]).T
        is_in = (x >= 0.0) & (x < size.width) & (y >= 0.0) & (y < size.height)
        way_m = max(
            (float((is_in * np.linalg.norm(state - each, axis=1)).max()) for each in same),
            default=1.0,
        )
        ways.append(per_m * way_m if seen[0, 2] > 0.0 else 0.0)
    return max(ways)


def _corners(one: Actor, pose: Pose) -> Float64Array:
    """[n, 3] Middles and ends of the parts of a body, m."""
    axes = np.array([part.to_body for part in one.model.parts(pose)])
    ends = [axes[:, :, 3], *(axes[:, :, 3] + axes[:, :, n] for n in range(3))]
    return np.concatenate(ends)
