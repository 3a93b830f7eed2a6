"""Text-event alignment: is a recording's own text the one that a CLIP model finds nearest?"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError
from texvent_lab.alignment.clip_model import ClipModel, Vectors
from texvent_lab.alignment.recordings import Recording, View

RECALL_AT = (1, 5, 10)
CONFIDENCE = 0.95


@dataclass(frozen=True, kw_only=True)
class Retrieval:
    """How high the own texts of recordings stand."""

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
    """What an exchange of the texts gives in the long run, computed."""
    p_value: float
    """Share of the exchanges whose mean similarity is at least the measured one; never 0."""
    within: Retrieval | None = None
    """Mean over random exchanges of texts within their groups."""
    p_within: float | None = None
    """As `p_value`, of those exchanges."""


def score_retrieval(
    similarity: NDArray[Any],
    own: NDArray[Any] | None = None,
    *,
    groups: NDArray[Any] | None = None,
    seed: int = 0,
    resamples: int = 1000,
    exchanges: int = 100,
) -> RetrievalReport:
    """Score a matrix of similarities.

    Args:
        similarity: of recording i and text j, [n, m], more is more similar.
        own: number of the text that belongs to each recording, [n]; default: the same number.
        groups: class of each text, [m], any values; None: no exchange within groups.
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

    def exchange(classes: NDArray[Any]) -> tuple[Retrieval, float]:
        own = (_permuted(classes, chance)[targets] for _ in range(exchanges))
        return _exchanged([_values(_Places.of(similarity, one)) for one in own], measured)

    shuffled, p_value = exchange(np.zeros(texts, np.int64))
    within = (None, None) if groups is None else exchange(np.asarray(groups))
    tail = 50 * (1 - CONFIDENCE)
    low, high = np.percentile(drawn, (tail, 100 - tail), axis=0)
    return RetrievalReport(
        recordings=count,
        texts=texts,
        measured=_retrieval(measured),
        low=_retrieval(low),
        high=_retrieval(high),
        shuffled=shuffled,
        chance=Retrieval(
            recall={k: min(k / texts, 1.0) for k in RECALL_AT},
            median_rank=(texts + 1) / 2,
            mean_similarity=float(similarity.mean(dtype=np.float64)),
        ),
        p_value=p_value,
        within=within[0],
        p_within=within[1],
    )


def _exchanged(mixed: Sequence[Any], measured: Any) -> tuple[Retrieval, float]:
    """Mean over exchanges of the texts, and the share that is as good as the pairs."""
    values = np.array(mixed)
    at_least = int((values[:, -1] >= measured[-1]).sum())
    return _retrieval(values.mean(axis=0)), (1 + at_least) / (1 + len(values))


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


def _permuted(groups: NDArray[Any], chance: np.random.Generator) -> NDArray[np.int64]:
    """A random permutation that exchanges numbers of equal groups only."""
    count = len(groups)
    sorted_places = np.argsort(groups, kind="stable")
    mixed_places = np.lexsort((chance.random(count), groups))
    permutation = np.empty(count, np.int64)
    permutation[sorted_places] = mixed_places
    return permutation


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


@dataclass(frozen=True, kw_only=True)
class AlignmentRow:
    """One source of events, seen in one way."""

    source: str
    view: str
    report: RetrievalReport

    @property
    def facts(self) -> dict[str, Any]:
        """Plain values, ready for JSON."""
        return {"source": self.source, "view": self.view, **asdict(self.report)}


def align(
    sources: Mapping[str, Sequence[Recording]],
    views: Mapping[str, View],
    clip: ClipModel,
    *,
    seed: int = 0,
    progress: Callable[[str, int, int], None] = lambda stage, done, total: None,
) -> list[AlignmentRow]:
    """Score every source in every view.

    The vector of a recording is the mean of those of its images, at unit length. Its text is
    ranked among all different texts of its source.

    Args:
        sources: name → recordings.
        views: name → how events become images.
        clip: the model.
        seed: of the bootstrap and of the control.
        progress: told of (source, done, total).

    Raises:
        InputError, FileFormatError: a recording cannot be read.
    """
    rows = []
    for source, recordings in sources.items():
        texts = list(dict.fromkeys(recording.text for recording in recordings))
        place = {text: number for number, text in enumerate(texts)}
        own = np.array([place[recording.text] for recording in recordings])
        vectors: dict[str, list[Vectors]] = {name: [] for name in views}
        for done, recording in enumerate(recordings):
            progress(source, done, len(recordings))
            events = recording.load()
            for name, view in views.items():
                vectors[name].append(_mean(clip.embed_images(view(events))))
        of_texts = clip.embed_texts(texts)
        groups = _labels(recordings, texts)
        for name in views:
            similarity = np.concatenate(vectors[name]) @ of_texts.T
            report = score_retrieval(similarity, own, groups=groups, seed=seed)
            rows.append(AlignmentRow(source=source, view=name, report=report))
    return rows


def _labels(recordings: Sequence[Recording], texts: Sequence[str]) -> NDArray[Any] | None:
    """Class of each text; None where there are none, or one alone."""
    found = {recording.text: recording.label for recording in recordings}
    labels = {label for label in found.values() if label is not None}
    return np.array([str(found[text]) for text in texts]) if len(labels) > 1 else None


def _mean(vectors: Vectors) -> Vectors:
    """Mean of vectors at unit length, [1, d]."""
    mean = vectors.mean(axis=0, keepdims=True)
    return np.asarray(mean / max(float(np.linalg.norm(mean)), 1e-12), np.float32)


COLUMNS = ("events", "seen as", "n", "texts", *(f"R@{k}" for k in RECALL_AT), "median rank",
           "cosine", "p")  # fmt: skip


def alignment_table(rows: Sequence[AlignmentRow]) -> str:
    """The scores with their intervals (95 %), and the control below each."""
    lines = [list(COLUMNS)]
    for row in rows:
        report = row.report
        counts = [f"{report.recordings:,}", f"{report.texts:,}"]
        lines.append(
            [row.source, row.view, *counts, *_with_interval(report), f"{report.p_value:.3f}"]
        )
        lines.append(["", "texts exchanged", "", "", *_cells(report.shuffled), ""])
        if report.within is not None:
            p_value = f"{report.p_within:.3f}"
            lines.append(["", "within classes", "", "", *_cells(report.within), p_value])
        lines.append(["", "chance", "", "", *_cells(report.chance), ""])
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
