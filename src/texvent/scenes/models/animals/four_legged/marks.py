"""Marks of faces and trunks by which a stranger tells one four-legged animal from another."""

from __future__ import annotations

from collections.abc import Callable

from texvent.scenes.models.animals.four_legged.build import Build, Coat, FaceDraw
from texvent.scenes.models.materials import BLACK, WHITE, Material, fur, skin
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import Point, ball, limb, rod
from texvent.scenes.scene import Colour

Extras = Callable[[Build, Coat], list[ModelPart]]


def _on_skull(build: Build, top: Point, place: Point, size: Point, paint: Material) -> ModelPart:
    """A spot on a head; place and size in shares of the skull."""
    skull = build.head[0]
    x, y, z = place
    middle = (top[0] + x * skull, top[1] + y * skull, top[2] + z * skull)
    return ball(paint, middle, (size[0] * skull, size[1] * skull, size[2] * skull))


def eye_patches(hue: Colour = BLACK) -> FaceDraw:
    """Dark patches round the eyes, as a panda has."""

    def draw(build: Build, top: Point) -> list[ModelPart]:
        dark, pale = fur(hue), Material((0.85, 0.85, 0.83))
        parts = []
        for side in (1.0, -1.0):
            patch, glint = (0.40, 0.22 * side, 0.10), (0.505, 0.235 * side, 0.17)
            parts.append(_on_skull(build, top, patch, (0.34, 0.30, 0.38), dark))
            parts.append(_on_skull(build, top, glint, (0.10, 0.12, 0.12), pale))
        return parts

    return draw


def mask(build: Build, top: Point) -> list[ModelPart]:
    """A dark band over the eyes under a pale brow, and pale cheeks, as a raccoon has."""
    pale, dark = fur((0.72, 0.70, 0.66)), fur((0.025, 0.025, 0.025))
    parts = []
    for side in (1.0, -1.0):
        brow, band, cheek = (
            (0.34, 0.20 * side, 0.30),
            (0.36, 0.24 * side, 0.08),
            (0.34, 0.24 * side, -0.14),
        )
        parts.append(_on_skull(build, top, brow, (0.42, 0.34, 0.26), pale))
        parts.append(_on_skull(build, top, cheek, (0.48, 0.40, 0.28), pale))
        parts.append(_on_skull(build, top, band, (0.50, 0.40, 0.26), dark))
        parts.append(_on_skull(build, top, (0.57, 0.22 * side, 0.15), (0.08, 0.10, 0.10), pale))
    return parts


def cheeks(hue: Colour) -> FaceDraw:
    """Pale cheeks and chin, as a fox, a tiger or a corgi has."""

    def draw(build: Build, top: Point) -> list[ModelPart]:
        pale = fur(hue)
        parts = [
            _on_skull(build, top, (0.28, 0.26 * side, -0.16), (0.56, 0.34, 0.44), pale)
            for side in (1.0, -1.0)
        ]
        return parts

    return draw


def big_nose(build: Build, top: Point) -> list[ModelPart]:
    """A koala's upright black nose."""
    return [_on_skull(build, top, (0.66, 0.0, 0.0), (0.24, 0.26, 0.46), skin((0.02, 0.02, 0.02)))]


def snout(hue: Colour) -> FaceDraw:
    """A flat disc before the nose, as a pig has, with its two holes."""

    def draw(build: Build, top: Point) -> list[ModelPart]:
        skull, muzzle = build.head
        x, z = top[0] + 0.35 * skull + muzzle, top[2] - 0.45 * muzzle - 0.05 * skull
        disc = rod(skin(hue), (x, 0.0, z), (x + 0.14 * skull, 0.0, z), 0.24 * skull)
        holes = [
            ball(Material(BLACK), (x + 0.15 * skull, 0.09 * s * skull, z), (0.06 * skull,) * 3)
            for s in (1.0, -1.0)
        ]
        return [disc, *holes]

    return draw


def whiskers(build: Build, top: Point) -> list[ModelPart]:
    """White cheeks at the nose with whiskers, and slit eyes, as a cat has."""
    skull, muzzle = build.head
    x, z = top[0] + 0.38 * skull + 0.8 * muzzle, top[2] - 0.40 * muzzle - 0.14 * skull
    pale = Material(WHITE)
    parts = [
        ball(
            pale,
            (x + 0.06 * skull, 0.11 * s * skull, z),
            (0.22 * skull, 0.22 * skull, 0.16 * skull),
        )
        for s in (1.0, -1.0)
    ]
    for side in (1.0, -1.0):
        for up in (-0.06, 0.06):
            root = (x + 0.08 * skull, 0.16 * side * skull, z)
            tip = (x - 0.05 * skull, 0.75 * side * skull, z + up * skull)
            parts.append(rod(pale, root, tip, 0.012 * skull))
        iris, slit = (0.40, 0.27 * side, 0.15), (0.48, 0.285 * side, 0.15)
        parts.append(_on_skull(build, top, iris, (0.20, 0.19, 0.19), Material((0.50, 0.55, 0.06))))
        parts.append(_on_skull(build, top, slit, (0.06, 0.06, 0.17), Material(BLACK)))
    return parts


def dark_shoulders(build: Build, coat: Coat) -> list[ModelPart]:
    """A dark band over the shoulders, as a panda has."""
    length, width, height = build.body
    z = build.shoulder - 0.5 * height
    low, high = (0.28 * length, 0.0, z - 0.2 * height), (0.28 * length, 0.0, z + 0.2 * height)
    return [limb(fur(BLACK), low, high, 0.40 * height, side_radius=0.56 * width)]


def hump(build: Build, coat: Coat) -> list[ModelPart]:
    """The high shoulders of a bear."""
    length, width, height = build.body
    z = build.shoulder - 0.16 * height
    return [ball(coat.trunk, (0.20 * length, 0.0, z), (0.50 * length, 0.72 * width, 0.62 * height))]


def curled_tail(build: Build, coat: Coat) -> list[ModelPart]:
    """A squirrel's tail: up along the back and over at its tip."""
    length, _, height = build.body
    x, z = -0.44 * length, build.shoulder - 0.45 * height
    places = ((0.0, 0.0), (-0.26, 0.25), (-0.30, 0.75), (-0.16, 1.15), (-0.40, 1.40))
    points: list[Point] = [(x + a * length, 0.0, z + b * length) for a, b in places]
    widths = (0.11, 0.20, 0.25, 0.19)
    return [
        limb(coat.limbs, start, end, wide * length)
        for start, end, wide in zip(points[:-1], points[1:], widths, strict=True)
    ]


def pale_front(hue: Colour) -> Extras:
    """A pale chest."""

    def draw(build: Build, coat: Coat) -> list[ModelPart]:
        length, width, height = build.body
        z = build.shoulder - 0.58 * height
        chest = ball(
            fur(hue), (0.34 * length, 0.0, z), (0.36 * length, 0.62 * width, 0.76 * height)
        )
        belly = ball(
            fur(hue), (0.0, 0.0, z - 0.04 * height), (0.9 * length, 0.6 * width, 0.8 * height)
        )
        return [chest, belly]

    return draw


def bib(build: Build, coat: Coat) -> list[ModelPart]:
    """The white chest that many cats have; a black one has none."""
    if max(coat.trunk.colour) < _BLACK_COAT:
        return []
    return pale_front((0.80, 0.78, 0.74))(build, coat)


_BLACK_COAT = 0.06
"""Brightest channel of a coat that passes for black."""


def udder(build: Build, coat: Coat) -> list[ModelPart]:
    """A cow's udder with its teats."""
    length, width, height = build.body
    pink = skin((0.72, 0.44, 0.40))
    x, z = -0.24 * length, build.shoulder - 0.98 * height
    bag = ball(pink, (x, 0.0, z), (0.24 * length, 0.56 * width, 0.38 * height))
    teats = [
        limb(pink, (x + 0.05 * a, 0.1 * b, z - 0.14 * height),
             (x + 0.05 * a, 0.1 * b, z - 0.26 * height), 0.022)
        for a in (1.0, -1.0) for b in (1.0, -1.0)
    ]  # fmt: skip
    return [bag, *teats]


def white_back(build: Build, coat: Coat) -> list[ModelPart]:
    """A white band from the head along the back, as a skunk has."""
    length, width, height = build.body
    z = build.shoulder - 0.20 * height
    pale = fur((0.85, 0.85, 0.83))
    start, end = (0.42 * length, 0.0, z), (-0.42 * length, 0.0, z)
    return [limb(pale, start, end, 0.28 * height, side_radius=0.20 * width)]
