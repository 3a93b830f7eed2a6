"""Scores of detectors, the document, and the table."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from texvent_lab.bench.document import markdown_table
from texvent_lab.bench.summary import mean_text

SCHEMA = "texvent-detection-1"


@dataclass(frozen=True, kw_only=True)
class ArmScore:
    """A network that was trained on the events of one simulator."""

    arm: str
    seed: int
    clips: Mapping[str, int]
    """Split → clips."""
    events: float
    """Events of the median test clip, as far as histograms count them."""
    boxes: int
    """Boxes of the test clips, at ends of windows; those at rest left out."""
    ap: Mapping[str, float]
    """Class → average precision over overlaps of .5 to .95; "all" is the mean."""
    ap50: Mapping[str, Mapping[str, float]]
    """The same at an overlap of .5, with low and high of the 95 % interval."""
    ap50_by_size: Mapping[str, float]
    street: Mapping[str, Mapping[str, float]] | None
    """AP50 and AP of cars on a recorded street: value, low and high of the 95 % interval."""
    best_epoch: int = 0
    training_seconds: float = 0.0
    seconds: float = 0.0


@dataclass(frozen=True)
class DetectionReport:
    """All results."""

    environment: Mapping[str, Any]
    protocol: Mapping[str, Any]
    scores: list[ArmScore]
    seconds: float

    def document(self) -> dict[str, Any]:
        """The values, ready for JSON."""
        return {"schema": SCHEMA, **asdict(self)}


def detection_table(report: DetectionReport) -> str:
    """A row per arm: means over its networks, ± standard error where there are several."""
    arms: dict[str, list[ArmScore]] = {}
    for score in report.scores:
        arms.setdefault(score.arm, []).append(score)
    classes = [name for name in report.scores[0].ap50 if name != "all"]
    titles = ["trained on", "events", "AP", "AP50 [95 %]", *classes]
    titles += [*report.scores[0].ap50_by_size, "recorded street, car AP50 [95 %]"]
    rows = []
    for arm, scores in arms.items():
        cells = [f"{scores[0].events:,.0f}"]
        cells += [mean_text([one.ap["all"] for one in scores])]
        cells += [", ".join(_interval(one.ap50["all"]) for one in scores)]
        cells += [mean_text([one.ap50[name]["value"] for one in scores]) for name in classes]
        cells += [
            mean_text([one.ap50_by_size[n] for one in scores]) for n in scores[0].ap50_by_size
        ]
        street = (_interval(one.street["AP50"]) if one.street else "–" for one in scores)
        rows.append([arm, *cells, ", ".join(street)])
    return markdown_table(titles, rows)


def _interval(one: Mapping[str, float]) -> str:
    return f"{one['value']:.3f} [{one['low']:.3f}, {one['high']:.3f}]"
