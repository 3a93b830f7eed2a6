"""From names and single options to the settings of a run."""

from argparse import Namespace
from pathlib import Path

import numpy as np
import pytest
import tomli_w
from tests.held_back import HeldBack

import texvent
from texvent._registry import SIMULATORS
from texvent.cli.simulation.calibrate import CalibrateOptions
from texvent.cli.simulation.generate import PromptOptions
from texvent.config import CaptureConfig, InterpolateConfig, warn_of_idle
from texvent.errors import ConfigError, TexventWarning
from texvent.sensor import SENSORS, SensorSize
from texvent.settings.config_files import read_config
from texvent.settings.resolution import resolve, unmeasured_sensor
from texvent.view.render import RenderConfig
from texvent_scenes.rig.config import RigConfig


def test_a_video_keeps_its_size_and_a_scene_is_davis346():
    assert resolve("simulate", {}).size is None
    assert resolve("generate", {}).size == (346, 260)
    assert resolve("generate", {}).interpolate.interpolate == "motion"


@pytest.mark.parametrize(
    ("command", "beside"), [("generate", None), ("simulate", None), ("simulate", True)]
)
def test_the_interpolation_that_a_model_was_made_for_goes_before_others_wishes(
    held_back, monkeypatch, command, beside
):
    monkeypatch.setattr(HeldBack, "default_interpolate", "blend", raising=False)
    for options, expected in ({}, "blend"), ({"interpolate": "none"}, "none"):
        options = {"simulator": held_back, **options}
        found = resolve(command, options, motion_beside=beside).interpolate.interpolate
        assert found == expected


def test_a_sensor_with_measured_constants_chooses_its_preset():
    settings = resolve("simulate", {"simulator": "physical", "sensor": "davis346"})
    assert settings.run.preset == "davis346"
    assert settings.simulate.balance == 20.0
    family = resolve("simulate", {"simulator": "voltmeter", "sensor": "davis240c"})
    assert family.run.preset == "davis240"
    named = resolve(
        "simulate", {"simulator": "physical", "sensor": "davis346", "preset": "default"}
    )
    assert named.run.preset == "default"


@pytest.mark.parametrize(
    ("sensor", "name"),
    [((64, 48), "64x48"), (SensorSize(64, 48), "64x48"), (SENSORS["dvs128"], "dvs128")],
)
def test_a_sensor_may_be_given_as_numbers_or_as_an_object(sensor, name):
    assert resolve("simulate", {"sensor": sensor}).run.sensor == name


@pytest.mark.parametrize("sensor", SENSORS)
def test_the_fill_factor_of_a_sensor_scales_the_noise_of_texvent_alone(sensor):
    scale = 0.22 / (SENSORS[sensor].fill_factor or 0.22)
    for preset in ("accurate", "paper"):
        options = {"sensor": sensor.upper(), "preset": preset}
        assert resolve("simulate", options).simulate.noise_scale == pytest.approx(scale, abs=5e-4)
        assert resolve("simulate", {**options, "noise_scale": 3.0}).simulate.noise_scale == 3.0
        assert resolve("simulate", {**options, "noise_rate_hz": 0.5}).simulate.noise_scale == 1.0
    physical = resolve("simulate", {"sensor": sensor, "simulator": "physical"})
    assert physical.simulate == SIMULATORS.load("physical").presets[physical.run.preset]


def test_a_sensor_without_measured_constants_is_said_to_have_none():
    with_constants = resolve("simulate", {"simulator": "voltmeter", "sensor": "davis346"})
    assert unmeasured_sensor(with_constants.run) is None
    with_some = resolve("simulate", {"simulator": "physical", "sensor": "IMX636"})
    assert "of evk4, contrast_threshold, " in unmeasured_sensor(with_some.run)
    without_them = {"simulator": "physical", "sensor": "evk4", "preset": "default"}
    assert unmeasured_sensor(resolve("simulate", without_them).run) is None
    without = resolve("simulate", {"simulator": "physical", "sensor": "gen4-hd"})
    assert "gen4-hd sets the size only" in unmeasured_sensor(without.run)
    assert unmeasured_sensor(resolve("simulate", {"sensor": "gen4-hd"}).run) is None


@pytest.mark.parametrize(
    ("sensor", "size", "preset"),
    [
        ("evk4", (1280, 720), "evk4"),
        ("IMX636", (1280, 720), "evk4"),
        ("genx320", (320, 320), "genx320"),
        ("gen3", (640, 480), "gen3.1"),
        ("dvxplorer", (640, 480), "dvxplorer"),
        ("davis240", (240, 180), "davis240c"),
    ],
)
def test_a_camera_chooses_size_and_preset_by_any_of_its_names(sensor, size, preset):
    settings = resolve("simulate", {"simulator": "physical", "sensor": sensor})
    assert settings.size == size
    assert settings.run.preset == preset


def test_settings_written_and_read_back_are_the_same(tmp_path):
    settings = resolve("generate", {"fps": "30000/1001", "simulator": "esim", "seed": 4})
    path = tmp_path / "run.toml"
    assert "device" not in settings.as_tables()["run"]  # it decides no event
    path.write_text(tomli_w.dumps(settings.as_tables()), encoding="utf-8")
    assert resolve("generate", {}, config=path) == settings


def test_a_generator_is_refused_where_frames_are_given():
    with pytest.raises(ConfigError, match="generator is set"):
        resolve("simulate", {"generator": "procedural"})


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("a.toml", "seed = = 3", "not valid"),
        ("a.yaml", "seed: [", "not valid"),
        ("a.json", "{}", "must end in .toml"),
        ("a.yaml", "- 3", "options by name"),
        ("a.toml", "seed = 1\n[run]\nseed = 2", "sets 'seed' twice"),
        ("a.yaml", "fixed-count: 1\nfixed_count: 2", "sets 'fixed_count' twice"),
        ("a.toml", "[simulat]\nnoise = 'none'", "unknown table 'simulat'.*did you mean 'simulate'"),
    ],
)
def test_a_broken_config_file_is_one_clear_error(tmp_path, name, text, message):
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ConfigError, match=message):
        read_config(path)


def test_a_sensor_that_is_one_number_is_told_what_a_sensor_can_be():
    with pytest.raises(ConfigError, match=r"sensor is 32; it must be a name.*\(width, height\)"):
        resolve("generate", {"sensor": 32})


CONFIGS = {
    **{name: next(iter(SIMULATORS.load(name).presets.values())) for name in SIMULATORS.builtin},
    **{type(one).__name__: one for one in (CaptureConfig(), InterpolateConfig())},
    **{type(one).__name__: one for one in (RigConfig(), RenderConfig())},
    **{type(one).__name__: one for one in (PromptOptions(), CalibrateOptions())},
}
RULES = [
    (owner, name, *rule)
    for owner, config in CONFIGS.items()
    for name, rule in getattr(config, "idle_with", {}).items()
]
OTHERS = {"fit": "stretch", "noise_curve": "1:9 9:9"}
NOT_OF_RUNS = ("RigConfig", "RenderConfig", "PromptOptions", "CalibrateOptions")


@pytest.mark.parametrize(("owner", "name", "decider", "values"), RULES)
def test_an_option_that_another_one_switches_off_is_said(tmp_path, owner, name, decider, values):
    config = CONFIGS[owner]
    if owner in NOT_OF_RUNS or name in ("interpolator_weights", "rife_flow"):
        config = Namespace(idle_with=config.idle_with, **{name: "another"})
        for value in values:
            set_to = Path(f"o{value}") if str(value).startswith(".") else value
            with pytest.warns(TexventWarning, match=f"{name} has no effect: {decider} is"):
                warn_of_idle([Namespace(**{decider: set_to}), config], [name])
        warn_of_idle([Namespace(**{decider: Path("o.else")}), config], [name])
        return
    default = getattr(config, name)
    other = default / 2 if isinstance(default, float) else OTHERS.get(name, 7)
    simulator = owner if owner in SIMULATORS.names() else "texvent"
    clip = np.random.default_rng(0).integers(0, 255, (3, 6, 8), np.uint8)
    for value in values:
        options = {"fps": 50, decider: value, "simulator": simulator}
        with pytest.warns(TexventWarning, match=f"{name} has no effect: {decider} is"):
            idle = texvent.simulate(clip, **options, **{name: other})
        assert idle.equals(texvent.simulate(clip, **options)), "it has an effect"
        texvent.simulate(clip, **options, **{name: default})  # without a warning


def test_a_file_of_all_options_names_none_that_is_switched_off(tmp_path):
    settings = resolve("simulate", {"noise": "none"})
    path = tmp_path / "run.toml"
    path.write_text(tomli_w.dumps(settings.as_tables()), encoding="utf-8")
    assert resolve("simulate", {}, config=path) == settings


@pytest.mark.parametrize(("name", "text"), [("c.toml", "seed = 3"), ("c.yaml", "seed: 3")])
def test_a_mark_of_the_byte_order_is_no_part_of_a_config_file(tmp_path, name, text):
    path = tmp_path / name
    path.write_text(text, encoding="utf-8-sig")
    assert read_config(path) == {"seed": 3}


@pytest.mark.parametrize("part", ["simulator", "preset", "generator"])
@pytest.mark.parametrize("value", [False, "", 0])
def test_a_name_that_is_none_is_no_default(part, value):
    with pytest.raises(ConfigError):
        resolve("generate", {part: value})
