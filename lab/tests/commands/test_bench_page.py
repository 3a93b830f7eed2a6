"""`texvent bench fidelity` and `bench page` as a user meets them."""

import json
import xml.etree.ElementTree as ElementTree

from texvent.cli.app import main


def test_a_result_is_written_and_becomes_a_page_with_its_images(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    chosen = ["--scenes", "static", "--simulators", "esim", "--interpolations", "none"]
    assert main(["bench", "fidelity", *chosen, "-o", "r.json", "--jobs", "1", "-q"]) == 0
    shown = capsys.readouterr()
    assert "### static, noisy pixels" in shown.out
    assert not shown.err
    document = json.loads((tmp_path / "r.json").read_text())
    assert document["scores"][0]["entry"] == "esim, none"
    # Nothing moves, so a model without noise has no event to place.
    assert document["scores"][0]["default_ratio"] == 0
    assert main(["bench", "page", "r.json"]) == 0
    written = capsys.readouterr().out.split()
    assert sorted(written) == ["r-bars.svg", "r-events.png", "r-levels.svg", "r-times.svg", "r.md"]
    page = (tmp_path / "r.md").read_text()
    assert "commit: " in page
    assert "### static, noisy pixels" in page
    assert "| esim, none | " in page
    assert "esim, blend" not in page  # "none" is the name of an interpolator here
    for name in written:
        if name.endswith(".svg"):
            texts = ElementTree.fromstring((tmp_path / name).read_text()).iter()
            assert any("esim, none" in (one.text or "") for one in texts)
        if name != "r.md":
            assert name in page
    assert main(["bench", "page", "r.json", "--overwrite", "--baseline", "esim, flow"]) != 0
    assert "allowed: esim, none" in capsys.readouterr().err
    assert main(["bench", "page", "r.json"]) != 0
    assert "exists already" in capsys.readouterr().err
