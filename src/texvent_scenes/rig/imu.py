"""Samples of an IMU on the rig: exact from the camera path, then with noise.

    accelerometer  f = Rᵀ (a − g) + b_a + n_a     specific force, m/s², in the IMU's axes
    gyroscope      ω = vee(Rᵀ Ṙ) + b_g + n_g      rad/s, in the IMU's axes

R turns IMU coordinates into the world's, a is the acceleration of the IMU in the world, g =
(0, 0, −9.80665) m/s²: an IMU at rest measures 9.80665 m/s² upwards. n is white noise of standard
deviation density · √rate, b a bias that starts at 0 and takes a step of density / √rate from
sample to sample (Woodman 2007; Kalibr's IMU noise model).

Derivatives are central differences of eighth order of the path, which is a function of time: for
a shake of 3.3 Hz they differ from the exact ones by 10⁻⁹ of their value. A blow, as where a camera
that follows an object bounces with it, is smoothed over 16 ms.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from texvent.frames import MICROSECONDS
from texvent.simulation.random.draws import draw_normals, frame_key
from texvent_scenes.rendered_scene import RenderedScene
from texvent_scenes.rig.description import Float64Array, ImuNoise, body_poses

GRAVITY = 9.80665
"""Standard gravity, m/s² (CGPM 1901)."""
STEP_S = 2e-3
"""Between the nine instants of a difference, s."""
FIRST = np.array([1 / 280, -4 / 105, 1 / 5, -4 / 5, 0, 4 / 5, -1 / 5, 4 / 105, -1 / 280])
"""Weights of the first derivative at offsets −4..4 (Fornberg 1988)."""
SECOND = np.array(
    [-1 / 560, 8 / 315, -1 / 5, 8 / 5, -205 / 72, 8 / 5, -1 / 5, 8 / 315, -1 / 560]
)  # fmt: skip
"""Weights of the second derivative."""
_BLOCK = 65_536


@dataclass(frozen=True, eq=False)
class ImuSamples:
    """Measurements of an IMU, and the truth beside them."""

    t_us: NDArray[np.int64]
    """[n] µs, on the clock of the events."""
    acceleration: Float64Array
    """[n, 3] specific force in the IMU's axes, m/s²."""
    rate: Float64Array
    """[n, 3] angular velocity in the IMU's axes, rad/s."""
    position: Float64Array
    """[n, 3] true place in the world, m."""
    to_world: Float64Array
    """[n, 3, 3] true rotation from the IMU to the world."""


def sample_times_us(rate_hz: float, stop_us: int) -> NDArray[np.int64]:
    """[n] times `round(k · 10⁶ / rate)` from 0 to `stop_us`, included."""
    count = int(stop_us * rate_hz / MICROSECONDS + 1e-9) + 1
    times = np.round(np.arange(count) * (MICROSECONDS / rate_hz)).astype(np.int64)
    return times[times <= stop_us]


def true_samples(
    scene: RenderedScene, first_from_imu: Float64Array, t_us: NDArray[np.int64]
) -> ImuSamples:
    """Samples of an IMU without noise."""
    t_s = t_us / MICROSECONDS
    position, to_world, acceleration, turning = _derivatives(scene, first_from_imu, t_s)
    force = acceleration + np.array([0.0, 0.0, GRAVITY])
    spin = np.swapaxes(to_world, 1, 2) @ turning
    rate = 0.5 * np.stack(
        [
            spin[:, 2, 1] - spin[:, 1, 2],
            spin[:, 0, 2] - spin[:, 2, 0],
            spin[:, 1, 0] - spin[:, 0, 1],
        ],
        axis=1,
    )
    return ImuSamples(t_us, np.einsum("nji,nj->ni", to_world, force), rate, position, to_world)


def with_noise(samples: ImuSamples, noise: ImuNoise, rate_hz: float, seed: int) -> ImuSamples:
    """The samples with white noise and wandering biases, which `seed` decides."""
    count = len(samples.t_us)
    of_force = (noise.accelerometer_noise_density, noise.accelerometer_random_walk)
    of_rate = (noise.gyroscope_noise_density, noise.gyroscope_random_walk)
    return replace(
        samples,
        acceleration=samples.acceleration + _noise(count, of_force, rate_hz, seed, sensor=0),
        rate=samples.rate + _noise(count, of_rate, rate_hz, seed, sensor=1),
    )


def _noise(
    count: int, densities: tuple[float, float], rate_hz: float, seed: int, *, sensor: int
) -> Float64Array:
    """[count, 3] white noise and bias of one of the two sensors, of their two densities."""
    white, walk = densities
    sample, axis = np.arange(count)[:, None], 3 * sensor + np.arange(3)
    drawn = np.empty((2, count, 3))
    for first in range(0, count, _BLOCK):
        block = slice(first, min(first + _BLOCK, count))
        key = frame_key(seed, first // _BLOCK)
        for kind in range(2):
            drawn[kind, block] = draw_normals(key, sample[block] - first, axis, 2 * kind)
    bias = np.cumsum(drawn[1], axis=0) - drawn[1][:1]
    return np.asarray(white * np.sqrt(rate_hz) * drawn[0] + walk / np.sqrt(rate_hz) * bias)


def _derivatives(
    scene: RenderedScene, first_from_imu: Float64Array, t_s: Float64Array
) -> tuple[Float64Array, Float64Array, Float64Array, Float64Array]:
    """Position, rotation to the world, acceleration, and the rotation's derivative."""
    around = t_s[:, None] + STEP_S * np.arange(-4, 5)
    position, to_world = body_poses(scene, first_from_imu, around.ravel())
    position = position.reshape(len(t_s), 9, 3)
    to_world = to_world.reshape(len(t_s), 9, 3, 3)
    acceleration = np.einsum("k,nki->ni", SECOND, position) / STEP_S**2
    turning = np.einsum("k,nkij->nij", FIRST, to_world) / STEP_S
    return position[:, 4], to_world[:, 4], acceleration, turning
