import xml.etree.ElementTree as ElementTree

import pytest

from texvent_lab.bench.fidelity.bar_chart import BAR_PX, bar_chart

from ..synthetic_report import synthetic_report

SVG = "{http://www.w3.org/2000/svg}"


def test_the_chart_is_an_svg_with_a_bar_per_entry_as_long_as_its_stpp():
    root = ElementTree.fromstring(bar_chart(synthetic_report()))
    panel = root.find(f"{SVG}g")
    widths = [float(bar.get("width")) for bar in panel.findall(f"{SVG}rect")]
    # Best first; an undefined value has no length.
    assert widths == pytest.approx([0.75 * BAR_PX, 0.45 * BAR_PX, 0.0], abs=0.06)
    texts = [text.text for text in panel.findall(f"{SVG}text")]
    assert texts[:3] == ["mixed, noisy pixels: STPP", "null", "floor"]
    assert texts[3:] == ["better", "0.750", "texvent paper, blend", "0.450", "lost", "undefined"]


def test_error_bars_are_one_standard_error_to_each_side():
    root = ElementTree.fromstring(bar_chart(synthetic_report()))
    lines = root.find(f"{SVG}g").findall(f"{SVG}line")
    better = lines[2]
    length = float(better.get("x2")) - float(better.get("x1"))
    assert length == pytest.approx(2 * 0.05 * BAR_PX, abs=0.2)
