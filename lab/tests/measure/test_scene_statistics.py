"""Statistics of scenes, on events and pictures whose figures are known."""

from pathlib import Path

import numpy as np
import pytest

from texvent import EventStream, SensorSize
from texvent_lab.bench.document import read_document
from texvent_lab.measure.scene_statistics import (
    SCENES,
    as_markdown,
    log_gradient,
    measure,
    picture_contrast,
)

ROOT = Path(__file__).parents[3]
ROWS = [(0, 0, 1), (0, 2, 0), (1, 12, 1), (0, 14, 1), (3, 40, 1)]  # x, ms, polarity


def test_rates_and_shares_are_those_counted_by_hand():
    x, ms, p = np.array(ROWS).T
    events = EventStream.from_columns(x, 0 * x, 1000 * ms, p, size=SensorSize(4, 1))
    row = measure("any", "by hand", events, {"all": 0.5}, 2.0)
    assert row.rate_hz == pytest.approx(5 / 4 / 0.04)
    # Four whole windows of 10 ms have events of 1, 2, 0 and 0 pixels, one of 33 ms of 2.
    assert row.active == pytest.approx((3 / 16, 2 / 4))
    assert (row.ever, row.often, row.positive, row.soon) == (0.75, 0.75, 0.8, 0.2)
    table = as_markdown([vars(row)])
    assert "| any (1) | 31.2 | 18.8 / 50.0 | 75 | 75 | 80 | 20 | 0.500 | 2 |" in table


def test_a_ramp_of_light_has_its_own_gradient():
    ramp = np.exp(-0.1 * np.arange(30.0))
    light = np.broadcast_to(ramp[None, :, None], (8, 30, 3))
    assert log_gradient(light)[:, 2:-2] == pytest.approx(0.1, abs=1e-9)
    lines = np.broadcast_to(np.resize([0.2, 0.5, 0.9], 30)[None, :, None], (8, 30, 3))
    assert log_gradient(lines)[:, 2:-2] == pytest.approx(0, abs=1e-9)  # finer than what is smoothed


def test_a_picture_has_a_contrast_of_all_vehicles_and_sky():
    found = picture_contrast("a car drives left on a road")
    assert found.keys() == {"all", "vehicles", "sky"}
    assert 0.0 < found["sky"] < found["all"] < found["vehicles"] < 1.0


def test_the_table_of_the_design_notes_is_that_of_the_stored_result():
    rows = read_document(ROOT / "docs/results/scenes.json.gz")["rows"]
    assert as_markdown(rows) in (ROOT / "docs/design.md").read_text(encoding="utf-8")
    assert {row["name"] for row in rows} >= {one for group in SCENES.values() for one in group}
