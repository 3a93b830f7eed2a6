"""Average precision of detected boxes on one recording, and how far chance in time moves it.

Source: the COCO detection score, by pycocotools; the moving-block bootstrap (Künsch 1989,
"The jackknife and the bootstrap for general stationary observations").
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from contextlib import redirect_stdout
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.config import check_range
from texvent.errors import InputError
from texvent.extending import require
from texvent_lab.bench.detection.labels import IGNORED

COCO_IOU = tuple(np.arange(50, 100, 5) / 100)
"""Least overlaps over which COCO averages: .5 to .95."""
ALL = "all"
"""In results: mean over the classes that have a counted box."""
MOST_DETECTIONS = 100
"""Detections of a class in a frame that count, the most certain first; COCO's number."""


class PrecisionEstimate(NamedTuple):
    """A score and its interval; NaN without a counted box."""

    value: float
    low: float
    """Lower end of the 95 % interval."""
    high: float
    samples: NDArray[np.float64]
    """Scores of the samples [S]; two detectors are compared sample by sample, with one seed."""


def average_precision(
    detections: NDArray[np.void],
    truth: NDArray[np.void],
    *,
    classes: Sequence[str],
    iou: Sequence[float] = COCO_IOU,
) -> dict[str, float]:
    """Average precision by class, and their mean as `ALL`; see `bootstrap`."""
    scores = bootstrap(detections, truth, classes=classes, iou=iou, block=1, samples=0)
    return {name: estimate.value for name, estimate in scores.items()}


def bootstrap(
    detections: NDArray[np.void],
    truth: NDArray[np.void],
    *,
    classes: Sequence[str],
    iou: Sequence[float] = COCO_IOU,
    block: int = 10,
    samples: int = 1000,
    seed: int = 0,
) -> dict[str, PrecisionEstimate]:
    """Average precision by class, and their mean as `ALL`, with 95 % intervals.

    Blocks of consecutive frames are drawn with replacement, with their boxes and detections, until
    there are as many frames as before. The interval covers chance in time within one recording; it
    says nothing of other places, and is too narrow where the same object is there all the time.

    Args:
        detections: `BOX_RECORD` [N], `class_confidence` their score; `class_id` is the place in
            `classes`, as in evlib. They lie at instants of the truth.
        truth: `BOX_RECORD` [M]. A confidence of 0 marks a box that counts neither as missed nor,
            for a detection that lies on it, as false. Its instants are the frames.
        classes: names.
        iou: least overlaps to average over; `(0.5,)` for AP50.
        block: frames of a block; as many as are alike.
        samples: number of samples.
        seed: of the draws.

    Raises:
        ConfigError: `block` is below 1 or above the number of frames, or `samples` below 0.
        InputError: a box has none of the classes, or a detection lies at no frame.
        MissingDependencyError: pycocotools is not installed.
    """
    _check(detections, truth, classes)
    times_us = np.unique(truth["t"])
    check_range("block", block, 1, len(times_us))
    check_range("samples", samples, 0)
    evaluation = require("pycocotools.cocoeval", extra="texvent-lab[detection]")
    draws = np.random.default_rng(seed)
    with redirect_stdout(io.StringIO()):
        sides = (_as_coco(boxes, times_us, classes) for boxes in (truth, detections))
        evaluator = evaluation.COCOeval(*sides, "bbox")
        options = evaluator.params
        options.iouThrs, options.maxDets = np.asarray(iou, float), [MOST_DETECTIONS]
        options.areaRng, options.areaRngLbl = [[0, np.inf]], ["all"]
        evaluator.evaluate()
        values = _accumulate(evaluator)
        matches = np.array(evaluator.evalImgs, dtype=object).reshape(-1, len(times_us))
        scores = np.empty((samples, len(values)))
        for number in range(samples):
            starts = draws.integers(len(times_us) - block + 1, size=-(-len(times_us) // block))
            frames = (starts[:, None] + np.arange(block)).ravel()[: len(times_us)]
            evaluator.evalImgs = list(matches[:, frames].ravel())
            scores[number] = _accumulate(evaluator)
    return {
        name: PrecisionEstimate(value, *_interval(column), column)
        for name, value, column in zip((*classes, ALL), values, scores.T, strict=True)
    }


def _accumulate(evaluator: Any) -> list[float]:
    """AP of each class and their mean, from the matches that the evaluator holds."""
    evaluator.accumulate()
    # [overlap, recall, class, area, most detections]; -1 where a class has no counted box.
    by_class = evaluator.eval["precision"][..., 0, 0].mean(axis=(0, 1))
    known = by_class[by_class >= 0]
    return [*np.where(by_class >= 0, by_class, np.nan).tolist(), _mean(known)]


def _mean(values: NDArray[np.float64]) -> float:
    return float(values.mean()) if values.size else np.nan


def _interval(scores: NDArray[np.float64]) -> tuple[float, float]:
    known = scores[~np.isnan(scores)]
    low, high = np.quantile(known, [0.025, 0.975]) if known.size else (np.nan, np.nan)
    return float(low), float(high)


def _check(detections: NDArray[np.void], truth: NDArray[np.void], classes: Sequence[str]) -> None:
    numbers = np.concatenate([detections["class_id"], truth["class_id"]])
    if numbers.max(initial=0) >= len(classes):
        raise InputError(
            f"a box has class {numbers.max()}; a class is a place in {', '.join(classes)}: "
            f"0 to {len(classes) - 1}"
        )
    lost = detections["t"][~np.isin(detections["t"], truth["t"])]
    if lost.size:
        raise InputError(
            f"a detection at {lost[0]} µs, where nothing is labelled; run the detector at the "
            "instants of the labels"
        )


def _as_coco(boxes: NDArray[np.void], times_us: NDArray[np.int64], classes: Sequence[str]) -> Any:
    """Boxes as a data set of pycocotools; ignored ones are a crowd there."""
    coco = require("pycocotools.coco", extra="texvent-lab[detection]").COCO()
    coco.dataset = {
        "images": [{"id": number} for number in range(len(times_us))],
        "categories": [{"id": number, "name": name} for number, name in enumerate(classes)],
        "annotations": [
            {
                "id": number,
                "image_id": int(np.searchsorted(times_us, box["t"])),
                "category_id": int(box["class_id"]),
                "bbox": [float(box[side]) for side in "xywh"],
                "area": float(box["w"] * box["h"]),
                "score": float(box["class_confidence"]),
                "iscrowd": int(box["class_confidence"] == IGNORED),
            }
            for number, box in enumerate(boxes, 1)
        ],
    }
    coco.createIndex()
    return coco
