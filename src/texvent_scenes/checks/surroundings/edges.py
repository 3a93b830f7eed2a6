"""Edge check: a subject at the image's edge, copies that merge, and what covers the picture."""

from __future__ import annotations

from collections.abc import Container, Iterator, Mapping, Sequence

import numpy as np

from texvent.camera import PosedCamera, project
from texvent.sensor import SensorSize
from texvent_scenes.description import SceneDescription
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.camera.subject import choose_main
from texvent_scenes.staging.compose import ComposedScene

_INSIDE, _OFTEN = 0.5, 0.4
"""Share of a subject's box that is inside the image; share of the instants in which it must be."""
_MERGED, _NEAR, _FEWEST = 0.75, 0.8, 6
"""Share of the smaller of two boxes in the image from which on they look like one, if they are as
near each other, in their sizes; copies up to which one counts them."""
_COVERS = 0.12
"""Share of the image from which on something before the subject covers much of it."""


def find_cut_subject(
    scene: ComposedScene,
    description: SceneDescription,
    cameras: Sequence[PosedCamera],
    times: Sequence[float],
    size: SensorSize,
) -> Iterator[int]:
    """Index of the subject of a moving camera that is at the image's edge for most of the clip."""
    shot = description.camera
    if not scene.actors or not shot.is_moving or shot.framing == "close":
        return
    main = choose_main(description, scene.actors)
    own = [one for one in scene.actors if one.object_index == main.object_index]
    if len(own) > 1 or not main.is_mover or scene.camera_path.passage_s is not None:
        return
    inside = [_share_inside(main, time_s, camera, size)
              for time_s, camera in zip(times, cameras, strict=True)]  # fmt: skip
    if max(inside) > 0.0 and np.mean(np.array(inside) >= _INSIDE) < _OFTEN:
        yield main.object_index


def find_merged(
    scene: ComposedScene,
    description: SceneDescription,
    cameras: Sequence[PosedCamera],
    times: Sequence[float],
    size: SensorSize,
) -> Iterator[tuple[int, int]]:
    """Objects whose copies look like fewer, and as how many, for most of the clip."""
    for index, said in enumerate(description.objects):
        own = [one for one in scene.actors if one.object_index == index]
        if not 2 <= len(own) == said.count <= _FEWEST:
            continue
        told = []
        for at, camera in zip(times, cameras, strict=True):
            boxes = [_image_box(one, at, camera, size) for one in own]
            told.append(_count_apart([(box, one.middle(at), one.size_m)
                                      for box, one in zip(boxes, own, strict=True)]))  # fmt: skip
        seen = int(np.median(told))
        if seen < len(own):
            yield index, seen


def list_covering(
    scene: ComposedScene,
    description: SceneDescription,
    seen: Mapping[int, Sequence[int]],
    points: int,
    times: Sequence[float],
    lost: Container[int] = (),
) -> Iterator[str]:
    """Sentences on bodies before the subject, or reported as lost, that cover much of the image.

    Args:
        scene: the staged scene.
        description: the scene before it was staged.
        seen: instance id → points of the grid that show it at each instant.
        points: of the grid.
        times: instants, s.
        lost: indices of objects of which too few copies are seen.
    """
    if not scene.actors:
        return
    main = choose_main(description, scene.actors)
    tied = {n for one in description.relations for n in (one.subject, *one.targets)
            if main.object_index in (one.subject, *one.targets)}  # fmt: skip
    for one in scene.actors:
        if one.object_index in tied | {main.object_index} or not seen[one.instance]:
            continue
        shares = [count / points for count in seen[one.instance]]
        instants = zip(times, map(scene.camera, times), strict=True)
        depths = [[(each.middle(at) - camera.position) @ camera.rotation[2] for each in (one, main)]
                  for at, camera in instants]  # fmt: skip
        is_before = np.mean([near < far for near, far in depths]) >= _OFTEN
        if (is_before or one.object_index in lost) and float(np.median(shares)) >= _COVERS:
            share = f"{100.0 * float(np.median(shares)):.0f} %"
            yield f"the {one.name} covers {share} of the picture"


def _image_box(one: Actor, time_s: float, camera: PosedCamera, size: SensorSize) -> Float64Array:
    """[2, 2] least and greatest x and y of a body in the image; empty behind the camera."""
    seen = project(camera, size, one.corners(time_s))
    if seen[:, 2].min() <= 0.0:
        return np.zeros((2, 2))
    return np.array([seen[:, :2].min(axis=0), seen[:, :2].max(axis=0)])


def _share_inside(one: Actor, time_s: float, camera: PosedCamera, size: SensorSize) -> float:
    """Share of a body's box that is inside the image."""
    box = _image_box(one, time_s, camera, size)
    inside = np.clip(box, 0.0, [size.width, size.height])
    return float(np.prod(np.ptp(inside, axis=0)) / max(float(np.prod(np.ptp(box, axis=0))), 1e-9))


def _count_apart(copies: Sequence[tuple[Float64Array, Float64Array, float]]) -> int:
    """Number of copies of which none merges with one that is counted before.

    Each is its box in the image, its middle and its size, m: what is far behind is smaller.
    """
    apart = list[tuple[Float64Array, Float64Array]]()
    for box, middle, size_m in copies:
        is_merged = any(
            _overlap(box, other) and np.linalg.norm(middle - place) < _NEAR * size_m
            for other, place in apart
        )
        if np.prod(np.ptp(box, axis=0)) > 0.0 and not is_merged:
            apart.append((box, middle))
    return len(apart)


def _overlap(box: Float64Array, other: Float64Array) -> bool:
    """Whether two boxes in the image look like one."""
    low, high = np.maximum(box[0], other[0]), np.minimum(box[1], other[1])
    shared = float(np.prod(np.maximum(high - low, 0.0)))
    areas = [float(np.prod(np.ptp(one, axis=0))) for one in (box, other)]
    return shared >= _MERGED * max(min(areas), 1e-9)
