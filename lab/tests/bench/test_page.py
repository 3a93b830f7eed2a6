"""Pages of results: their own files and stored ones, hostile text, and documents of other kinds."""

import json
import re
import xml.etree.ElementTree as ElementTree
from dataclasses import replace

import pytest

from texvent.cli.app import main
from texvent.errors import FileFormatError
from texvent_lab.bench.document import read_document
from texvent_lab.bench.fidelity.oracle_run import FidelityPlan
from texvent_lab.bench.page import page_files
from texvent_lab.bench.paper.published_tables import TABLES
from texvent_lab.commands.bench import fidelity

from .stored_pages import NAMES, PAGES, RESULTS, digests, stored
from .synthetic_report import synthetic_report


@pytest.mark.long
@pytest.mark.parametrize("name", NAMES)
def test_every_stored_result_has_the_page_and_chart_that_it_had(name):
    """Unless it is another result: then `stored_pages` writes the digests anew."""
    files = stored(name)
    assert digests(files) == json.loads(PAGES.read_text())[name]
    page = files[f"{name}.md"].decode()
    assert (f"({name}.svg)" in page) == (f"{name}.svg" in files)
    assert "commit: " in page
    assert page.splitlines()[0].partition(" (")[2].rstrip(")") == name.partition("-")[2]
    for chart in (one for one in files if one.endswith(".svg")):
        ElementTree.fromstring(files[chart])


def test_the_page_of_objects_has_both_tables():
    document = read_document(RESULTS / "objects.json.gz")
    page = page_files(document, "objects.json.gz")["objects.md"].decode()
    for test in ("table", "turntable"):
        assert f"## {test.capitalize()}" in page
        assert all(f"| {one['arm']} |" in page for one in document[test])


def test_the_papers_page_has_every_table_and_the_time_of_each_that_was_measured():
    document = read_document(RESULTS / "paper.json.gz")
    page = page_files(document, "paper.json.gz")["paper.md"].decode()
    measured = [number for number in TABLES if document[f"table {number}"]["rows"]]
    assert all(f"## Table {number}: " in page for number in TABLES)
    assert page.count("- Measured in ") == len(measured) > 0
    assert "`--folder`" in page
    assert not re.search(r"(?<!`)--[a-z]", page)  # which a typesetter makes a dash


def test_text_of_a_result_is_no_html_in_page_or_chart():
    hostile = '</text></script><script>alert(1)</script>"><img src=x onerror=alert(1)>\u2028| x'
    report = synthetic_report()
    report = replace(
        report,
        references=[replace(one, scene=hostile) for one in report.references],
        scores=[replace(one, scene=hostile, entry=hostile) for one in report.scores],
    )
    for name, content in page_files(report.document(), "result.json").items():
        text = content.decode()
        assert "<script" not in text, name
        assert "<img" not in text, name
        if name.endswith(".svg"):
            ElementTree.fromstring(text)


def test_a_chart_shows_every_entry():
    report = synthetic_report()
    chart = page_files(report.document(), "result.json")["result.svg"]
    words = " ".join(one.text or "" for one in ElementTree.fromstring(chart).iter())
    assert all(one.entry in words for one in report.scores)


@pytest.mark.parametrize(
    "change",
    [{"schema": "other"}, {"scores": [{}]}, {"scores": 3}, {"references": []}],
    ids=["schema", "empty score", "no list", "no reference"],
)
def test_another_document_is_refused(change):
    with pytest.raises(FileFormatError, match=r"schema|no result"):
        page_files({**synthetic_report().document(), **change}, "result.json")


@pytest.mark.long
def test_a_result_is_written_and_becomes_a_page(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    few = FidelityPlan(score_seeds=(21,), fit_seeds=(21,))
    monkeypatch.setattr(fidelity, "FidelityPlan", lambda: few)
    chosen = ["--scenes", "static", "--simulators", "esim", "--interpolations", "none"]
    assert main(["bench", "fidelity", *chosen, "-o", "r.json", "--jobs", "1", "-q"]) == 0
    shown = capsys.readouterr()
    assert "## static, noisy pixels" in shown.out
    assert not shown.err
    document = json.loads((tmp_path / "r.json").read_text())
    # Nothing moves, so a model without noise has no event to place.
    assert document["scores"][0]["default_ratio"] == 0
    assert main(["bench", "page", "r.json"]) == 0
    assert capsys.readouterr().out.split() == ["r.md", "r.svg"]
    assert "| esim, none | " in (tmp_path / "r.md").read_text()
    assert main(["bench", "page", "r.json", "--overwrite", "--baseline", "esim, flow"]) != 0
    assert "allowed: esim, none" in capsys.readouterr().err
    assert main(["bench", "page", "r.json"]) != 0
    assert "exists already" in capsys.readouterr().err
