"""Text-event alignment: is a recording's own text the one that a CLIP model finds nearest?"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.generate.videos.clip_model import ClipModel, Vectors
from texvent_lab.alignment.recordings import Recording
from texvent_lab.alignment.retrieval import RECALL_AT, Retrieval, RetrievalReport, score_retrieval
from texvent_lab.alignment.views import View


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
