"""A model made of parts that stay in place and parts that move with the pose."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from texvent.scenes.models.protocol import ModelPart, Pose
from texvent.scenes.models.shapes import Affine, bounds

Articulation = Callable[[Pose], Sequence[ModelPart]]
Anchorage = Callable[[str, Pose], Affine | None]
"""Axes [3, 4] at a named place of a body at its usual size."""

# Poses that together show how far limbs, wings and rotors reach: times and distances spread
# evenly by the golden ratio and its two-dimensional counterpart, out of step with any cycle.
SAMPLE_POSES = tuple(
    Pose(
        time_s=5.0 * (0.6180339887 * step % 1.0),
        distance_m=6.0 * (0.7548776662 * step % 1.0),
        speed_m_s=3.0,
        activity=what,
    )
    for what in ("stand", "move", "run")
    for step in range(12)
)
STANDING_POSES = SAMPLE_POSES[:12]
"""The sample for what moves with time alone."""


class ArticulatedModel:
    """A `Model` from parts drawn at its usual size.

    Its length, width and height are measured, not declared, so they are true for every seed: the
    least box around the origin (from the ground up, unless `is_centred`) that holds all parts
    over a sample of poses.
    """

    def __init__(
        self,
        rigid: Sequence[ModelPart],
        *,
        scale: float,
        articulate: Articulation | None = None,
        is_centred: bool = False,
        anchor: Anchorage | None = None,
        poses: Sequence[Pose] = SAMPLE_POSES,
        is_wheeled: bool = False,
    ) -> None:
        """Measure the figure.

        Args:
            rigid: parts that never move in the body.
            scale: size relative to the usual one.
            articulate: gives the parts that move; None = there are none.
            is_centred: whether the origin is its middle rather than the ground below it.
            anchor: places at which other things are held; None = those of its box.
            poses: what its size is measured over.
            is_wheeled: whether it rolls on wheels; what does not rolls as a whole.
        """
        self._scale = float(scale)
        self._rigid = [_scaled(each, self._scale) for each in rigid]
        self._articulate = articulate
        self._anchor = anchor
        self.is_centred = is_centred
        self.is_wheeled = is_wheeled
        low, high = (self._scale * corner for corner in _measure(rigid, articulate, poses))
        reach = np.maximum(np.abs(low), np.abs(high))
        self.length = float(2.0 * reach[0])
        self.width = float(2.0 * reach[1])
        self.height = float(2.0 * reach[2]) if is_centred else float(high[2])

    @property
    def scale(self) -> float:
        """Size relative to the usual one."""
        return self._scale

    def parts(self, pose: Pose) -> Sequence[ModelPart]:
        """The shapes at that pose, rigid ones first."""
        if self._articulate is None:
            return list(self._rigid)
        usual = self._at_usual_size(pose)
        return [*self._rigid, *(_scaled(each, self._scale) for each in self._articulate(usual))]

    def anchor(self, name: str, pose: Pose) -> Affine | None:
        """Axes [3, 4] at a named place, m; None = this model names no places."""
        if self._anchor is None:
            return None
        axes = self._anchor(name, self._at_usual_size(pose))
        if axes is None:
            return None
        return np.column_stack([axes[:, :3], self._scale * axes[:, 3]])

    def _at_usual_size(self, pose: Pose) -> Pose:
        """The same instant of a body of the usual size."""
        if self._scale == 1.0:
            return pose
        grips = tuple(
            (name, (x / self._scale, y / self._scale, z / self._scale))
            for name, (x, y, z) in pose.grips
        )
        return replace(
            pose,
            distance_m=pose.distance_m / self._scale,
            speed_m_s=pose.speed_m_s / self._scale,
            grips=grips,
        )


def _measure(
    rigid: Sequence[ModelPart], articulate: Articulation | None, poses: Sequence[Pose]
) -> tuple[Affine, Affine]:
    """Lowest and highest x, y, z that the parts reach, at the usual size, m."""
    parts = list(rigid)
    if articulate is not None:
        for pose in poses:
            parts += articulate(pose)
    return bounds(parts)


def _scaled(each: ModelPart, scale: float) -> ModelPart:
    return each if scale == 1.0 else each.at(scale * each.to_body)
