"""The published pages are what `texvent bench page` makes of the published results."""

import xml.etree.ElementTree as ElementTree
from dataclasses import replace
from pathlib import Path

from texvent_lab.bench.fidelity import page
from texvent_lab.bench.fidelity.table import BASELINE

from ..synthetic_report import synthetic_report

RESULTS = Path(__file__).parents[4] / "docs" / "results"


def test_text_of_a_result_is_no_html_in_page_or_charts(monkeypatch):
    monkeypatch.setattr(page, "event_image_grid", lambda report, scene: b"")
    hostile = '</text></script><script>alert(1)</script>"><img src=x onerror=alert(1)>\u2028| x'
    report = synthetic_report()
    report = replace(
        report,
        references=[replace(one, scene=hostile) for one in report.references],
        scores=[replace(one, scene=hostile, entry=hostile) for one in report.scores],
    )
    for name, content in page.page_files(report, "result.json", baseline=BASELINE).items():
        text = content.decode()
        assert "<script" not in text, name
        assert "<img" not in text, name
        if name.endswith(".svg"):
            ElementTree.fromstring(text)


def test_charts_show_every_entry_with_its_scores():
    report = synthetic_report()
    for chart in (page.score_chart(report), page.level_chart(report, "mixed", "noisy")):
        words = " ".join(one.text or "" for one in ElementTree.fromstring(chart).iter())
        assert all(one.entry in words for one in report.scores)
    assert ".90" in page.level_chart(report, "mixed", "noisy").decode()
