import numpy as np
import pytest
from tests.transform.recordings import packets

from texvent.events import EventStream
from texvent.metrics.latent_similarity import LatentSimilarity
from texvent.represent.histogram import CUTOFF, stacked_histogram
from texvent.sensor import SensorSize
from texvent.transform.edits import merge

from ..recordings import random_events


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


@pytest.mark.parametrize("size", [SensorSize(16, 13), SensorSize(7, 9)])
def test_the_histogram_alone_is_not_filled_in_but_scores_the_same_beyond_the_cutoff(size):
    a, b = (busy_pixel(random_events(seed, 900, size, 120_000), 40 * seed) for seed in (1, 2))
    assert stacked_histogram(a.between(0, 50_000), cutoff=255).max() > 2 * CUTOFF
    dense = LatentSimilarity(backbone=lambda histogram: (histogram,))
    assert LatentSimilarity()(a, b) == dense(a, b) != 1


def busy_pixel(events, count):
    """The same, with as many events more in one pixel within 100 µs."""
    t = np.arange(count) * 100 // count + 20_000
    zeros = np.zeros(count, int)
    more = EventStream(zeros + 3, zeros + 2, t, zeros + 1, events.size)
    return merge([packets(events), packets(more)]).collect()
