"""The picture of a scene at some instants, through a grid of image points."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Container, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.generate.landmarks import is_marked
from texvent.scenes.projection import ray_directions
from texvent.scenes.raycast.render import grey_light, render_pixels
from texvent.scenes.raycast.trace import GROUND, SKY
from texvent.scenes.scene import Camera, Float64Array, Primitives
from texvent.scenes.staging.compose import ComposedScene
from texvent.sensor import SensorSize
from texvent.transfer import WHITE, encode_srgb

USUAL = (1, 4, 7)
"""Which of the nine views colours and light are judged by."""
DENSE = (1, 3, 4, 5, 7)
"""Which of them effects are judged by: a splash does not last."""
DARK, MOST_DARK = 0.30, 0.5
"""Luma up to which a point is dark, and share of such points that makes a picture dark."""
LEAST_TOLD = 0.005
"""Share of the image points that a noun of the scenery is told by."""
_GREY = 0.004
"""Difference between the levels of red, green and blue of what is grey."""
VISIBLE = 0.06
"""Difference of a coded level, as a share of white, that is seen at once."""


UNEVEN = 0.05
"""Share of the time by which uneven instants are moved."""


def uneven_times(start_s: float, end_s: float, count: int) -> Float64Array:
    """[count] instants with uneven gaps: what repeats itself is at another point of its round."""
    even = np.linspace(0.0, 1.0, count)
    return np.asarray(start_s + (end_s - start_s) * (even + UNEVEN * np.sin(2.0 * np.pi * even)))


class View(NamedTuple):
    """What the camera sees at an instant."""

    time_s: float
    camera: Camera
    size: SensorSize
    shapes: Primitives
    depth: Float64Array
    """[k] of each image point, m."""
    number: NDArray[np.int32]
    """[k] shape of each image point."""

    @property
    def owner(self) -> NDArray[np.int32]:
        """[n] instance of each shape."""
        return np.asarray(self.shapes.instance, dtype=np.int32)

    @property
    def instance(self) -> NDArray[np.int32]:
        """[k] instance at each image point; 0 = ground, sky, scenery."""
        is_shape = self.number >= 0
        found = np.zeros(len(self.number), dtype=np.int32)
        found[is_shape] = self.owner[self.number[is_shape]]
        return found

    @property
    def is_sky(self) -> NDArray[np.bool_]:
        """[k] whether each image point shows the sky."""
        return np.asarray(self.number == SKY)


class Picture:
    """A scene's picture through image points; what is asked for is rendered once."""

    def __init__(
        self, scene: ComposedScene, size: SensorSize, points: Float64Array, views: Sequence[View]
    ) -> None:
        self.scene = scene
        self.size = size
        self.points = points
        self.views = views
        self._wanted = np.zeros(size.shape, dtype=np.bool_)
        columns, rows = np.floor(points).astype(np.int64).T
        self._wanted[rows, columns] = True
        self._colours: dict[int, Float64Array] = {}

    def colours(self, number: int) -> Float64Array:
        """[k, 3] sRGB-coded, 0..1, of the view of that number."""
        if number not in self._colours:
            self._colours[number] = self._render(self.scene, number)
        return self._colours[number]

    def is_grey(self) -> bool:
        """Whether no image point has a colour."""
        return all(float(np.ptp(self.colours(one), axis=1).max()) < _GREY for one in USUAL)

    def seen_nouns(self, least: float = LEAST_TOLD) -> set[str]:
        """Nouns of all things and scenery of which that share of the image points shows them."""
        scenery = self.scene.list_scenery()
        most: Counter[str] = Counter()
        for view in self.views:
            counts: Counter[str] = Counter()
            for one, count in zip(*np.unique(view.number[view.number >= 0], return_counts=True),
                                  strict=True):  # fmt: skip
                noun = self.scene.class_names.get(int(view.owner[one]), "")
                counts[noun or (scenery[one] if one < len(scenery) else "")] += int(count)
            most |= counts
        return {noun for noun, count in most.items() if count >= least * len(self.points)}

    def scenery_share(self, nouns: Container[str]) -> float:
        """Share of the picture that scenery of those nouns covers, at most."""
        scenery = self.scene.list_scenery()
        wanted = [number for number, noun in enumerate(scenery) if noun in nouns]
        return max(float(np.isin(view.number, wanted).mean()) for view in self.views)

    def strip(self, number: int) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """[k] whether image points show water or road of the ground, and the ground beside it."""
        view = self.views[number]
        found = view.number == GROUND
        rays = ray_directions(view.camera, self.size, self.points[found])
        spots = (view.camera.position + rays * view.depth[found, None])[:, :2]
        _, where = is_marked(self.scene.environment(view.time_s), spots)
        beside = found.copy()
        found[found] = where
        beside[beside] = ~where
        return np.asarray(found, dtype=np.bool_), np.asarray(beside, dtype=np.bool_)

    def difference(
        self,
        change: Callable[[ComposedScene], ComposedScene] | None,
        number: int,
        *,
        shadows: bool = True,
    ) -> Float64Array:
        """[k] how much a view differs from that of a changed scene: the greatest of R, G and B.

        Args:
            change: gives the scene without what is looked for; None: as it is.
            number: of the view.
            shadows: False: the other scene is without any shadows.
        """
        changed = self.changed(change, number, shadows=shadows)
        return np.asarray(np.abs(self.colours(number) - changed).max(axis=1))

    def changed(
        self,
        change: Callable[[ComposedScene], ComposedScene] | None,
        number: int,
        *,
        shadows: bool = True,
    ) -> Float64Array:
        """[k, 3] as `colours`, of a changed scene; arguments as for `difference`."""
        other = self.scene if change is None else change(self.scene)
        return self._render(other, number, shadows=shadows)

    def luma(self) -> Float64Array:
        """Luma (BT.601) of all image points of the views that light is judged by, 0..1."""
        pixels = np.concatenate([self.colours(number) for number in USUAL])
        return np.asarray(pixels @ np.array([0.299, 0.587, 0.114]))

    def ground_share(self) -> float:
        """Share of the picture that is ground, at most."""
        return max(float(np.mean(self.views[one].number == GROUND)) for one in USUAL)

    def brightness(self) -> float:
        """Mean luma of the picture, 0..1."""
        return float(self.luma().mean())

    def is_dark(self) -> bool:
        """Whether it is dark on the whole, or most of it but for what lamps light."""
        luma = self.luma()
        return bool(luma.mean() <= DARK or np.mean(luma <= DARK) >= MOST_DARK)

    def _render(self, scene: ComposedScene, number: int, *, shadows: bool = True) -> Float64Array:
        light = render_pixels(
            scene, self.views[number].time_s, self.size, self._wanted, samples=1, shadows=shadows
        )
        light = grey_light(light) if scene.is_grey else light
        return np.asarray(encode_srgb(light) / WHITE, dtype=np.float64)


def lies_around(picture: Picture, own: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """[k] whether image points lie around those of a thing, as far as 4 % of the width."""
    at, reach = picture.points[own], 0.04 * picture.size.width
    low, high = at.min(axis=0) - reach, at.max(axis=0) + reach
    near = np.all((picture.points >= low) & (picture.points <= high), axis=1)
    return np.asarray(near & ~own)
