import math

import numpy as np
import pytest

from texvent.events import EventStream
from texvent.metrics.unpaired.frechet import FrechetStatistics, frechet_distance
from texvent.metrics.unpaired.patch_statistics import FEATURES, patch_statistics
from texvent.sensor import SensorSize

from .. import slow
from ..recordings import TOY, one_beat, random_events


def test_patch_statistics_agree_with_their_slow_twin():
    # 40 × 30 leaves a border that no patch covers; few events leave patches below 8.
    events = random_events(3, 260, SensorSize(40, 30), 150_000)
    features = patch_statistics(events)
    assert features.shape[1] == len(FEATURES) == 14
    assert 5 < len(features) < 18
    np.testing.assert_allclose(features, slow.patch_features(events), atol=1e-9)


def test_patches_without_a_repeated_pixel_have_the_stated_defaults():
    diagonal = EventStream(range(8), range(8), range(0, 800, 100), [1] * 8, SensorSize(12, 12))
    features = dict(zip(FEATURES, patch_statistics(diagonal)[0], strict=True))
    assert features["log_mean_interval"] == -1.3
    assert features["sd_log_interval"] == features["polarity_flips"] == 0
    assert features["mean_step_px"] == pytest.approx(math.sqrt(2))
    assert patch_statistics(diagonal[:7]).shape == (0, 14)


def test_frechet_distance_of_one_dimension_is_as_in_the_textbook():
    a = np.array([[-1.0], [1.0]]) * 3 / math.sqrt(2)  # mean 0, sd 3 (n − 1)
    b = np.array([[-1.0], [1.0]]) / math.sqrt(2) + 4  # mean 4, sd 1
    assert frechet_distance(a, b) == pytest.approx(4**2 + (3 - 1) ** 2, rel=1e-4)


def test_frechet_distance_of_independent_features_adds_up():
    rng = np.random.default_rng(0)
    a = rng.normal(size=(400, 3))
    a = np.linalg.solve(np.linalg.cholesky(np.cov(a.T)), (a - a.mean(0)).T).T  # exactly white
    b = a * [1.0, 2.0, 3.0] + [0.0, 0.0, 5.0]
    assert frechet_distance(a, b) == pytest.approx(0 + 1 + 4 + 25, rel=1e-4)
    assert frechet_distance(a, a) == pytest.approx(0.0, abs=1e-6)


def test_other_scenes_with_the_same_statistics_are_close_and_batched_events_are_not():
    a, b = random_events(1, 6000, TOY), random_events(2, 6000, TOY)
    metric = FrechetStatistics()
    assert metric(b, a) < 3.0
    assert metric(one_beat(b), a) > 10 * metric(b, a)


def test_too_few_patches_are_undefined():
    assert math.isnan(FrechetStatistics()(random_events(1), random_events(2)))
