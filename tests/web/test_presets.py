"""The presets that the web page offers; what it offers is what there is."""

import texvent
from texvent.web.gradio_page import _options, _presets


def test_the_page_offers_presets_by_their_names():
    assert _presets("texvent") == ["paper (default)", "accurate"]
    for simulator in texvent.simulators():
        first, *others = _presets(simulator)
        assert others == list(texvent.presets(simulator))[1:]
        asked = ("procedural", 1.0, simulator, first, "dvs128", 0)
        assert _options(asked)["preset"] is None  # the default, or what the sensor has measured
    assert _options(("procedural", 1.0, "texvent", "accurate", "dvs128", 0))["preset"] == "accurate"
