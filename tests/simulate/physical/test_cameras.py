"""Cameras: every constant has a source or says that it has none; biases by hand."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from texvent.simulate.physical.cameras.biases import NAMES, UNMAPPED, bias_effect
from texvent.simulate.physical.cameras.davis import COARSE_PA, parse_current, threshold

from texvent.errors import ConfigError
from texvent.sensor import SENSORS
from texvent.simulate.physical.cameras import CAMERAS, NOT_OF_A_CAMERA, PRESETS, camera_table
from texvent.simulate.physical.config import PhysicalConfig

from .camera_tables import PAGE, tables


@pytest.mark.parametrize("name", CAMERAS)
def test_every_constant_of_a_camera_has_a_source_or_is_unmeasured(name: str) -> None:
    table = {one.option: one for one in camera_table(name)}
    fields = {field.name for field in dataclasses.fields(PhysicalConfig)}
    assert set(table) | set(NOT_OF_A_CAMERA) == fields
    for option, constant in table.items():
        assert getattr(PRESETS[name], option) == constant.value
        if constant.basis == "unmeasured":
            assert constant.value == getattr(PhysicalConfig(), option)
        else:
            assert len(constant.reference) > 20
    # Whatever the preset changes is in the table, so nothing has slipped in beside it.
    changed = {
        one for one in fields if getattr(PRESETS[name], one) != getattr(PhysicalConfig(), one)
    }
    assert changed - {"bias_camera"} <= {one.option for one in CAMERAS[name].constants}


def test_every_camera_is_a_sensor_of_that_name_with_biases() -> None:
    for name, camera in CAMERAS.items():
        assert SENSORS[name].description.split()[0] in camera.description
        assert PRESETS[name].bias_camera == camera.biases
        assert camera.biases in NAMES


def test_the_tables_of_the_page_are_those_of_the_code() -> None:
    page = Path(PAGE).read_text(encoding="utf-8")
    for name, table in tables().items():
        assert table in page, (
            f"{name} changed; run: python -m tests.simulate.physical.camera_tables"
        )


def with_bias(camera: str, bias: str, **options: object) -> PhysicalConfig:
    return dataclasses.replace(PRESETS[camera], bias=bias, **options)


def test_thresholds_of_gen31_are_proportional_to_differences_of_voltages() -> None:
    usual = PRESETS["gen3.1"].contrast_threshold
    plain = with_bias("gen3.1", "diff_on=384,diff=299,bias_diff_off=221")
    assert plain.contrast_threshold_on == plain.contrast_threshold_off == usual
    # 469 - 299 is twice 384 - 299; 299 - 182 is 1.5 times 299 - 221.
    biased = with_bias("gen3.1", "diff_on=469,diff_off=182")
    assert biased.contrast_threshold_on == pytest.approx(2 * usual)
    assert biased.contrast_threshold_off == pytest.approx(1.5 * usual)
    # The option is the threshold at the default biases, so it may be fitted.
    fitted = with_bias("gen3.1", "diff_on=469", contrast_threshold=0.35)
    assert fitted.contrast_threshold_on == pytest.approx(0.7)
    assert fitted.contrast_threshold_off == pytest.approx(0.35)


def test_thresholds_of_a_davis_follow_from_ratios_of_currents() -> None:
    # libcaer: 4/39 is 48437 * 39 / 255 = 7408 pA, 5/255 is 387500 pA, 3/255 is 6054 pA.
    biased = with_bias("davis346", "diff=4/39,on=5/255,off=1nA")
    assert biased.contrast_threshold_on == pytest.approx(math.log(387_500 / 7408.01) / 14)
    assert biased.contrast_threshold_off == pytest.approx(math.log(7408.01 / 1000) / 14)
    assert biased.refractory_us == PhysicalConfig().refractory_period_us


def test_a_davis_rests_for_its_charge_over_its_current() -> None:
    # 20 fF times 0.8 V over 50 pA.
    assert with_bias("davis240c", "refr=50pA").refractory_us == 320
    assert with_bias("davis240c", "refr=0.05nA").refractory_us == 320


@pytest.mark.parametrize(
    ("options", "name"),
    [
        ({"contrast_threshold": 0.25}, "contrast_threshold"),
        ({"on_off_ratio": 1.2}, "on_off_ratio"),
        ({"refractory_period_us": 500}, "refractory_period_us"),
    ],
)
def test_an_option_that_a_bias_sets_too_is_refused(options: dict, name: str) -> None:
    with pytest.raises(ConfigError, match=rf"{name} is .* sets it too; leave one of them out"):
        with_bias("davis346", "diff=4/39,on=5/255,off=4/1,refr=4/25", **options)


@pytest.mark.parametrize(
    ("camera", "text", "message"),
    [
        ("evk4", "diff_on=20", "diff_on of imx636 is 20, but what it does is not published"),
        ("evk4", "diff_on=200", r"diff_on of imx636 is '200'; it must be a whole number, -85..140"),
        ("evk4", "refr=30", "give refractory_period_us, which"),
        ("evk4", "hpf=30", "give residual_decay_hz"),
        ("evk4", "gain=1", "imx636 has no bias 'gain'; allowed: diff_on, diff_off"),
        ("evk4", "fo=x", "it must be a whole number, -35..55"),
        ("evk4", "fo", "write NAME=VALUE"),
        ("evk4", "fo=0,fo=0", "give fo once"),
        ("genx320", "fo=35", "default, 34, and give cutoff_hz"),
        ("gen3.1", "diff_on=373", "it must be at least 374, diff . 75"),
        ("gen3.1", "diff_off=235", "it must be at most 234, diff - 65"),
        ("gen3.1", "pr=1300", "default, 1250"),
        ("dvxplorer", "on=18", r"0..17"),
        ("davis346", "on=5/255", "diff, on and off together; only on is given"),
        ("davis346", "sf=1/16", "a bandwidth that does not depend on light"),
        ("davis346", "off=4/0", r"COARSE/FINE, 0/1..7/255"),
        ("davis346", "off=30uA", r"1pA..24.8uA"),
        ("davis346", "diff=4/39,on=4/30,off=4/1", "it must be at least 0.01"),
        ("default", "on=1", "biases belong to a camera"),
    ],
)
def test_a_wrong_bias_is_one_clear_line(camera: str, text: str, message: str) -> None:
    with pytest.raises(ConfigError, match=message) as caught:
        with_bias(camera, text)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("camera", UNMAPPED)
def test_default_biases_change_nothing(camera: str) -> None:
    text = ",".join(f"bias_{name}={bias.default}" for name, bias in UNMAPPED[camera].items())
    assert bias_effect(camera, text) == bias_effect(camera, text.split(",")[0])
    assert set(bias_effect(camera, text)) == {None, 1.0}


@given(st.integers(0, 7), st.integers(1, 255))
def test_a_current_is_its_share_of_the_coarse_one(coarse: int, fine: int) -> None:
    assert parse_current("davis346", "on", f"{coarse}/{fine}") * 255 == pytest.approx(
        COARSE_PA[coarse] * fine
    )


@given(st.floats(1, 1e6), st.floats(1.2, 1e4), st.floats(1.2, 1e4))
def test_thresholds_of_two_ratios_add_up(current: float, first: float, second: float) -> None:
    def of(larger: float, smaller: float) -> float:
        return threshold("davis346", ("on", larger), ("diff", smaller))

    both = of(current * first * second, current)
    assert both == pytest.approx(of(current * first, current) + of(current * second, current))
