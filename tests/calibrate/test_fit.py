import dataclasses

import pytest

from texvent.calibrate.fit import fit_sensor
from texvent.calibrate.preset import describe_fit, write_preset
from texvent.errors import OutputError
from texvent.run.settings import resolve
from texvent.sensor import SensorSize
from texvent.simulate.physical.config import PRESETS

from .conftest import TRUTH

START = dataclasses.replace(TRUTH, contrast_threshold=0.2, on_off_ratio=1.0, balance=10.0)


@pytest.fixture(scope="module")
def lines() -> list[str]:
    return []


@pytest.fixture(scope="module")
def fit(recording, lines):
    return fit_sensor(recording, start=START, seconds=0.4, report=lines.append)


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


def test_every_step_is_reported(fit, lines):
    assert not fit.has_noise
    assert lines[0] == "too few still pixels to measure noise"
    assert any(line.startswith("balance 20: distance") for line in lines)
    assert any(line.startswith("cutoff_hz") for line in lines)


def test_a_preset_is_a_config_file_of_a_run(fit, tmp_path):
    path = write_preset(fit, tmp_path / "my.toml", size=SensorSize(32, 24), source="a test")
    settings = resolve("simulate", {}, config=path)
    assert settings.run.simulator == "physical"
    assert settings.size == (32, 24)
    # The gamma belongs to the frames of a run, not to the sensor.
    assert settings.simulate == dataclasses.replace(fit.config, gamma=PRESETS["default"].gamma)
    text = path.read_text()
    assert text.startswith("# Fitted to a test by texvent")
    assert all(f"# {line}\n" in text for line in describe_fit(fit, "a test"))


def test_an_existing_preset_is_kept(fit, tmp_path):
    path = tmp_path / "my.toml"
    path.write_text("mine")
    with pytest.raises(OutputError, match="exists"):
        write_preset(fit, path, size=SensorSize(32, 24), source="a test")
    assert path.read_text() == "mine"
    write_preset(fit, path, size=SensorSize(32, 24), source="a test", overwrite=True)
    assert path.read_text() != "mine"
