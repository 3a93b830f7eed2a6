"""The IMU: integrated, it returns the pose; its noise has the densities stated."""

import math
from dataclasses import replace

import numpy as np
import pytest
from tests.scenes.hand_scenes import HandScene, turned

from texvent.camera import PosedCamera
from texvent.sensor import SensorSize
from texvent_scenes.rendered_scene import RenderedScene
from texvent_scenes.rig.description import IMU_NOISES, ImuNoise
from texvent_scenes.rig.imu import (
    _BLOCK,
    GRAVITY,
    ImuSamples,
    sample_times_us,
    true_samples,
    with_noise,
)
from texvent_scenes.scene_input import list_nouns, understand
from texvent_scenes.staging.compose import compose_scene

RATE, DURATION = 1000.0, 1.0
LEVEL = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
"""Camera axes in the world: right is x, down is −z, forward is y."""


def scene_of(prompt: str) -> RenderedScene:
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


def first_velocity(scene: RenderedScene, offset: np.ndarray) -> np.ndarray:
    step = 1e-4
    ends = [true_samples(scene, offset, np.array([t])) for t in (-100, 100)]
    return (ends[1].position[0] - ends[0].position[0]) / (2.0 * step)


@pytest.mark.long
@pytest.mark.parametrize(
    "prompt",
    [
        "a red car drives left past two trees, handheld camera",
        "a bus drives left, the camera follows it, handheld",
    ],
)
def test_integrating_the_imu_returns_the_pose_within_a_quarter_of_a_millimetre(prompt):
    scene = scene_of(prompt)
    offset = np.eye(4)
    offset[:3, :3], offset[:3, 3] = turned(0.4), (0.05, -0.02, 0.03)
    samples = true_samples(scene, offset, sample_times_us(RATE, int(DURATION * 1e6)))
    place, turn = integrate(samples, first_velocity(scene, offset))
    assert np.linalg.norm(place - samples.position[-1]) < 2.5e-4
    between = turn.T @ samples.to_world[-1]
    angle = math.degrees(math.acos(min(1.0, (np.trace(between) - 1.0) / 2.0)))
    assert angle < 0.005
    assert np.ptp(samples.position, axis=0).max() > 0.01 or np.abs(samples.rate).max() > 0.01


@pytest.mark.parametrize("offset", [(0.1, 0.0, 0.0), (-0.02, 0.05, 0.1), (0.0, 0.0, 0.0)])
def test_an_imu_off_the_axis_feels_centripetal_and_tangential_acceleration(offset):
    """On a circle of 2 m, the camera along its path, at ω = 1.5 + 4 t rad/s to the left.

    The camera's right points away from the centre, so right is the radius, forward the tangent.
    """
    radius, spin, faster = 2.0, 1.5, 4.0

    def camera_at(time: float) -> PosedCamera:
        angle = spin * time + 0.5 * faster * time**2
        forward = np.array([-math.sin(angle), math.cos(angle), 0.0])
        right = np.array([math.cos(angle), math.sin(angle), 0.0])
        return PosedCamera(radius * right, np.stack([right, [0, 0, -1.0], forward]), 1.0)

    mount = np.eye(4)
    mount[:3, 3] = right, down, forward = offset
    samples = true_samples(HandScene(camera_at=camera_at), mount, np.array([0, 300_000]))
    out = radius + right
    for number, time in enumerate((0.0, 0.3)):
        rate = spin + faster * time
        along = [-(rate**2) * out - faster * forward, -GRAVITY, faster * out - rate**2 * forward]
        np.testing.assert_allclose(samples.acceleration[number], along, atol=1e-6)
        np.testing.assert_allclose(samples.rate[number], [0.0, -rate, 0.0], atol=1e-9)
    np.testing.assert_allclose(samples.position[0], [out, forward, -down], atol=1e-12)


def test_an_imu_at_rest_feels_gravity_alone_wherever_it_is_and_however_it_is_turned():
    mount = np.eye(4)
    mount[:3, :3], mount[:3, 3] = rotation_of(np.array([0.3, -1.1, 0.7])), (0.1, 0.2, 0.3)
    scene = HandScene(camera_at=lambda time: PosedCamera(np.array([5.0, 6.0, 7.0]), LEVEL, 1.0))
    samples = true_samples(scene, mount, np.array([0, 10**6]))
    up = mount[:3, :3].T @ [0.0, -GRAVITY, 0.0]
    np.testing.assert_allclose(samples.acceleration, [up] * 2, atol=1e-7)
    np.testing.assert_allclose(samples.rate, np.zeros((2, 3)), atol=1e-9)
    np.testing.assert_allclose(samples.position, [[5.1, 6.3, 6.8]] * 2, atol=1e-12)


def allan_deviation(values: np.ndarray, samples: int) -> float:
    """Overlapping Allan deviation of a rate over `samples` samples."""
    angle = np.cumsum(np.append(0.0, values))
    second = angle[2 * samples :] - 2.0 * angle[samples:-samples] + angle[: -2 * samples]
    return float(np.sqrt((second**2).mean() / 2.0) / samples)


@pytest.mark.long
@pytest.mark.parametrize("sensor", ["acceleration", "rate"])
def test_allan_deviation_returns_the_stated_densities(sensor):
    """White noise N: σ(τ) = N / √τ. Walk K: σ(τ) = K √(τ / 3). IEEE Std 952, annex C."""
    rate_hz, count = 20.0, 40_000
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
        assert allan_deviation(values, 20) == pytest.approx(density, rel=0.05)  # τ = 1 s
        values = getattr(with_noise(still, wander, rate_hz, 1), sensor)[:, axis]
        expected = walk * math.sqrt(1.0 / 3.0)
        assert allan_deviation(values, 20) == pytest.approx(expected, rel=0.1)


def test_noise_is_keyed_by_the_seed_starts_without_bias_and_differs_in_every_axis():
    still = ImuSamples(
        np.arange(4000), *(np.zeros((4000, 3)) for _ in range(3)), np.zeros((1, 3, 3))
    )
    white, walk = ImuNoise(1.0, 0.0, 1.0, 0.0), ImuNoise(0.0, 1.0, 0.0, 1.0)
    first, again, other = (with_noise(still, walk, 100.0, seed) for seed in (0, 0, 1))
    np.testing.assert_array_equal(first.rate, again.rate)
    assert (first.rate[1:] != other.rate[1:]).all()
    noise = with_noise(still, white, 100.0, 0)
    biases = np.concatenate([first.acceleration, first.rate], axis=1)
    assert not biases[0].any()
    columns = [noise.acceleration[1:], noise.rate[1:], np.diff(biases, axis=0)]
    # Six deviations of the correlation of 4000 independent pairs.
    np.testing.assert_allclose(np.corrcoef(np.concatenate(columns, axis=1).T), np.eye(12), atol=0.1)


def test_times_are_whole_microseconds_of_the_rate():
    assert sample_times_us(300.0, 10_000).tolist() == [0, 3333, 6667, 10_000]
    assert len(sample_times_us(1000.0, 2_000_000)) == 2001


def test_across_a_corner_of_the_path_it_leads_to_the_same_pose():
    def camera_at(time: float) -> PosedCamera:
        return PosedCamera(np.array([0.0, 0.0, abs(time - 0.5)]), LEVEL, 1.0)

    samples = true_samples(HandScene(camera_at=camera_at), np.eye(4), sample_times_us(RATE, 10**6))
    place, _ = integrate(samples, np.array([0.0, 0.0, -1.0]))
    np.testing.assert_allclose(place, samples.position[-1], atol=1e-3)


def test_noise_goes_on_from_block_to_block_and_differs_by_sensor_and_seed():
    count = 2 * _BLOCK + 5
    still = np.zeros((count, 3))
    samples = ImuSamples(np.arange(count), still, still, still, np.zeros((count, 3, 3)))
    noise = ImuNoise(1.0, 0.0, 1.0, 0.0)
    made, other = (with_noise(samples, noise, 1.0, seed) for seed in (1, 2))
    parts = [one[start : start + 1000, axis]
             for one in (made.acceleration, made.rate, other.acceleration)
             for start in (0, _BLOCK, 2 * _BLOCK - 1000) for axis in range(3)]  # fmt: skip
    correlation = np.corrcoef(parts) - np.eye(len(parts))
    assert np.abs(correlation).max() < 0.2
    again = with_noise(samples, noise, 1.0, 1)
    assert np.array_equal(again.acceleration, made.acceleration)
