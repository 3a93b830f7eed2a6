import math

import numpy as np
import pytest

from texvent.events import EventStream
from texvent.metrics.latent_similarity import LatentSimilarity, patch_cosine
from texvent.sensor import SensorSize

from ..recordings import random_events


def test_cosine_is_taken_between_averages_of_three_by_three_patches():
    a, b = np.zeros((2, 2, 4), np.float32), np.zeros((2, 2, 4), np.float32)
    a[0, 0, 0], b[0, 1, 2] = 1, 7  # the same patch: cosine 1
    a[0, 0, 3], b[0, 0, 3], b[1, 0, 3] = 1, 1, 1  # 45 degrees
    assert patch_cosine(a, b) == pytest.approx((1 + math.sqrt(0.5)) / 2)


def test_patches_empty_in_both_are_left_out_and_empty_in_one_count_zero():
    a, b = np.zeros((1, 3, 9), np.float32), np.zeros((1, 3, 9), np.float32)
    a[0, 0, 0] = b[0, 0, 0] = 1
    assert patch_cosine(a, b) == 1.0
    b[0, 0, 8] = 1
    assert patch_cosine(a, b) == 0.5
    assert math.isnan(patch_cosine(a * 0, b * 0))


def test_a_backbone_sees_the_stacked_histogram_and_its_stages_are_averaged():
    shapes = []

    def backbone(histogram):
        shapes.append(histogram.shape)
        assert histogram.dtype == np.float32
        constant = np.ones((1, 3, 3), np.float32)
        return histogram, constant

    a = EventStream([0], [0], [10], [1], SensorSize(9, 6))
    b = EventStream([0], [0], [10], [0], SensorSize(9, 6))
    # Histogram: nothing in common, 0; constant features: 1.
    assert LatentSimilarity(backbone=backbone)(a, b) == pytest.approx(0.5)
    assert shapes == [(20, 6, 9)] * 2


def crowded(events):
    """Most of the events on few pixels, so that counts on both sides of the cutoff occur."""
    kept = (events.x * events.y % 5 == 0) | (np.arange(len(events)) % 40 == 0)
    return events[kept]


@pytest.mark.parametrize("size", [SensorSize(16, 13), SensorSize(7, 9)])
@pytest.mark.parametrize("count", [400, 100_000])
def test_the_histogram_alone_is_not_filled_in_but_scores_the_same(size, count):
    # Sides that are no multiple of 3; the larger count is beyond the cutoff in nearly every cell.
    a, b = (random_events(seed, count, size, 120_000) for seed in (1, 2))
    if count > 400:
        a, b = (crowded(one) for one in (a, b))
    dense = LatentSimilarity(backbone=lambda histogram: (histogram,))
    assert LatentSimilarity()(a, b) == dense(a, b)
