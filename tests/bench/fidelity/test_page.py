"""The published pages are what `texvent bench page` makes of the published results."""

from pathlib import Path

import pytest

from texvent.bench.document import read_document
from texvent.bench.fidelity import page
from texvent.bench.fidelity.results import read_report
from texvent.bench.fidelity.table import BASELINE

RESULTS = Path(__file__).parents[3] / "docs" / "results"


@pytest.mark.parametrize(
    ("result", "baseline", "has_charts"),
    [
        ("fidelity.json.gz", BASELINE, True),
        ("fidelity-full.json.gz", BASELINE, False),
        ("real-davis346.json.gz", "texvent, flow", True),
        ("real-slider_depth.json.gz", "texvent, flow", True),
    ],
)
def test_published_pages_and_charts_are_those_of_the_published_results(
    result, baseline, has_charts, monkeypatch
):
    # Event images are simulated again, which takes minutes.
    monkeypatch.setattr(page, "event_image_grid", lambda report, scene: b"")
    report = read_report(read_document(RESULTS / result))
    files = page.page_files(report, result, baseline=baseline, has_charts=has_charts)
    for name, content in files.items():
        assert (RESULTS / name).is_file()
        if content:
            assert content == (RESULTS / name).read_bytes()
