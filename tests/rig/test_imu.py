"""The IMU: integrated, it returns the pose; its noise has the densities stated."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from tests.scenes.hand_scenes import HandScene, turned

from texvent.generate.scene_input import list_nouns, understand
from texvent.rig.description import IMU_NOISES, ImuNoise
from texvent.rig.imu import (
    GRAVITY,
    ImuSamples,
    sample_times_us,
    true_samples,
    with_noise,
)
from texvent.scenes.scene import Camera, Scene
from texvent.scenes.staging.compose import compose_scene
from texvent.sensor import SensorSize

RATE, DURATION = 1000.0, 2.0
LEVEL = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
"""Camera axes in the world: right is x, down is −z, forward is y."""


def scene_of(prompt: str) -> Scene:
    description = understand(prompt, list_nouns())
    return compose_scene(description, seed=3, size=SensorSize(64, 48), duration_s=DURATION)


def rotation_of(vector: np.ndarray) -> np.ndarray:
    """Rodrigues' formula."""
    angle = float(np.linalg.norm(vector))
    if angle == 0.0:
        return np.eye(3)
    x, y, z = vector / angle
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross


def integrate(samples: ImuSamples, velocity: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Strapdown integration by the trapezoidal rule, from the first pose and velocity."""
    place, turn = samples.position[0].copy(), samples.to_world[0].copy()
    gravity = np.array([0.0, 0.0, -GRAVITY])
    steps = np.diff(samples.t_us) * 1e-6
    for number, step in enumerate(steps):
        rate = 0.5 * (samples.rate[number] + samples.rate[number + 1])
        after = turn @ rotation_of(rate * step)
        before_a = turn @ samples.acceleration[number] + gravity
        after_a = after @ samples.acceleration[number + 1] + gravity
        place += step * velocity + step**2 * (2.0 * before_a + after_a) / 6.0
        velocity = velocity + 0.5 * step * (before_a + after_a)
        turn = after
    return place, turn


def first_velocity(scene: Scene, offset: np.ndarray) -> np.ndarray:
    step = 1e-4
    ends = [true_samples(scene, offset, np.array([t])) for t in (-100, 100)]
    return (ends[1].position[0] - ends[0].position[0]) / (2.0 * step)


@pytest.mark.parametrize(
    "prompt",
    [
        "a red car drives left past two trees, handheld camera",
        "a bus drives left, the camera follows it, handheld",
    ],
)
def test_integrating_the_imu_returns_the_pose_within_a_millimetre(prompt: str) -> None:
    scene = scene_of(prompt)
    offset = np.eye(4)
    offset[:3, :3], offset[:3, 3] = turned(0.4), (0.05, -0.02, 0.03)
    samples = true_samples(scene, offset, sample_times_us(RATE, int(DURATION * 1e6)))
    place, turn = integrate(samples, first_velocity(scene, offset))
    assert np.linalg.norm(place - samples.position[-1]) < 1e-3
    between = turn.T @ samples.to_world[-1]
    angle = math.degrees(math.acos(min(1.0, (np.trace(between) - 1.0) / 2.0)))
    assert angle < 0.01
    assert np.ptp(samples.position, axis=0).max() > 0.01 or np.abs(samples.rate).max() > 0.01


def test_a_circle_gives_its_centripetal_acceleration_and_rate() -> None:
    """Radius 2 m at 1.5 rad/s, the camera looking along its path: a = ω² r to the left."""
    rate = 1.5

    def camera_at(time: float) -> Camera:
        angle = rate * time
        forward = np.array([-math.sin(angle), math.cos(angle), 0.0])
        right = np.array([math.cos(angle), math.sin(angle), 0.0])
        return Camera(2.0 * right, np.stack([right, [0, 0, -1.0], forward]), 1.0)

    samples = true_samples(HandScene(camera_at=camera_at), np.eye(4), np.array([0, 300_000]))
    np.testing.assert_allclose(
        samples.acceleration, [[-(rate**2) * 2.0, -GRAVITY, 0.0]] * 2, atol=1e-7
    )
    np.testing.assert_allclose(samples.rate, [[0.0, -rate, 0.0]] * 2, atol=1e-9)


def allan_deviation(values: np.ndarray, samples: int) -> float:
    """Overlapping Allan deviation of a rate over `samples` samples."""
    angle = np.cumsum(np.append(0.0, values))
    second = angle[2 * samples :] - 2.0 * angle[samples:-samples] + angle[: -2 * samples]
    return float(np.sqrt((second**2).mean() / 2.0) / samples)


@pytest.mark.parametrize("sensor", ["acceleration", "rate"])
def test_allan_deviation_returns_the_stated_densities(sensor: str) -> None:
    """White noise N: σ(τ) = N / √τ. Walk K: σ(τ) = K √(τ / 3). IEEE Std 952, annex C."""
    rate_hz, count = 200.0, 400_000
    still = ImuSamples(
        np.arange(count), *(np.zeros((count, 3)) for _ in range(3)), np.zeros((1, 3, 3))
    )
    noise = IMU_NOISES["adis16448"]
    own = "accelerometer" if sensor == "acceleration" else "gyroscope"
    density, walk = (getattr(noise, f"{own}_{name}") for name in ("noise_density", "random_walk"))
    white = replace(noise, **{f"{own}_random_walk": 0.0})
    wander = replace(noise, **{f"{own}_noise_density": 0.0})
    for axis in range(3):
        values = getattr(with_noise(still, white, rate_hz, 1), sensor)[:, axis]
        assert allan_deviation(values, 200) == pytest.approx(density, rel=0.05)  # τ = 1 s
        values = getattr(with_noise(still, wander, rate_hz, 1), sensor)[:, axis]
        expected = walk * math.sqrt(1.0 / 3.0)
        assert allan_deviation(values, 200) == pytest.approx(expected, rel=0.1)


def test_noise_is_keyed_by_the_seed_and_starts_without_bias() -> None:
    still = ImuSamples(np.arange(50), *(np.zeros((50, 3)) for _ in range(3)), np.zeros((1, 3, 3)))
    only_walk = ImuNoise(gyroscope_random_walk=1.0)
    first, again, other = (with_noise(still, only_walk, 100.0, seed).rate for seed in (0, 0, 1))
    np.testing.assert_array_equal(first, again)
    assert (first[1:] != other[1:]).all()
    assert (first[0] == 0.0).all()
    assert len(np.unique(with_noise(still, IMU_NOISES["adis16448"], 100.0, 0).acceleration)) == 150


def test_times_are_whole_microseconds_of_the_rate() -> None:
    assert sample_times_us(300.0, 10_000).tolist() == [0, 3333, 6667, 10_000]
    assert len(sample_times_us(1000.0, 2_000_000)) == 2001


def test_across_a_corner_of_the_path_it_leads_to_the_same_pose() -> None:
    def camera_at(time: float) -> Camera:
        return Camera(np.array([0.0, 0.0, abs(time - 0.5)]), LEVEL, 1.0)

    samples = true_samples(HandScene(camera_at=camera_at), np.eye(4), sample_times_us(RATE, 10**6))
    place, _ = integrate(samples, np.array([0.0, 0.0, -1.0]))
    np.testing.assert_allclose(place, samples.position[-1], atol=1e-3)
