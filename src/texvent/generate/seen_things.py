"""Which things of a scene its camera ever sees: what stays hidden is not shown."""

from __future__ import annotations

import math
from collections import Counter

import numpy as np

from texvent.scenes.inflection import pluralise
from texvent.scenes.raycast.ground_truth import visible_instances
from texvent.scenes.scene import Float64Array, Scene
from texvent.sensor import SensorSize

INSTANTS = 9
"""Instants of the clip at which it is looked for things."""
MOST_COUNTED = 6
"""Things of a noun that are counted one by one; of more, some may hide each other."""
MOST_POINTS = 4000
"""Image points that are looked at per instant."""


def list_unseen(scene: Scene, size: SensorSize, duration_s: float) -> tuple[str, ...]:
    """Things that are not seen at any instant: out of the image, hidden, or a few pixels small.

    Args:
        scene: the scene; its `class_names` are looked for.
        size: of the image, pixels.
        duration_s: of the clip, s.

    Returns:
        Their nouns; or how many of them, such as "1 of 3 dogs", of at most `MOST_COUNTED`.
    """
    names = scene.class_names
    missing = dict(names)
    points = image_points(size)
    for time_s in np.linspace(0.0, duration_s, INSTANTS):
        if not missing:
            break
        _, instances = visible_instances(scene, float(time_s), size, points)
        for instance in np.unique(instances).tolist():
            missing.pop(instance, None)
    found, all_of = [], Counter(names.values())
    for noun, count in Counter(missing.values()).items():
        if count == all_of[noun]:
            found.append(noun)
        elif all_of[noun] <= MOST_COUNTED:
            found.append(f"{count} of {all_of[noun]} {pluralise(noun)}")
    return tuple(found)


def image_points(size: SensorSize) -> Float64Array:
    """Centres of pixels [k, 2] (x, y), evenly spread; rows are shifted, so that poles are met too.

    Example:
        >>> image_points(SensorSize(3, 2)).tolist()[:3], len(image_points(SensorSize(346, 260)))
        ([[0.5, 0.5], [1.5, 0.5], [2.5, 0.5]], 3599)
    """
    step = max(1, math.ceil(math.sqrt(size.width * size.height / MOST_POINTS)))
    rows = np.arange(step // 2, size.height, step)
    found = []
    for number, row in enumerate(rows):
        columns = np.arange((2 * number) % step, size.width, step)
        found.append(np.stack([columns, np.full(len(columns), row)], axis=1))
    return np.asarray(np.concatenate(found) + 0.5, dtype=np.float64)
