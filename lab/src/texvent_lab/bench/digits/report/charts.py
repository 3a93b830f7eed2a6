"""The results as SVG charts: accuracy of every arm, and the few-shot curve."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from texvent.metrics.summary import summarise
from texvent_lab.bench.digits.report.results import RECORDINGS, DigitsReport, SetScore, ShotScore
from texvent_lab.bench.digits.report.tables import REPRESENTATION_TITLES, WAY_TITLES
from texvent_lab.bench.svg import placed, svg_document, svg_text

COLOURS = (
    *("#4c78a8", "#f58518", "#59a14f", "#b279a2", "#8c8c96"),
    *("#e45756", "#72b7b2", "#9c755f", "#d4a600", "#26262e"),
)
LABEL_PX, PLOT_PX, ROW_PX, HEAD_PX, FOOT_PX, RIGHT_PX = 150, 300, 18, 40, 42, 24
CURVE_WIDTH, CURVE_HEIGHT, CURVE_LEFT, CURVE_TOP, LEGEND_PX = 420, 240, 50, 30, 170
WAY_COLOURS = dict(zip(WAY_TITLES, COLOURS, strict=False))
WAY_SHIFT = {"exact": -3, "flow": 3, "frames": 0}
"""px, so that an arm's ways do not hide each other."""
GRID = "stroke='#d8d8de'"
SMALL = "font-size='9'"
BOLD = "font-weight='bold'"
MIDDLE = "text-anchor='middle'"


class Point(NamedTuple):
    """A mean and its standard error, 0 if unknown."""

    mean: float
    error: float

    @classmethod
    def of(cls, values: Sequence[float]) -> Point:
        """Of the values of several seeds."""
        found = summarise(values)
        error = found.standard_error
        return cls(found.mean, error if math.isfinite(error) else 0.0)


class Axis(NamedTuple):
    """Accuracies from a tenth up to 1, along pixels."""

    low: float
    first_px: float
    last_px: float

    @classmethod
    def above(cls, points: Iterable[Point], first_px: float, last_px: float) -> Axis:
        """From the tenth below the lowest end of an error bar."""
        lowest = min(one.mean - one.error for one in points)
        return cls(max(math.floor(lowest * 10), 0) / 10, first_px, last_px)

    def place(self, value: float) -> float:
        """Pixel of an accuracy."""
        return self.first_px + (self.last_px - self.first_px) * (value - self.low) / (1 - self.low)

    @property
    def tenths(self) -> list[float]:
        """Where lines are drawn."""
        return [number / 10 for number in range(round(self.low * 10), 11)]


def accuracy_chart(report: DigitsReport) -> str:
    """Accuracy on recordings: a panel per representation, a row per arm, a colour per way.

    Of each arm it shows the first choice of a threshold that the run covers.
    """
    panels = [_panel(report, kind) for kind in report.ceiling]
    height = HEAD_PX + len(_arms(report)) * ROW_PX + FOOT_PX
    width = LABEL_PX + PLOT_PX + RIGHT_PX
    parts = [placed(panel, number * width, 0) for number, panel in enumerate(panels)]
    parts += _legend(report.scores, height - 6)
    return svg_document(width * len(panels), height, parts)


def _panel(report: DigitsReport, representation: str) -> str:
    arms, choice = _arms(report), report.scores[0].choice
    scores = [
        one for one in report.scores if (one.representation, one.choice) == (representation, choice)
    ]
    points = [Point.of(one.accuracy) for one in scores]
    axis = Axis.above(points, LABEL_PX, LABEL_PX + PLOT_PX)
    bottom = HEAD_PX + len(arms) * ROW_PX
    title = f"{REPRESENTATION_TITLES[representation]}, δ {choice}"
    parts = [svg_text(title, LABEL_PX, 16, BOLD)]
    for value in axis.tenths:
        x = axis.place(value)
        parts.append(_line(x, HEAD_PX, x, bottom, GRID))
        parts.append(svg_text(f"{value:g}", x, bottom + 14, f"{MIDDLE} {SMALL}"))
    x = axis.place(Point.of(report.ceiling[representation]).mean)
    parts.append(_line(x, HEAD_PX - 6, x, bottom, "stroke='#b04a4a' stroke-dasharray='3 2'"))
    label = f"text-anchor='end' style='fill:#b04a4a' {SMALL}"
    parts.append(svg_text("trained on recordings", x, HEAD_PX - 9, label))
    for row, arm in enumerate(arms):
        y = HEAD_PX + (row + 0.5) * ROW_PX
        parts.append(svg_text(arm, LABEL_PX - 8, y + 4, "text-anchor='end'"))
        for one in scores:
            if one.arm == arm:
                point, colour = Point.of(one.accuracy), WAY_COLOURS[one.way]
                left, right = (axis.place(point.mean + sign * point.error) for sign in (-1, 1))
                at = y + WAY_SHIFT[one.way]
                parts.append(_line(left, at, right, at, f"stroke='{colour}' stroke-width='2'"))
                parts.append(_dot(axis.place(point.mean), at, colour))
    return "".join(parts)


def _legend(scores: Sequence[SetScore], y: float) -> list[str]:
    parts, x = [], float(LABEL_PX)
    for way in dict.fromkeys(one.way for one in scores):
        parts += [_dot(x + 4, y - 3, WAY_COLOURS[way]), svg_text(WAY_TITLES[way], x + 12, y, SMALL)]
        x += 24 + 4.6 * len(WAY_TITLES[way])
    return parts


def few_shot_chart(report: DigitsReport) -> str:
    """Accuracy by recordings per class, a line per arm whose simulated events are added."""
    shots = sorted({one.shots for one in report.few_shot})
    bottom = CURVE_TOP + CURVE_HEIGHT
    axis = Axis.above((Point.of(one.accuracy) for one in report.few_shot), bottom, CURVE_TOP)
    steps = CURVE_WIDTH / max(len(shots) - 1, 1)
    columns = {shot: CURVE_LEFT + steps * number for number, shot in enumerate(shots)}
    right = CURVE_LEFT + CURVE_WIDTH
    parts = [svg_text("Accuracy on recordings", CURVE_LEFT, 16, BOLD)]
    for value in axis.tenths:
        y = axis.place(value)
        parts.append(_line(CURVE_LEFT, y, right, y, GRID))
        parts.append(svg_text(f"{value:g}", CURVE_LEFT - 6, y + 4, f"text-anchor='end' {SMALL}"))
    for shot, x in columns.items():
        parts.append(svg_text(str(shot), x, bottom + 16, MIDDLE))
    words = "recordings per class that the network sees"
    parts.append(svg_text(words, CURVE_LEFT + CURVE_WIDTH / 2, bottom + 34, MIDDLE))
    for number, arm in enumerate(dict.fromkeys(one.arm for one in report.few_shot)):
        colour = COLOURS[number % len(COLOURS)]
        scores = sorted((one for one in report.few_shot if one.arm == arm), key=_shots)
        points = [(columns[one.shots], Point.of(one.accuracy)) for one in scores]
        parts += _curve(points, axis, colour)
        y = CURVE_TOP + 16 + ROW_PX * number
        parts.append(_dot(right + 24, y - 4, colour))
        label = "recordings alone" if arm == RECORDINGS else f"with {arm}"
        parts.append(svg_text(label, right + 34, y))
    return svg_document(right + LEGEND_PX, bottom + 46, parts)


def _curve(points: Sequence[tuple[float, Point]], axis: Axis, colour: str) -> list[str]:
    """A line through the means, with an error bar at each."""
    path = " ".join(f"{x:.1f},{axis.place(point.mean):.1f}" for x, point in points)
    parts = [f"<polyline points='{path}' fill='none' stroke='{colour}' stroke-width='1.5'/>"]
    for x, point in points:
        low, high = (axis.place(point.mean + sign * point.error) for sign in (-1, 1))
        parts += [_line(x, low, x, high, f"stroke='{colour}'")]
        parts += [_dot(x, axis.place(point.mean), colour)]
    return parts


def _arms(report: DigitsReport) -> list[str]:
    return list(dict.fromkeys(one.arm for one in report.scores))


def _shots(score: ShotScore) -> int:
    return score.shots


def _dot(x: float, y: float, colour: str) -> str:
    return f"<circle cx='{x:.1f}' cy='{y:.1f}' r='3.5' fill='{colour}'/>"


def _line(x1: float, y1: float, x2: float, y2: float, attributes: str) -> str:
    return f"<line x1='{x1:.1f}' y1='{y1:.1f}' x2='{x2:.1f}' y2='{y2:.1f}' {attributes}/>"
