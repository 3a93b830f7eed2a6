from dataclasses import replace
from pathlib import Path

import pytest

from texvent.simulate.texvent.simulator import TexventSimulator
from texvent_lab.bench.fidelity.entries import read_ablations
from texvent_lab.bench.fidelity.table import fidelity_tables
from texvent_lab.bench.oracle.run import FidelityPlan, run_fidelity

PAPER = Path(__file__).parents[4] / "configs" / "paper"


def test_the_paper_has_twelve_ablations_in_their_order():
    names = [entry.name for entry in read_ablations(PAPER)]
    assert names == [*(f"E{i}" for i in range(1, 13)), "Texvent"]


@pytest.mark.parametrize(
    ("name", "changes"),
    [
        ("Texvent", {}),
        ("E1", {"balance": 0.001}),
        ("E2", {"balance": 15.0}),
        ("E3", {"balance": 60.0}),
        ("E4", {"cache": "none"}),
        ("E5", {"cache": "global"}),
        ("E9", {"noise": "none"}),
        ("E10", {"noise": "gaussian"}),
        ("E11", {"noise": "random"}),
        ("E12", {"timestamp_rule": "random"}),
    ],
)
def test_each_ablation_changes_what_the_paper_says(name, changes):
    entry = next(entry for entry in read_ablations(PAPER) if entry.name == name)
    assert entry.settings(5).simulate == replace(TexventSimulator.presets["paper"], **changes)
    assert entry.settings(5).run.seed == 5


def test_interpolation_is_removed_fixed_and_replaced():
    entries = {entry.name: entry.settings(0).interpolate for entry in read_ablations(PAPER)}
    assert entries["E6"].interpolate == "none"
    assert (entries["E7"].count, entries["E7"].fixed_count) == ("fixed", 10)
    assert entries["E8"].interpolate not in ("none", entries["Texvent"].interpolate)


def test_the_threshold_is_fitted_only_if_asked_for():
    kept, fitted = (read_ablations(PAPER, is_rate_matched=flag)[0] for flag in (False, True))
    assert kept.default_threshold is None
    assert fitted.default_threshold == 0.2


def test_ablations_run_and_are_compared_with_a_row_of_choice(tmp_path):
    for name, noise in (("quiet", 0.0), ("loud", 50.0)):
        (tmp_path / f"{name}.toml").write_text(
            f'interpolate = "none"\nnoise_rate_hz = {noise}\nnoise = "random"\n'
        )
    plan = FidelityPlan(
        scenes=("static",),
        score_seeds=(21,),
        metrics=("stpp", "count_ratio"),
        entries=read_ablations(tmp_path),
    )
    report = run_fidelity(plan)
    counts = {score.entry: score.values["count_ratio"][0] for score in report.scores}
    assert counts["loud"] > 10 * counts["quiet"]
    assert all(score.threshold is None for score in report.scores)
    text = fidelity_tables(report, baseline="quiet")
    assert "STPP − quiet" in text
    assert "STPP −" not in fidelity_tables(report)  # the default baseline did not run
