"""Charts of a result of the oracle benchmark: scores, levels of the pyramid, time errors."""

from __future__ import annotations

from matplotlib.colors import to_rgba

from texvent.metrics.stpp import SPACE_CELLS, TIME_CELLS
from texvent.metrics.summary import summarise
from texvent_lab.bench.fidelity.details import BIN_US, BINS, CAP_US, Details
from texvent_lab.bench.fidelity.results import FidelityReport
from texvent_lab.charts import (
    Dot,
    DotPanel,
    Matrix,
    dot_chart,
    histogram_chart,
    matrix_chart,
)

COLOURS = {
    "frames": "#4c78a8",
    "true frames": "#59a14f",
    "frames, sensor known": "#9ab8dc",
    "true frames, sensor known": "#a8d3a2",
    "recorded": "#8c8c96",
}
"""Track → colour of its entries."""


def score_chart(report: FidelityReport) -> bytes:
    """STPP of every entry with its standard error, between null and floor: a panel per scene."""
    panels = []
    for one in report.references:
        dots = []
        for score in report.ranked(one.scene, one.target):
            found = score.summary("stpp")
            dots.append(Dot(score.entry, score.track, found.mean, found.standard_error))
        bounds = {"null": one.null["stpp"], "floor": one.floor["stpp"]}
        lines = {name: summarise(values).mean for name, values in bounds.items()}
        panels.append(DotPanel(f"{one.title}: STPP", dots, lines))
    return dot_chart(panels, COLOURS, least=0)


def level_chart(report: FidelityReport, scene: str, target: str) -> bytes:
    """STPP on each level of the pyramid: time downwards, space to the right, fine at the end."""
    rows = [f"{50 / parts:g} ms" for parts in TIME_CELLS]
    columns = [f"1/{parts}" for parts in SPACE_CELLS]
    panels = []
    for title, (details, colour) in _entries(report, scene, target).items():
        colours = [[to_rgba(colour, share) for share in shares] for shares in details.levels]
        texts = [[f"{share:.2f}"[1:] for share in shares] for shares in details.levels]
        panels.append(Matrix(title, rows, columns, colours, texts))
    return matrix_chart(panels)


def time_chart(report: FidelityReport, scene: str, target: str) -> bytes:
    """Time from each true event to the nearest simulated one, -10 to +10 ms."""
    near = 1_000 // BIN_US
    panels = {}
    for title, (details, colour) in _entries(report, scene, target).items():
        shares = details.time_error
        within = sum(shares[BINS // 2 - near : BINS // 2 + near])
        alone = max(1 - sum(shares), 0)
        note = f"{100 * within:.0f} % in 1 ms, {100 * alone:.0f} % alone"
        panels[f"{title}\n{note}"] = (shares, colour)
    edges = [(number * BIN_US - CAP_US) / 1000 for number in range(BINS + 1)]
    return histogram_chart(panels, edges, unit="ms")


def _entries(report: FidelityReport, scene: str, target: str) -> dict[str, tuple[Details, str]]:
    """Title → details and colour: the floor, then the entries, the best first."""
    floor = report.reference(scene, target).details
    shown = {f"floor: {report.floor_name}": (floor, COLOURS["recorded"])}
    for score in report.ranked(scene, target):
        title = f"{score.entry}  {score.summary('stpp').mean:.3f}"
        shown[title] = (score.details, COLOURS[score.track])
    return shown
