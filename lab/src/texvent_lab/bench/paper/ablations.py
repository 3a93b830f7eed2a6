"""Tables 4 and 5 of the paper: one design choice changed at a time, by STPP."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from texvent.errors import InputError
from texvent_lab.bench.fidelity.comparison import difference_text
from texvent_lab.bench.fidelity.entries import ConfigEntry
from texvent_lab.bench.fidelity.results import FidelityReport
from texvent_lab.bench.paper.config import ABLATIONS, BASELINE
from texvent_lab.bench.paper.published_tables import TABLES, Measured
from texvent_lab.plug_ins.super_slomo import find_super_slomo

EQ7_READING = (
    "E12: Eq. 7's minimum and maximum are over the pixels that fire. The letter takes all pixels: "
    "STPP .680 for .690 on davis346, .553 for .563 on slider_depth (24 frames, δ = .2, no noise); "
    "random times .708 and .577"
)
EQS_NEED = (
    "EQS itself: it needs RVT's weights, and streams of N-ImageNet and streams simulated from "
    "their captions, which no one publishes"
)


def leave_out_other_tables(number: int, entries: Sequence[ConfigEntry]) -> list[ConfigEntry]:
    """The rows of Table 4 or 5, and the user's own; not those of the other of the two."""
    others = {column for table in ABLATIONS for column in TABLES[table].columns}
    return [one for one in entries if one.name not in others - set(TABLES[number].columns)]


def measure_ablations(number: int, report: FidelityReport) -> Measured:
    """STPP of the rows of Table 4 or 5, and its paired difference to the paper's own setting.

    Args:
        number: 4 or 5.
        report: a run of the files in configs/paper, on scenes, on recordings, or both.
    """
    rows: dict[str, dict[str, str]] = {}
    for reference in report.references:
        scores = {one.entry: one for one in report.ranked(reference.scene, reference.target)}
        compared = report.comparison(reference)
        has_baseline = BASELINE in scores
        against = compared.differences(BASELINE) if has_baseline and compared.is_enough else None
        stpp: dict[str, str] = {}
        difference: dict[str, str] = {}
        for column in TABLES[number].columns:
            if column not in scores:
                continue
            score = scores[column]
            lost = " (count not reached)" if score.threshold and not score.is_matched else ""
            stpp[column] = f"{score.summary('stpp').mean:.3f}{lost}"
            if not has_baseline or column == BASELINE:
                continue
            if against is not None:
                difference[column] = difference_text(against[column], sign="+")
            else:
                found = score.difference("stpp", scores[BASELINE])
                difference[column] = f"{found.mean:+.3f} ± {found.standard_error:.3f}"
        rows[f"STPP ↑, {reference.title}"] = stpp
        rows[f"− {BASELINE}, {reference.title}"] = difference
    notes = [EQ7_READING] if number == 5 else []
    return Measured(rows, notes, [EQS_NEED])


def choose_e8(
    entries: Sequence[ConfigEntry], weights: Path | None
) -> tuple[list[ConfigEntry], Measured]:
    """E8 by Super SloMo where its weights are, else as its file says; and a note of which.

    Raises:
        InputError: there is no file `weights`.
    """
    try:
        path = find_super_slomo(weights)
    except InputError:
        if weights is not None:
            raise
        note = "E8: optical flow in place of Super SloMo, with VID2E's number of frames"
        return list(entries), Measured(
            notes=[note], needs=["E8 by Super SloMo: --slomo-weights FILE"]
        )
    options = (("interpolate", "super-slomo"), ("interpolator_weights", path))
    chosen = [replace(one, options=options) if one.name == "E8" else one for one in entries]
    return chosen, Measured(notes=[f"E8: Super SloMo ({path}), with VID2E's number of frames"])
