"""Text-event alignment: is a recording's own text the one that a CLIP model finds nearest?"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError
from texvent_lab.alignment.clip_model import ClipModel, Vectors
from texvent_lab.alignment.recordings import TextRecording, View

RECALL_AT = (1, 5, 10)
CONFIDENCE = 0.95


@dataclass(frozen=True, kw_only=True)
class Retrieval:
    """Ranks of the recordings' own texts."""

    recall: Mapping[int, float]
    """k → share of the recordings whose own text is among the k most similar."""
    median_rank: float
    """Median place of the own text, from 1."""
    mean_similarity: float
    """Mean similarity of a recording with its own text."""


@dataclass(frozen=True, kw_only=True)
class RetrievalReport:
    """A retrieval score with its interval and its control."""

    recordings: int
    texts: int
    """Different texts that were ranked."""
    measured: Retrieval
    low: Retrieval
    """Lower ends of the bootstrap intervals (95 %)."""
    high: Retrieval
    """Upper ends."""
    shuffled: Retrieval
    """Mean over random exchanges of the texts."""
    chance: Retrieval
    """Score that an exchange of the texts gives in the long run, computed."""
    p_value: float
    """Share of the exchanges whose mean similarity is at least the measured one; never 0."""
    misfits: Sequence[Mapping[str, Any]] = ()
    """See `find_misfits`."""


def score_retrieval(
    similarity: NDArray[Any],
    own: NDArray[Any] | None = None,
    *,
    seed: int = 0,
    resamples: int = 1000,
    exchanges: int = 100,
) -> RetrievalReport:
    """Score a matrix of similarities.

    Args:
        similarity: of recording i and text j, [n, m], more is more similar.
        own: number of the text that belongs to each recording, [n]; default: the same number.
        seed: of the bootstrap and of the exchanges.
        resamples: bootstrap samples of the recordings; the texts stay.
        exchanges: random exchanges of the texts.

    Raises:
        InputError: no recording, a value that is not finite, or an own text that is not there.

    Example:
        >>> report = score_retrieval(np.array([[0.9, 0.1], [0.2, 0.8]]))
        >>> report.measured.recall[1], report.measured.median_rank, report.chance.recall[1]
        (1.0, 1.0, 0.5)
    """
    similarity, targets = _checked(similarity, own)
    count, texts = similarity.shape
    chance = np.random.default_rng(seed)
    places = _Places.of(similarity, targets)
    samples = chance.integers(count, size=(resamples, count))
    drawn = [_values(places.take(sample)) for sample in samples]
    measured = _values(places)

    mixed = [
        _values(_Places.of(similarity, chance.permutation(texts)[targets]))
        for _ in range(exchanges)
    ]
    at_least = sum(one[-1] >= measured[-1] for one in mixed)
    tail = 50 * (1 - CONFIDENCE)
    low, high = np.percentile(drawn, (tail, 100 - tail), axis=0)
    return RetrievalReport(
        recordings=count,
        texts=texts,
        measured=_retrieval(measured),
        low=_retrieval(low),
        high=_retrieval(high),
        shuffled=_retrieval(np.mean(mixed, axis=0)),
        chance=Retrieval(
            recall={k: min(k / texts, 1.0) for k in RECALL_AT},
            median_rank=(texts + 1) / 2,
            mean_similarity=float(similarity.mean(dtype=np.float64)),
        ),
        p_value=float((1 + at_least) / (1 + exchanges)),
    )


def _checked(
    similarity: NDArray[Any], own: NDArray[Any] | None
) -> tuple[NDArray[Any], NDArray[Any]]:
    """The matrix, and the number of the text of each recording; errors as `score_retrieval`."""
    similarity = np.asarray(similarity)
    if similarity.ndim != 2 or 0 in similarity.shape:
        raise InputError(f"similarity has shape {similarity.shape}; it must be [recordings, texts]")
    if not np.isfinite(similarity).all():
        raise InputError("similarity holds NaN or infinity; the model's weights may be damaged")
    count, texts = similarity.shape
    targets = np.arange(count) if own is None else np.asarray(own)
    if targets.shape != (count,) or targets.min() < 0 or targets.max() >= texts:
        raise InputError(
            f"own texts are {targets.shape} numbers up to {targets.max(initial=-1)}; there are "
            f"{count} recordings and {texts} texts"
        )
    return similarity, targets


@dataclass(frozen=True)
class _Places:
    """For each recording: texts above its own, others as similar, and the similarity itself."""

    above: NDArray[np.int64]
    equal: NDArray[np.int64]
    similarity: NDArray[np.float64]

    @classmethod
    def of(cls, similarity: NDArray[Any], targets: NDArray[Any]) -> _Places:
        own = similarity[np.arange(len(targets)), targets]
        above = (similarity > own[:, None]).sum(axis=1)
        equal = (similarity == own[:, None]).sum(axis=1) - 1
        return cls(above, equal, own.astype(np.float64))

    def take(self, which: NDArray[np.int64]) -> _Places:
        return _Places(self.above[which], self.equal[which], self.similarity[which])


def _values(places: _Places) -> NDArray[np.float64]:
    """Recalls, median rank, mean similarity."""
    # Among e others as similar, each order is as likely.
    recalls = [np.clip((k - places.above) / (places.equal + 1), 0, 1).mean() for k in RECALL_AT]
    ranks = 1 + places.above + places.equal / 2
    return np.array([*recalls, np.median(ranks), places.similarity.mean()])


def _retrieval(values: NDArray[np.float64]) -> Retrieval:
    *recalls, median, mean = map(float, values)
    return Retrieval(
        recall=dict(zip(RECALL_AT, recalls, strict=True)), median_rank=median, mean_similarity=mean
    )


def align(
    sources: Mapping[str, Sequence[TextRecording]],
    draw: View,
    clip: ClipModel,
    *,
    seed: int = 0,
    margin: float | None = None,
    progress: Callable[[str, int, int], None] = lambda stage, done, total: None,
) -> dict[str, RetrievalReport]:
    """Score every source.

    The vector of a recording is the mean of those of its images, at unit length. Its text is
    ranked among all different texts of its source.

    Args:
        sources: name → recordings.
        draw: how events become images.
        clip: the model.
        seed: of the bootstrap and of the control.
        margin: of misfits; None finds none.
        progress: told of (source, done, total).

    Raises:
        InputError, FileFormatError: a recording cannot be read.
    """
    reports = {}
    for source, recordings in sources.items():
        texts = list(dict.fromkeys(recording.text for recording in recordings))
        place = {text: number for number, text in enumerate(texts)}
        own = np.array([place[recording.text] for recording in recordings])
        vectors: list[Vectors] = []
        for done, recording in enumerate(recordings):
            progress(source, done, len(recordings))
            vectors.append(_mean(clip.embed_images(draw(recording.load()))))
        similarity = np.concatenate(vectors) @ clip.embed_texts(texts).T
        report = score_retrieval(similarity, own, seed=seed)
        found = [] if margin is None else find_misfits(recordings, similarity, own, margin)
        reports[source] = replace(report, misfits=found)
    return reports


def find_misfits(
    recordings: Sequence[TextRecording],
    similarity: NDArray[Any],
    own: NDArray[Any],
    margin: float,
) -> list[dict[str, Any]]:
    """Recordings less similar to their own text than `margin` above the mean of the other texts.

    The worst come first. There are at least two texts.
    """
    fitting = similarity[np.arange(len(own)), own].astype(np.float64)
    others = (similarity.sum(axis=1, dtype=np.float64) - fitting) / (similarity.shape[1] - 1)
    places = [n for n in np.argsort(fitting - others) if fitting[n] - others[n] < margin]
    return [
        {"sample": one.key or one.id, "own": float(fitting[n]), "others": float(others[n]),
         "text": one.text}
        for n in places for one in [recordings[n]]
    ]  # fmt: skip


def _mean(vectors: Vectors) -> Vectors:
    """Mean of vectors at unit length, [1, d]."""
    mean = vectors.mean(axis=0, keepdims=True)
    return np.asarray(mean / max(float(np.linalg.norm(mean)), 1e-12), np.float32)


COLUMNS = ("events", "n", "texts", *(f"R@{k}" for k in RECALL_AT), "median rank", "cosine", "p")


def alignment_table(reports: Mapping[str, RetrievalReport]) -> str:
    """The scores with their intervals (95 %), and the controls below each."""
    lines = [list(COLUMNS)]
    for source, report in reports.items():
        counts = [f"{report.recordings:,}", f"{report.texts:,}"]
        lines.append([source, *counts, *_with_interval(report), f"{report.p_value:.3f}"])
        lines.append(["texts exchanged", "", "", *_cells(report.shuffled), ""])
        lines.append(["chance", "", "", *_cells(report.chance), ""])
    widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
    return "".join(
        "  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip()
        + "\n"
        for line in lines
    )


def _cells(one: Retrieval) -> list[str]:
    recalls = [f"{one.recall[k]:.3f}" for k in RECALL_AT]
    return [*recalls, f"{one.median_rank:.1f}", f"{one.mean_similarity:.4f}"]


def _with_interval(report: RetrievalReport) -> list[str]:
    parts = (_cells(one) for one in (report.measured, report.low, report.high))
    return [f"{value} [{low}, {high}]" for value, low, high in zip(*parts, strict=True)]
