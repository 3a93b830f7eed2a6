"""The whole benchmark on ten made-up figures: trained, resumed, shown, refused."""

import numpy as np
import pytest

from texvent.cli.app import main
from texvent_lab.bench.digits.arms import find_arm
from texvent_lab.bench.digits.inputs import read_mnist
from texvent_lab.bench.digits.page import page_files
from texvent_lab.bench.digits.plan import DigitsPlan
from texvent_lab.bench.digits.results import read_report
from texvent_lab.bench.digits.run import run_digits
from texvent_lab.bench.digits.simulation import simulate_digits
from texvent_lab.bench.digits.tables import summary_text
from texvent_lab.bench.document import read_document, write_document
from texvent_lab.train.schedule import Schedule

from .synthetic_data import PAIRS, TRAIN, write_mnist, write_recordings

ARMS = ("esim", "frame difference")


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    """(folder of MNIST's files, .zip file of recordings)."""
    folder = tmp_path_factory.mktemp("digits")
    images = write_mnist(folder / "mnist")
    write_recordings(folder / "recordings.zip", images)
    return folder / "mnist", folder / "recordings.zip"


def tiny_plan(data, work, **changes):
    options = {
        "arms": ARMS,
        "ways": ("exact",),
        "choices": ("matched",),
        "digits": 60,
        "held_out": 20,
        "recorded": TRAIN,
        "pairs": PAIRS,
        "seeds": 2,
        "other_seeds": 1,
        "folds": 3,
        "shots": (1,),
        "shot_arms": ("esim",),
        "schedule": Schedule(epochs=12, batch_size=16, learning_rate=0.01),
    }
    return DigitsPlan(mnist=data[0], nmnist=data[1], work=work, **{**options, **changes})


def comparable(report):
    document = report.document()
    return {name: value for name, value in document.items() if name != "seconds"}


@pytest.fixture(scope="module")
def report(data, tmp_path_factory):
    pytest.importorskip("torch")
    return run_digits(tiny_plan(data, tmp_path_factory.mktemp("work")))


@pytest.mark.torch
def test_networks_learn_the_recorded_figures_from_simulated_ones(report):
    best = {
        one.arm: np.mean(one.accuracy)
        for one in report.scores
        if (one.representation, one.choice) == ("histogram", "matched")
    }
    assert best["esim"] > 0.25  # chance is 0.1
    assert report.protocol["share of events with the right sign"] > 0.95
    esim = report.scores[0]
    assert (esim.arm, esim.is_matched) == ("esim", True)
    assert 0.3 < esim.threshold < 0.7  # recorded with 0.5
    assert len(esim.accuracy) == len(esim.held_out) == 2
    assert len(esim.judged) == 1
    assert {one.shots for one in report.few_shot} == {0, 1}
    assert len(report.comparisons) == 2
    assert report.few_shot_tested == TRAIN - 10


@pytest.mark.torch
def test_a_run_that_was_stopped_ends_as_one_that_was_not(data, tmp_path, report):
    done = []

    def stop(line):
        done.append(line)
        if len(done) in (3, 7):
            raise KeyboardInterrupt

    plan = tiny_plan(data, tmp_path)
    for _ in range(2):
        with pytest.raises(KeyboardInterrupt):
            run_digits(plan, progress=stop)
    before = len(done)
    resumed = run_digits(plan, progress=done.append)
    assert comparable(resumed) == comparable(report)
    again = []
    run_digits(plan, progress=again.append)
    assert again == []
    assert len(done) > before


@pytest.mark.torch
def test_the_page_shows_what_the_document_holds(report, tmp_path):
    write_document(tmp_path / "digits.json", report.document(), overwrite=False)
    again = read_report(read_document(tmp_path / "digits.json"))
    assert again == report
    files = page_files(again, "digits.json")
    assert sorted(files) == ["digits-accuracy.svg", "digits-few-shot.svg", "digits.md"]
    page = files["digits.md"].decode()
    assert "| esim | true frames |" in page
    assert "(digits-few-shot.svg)" in page
    assert "McNemar" in page
    assert "| esim | true frames |" in summary_text(report)
    assert sorted(page_files(again, "digits.json", has_charts=False)) == ["digits.md"]
    command = ["bench", "page", str(tmp_path / "digits.json")]
    assert main(command) == 0
    assert (tmp_path / "digits.md").read_bytes() == files["digits.md"]


def test_counts_fall_with_the_threshold(data):
    mnist = read_mnist(data[0])
    counts = [
        simulate_digits(
            mnist, np.arange(1, 7), find_arm("esim").settings("exact", threshold=threshold)
        ).median_count
        for threshold in (0.1, 0.2, 0.4, 0.8)
    ]
    assert counts == sorted(counts, reverse=True)
    assert counts[0] > 3 * counts[-1]
