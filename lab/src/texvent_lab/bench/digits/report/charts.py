"""Charts of a result: accuracy of every arm, and the few-shot curve."""

from __future__ import annotations

import math

from texvent.metrics.summary import summarise
from texvent_lab.bench.digits.report.results import RECORDINGS, DigitsReport
from texvent_lab.bench.digits.report.tables import REPRESENTATION_TITLES, WAY_TITLES
from texvent_lab.charts import COLOURS, Dot, DotPanel, curve_chart, dot_chart

WAY_COLOURS = dict(zip(WAY_TITLES.values(), COLOURS, strict=False))


def accuracy_chart(report: DigitsReport) -> bytes:
    """Accuracy on recordings: a panel per representation, a row per arm, a colour per way.

    Of each arm it shows the first choice of a threshold that the run covers.
    """
    choice = report.scores[0].choice
    panels = []
    for kind, ceiling in report.ceiling.items():
        dots = []
        for one in report.scores:
            if (one.representation, one.choice) == (kind, choice):
                found = summarise(one.accuracy)
                dots.append(Dot(one.arm, WAY_TITLES[one.way], found.mean, found.standard_error))
        lines = {"trained on recordings": summarise(ceiling).mean}
        panels.append(DotPanel(f"{REPRESENTATION_TITLES[kind]}, δ {choice}", dots, lines))
    return dot_chart(panels, WAY_COLOURS)


def few_shot_chart(report: DigitsReport) -> bytes:
    """Accuracy by recordings per class, a curve per arm whose simulated events are added."""
    shots = sorted({one.shots for one in report.few_shot})
    found = {(one.arm, one.shots): summarise(one.accuracy) for one in report.few_shot}
    curves = {}
    for arm in dict.fromkeys(one.arm for one in report.few_shot):
        name = "recordings alone" if arm == RECORDINGS else f"with {arm}"
        curves[name] = [
            (one.mean, one.standard_error) if (one := found.get((arm, shot))) else (math.nan, 0)
            for shot in shots
        ]
    words = "recordings per class that the network sees"
    return curve_chart(curves, [*map(str, shots)], title="Accuracy on recordings", xlabel=words)
