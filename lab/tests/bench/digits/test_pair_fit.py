"""The physical model fitted to recordings whose options are known."""

from texvent.run.prepare import prepare_video
from texvent_lab.bench.digits import pair_fit
from texvent_lab.bench.digits.arms import find_arm
from texvent_lab.bench.digits.sheet import Digits, DigitSheet

from .synthetic_data import figures, tile_events

TRUE = {"cutoff_hz": 60.0, "refractory_period_us": 2000, "contrast_threshold": 0.4}


def test_the_fit_finds_the_options_of_a_recording(monkeypatch):
    searched = {"cutoff_hz": (60.0, 1000.0), "refractory_period_us": (100, 2000)}
    monkeypatch.setattr(pair_fit, "COORDINATES", searched)
    sheet, arm = DigitSheet(Digits.as_measured(figures(1, 0))), find_arm("physical")
    truth = prepare_video(sheet, arm.settings("exact", fitted=TRUE)).packets.collect()
    recorded = [tile_events(sheet, truth, number) for number in range(1)]
    lines = []
    found, start, end = pair_fit.fit_to_pairs(sheet, recorded, arm.settings("exact"), lines.append)
    assert found["cutoff_hz"] == 60.0
    assert found["refractory_period_us"] == 2000
    assert 0.36 < found["contrast_threshold"] < 0.44
    assert end.total < 0.3 * start.total
    assert len(lines) == 4
