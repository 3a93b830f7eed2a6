"""Lenses: where on the image a direction lands, and back, with distortion.

Normalised coordinates are x and y of a direction whose component along the optical axis is 1.
Image coordinates are pixels with (0, 0) at the image's top left *corner*. Calibration files
(OpenCV, Kalibr, ROS) count from the *centre* of the top left pixel: their principal point is half
a pixel less in x and y, see `Lens.intrinsics`.

    radtan       x_d = x (1 + k1 r² + k2 r⁴ + k3 r⁶) + 2 p1 x y + p2 (r² + 2 x²), y_d likewise
    equidistant  θ_d = θ (1 + k1 θ² + k2 θ⁴ + k3 θ⁶ + k4 θ⁸), θ = atan r

Source: OpenCV's camera model (radtan: its first five coefficients) and fisheye model, which
Kalibr calls radtan and equidistant; Brown 1966; Kannala and Brandt, PAMI 2006.
"""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.errors import ConfigError
from texvent.sensor import SensorSize

Float64Array = NDArray[np.float64]
Distortion = Literal["none", "radtan", "equidistant"]
DISTORTIONS: tuple[Distortion, ...] = ("none", "radtan", "equidistant")
"""Models by name; the position is the number by which kernels know them."""
WIDEST = math.radians(85.0)
"""Nothing further from the optical axis is seen: a fisheye's image ends in a circle there."""
ITERATIONS = 30
"""Newton steps at most; a lens that does not fold needs four to six."""
CONVERGED = 1e-12
"""Distance in normalised coordinates at which Newton's steps end."""
RETURNED_PX = 1e-6
"""Most that a ray may land from where it was searched for."""
HALF_PIXEL = 0.5


@dataclass(frozen=True)
class Lens:
    """Calibration of one camera: pinhole projection and distortion.

    Raises:
        ConfigError: a focal length is not above 0, or a number is not finite.
    """

    fx: float
    """Focal length in pixel widths."""
    fy: float
    """Focal length in pixel heights."""
    cx: float
    """Column at which the optical axis meets the image, pixels from its left edge."""
    cy: float
    """Row at which the optical axis meets the image, pixels from its top edge."""
    distortion: Distortion = "none"
    coefficients: tuple[float, ...] = (0.0, 0.0, 0.0, 0.0)
    """k1, k2, p1, p2 of radtan, and k3 if there is a fifth; or k1, k2, k3, k4 of equidistant."""

    def __post_init__(self) -> None:
        if not (self.fx > 0.0 and self.fy > 0.0 and math.isfinite(self.fx + self.fy)):
            raise ConfigError(
                f"the focal lengths are {self.fx:g} and {self.fy:g} pixels; they must be above 0"
            )
        if not all(map(math.isfinite, (self.cx, self.cy, *self.coefficients))):
            raise ConfigError(
                f"centre ({self.cx:g}, {self.cy:g}) and coefficients {list(self.coefficients)}; "
                "all must be finite"
            )

    @property
    def number(self) -> int:
        """The distortion as kernels know it: its place in `DISTORTIONS`."""
        return DISTORTIONS.index(self.distortion)

    @property
    def five(self) -> tuple[float, float, float, float, float]:
        """The coefficients, 0 for those that the model lacks."""
        k1, k2, p1, p2, k3 = (*self.coefficients, *[0.0] * (5 - len(self.coefficients)))
        return k1, k2, p1, p2, k3

    @property
    def intrinsics(self) -> tuple[float, float, float, float]:
        """fx, fy, cx, cy of calibration files: pixel centres have whole coordinates."""
        return self.fx, self.fy, self.cx - HALF_PIXEL, self.cy - HALF_PIXEL


class LensReach(NamedTuple):
    """Effect of a lens on a whole image."""

    plane: tuple[float, float, float, float]
    """Left, top, right, bottom of all pixels in the image that the same pinhole camera without
    distortion has, pixels."""
    coarsest_angle: float
    """Largest angle between neighbouring pixels, over that on the optical axis."""
    coarsest_step: float
    """Largest step between neighbouring pixels in the image without distortion, pixels."""
    dark: float
    """Share of the image that no ray reaches: outside an equidistant lens's circle of 85°."""


def distort(lens: Lens, points: Float64Array) -> Float64Array:
    """Normalised coordinates [..., 2] → those where the lens puts them; NaN where it folds."""
    x, y = points[..., 0], points[..., 1]
    first, second, third, fourth, fifth = lens.five
    if lens.distortion == "none":
        return points
    square = x * x + y * y
    if lens.distortion == "radtan":
        radial = 1.0 + square * (first + square * (second + square * fifth))
        placed = (
            x * radial + 2.0 * third * x * y + fourth * (square + 2.0 * x * x),
            y * radial + 2.0 * fourth * x * y + third * (square + 2.0 * y * y),
        )
    else:
        radius = np.sqrt(square)
        angle = np.arctan(radius)
        a = angle * angle
        scale = angle * (1.0 + a * (first + a * (second + a * (third + a * fourth))))
        ratio = np.where(radius > 0.0, scale / np.where(radius > 0.0, radius, 1.0), 1.0)
        placed = (x * ratio, y * ratio)
    inside = square <= lens_limits(lens)[0] ** 2
    return np.where(inside[..., None], np.stack(placed, axis=-1), np.nan)


def undistort(lens: Lens, points: Float64Array) -> Float64Array:
    """The inverse of `distort`, by Newton's method; anything where a lens folds, see `returns`.

    This is the definition that the kernels of `raycast/vectors.py` are tested against.
    """
    target = np.asarray(points, dtype=np.float64)
    if lens.distortion == "none":
        return target
    if lens.distortion == "equidistant":
        radius = np.linalg.norm(target, axis=-1)
        angle = _equidistant_angle(lens, radius)
        ratio = np.where(radius > 0.0, np.tan(angle) / np.where(radius > 0.0, radius, 1.0), 1.0)
        return np.asarray(target * ratio[..., None])
    k1, k2, p1, p2, k3 = lens.five
    radius, furthest = np.linalg.norm(target, axis=-1, keepdims=True), lens_limits(lens)[1]
    found: Float64Array = target * np.minimum(furthest / np.maximum(radius, 1e-300), 1.0)
    for _ in range(ITERATIONS):
        x, y = found[..., 0], found[..., 1]
        square = x * x + y * y
        radial = 1.0 + square * (k1 + square * (k2 + square * k3))
        slope = 2.0 * (k1 + square * (2.0 * k2 + 3.0 * k3 * square))
        miss_x = x * radial + 2.0 * p1 * x * y + p2 * (square + 2.0 * x * x) - target[..., 0]
        miss_y = y * radial + 2.0 * p2 * x * y + p1 * (square + 2.0 * y * y) - target[..., 1]
        xx = radial + slope * x * x + 2.0 * p1 * y + 6.0 * p2 * x
        xy = slope * x * y + 2.0 * p1 * x + 2.0 * p2 * y
        yy = radial + slope * y * y + 2.0 * p2 * x + 6.0 * p1 * y
        determinant = xx * yy - xy * xy
        determinant = np.where(determinant == 0.0, np.nan, determinant)
        step = np.stack(
            [
                (yy * miss_x - xy * miss_y) / determinant,
                (xx * miss_y - xy * miss_x) / determinant,
            ],
            axis=-1,
        )
        found = found - step
        if not np.any(np.abs(step) > CONVERGED):
            break
    return found


def _equidistant_angle(lens: Lens, distorted: Float64Array) -> Float64Array:
    """θ of θ_d, radians; NaN beyond `WIDEST`."""
    k1, k2, k3, k4, _ = lens.five
    angle = np.array(distorted)
    for _ in range(ITERATIONS):
        a = angle * angle
        miss = angle * (1.0 + a * (k1 + a * (k2 + a * (k3 + a * k4)))) - distorted
        slope = 1.0 + a * (3.0 * k1 + a * (5.0 * k2 + a * (7.0 * k3 + a * 9.0 * k4)))
        step = miss / np.where(slope == 0.0, np.nan, slope)
        angle = angle - step
        if not np.any(np.abs(step) > CONVERGED):
            break
    return np.where((angle >= 0.0) & (angle <= WIDEST), angle, np.nan)


@functools.lru_cache(maxsize=64)
def lens_limits(lens: Lens) -> tuple[float, float]:
    """Normalised radii: where the lens folds, and the furthest start of the search for a ray.

    Steps from near a fold lead away; from where a lens spreads points most they settle.
    """
    angle = np.linspace(0.0, WIDEST, 20_001)
    a, radius = angle * angle, np.tan(angle)
    k1, k2, k3, k4, k5 = lens.five
    if lens.distortion == "radtan":
        square = radius * radius
        slope = 1.0 + square * (3.0 * k1 + square * (5.0 * k2 + square * 7.0 * k5))
    else:
        slope = 1.0 + a * (3.0 * k1 + a * (5.0 * k2 + a * (7.0 * k3 + a * 9.0 * k4)))
    folded = np.flatnonzero(slope <= 0.0)
    last = folded[0] - 1 if len(folded) else len(radius) - 1
    return float(radius[last]), float(radius[np.argmax(slope[: last + 1])]) or math.inf


def normalised(lens: Lens, points: Float64Array) -> Float64Array:
    """Normalised coordinates [..., 2] of the rays through image points [..., 2], pixels."""
    return undistort(lens, (points - [lens.cx, lens.cy]) / [lens.fx, lens.fy])


def returns(lens: Lens, points: Float64Array, found: Float64Array) -> NDArray[np.bool_]:
    """Whether the rays of `found`, normalised coordinates, land at those image points, pixels."""
    back = distort(lens, found) * [lens.fx, lens.fy] + [lens.cx, lens.cy]
    return np.asarray(np.abs(back - points).max(axis=-1) < RETURNED_PX)  # NaN does not


def straight_pixels(lens: Lens, size: SensorSize) -> Float64Array:
    """[H, W, 2] place of each pixel in the image of the same camera without distortion.

    Pixels have whole coordinates in the middle. NaN where the lens lets no ray through.
    """
    rows, columns = np.indices(size.shape) + HALF_PIXEL
    middles = np.stack([columns, rows], axis=-1)
    with np.errstate(all="ignore"):
        found = normalised(lens, middles)
        found[~returns(lens, middles, found)] = np.nan
    return np.asarray(found * lens.intrinsics[:2] + lens.intrinsics[2:])


@functools.lru_cache(maxsize=64)
def lens_reach(lens: Lens, size: SensorSize) -> LensReach:
    """Effect of a lens on an image of that size.

    Raises:
        ConfigError: it folds within the image, a pixel of a lens that is not equidistant looks
            further than 85° from the optical axis, or the image's middle sees nothing.
    """
    across = np.linspace(0.0, size.width, max(2, min(size.width // 4, 200)))
    down = np.linspace(0.0, size.height, max(2, min(size.height // 4, 200)))
    x, y = (one.ravel() for one in np.meshgrid(across, down))
    points = np.stack([x, y], axis=-1)
    found = normalised(lens, points)
    wrong = ~returns(lens, points, found)
    wrong |= ~(np.hypot(found[:, 0], found[:, 1]) <= math.tan(WIDEST) * (1.0 + 1e-9))
    dark = np.isnan(found[:, 0]) & (lens.distortion == "equidistant")
    wrong &= ~dark
    middle = normalised(lens, np.array([[0.5 * size.width, 0.5 * size.height]]))
    if wrong.any() or np.isnan(middle).any():
        wrong |= dark
        first = points[np.flatnonzero(wrong)[0]]
        raise ConfigError(
            f"no ray reaches image point ({first[0]:g}, {first[1]:g}) of {size} through this lens "
            f"({lens.distortion} {list(lens.coefficients)}): it folds there or looks further than "
            "85° from its axis; check its intrinsics and coefficients against the resolution"
        )
    focal = np.array([lens.fx, lens.fy])
    plane = found * focal + [lens.cx, lens.cy]
    low, high = np.nanmin(plane, axis=0), np.nanmax(plane, axis=0)
    if dark.any():
        centre, radius = np.array([lens.cx, lens.cy]), focal * math.tan(WIDEST)
        low, high = centre - radius, centre + radius
    half = 0.5 * np.eye(2)[:, None]
    steps = np.nan_to_num(normalised(lens, points + half) - normalised(lens, points - half))
    # |step × direction| / |direction|², with direction (x, y, 1) and step (sx, sy, 0).
    (x, y), (sx, sy) = np.nan_to_num(found).T, np.moveaxis(steps, -1, 0)
    across = np.sqrt(sx * sx + sy * sy + (sx * y - sy * x) ** 2)
    angles = across / (1.0 + x * x + y * y) * max(lens.fx, lens.fy)
    return LensReach(
        (float(low[0]), float(low[1]), float(high[0]), float(high[1])),
        max(1.0, float(angles.max())),
        max(1.0, float(np.abs(steps * focal).max())),
        float(dark.mean()),
    )
