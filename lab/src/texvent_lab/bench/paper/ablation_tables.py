"""The paper's Tables 4 and 5 on scenes with true events and on recordings, by STPP."""

from __future__ import annotations

from collections.abc import Sequence

from texvent_lab.bench.fidelity.comparison import difference_text
from texvent_lab.bench.fidelity.results import FidelityReport
from texvent_lab.bench.paper.config_entry import ConfigEntry
from texvent_lab.bench.paper.published_tables import TABLES, OurFigures

BASELINE = "Texvent"
TABLES_HERE = (4, 5)
EQS_NEED = (
    "EQS itself: it needs RVT's weights, and streams of N-ImageNet and streams simulated from "
    "their captions, which no one publishes"
)


def leave_out_other_tables(number: int, entries: Sequence[ConfigEntry]) -> list[ConfigEntry]:
    """The rows of Table 4 or 5, and the user's own; not those of the other of the two."""
    others = {column for table in TABLES_HERE for column in TABLES[table].columns}
    return [one for one in entries if one.name not in others - set(TABLES[number].columns)]


def ablation_figures(number: int, report: FidelityReport) -> OurFigures:
    """STPP of the rows of Table 4 or 5, and its paired difference to the paper's own setting.

    Args:
        number: 4 or 5.
        report: a run of the files in configs/paper, on scenes, on recordings, or both.
    """
    figures: dict[str, dict[str, str]] = {}
    for reference in report.references:
        scores = {one.entry: one for one in report.ranked(reference.scene, reference.target)}
        baseline = scores.get(BASELINE)
        stpp: dict[str, str] = {}
        difference: dict[str, str] = {}
        compared = report.comparison(reference)
        against = compared.differences(BASELINE) if baseline and compared.is_enough else None
        for column in TABLES[number].columns:
            if column not in scores:
                continue
            score = scores[column]
            lost = " (count not reached)" if score.threshold and not score.is_matched else ""
            stpp[column] = f"{score.summary('stpp').mean:.3f}{lost}"
            if baseline is None or column == BASELINE:
                continue
            if against is not None:
                difference[column] = difference_text(against[column], sign="+")
            else:
                found = score.difference("stpp", baseline)
                difference[column] = f"{found.mean:+.3f} ± {found.standard_error:.3f}"
        figures[f"STPP ↑, {reference.title}"] = stpp
        figures[f"− {BASELINE}, {reference.title}"] = difference
    return OurFigures(figures, needs=[EQS_NEED])
