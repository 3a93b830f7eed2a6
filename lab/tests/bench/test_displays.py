"""Results of benchmarks in a notebook."""

from __future__ import annotations

from pathlib import Path

import pytest

from texvent_lab.bench.document import read_document
from texvent_lab.bench.fidelity.results import read_report
from texvent_lab.bench.selftest.table import read_selftest

RESULTS = Path(__file__).parents[3] / "docs/results"


@pytest.mark.parametrize(
    ("report", "has"),
    [
        (lambda: read_report(read_document(RESULTS / "fidelity.json.gz")), "| entry |"),
        (lambda: read_selftest(RESULTS / "selftest.json.gz"), "| metric |"),
    ],
    ids=["fidelity", "selftest"],
)
def test_results_of_benchmarks_show_their_tables(report, has):
    bundle = report()._repr_mimebundle_()
    assert has in bundle["text/markdown"]
    assert "<script" not in bundle["text/markdown"]
