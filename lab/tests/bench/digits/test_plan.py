"""What a plan covers, and what its steps depend on."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from texvent_lab.bench.digits.arms import ARMS, Cell
from texvent_lab.bench.digits.networks import choose_recordings
from texvent_lab.bench.digits.plan import DigitsPlan, Run, Training


def plan(**changes):
    options = {"mnist": Path("m"), "nmnist": Path("n"), "work": Path("w"), "arms": ("esim",)}
    return DigitsPlan(**{**options, **changes})


def run(**changes):
    return Run(plan(**changes), mnist="a", recorded="b", pairs="c", target=4000.0, polarity=0.9)


def test_arms_are_run_by_every_choice_but_interpolated_only_with_matched_thresholds():
    cells = plan(arms=("esim", "frame difference")).cells
    found = {(one.arm, one.way, one.choice) for one in cells}
    assert found == {
        ("esim", "exact", "matched"), ("esim", "flow", "matched"),
        ("esim", "exact", "default"), ("esim", "exact", "random"),
        ("frame difference", "frames", "matched"), ("frame difference", "frames", "default"),
        ("frame difference", "frames", "random"),
    }  # fmt: skip
    assert len(cells) == len(found)


@pytest.mark.parametrize("arm", ARMS, ids=lambda arm: arm.name)
def test_every_arm_has_settings_and_a_threshold_that_can_be_set(arm):
    for way in arm.ways:
        first, second = arm.settings(way), arm.settings(way, threshold=0.4)
        assert first.simulate != second.simulate
        assert first.interpolate.interpolate in ("exact", "flow", "none")


def test_pairs_training_and_held_out_digits_are_disjoint():
    one = plan(digits=9000)
    parts = [np.arange(1, one.pairs + 1), one.numbers, one.held_out_numbers]
    assert len(np.unique(np.concatenate(parts))) == sum(map(len, parts)) == 100 + 9000 + 500
    assert one.held_out_numbers[-1] == 10_000


def test_steps_depend_on_what_they_compute_and_on_nothing_else():
    training = Training(None, "histogram", 0, fold=1)
    first = run().training_step(training).digest
    assert run(arms=("v2e",), digits=2000).training_step(training).digest == first
    assert run(work=Path("elsewhere")).training_step(training).digest == first
    for other in (
        run(digits=1000).training_step(training),
        dataclasses.replace(run(), recorded="x").training_step(training),
        run().training_step(dataclasses.replace(training, seed=1)),
        run().training_step(dataclasses.replace(training, fold=2)),
        run(folds=5).training_step(training),
        run(precision="bfloat16").training_step(training),
    ):
        assert other.digest != first
    cell = Cell("esim", "exact", "default")
    a_set = run().set_step(cell).digest
    assert run(seeds=9).set_step(cell).digest == a_set
    assert run(held_out=10).set_step(cell).digest != a_set
    assert run().set_step(dataclasses.replace(cell, choice="random")).digest != a_set


def test_few_shots_are_nested_and_balanced_and_folds_cover_all():
    labels = np.repeat(np.arange(10), 40)
    one = plan()
    seen = {
        shots: choose_recordings(labels, Training(None, "histogram", 3, shots=shots), one)
        for shots in (1, 3, 30)
    }
    for shots, mask in seen.items():
        assert np.bincount(labels[mask]).tolist() == [shots] * 10
    assert not (seen[1] & ~seen[3]).any()
    assert not (seen[3] & ~seen[30]).any()
    other = choose_recordings(labels, Training(None, "histogram", 4, shots=3), one)
    assert (other != seen[3]).any()
    unseen = [
        ~choose_recordings(labels, Training(None, "histogram", 0, fold=fold), one)
        for fold in range(one.folds)
    ]
    assert (np.sum(unseen, axis=0) == 1).all()
    cell = Cell("esim", "exact", "matched")
    assert not choose_recordings(labels, Training(cell, "histogram", 0), one).any()
