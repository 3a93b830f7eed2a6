"""Scenes made by hand, so that the renderer is tested without the words that make scenes."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from texvent.camera import PosedCamera
from texvent_scenes.rendered_scene import (
    LAMP_RECORD,
    Environment,
    Float64Array,
    Ground,
    Primitives,
    Shape,
    Texture,
)

Point = tuple[float, float, float]


@dataclass(frozen=True)
class MovingShape:
    """One shape: where it is at each instant, and what it looks like."""

    shape: Shape
    scale: Point
    place: Callable[[float], Point]
    colour: Point = (0.8, 0.1, 0.05)
    second: Point = (0.9, 0.9, 0.9)
    texture: Texture = Texture.PLAIN
    texture_scale: float = 1.0
    spin: float = 0.0
    emission: float = 0.0
    instance: int = 0


def still(x: float, y: float, z: float) -> Callable[[float], Point]:
    return lambda time: (x, y, z)


def moving(start: Point, velocity: Point) -> Callable[[float], Point]:
    return lambda time: (
        start[0] + time * velocity[0],
        start[1] + time * velocity[1],
        start[2] + time * velocity[2],
    )


def look_at(position: Point, target: Point) -> PosedCamera:
    forward = np.subtract(target, position).astype(np.float64)
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    return PosedCamera(
        np.array(position, dtype=np.float64),
        np.stack([right, np.cross(forward, right), forward]),
        1.0,
    )


def day(ground: Ground = Ground.GRASS) -> Environment:
    sun = np.array([-0.5, -0.6, 0.7])
    return Environment(
        ground=ground,
        ground_colour=np.array([0.09, 0.2, 0.04], dtype=np.float32),
        ground_second_colour=np.array([0.16, 0.25, 0.06], dtype=np.float32),
        road_angle=0.0,
        road_half_width=3.5,
        road_offset=np.zeros(2),
        sky_top=np.array([0.12, 0.3, 0.75], dtype=np.float32),
        sky_horizon=np.array([0.6, 0.75, 0.9], dtype=np.float32),
        clouds=0.0,
        sun_direction=sun / np.linalg.norm(sun),
        sun_colour=np.array([1.0, 0.95, 0.85], dtype=np.float32),
        ambient=np.array([0.3, 0.35, 0.42], dtype=np.float32),
        shadows=True,
        fog_distance=np.inf,
        fog_colour=np.array([0.7, 0.75, 0.8], dtype=np.float32),
        exposure=1.0,
        lamps=np.zeros(0, LAMP_RECORD),
        time_s=0.0,
    )


def lamp_row(
    place: Point,
    light: Point = (2.0, 2.0, 2.0),
    *,
    reach: float = 100.0,
    beam: Point | None = None,
    cosines: tuple[float, float] = (-2.0, -2.0),
    radius: float = 0.01,
    casts: bool = False,
    glows: bool = False,
) -> np.ndarray:
    """[1] `LAMP_RECORD`."""
    direction = (0.0, 0.0, 0.0) if beam is None else beam
    return np.array([(place, light, reach, direction, *cosines, radius, casts, glows)], LAMP_RECORD)


def turned(angle: float) -> Float64Array:
    cosine, sine = np.cos(angle), np.sin(angle)
    return np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])


@dataclass(frozen=True)
class HandScene:
    """A scene of `Thing`s."""

    shapes: tuple[MovingShape, ...] = ()
    camera_at: Callable[[float], PosedCamera] = field(
        default=lambda time: look_at((0.0, -8.0, 1.7), (0.0, 0.0, 1.0))
    )
    environment_base: Environment = field(default_factory=day)
    class_names: dict[int, str] = field(default_factory=dict)

    def primitives(self, time_s: float) -> Primitives:
        maps = np.zeros((len(self.shapes), 3, 4))
        for row, shape in enumerate(self.shapes):
            maps[row, :, :3] = turned(shape.spin * time_s) * shape.scale
            maps[row, :, 3] = shape.place(time_s)
        shapes = self.shapes
        return Primitives(
            shape=np.array([shape.shape for shape in shapes], dtype=np.int8),
            to_world=maps,
            colour=np.array([t.colour for t in shapes], dtype=np.float32).reshape(-1, 3),
            second_colour=np.array([t.second for t in shapes], dtype=np.float32).reshape(-1, 3),
            texture=np.array([shape.texture for shape in shapes], dtype=np.int8),
            texture_scale=np.array([shape.texture_scale for shape in shapes], dtype=np.float32),
            emission=np.array([shape.emission for shape in shapes], dtype=np.float32),
            instance=np.array([shape.instance for shape in shapes], dtype=np.int32),
        )

    def camera(self, time_s: float) -> PosedCamera:
        return self.camera_at(time_s)

    def environment(self, time_s: float) -> Environment:
        return replace(self.environment_base, time_s=time_s)


def showcase(ground: Ground = Ground.ROAD) -> HandScene:
    """One of each shape and texture."""
    box, cylinder, grey = Shape.BOX, Shape.CYLINDER, (0.9, 0.9, 0.9)
    rows = (
        (Shape.ELLIPSOID, grey, still(-2.6, 0.0, 0.9), (0.8, 0.1, 0.05), grey),
        (box, (1.4, 0.7, 0.5), moving((0.0, 0.5, 0.6), (2.0, 0.0, 0.0)), (0.05, 0.2, 0.7), grey,
         Texture.CHECKS, 4.0),
        (cylinder, (0.4, 0.4, 1.0), still(2.6, 0.0, 1.0), (0.8, 0.1, 0.05), grey,
         Texture.STRIPES, 4.0),
        (Shape.CONE, (0.8, 0.8, 1.2), still(-1.0, 2.5, 1.2), (0.02, 0.25, 0.05), grey,
         Texture.MOTTLED, 5.0),
        (cylinder, (0.02, 0.02, 2.0), still(1.2, -1.0, 2.0), (0.8, 0.1, 0.05), grey),
        (box, (3.0, 2.0, 4.0), still(5.0, 14.0, 4.0), (0.45, 0.3, 0.2), (0.05, 0.07, 0.1),
         Texture.CHECKS, 3.0),
    )  # fmt: skip
    shapes = (MovingShape(*row, instance=number) for number, row in enumerate(rows, 1))
    return HandScene(tuple(shapes), environment_base=day(ground))
