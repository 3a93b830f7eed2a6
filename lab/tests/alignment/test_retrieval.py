"""Retrieval on matrices whose ranks are known by hand, and what holds for every matrix."""

import math
import re
from functools import partial
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from tests.examples import examples

from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent_lab.alignment.align import (
    RetrievalReport,
    align,
    alignment_table,
    find_misfits,
    score_retrieval,
)
from texvent_lab.alignment.recordings import TextRecording

EMPTY = EventStream.empty(SensorSize(1, 1))

BY_HAND = np.array(
    [
        [0.9, 0.1, 0.2, 0.3],  # own text first
        [0.5, 0.4, 0.3, 0.2],  # second
        [0.3, 0.2, 0.1, 0.4],  # last
        [0.1, 0.1, 0.1, 0.1],  # all equal
    ]
)


def score(similarity: NDArray[Any], own: Any = None, **options: Any) -> RetrievalReport:
    return score_retrieval(similarity, own, **{"resamples": 20, "exchanges": 20, **options})


@st.composite
def matrices(draw: st.DrawFn) -> NDArray[np.float64]:
    """Square, with many ties."""
    side = draw(st.integers(1, 12))
    levels = draw(st.integers(1, 6))
    rng = np.random.default_rng(draw(st.integers(0, 10_000)))
    return rng.integers(-levels, levels + 1, (side, side)) / levels


def test_ranks_by_hand() -> None:
    measured = score(BY_HAND).measured
    assert measured.recall[1] == (1 + 0 + 0 + 1 / 4) / 4
    assert measured.recall[5] == 1.0
    assert measured.median_rank == (2 + 2.5) / 2
    assert measured.mean_similarity == pytest.approx((0.9 + 0.4 + 0.1 + 0.1) / 4)


def test_misfits_are_nearer_to_other_texts_than_to_their_own_and_the_worst_come_first() -> None:
    recordings = [TextRecording(str(n), f"text {n}", lambda: EMPTY, f"key {n}") for n in range(4)]

    def misfits(margin: float) -> list[dict[str, Any]]:
        return find_misfits(recordings, BY_HAND, np.arange(4), margin)

    # Own text minus mean of the others: .7, .07, -.2, 0.
    assert [one["sample"] for one in misfits(0.1)] == ["key 2", "key 3", "key 1"]
    assert len(misfits(1)) == 4
    (worst,) = misfits(-0.1)
    assert worst["text"] == "text 2"
    assert (worst["own"], worst["others"]) == pytest.approx((0.1, 0.3))


def test_the_bootstrap_interval_is_that_of_a_share() -> None:
    count = 400
    rng = np.random.default_rng(1)
    similarity = rng.random((count, count)) * 0.5
    is_first = np.arange(count) < 100
    similarity[is_first, np.arange(count)[is_first]] = 1.0
    similarity[~is_first, np.arange(count)[~is_first]] = -1.0
    report = score(similarity, resamples=2000)
    error = math.sqrt(0.25 * 0.75 / count)
    assert report.measured.recall[1] == 0.25
    assert report.low.recall[1] == pytest.approx(0.25 - 1.96 * error, abs=0.01)
    assert report.high.recall[1] == pytest.approx(0.25 + 1.96 * error, abs=0.01)


def test_exchanged_texts_come_out_at_chance_and_the_p_value_tells_pairs_from_none() -> None:
    rng = np.random.default_rng(2)
    noise = rng.normal(size=(60, 60))
    unrelated = score(noise, exchanges=400)
    assert unrelated.shuffled.recall[10] == pytest.approx(10 / 60, abs=0.01)
    assert unrelated.shuffled.median_rank == pytest.approx(30.5, abs=1.5)
    assert unrelated.shuffled.mean_similarity == pytest.approx(noise.mean(), abs=0.03)
    assert 0.01 < unrelated.p_value < 0.99
    assert score(noise, exchanges=400, seed=1).shuffled != unrelated.shuffled
    paired = score(noise + np.eye(60), exchanges=400)
    assert paired.p_value == 1 / 401
    assert paired.shuffled.recall[1] < paired.low.recall[1]


@pytest.mark.long
@given(matrices())
@examples(60)
def test_all_cyclic_exchanges_together_are_exactly_chance(matrix: NDArray[np.float64]) -> None:
    side = len(matrix)
    chance = score(matrix).chance
    shifted = [score(matrix, (np.arange(side) + shift) % side).measured for shift in range(side)]
    for k, expected in chance.recall.items():
        assert np.mean([one.recall[k] for one in shifted]) == pytest.approx(expected)
    assert np.mean([one.mean_similarity for one in shifted]) == pytest.approx(
        chance.mean_similarity
    )


@given(seed=st.integers(0, 999))
@examples(10)
def test_recordings_are_ranked_by_the_mean_direction_of_their_images_among_different_texts(
    seed: int,
) -> None:
    rng = np.random.default_rng(seed)
    images = [rng.normal(size=(count, 6)) for count in rng.integers(1, 5, 7)]
    words = rng.normal(size=(3, 6))
    clip: Any = SimpleNamespace(
        embed_images=lambda one: one,
        embed_texts=lambda texts: np.stack([words["ABC".index(one)] for one in texts]),
    )
    loads: Any = [partial(int, n) for n in range(7)]
    recordings = [TextRecording(str(n), "BCA"[n % 3], load) for n, load in enumerate(loads)]
    drawn: Any = images.__getitem__
    reports = align({"all": recordings, "few": recordings[:2]}, drawn, clip, seed=seed, margin=9.0)
    for name, texts in (("all", [1, 2, 0]), ("few", [1, 2])):
        own = np.arange(len(recordings) if name == "all" else 2) % 3
        means = np.stack([images[n].mean(axis=0) for n in range(len(own))])
        cosines = means / np.linalg.norm(means, axis=1, keepdims=True) @ words[texts].T
        ranks = [1 + sum(row > row[place]) for row, place in zip(cosines, own, strict=True)]
        measured = reports[name].measured
        assert measured.recall[1] == np.mean(np.array(ranks) == 1)
        assert measured.median_rank == np.median(ranks)
        expected = np.mean([row[place] for row, place in zip(cosines, own, strict=True)])
        assert measured.mean_similarity == pytest.approx(expected, abs=1e-5)
        assert len(reports[name].misfits) == len(own)
    head, first, mixed, chance = (
        re.split(r"\s{2,}", line) for line in alignment_table(reports).splitlines()[:4]
    )
    one = reports["all"]
    for place, k in enumerate((1, 5, 10), start=3):
        value, low, high = (f"{each.recall[k]:.3f}" for each in (one.measured, one.low, one.high))
        assert (head[place], first[place]) == (f"R@{k}", f"{value} [{low}, {high}]")
        assert mixed[place - 2] == f"{one.shuffled.recall[k]:.3f}"
        assert chance[place - 2] == f"{min(k / 3, 1):.3f}"
    assert (first[:3], chance[4], first[-1]) == (["all", "7", "3"], "2.0", f"{one.p_value:.3f}")
