"""Calibration on real DAVIS recordings, fetched from the package index."""

import dataclasses

import pytest

from texvent.calibrate.fit import fit_sensor
from texvent.calibrate.recording import Recording, simulate_span
from texvent.calibrate.search import measure_distance
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig, InterpolateConfig
from texvent.data.pull import pull
from texvent.io.files import load
from texvent.sensor import SensorSize
from texvent.simulate.physical.cameras import PRESETS


@pytest.mark.network
def test_a_fitted_davis_is_closer_to_the_half_it_has_not_seen():
    folder = pull("slider_depth")
    recording = Recording(
        open_frames(folder, CaptureConfig()),
        load(folder / "events.txt", size=SensorSize(240, 180)),
        InterpolateConfig(max_intermediate=8),
    )
    start = dataclasses.replace(PRESETS["davis240c"], gamma=1.0)
    fit = fit_sensor(recording, start=start, seconds=0.3)
    before, after = (fit.distances[name][1] for name in ("start", "fitted"))
    assert after.total < 0.4 * before.total
    assert after.overlap < before.overlap - 0.1
    assert after.intervals < before.intervals
    assert fit.noise is not None


@pytest.mark.network
def test_a_fitted_davis346_is_closer_to_the_street_it_has_not_seen():
    path = pull("davis346")
    recording = Recording(
        open_frames(path, CaptureConfig()), load(path), InterpolateConfig(max_intermediate=8)
    )
    start = dataclasses.replace(PRESETS["davis346"], gamma=1.0)
    fit = fit_sensor(recording, start=start, seconds=0.4)
    # AEDAT4 states the exposure, so the times of its frames need no correction.
    assert fit.offset_us == 0
    # A street at rest but for the cars: no OFF event, few ON events from leak.
    assert fit.noise is not None
    assert fit.config.leak_rate_hz < 0.01
    before, after = (fit.distances[name][1] for name in ("start", "fitted"))
    assert after.total < 0.5 * before.total
    assert after.overlap < before.overlap - 0.05
    default = dataclasses.replace(PRESETS["default"], gamma=1.0)
    frames = recording.dense_frames(fit.held_out, default)
    events = simulate_span(frames, fit.held_out, default)
    unfitted = measure_distance(events, recording.events.cut(*fit.held_out))
    assert after.total < 0.5 * unfitted.total
    assert after.overlap < unfitted.overlap - 0.05
