"""Scores of networks on recorded objects, the document, and the tables."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError
from texvent.truth.boxes import BOX_RECORD
from texvent_lab.bench.detection.labels import COUNTED, IGNORED
from texvent_lab.bench.detection.precision import ALL, bootstrap
from texvent_lab.bench.document import markdown_table, read_records
from texvent_lab.bench.objects.recorded import Frames
from texvent_lab.bench.summary import mean_text, summarise

SCHEMA = "texvent-objects-1"
REFERENCE = "texvent"
"""Arm that the others are compared with."""
RECORDED = "recorded"
SAMPLES = 100
"""Resamples of the bootstrap over poses."""
POSES = 12
"""Successive poses of a block; the arm moves in the same way for about as many."""


@dataclass(frozen=True)
class WindowSet:
    """Simulated windows of an arm."""

    threshold: float | None
    """Contrast threshold, log units; None for a model without one, or where clips draw theirs."""
    events: int
    """In all clips."""
    windows: int
    share: float
    """Share of pixels with an event in a window."""


@dataclass(frozen=True)
class ObjectScore:
    """Networks that were trained on one set of windows."""

    arm: str
    """Name, or `RECORDED`: trained on the other half of the recorded windows."""
    windows: Mapping[str, Any] | None
    """See `WindowSet`."""
    scores: Mapping[str, Sequence[float]]
    """Name → a value per seed."""
    interval: Sequence[float]
    """95 % of the first score, by blocks of recorded windows."""
    difference: Sequence[float] | None
    """Mean of the first score less the reference's, and its 95 % interval; None for itself."""


@dataclass(frozen=True)
class ObjectsReport:
    """All results."""

    environment: Mapping[str, Any]
    protocol: Mapping[str, Any]
    table: Sequence[ObjectScore]
    """Detection on a robot's table: AP50 of visible objects first."""
    turntable: Sequence[ObjectScore]
    """Classification of turntable windows: accuracy, the mean over recordings, first."""
    seconds: float
    reference: str = REFERENCE
    """Arm that the others are compared with."""

    def document(self) -> dict[str, Any]:
        """The values, ready for JSON."""
        return {"schema": SCHEMA, **asdict(self)}


def read_report(document: Mapping[str, Any]) -> ObjectsReport:
    """The results in a document.

    Raises:
        FileFormatError: it has another schema.
        KeyError, TypeError: it has another layout.
    """
    if document.get("schema") != SCHEMA:
        raise FileFormatError(f"this is no result of texvent bench objects ({SCHEMA})")
    values = {name: value for name, value in document.items() if name != "schema"}
    tests = {test: read_records(ObjectScore, values[test]) for test in ("table", "turntable")}
    return ObjectsReport(**{**values, **tests})


def score_all(
    recorded: Frames,
    classes: Sequence[str],
    sets: Mapping[str, WindowSet],
    found: Mapping[str | None, Sequence[NDArray[Any]]],
    *,
    reference: str = REFERENCE,
) -> list[ObjectScore]:
    """Scores of all arms, then of networks trained on recorded windows.

    Args:
        recorded: what was tested on.
        classes: their names.
        sets: arm → its windows.
        found: arm, or None for those trained on recorded windows → predictions per seed: boxes, or
            a class per window.
        reference: arm that the others are compared with.
    """
    is_table = np.isfinite(recorded.boxes).all()
    score = _score_boxes if is_table else _score_classes
    scored = {arm: score(recorded, classes, one) for arm, one in found.items()}
    compared = scored.get(reference)
    rows = []
    for arm, (scores, samples) in scored.items():
        difference = None
        if compared is not None and arm not in (reference, None):
            first = next(iter(scores))
            mean = np.mean(scores[first]) - np.mean(compared[0][first])
            difference = [float(mean), *_ends(samples - compared[1])]
        windows = None if arm is None else asdict(sets[arm])
        rows.append(ObjectScore(arm or RECORDED, windows, scores, _ends(samples), difference))
    return [*rows, count_floor(recorded, classes)] if not is_table else rows


def _ends(samples: NDArray[np.float64]) -> list[float]:
    return [float(one) for one in np.quantile(samples, [0.025, 0.975])]


def as_truth(recorded: Frames, *, is_visible_only: bool) -> NDArray[np.void]:
    """Labelled boxes, `t` the number of the frame; those not counted are ignored."""
    truth = np.zeros(len(recorded.boxes), BOX_RECORD)
    truth["t"] = np.arange(len(truth))
    for side, values in zip("xywh", recorded.boxes.T, strict=True):
        truth[side] = values
    is_counted = recorded.is_visible if is_visible_only else np.ones(len(truth), np.bool_)
    truth["class_id"] = recorded.classes
    truth["class_confidence"] = np.where(is_counted, COUNTED, IGNORED)
    return truth


def _score_boxes(
    recorded: Frames, classes: Sequence[str], found: Sequence[NDArray[np.void]]
) -> tuple[dict[str, list[float]], NDArray[np.float64]]:
    """Scores per seed; samples of the bootstrap of the first one, the mean over seeds."""
    scores: dict[str, list[float]] = {}
    samples = np.zeros(SAMPLES)
    block = min(POSES * len(classes), len(recorded.boxes))
    for boxes in found:
        for name, is_visible_only in (("AP50 visible", True), ("AP50", False)):
            truth = as_truth(recorded, is_visible_only=is_visible_only)
            count = SAMPLES if is_visible_only else 0
            options: dict[str, Any] = {
                "classes": classes,
                "iou": (0.5,),
                "block": block,
                "samples": count,
            }
            ap = bootstrap(boxes, truth, **options)
            scores.setdefault(name, []).append(ap[ALL].value)
            if is_visible_only:
                samples += ap[ALL].samples / len(found)
                for kind in classes:
                    scores.setdefault(f"AP50 visible, {kind}", []).append(ap[kind].value)
        for name, value in _best_boxes(recorded, boxes).items():
            scores.setdefault(name, []).append(value)
    return scores, samples


def _best_boxes(recorded: Frames, boxes: NDArray[np.void]) -> dict[str, float]:
    """Shares of frames whose most certain box overlaps the object by half, and has its class."""
    order = np.lexsort([-boxes["class_confidence"], boxes["t"]])
    frames, first = np.unique(boxes["t"][order], return_index=True)
    best = boxes[order][first]
    x, y, width, height = recorded.boxes[frames].T
    across = np.minimum(best["x"] + best["w"], x + width) - np.maximum(best["x"], x)
    down = np.minimum(best["y"] + best["h"], y + height) - np.maximum(best["y"], y)
    shared = np.maximum(across, 0) * np.maximum(down, 0)
    overlap = shared / (best["w"] * best["h"] + width * height - shared)
    count = len(recorded.boxes)
    is_class = best["class_id"] == recorded.classes[frames]
    return {
        "located": float((overlap >= 0.5).sum() / count),
        "class": float(is_class.sum() / count),
    }


def _score_classes(
    recorded: Frames, classes: Sequence[str], found: Sequence[NDArray[np.int64]]
) -> tuple[dict[str, list[float]], NDArray[np.float64]]:
    """As `_score_boxes`, of blocks of windows of each recording."""
    is_right = np.array([one == recorded.classes for one in found])
    by_class = {
        kind: is_right[:, recorded.classes == number].mean(axis=1)
        for number, kind in enumerate(classes)
    }
    scores = {"accuracy": np.mean(list(by_class.values()), axis=0).tolist()}
    scores |= {kind: values.tolist() for kind, values in by_class.items()}
    samples = np.zeros(SAMPLES)
    for number in range(len(classes)):
        values = is_right[:, recorded.classes == number].mean(axis=0)
        block = min(10, len(values))
        draws = np.random.default_rng(number)
        starts = draws.integers(len(values) - block + 1, size=(SAMPLES, -(-len(values) // block)))
        chosen = (starts[..., None] + np.arange(block)).reshape(SAMPLES, -1)[:, : len(values)]
        samples += values[chosen].mean(axis=1) / len(classes)
    return scores, samples


def count_floor(recorded: Frames, classes: Sequence[str]) -> ObjectScore:
    """Accuracy of the class whose windows have the likeliest number of events, and nothing else.

    It learns from the even windows and is tested on the odd ones, which is easier than the halves.
    """
    counts = np.log1p((recorded.images != 0).sum(axis=(1, 2)))
    kinds, even = recorded.classes, np.arange(len(counts)) % 2 == 0
    chance = []
    for number in range(len(classes)):
        learned = counts[even & (kinds == number)]
        spread = learned.std() + 1e-3
        chance.append(-(((counts - learned.mean()) / spread) ** 2) / 2 - np.log(spread))
    found = np.argmax(chance, axis=0)
    scores, samples = _score_classes(recorded.select(~even), classes, [found[~even]])
    return ObjectScore("number of events alone", None, scores, _ends(samples), None)


def objects_tables(report: ObjectsReport) -> str:
    """Detection, then classification: a row per arm, the best on top, and the recorded ceiling."""
    parts = []
    for title, rows in (("table", report.table), ("turntable", report.turntable)):
        ranked = sorted(rows, key=lambda one: (one.windows is None, -_mean(one)))
        names = list(ranked[0].scores)
        titles = [
            "trained on",
            "δ",
            "pixels with an event",
            names[0],
            "95 %",
            f"less {report.reference}",
        ]
        table = [_row(one, names) for one in ranked]
        parts.append(f"## {title.capitalize()}\n\n{markdown_table(titles + names[1:], table)}")
    return "\n".join(parts)


def _mean(one: ObjectScore) -> float:
    return summarise(next(iter(one.scores.values()))).mean


def _row(one: ObjectScore, names: Sequence[str]) -> list[str]:
    sets = one.windows
    made = ["–", "–"]
    if sets is not None:
        threshold = sets["threshold"]
        made = ["–" if threshold is None else f"{threshold:.2f}", f"{sets['share']:.3f}"]
    difference = "–"
    if one.difference is not None:
        difference = "{:+.3f} [{:+.3f}, {:+.3f}]".format(*one.difference)
    interval = "[{:.3f}, {:.3f}]".format(*one.interval)
    first, *others = (mean_text(one.scores[name]) for name in names)
    return [one.arm, *made, first, interval, difference, *others]
