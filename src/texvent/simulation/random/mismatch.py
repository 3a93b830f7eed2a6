"""Mismatch between the pixels of a sensor: drawn once, the same in every frame of a seed."""

from __future__ import annotations

import math
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range
from texvent.simulation.random.draws import Purpose, draw_normals, draw_uniforms, frame_key

Float64Array = NDArray[np.float64]
Shape = tuple[int, ...]

LOWEST_THRESHOLD = 0.01
"""Floor of drawn thresholds, log units: v2e's and ESIM's, so that no pixel fires without end."""
LONG_AGO_US = -(2**62)
"""Stands for the last event of a pixel that has not fired yet, µs."""
SENSOR_FRAME = -1
"""Frame number in keys of draws that belong to the sensor; frames count from 0."""


class Thresholds(NamedTuple):
    """Contrast thresholds: changes of brightness that fire a pixel, log units."""

    on: Float64Array
    """[n], or [1] where all pixels have the same."""
    off: Float64Array
    """[n] or [1]."""


class NominalThresholds(Protocol):
    """The options that say what a sensor's thresholds are."""

    @property
    def contrast_threshold_on(self) -> float:
        """Mean of the ON thresholds, log units."""
        ...

    @property
    def contrast_threshold_off(self) -> float:
        """Mean of the OFF thresholds, log units."""
        ...

    @property
    def threshold_sigma(self) -> float:
        """Standard deviation of both, log units."""
        ...


class PixelMismatch(NamedTuple):
    """Constants that differ from pixel to pixel, as compiled kernels read them."""

    threshold_on: NDArray[np.float32]
    """[n] log units, above 0."""
    threshold_off: NDArray[np.float32]
    """[n] log units, above 0."""
    leak: NDArray[np.float32]
    """[n] log units per µs by which the change grows on its own, at least 0; [0] without leak."""

    def part(self, part: slice) -> PixelMismatch:
        """That of some pixels."""
        return PixelMismatch(self.threshold_on[part], self.threshold_off[part], self.leak[part])


def check_nominal_thresholds(nominal: NominalThresholds) -> None:
    """Check the ranges of three options.

    Raises:
        ConfigError: one is out of range.
    """
    on, off = nominal.contrast_threshold_on, nominal.contrast_threshold_off
    check_range("contrast_threshold_on", on, LOWEST_THRESHOLD, 10.0)
    check_range("contrast_threshold_off", off, LOWEST_THRESHOLD, 10.0)
    check_range("threshold_sigma", nominal.threshold_sigma, 0.0, 10.0)


def smaller_threshold(nominal: NominalThresholds) -> float:
    """The smaller of the two nominal thresholds, log units."""
    return min(nominal.contrast_threshold_on, nominal.contrast_threshold_off)


def draw_threshold_pair(
    shape: Shape, key: np.uint64, nominal: NominalThresholds
) -> tuple[Float64Array, Float64Array]:
    """ON and OFF thresholds of every pixel, two of [H, W]; see `draw_threshold_pair_at`."""
    y, x = np.ogrid[: shape[0], : shape[1]]
    return draw_threshold_pair_at(y, x, key, nominal)


def draw_threshold_pair_at(
    y: NDArray[np.int64], x: NDArray[np.int64], key: np.uint64, nominal: NominalThresholds
) -> tuple[Float64Array, Float64Array]:
    """Contrast thresholds of some pixels, with Gaussian mismatch between pixels.

    Args:
        y: rows, of a shape that broadcasts with `x`.
        x: columns.
        key: of `sensor_key`, or of a frame for thresholds that change in time.
        nominal: means and standard deviation; of 0, every pixel has the means.

    Returns:
        ON and OFF thresholds, float64, log units; drawn ones are at least `LOWEST_THRESHOLD`.
    """
    sigma = nominal.threshold_sigma

    def draw(mean: float, purpose: Purpose) -> Float64Array:
        if sigma == 0:
            return np.full(np.broadcast_shapes(y.shape, x.shape), float(mean))
        return np.maximum(mean + sigma * draw_normals(key, y, x, purpose.draw()), LOWEST_THRESHOLD)

    return (
        draw(nominal.contrast_threshold_on, Purpose.THRESHOLD_ON),
        draw(nominal.contrast_threshold_off, Purpose.THRESHOLD_OFF),
    )


def thresholds_at(pixel: NDArray[np.int64], thresholds: Thresholds) -> Thresholds:
    """Those of some pixels, of thresholds of all, [H · W] each, or [1] if all have the same."""
    on, off = (one if one.size == 1 else one[pixel] for one in thresholds)
    return Thresholds(on, off)


def draw_rate_factors(
    shape: Shape, key: np.uint64, purpose: Purpose, *, decades: float
) -> Float64Array:
    """Log-normal factors on a rate, median 1.

    Args:
        shape: (height, width).
        key: of `sensor_key`.
        purpose: what the rate is of.
        decades: standard deviation of log10 of the factor; 0 gives 1 everywhere.

    Returns:
        [H, W] float64, above 0.
    """
    if decades == 0:
        return np.ones(shape)
    y, x = np.ogrid[: shape[0], : shape[1]]
    return np.asarray(np.exp(math.log(10) * decades * draw_normals(key, y, x, purpose.draw())))


def draw_chosen(
    shape: Shape, key: np.uint64, purpose: Purpose, *, fraction: float
) -> NDArray[np.bool_]:
    """Pixels chosen at random, each with probability `fraction`; [H, W] bool."""
    y, x = np.ogrid[: shape[0], : shape[1]]
    return np.asarray(draw_uniforms(key, y, x, purpose.draw()) < fraction)


def sensor_key(seed: int) -> np.uint64:
    """Key of the draws that are made once for the sensor."""
    return frame_key(seed, SENSOR_FRAME)
