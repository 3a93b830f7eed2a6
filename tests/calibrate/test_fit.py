import dataclasses
from pathlib import Path

import pytest

from texvent.calibrate.estimates import write_preset
from texvent.calibrate.fit import describe_fit, fit_sensor
from texvent.frames import Video
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent.simulation.physical.cameras import PRESETS
from texvent.simulation.physical.config import PhysicalConfig

from .conftest import TRUTH, moving_blobs, record

START = dataclasses.replace(TRUTH, contrast_threshold=0.2, on_off_ratio=1.0, balance=10.0)


@pytest.fixture(scope="module")
def fit(recording):
    return fit_sensor(recording, start=START, seconds=0.4)


def test_the_fit_finds_the_sensor_that_made_the_recording(fit):
    assert fit.config.contrast_threshold == pytest.approx(TRUTH.contrast_threshold, rel=0.12)
    assert fit.config.on_off_ratio == pytest.approx(TRUTH.on_off_ratio, rel=0.08)
    assert fit.config.balance == pytest.approx(TRUTH.balance, rel=0.5)
    assert fit.offset_us == 0


def test_the_fit_is_better_where_it_was_not_fitted(fit):
    start, fitted = fit.distances["start"], fit.distances["fitted"]
    assert fit.span.stop_us <= fit.held_out.start_us
    assert fitted[1].total < 0.3 * start[1].total
    assert fitted[0].total < 0.3 * start[0].total
    assert fitted[0] != fitted[1]


def test_every_fitted_option_has_an_interval_that_holds_it(fit):
    found = {one.name: one for one in fit.found}
    assert set(found) == {"contrast_threshold", "on_off_ratio", "balance", "cutoff_hz"}
    for name, one in found.items():
        assert one.low <= one.value <= one.high
        assert one.value == getattr(fit.config, name)
        # The true value, or what the steps of the search leave of it.
        assert one.low / 1.2 <= getattr(TRUTH, name) <= one.high * 1.2, name
    kept = {one.name for one in fit.kept}
    assert {"noise_curve", "leak_rate_hz", "threshold_sigma", "refractory_period_us"} <= kept


@pytest.mark.long
def test_a_third_of_a_second_is_fitted_and_says_what_it_does_not_tell():
    fit = fit_sensor(record(moving_blobs(19), TRUTH), start=START)
    # Balance and threshold can stand in for each other in so little time: the interval says so.
    threshold = next(one for one in fit.found if one.name == "contrast_threshold")
    assert threshold.low < TRUTH.contrast_threshold < threshold.high < 3 * threshold.low
    assert fit.distances["fitted"][1].total < 0.5 * fit.distances["start"][1].total
    assert all(getattr(fit.config, one.name) == one.value for one in fit.kept)
    assert {one.name for one in (*fit.found, *fit.kept)} >= {"balance", "cutoff_hz", "noise_curve"}


def test_late_frame_times_are_found_and_what_another_recording_told_better_is_kept(recording):
    frames = recording.frames
    early = Video(frames.pixels, [t_us - 10_000 for t_us in frames.times_us])
    recording = dataclasses.replace(recording, frames=early)
    fit = fit_sensor(recording, start=START, seconds=0.2, keep=["balance", "cutoff_hz"])
    assert fit.offset_us == 10_000
    assert (fit.config.balance, fit.config.cutoff_hz) == (START.balance, START.cutoff_hz)
    assert fit.config.contrast_threshold != START.contrast_threshold
    assert {one.name for one in fit.found} == {"contrast_threshold", "on_off_ratio"}
    assert {one.name for one in fit.kept if one.reason == "as asked"} == {"balance", "cutoff_hz"}


def test_too_few_events_keep_every_option_of_the_circuit(recording):
    few = dataclasses.replace(recording, events=recording.events[::400])
    fit = fit_sensor(few, start=START, seconds=0.2)
    assert fit.config == START
    assert not fit.found
    reason = {one.name: one.reason for one in fit.kept}["contrast_threshold"]
    assert reason.endswith("OFF events; 100 of each are needed")


def write(fit, path, **options):
    lines = describe_fit(fit, "a test")
    return write_preset(fit.config, lines, path, size=SensorSize(32, 24), **options), lines


OTHER = {
    "gamma": 1.3, "balance": 11.0, "contrast_threshold": 0.22, "on_off_ratio": 1.2,
    "threshold_sigma": 0.04, "initial_phase": "random", "cutoff_hz": 90.0, "cutoff_limit_hz": 80.0,
    "refractory_period_us": 70, "leak_rate_hz": 0.3, "leak_rate_decades": 0.2,
    "noise_curve": "3:2 90:1", "noise_scale": 0.7, "noise_decades": 0.15,
    "noise_on_fraction": 0.4, "hot_pixel_fraction": 0.01, "hot_pixel_rate_hz": 9.0,
    "sensor_seed": 5, "scan_period_ns": 900, "threshold_map": Path("map.npz"),
}  # fmt: skip
"""Every option at a value that no preset has."""


def test_a_preset_keeps_every_option_but_those_that_belong_to_a_run(tmp_path):
    assert OTHER.keys() == {one.name for one in dataclasses.fields(PhysicalConfig)}
    path = write_preset(PhysicalConfig(**OTHER), [], tmp_path / "p.toml", size=SensorSize(32, 24))
    read, usual = resolve("simulate", {}, config=path).simulate, PhysicalConfig()
    for name, value in OTHER.items():
        of_run = name in ("gamma", "sensor_seed")
        assert getattr(read, name) == (getattr(usual, name) if of_run else value), name


def test_a_preset_is_a_config_file_of_a_run(fit, tmp_path):
    path, lines = write(fit, tmp_path / "my.toml")
    settings = resolve("simulate", {}, config=path)
    assert settings.run.simulator == "physical"
    assert settings.size == (32, 24)
    # The gamma belongs to the frames of a run, not to the sensor.
    assert settings.simulate == dataclasses.replace(fit.config, gamma=PRESETS["default"].gamma)
    text = path.read_text()
    assert text.startswith("# Fitted to a test by texvent")
    assert all(f"# {line}\n" in text for line in lines)
    assert "# found balance 20 (95 %: " in text
