"""Transfer functions: hand-computed values, published points, round trips."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.transfer import (
    DECODERS,
    decode_half,
    decode_hlg,
    decode_pq,
    decode_srgb,
    encode_half,
    encode_srgb,
)


def test_srgb_is_iec_61966_2_1_and_goes_on_above_white():
    # 0.5 is coded as 187.5 of 255, 0.001 as 3.3 on the line, 4 by the same power.
    coded = encode_srgb(np.array([0.0, 0.001, 0.5, 1.0, 4.0, -0.2]))
    assert coded == pytest.approx([0.0, 3.2946, 187.516, 255.0, 465.323, 0.0], abs=0.01)
    # ((0.5 + 0.055) / 1.055)^2.4 = 0.21404; 0.04 / 12.92 = 0.003096.
    assert decode_srgb(np.array([0.04, 0.5, 1.0])) == pytest.approx(
        [0.003096, 0.21404, 1], abs=1e-5
    )


@given(st.floats(0, 1e4))
def test_srgb_is_undone(light):
    assert float(decode_srgb(encode_srgb(np.array(light)) / 255.0)) == pytest.approx(
        light, rel=1e-5, abs=1e-7
    )


def pq_signal(light):
    """BT.2100 table 4, the inverse of the EOTF, as it is printed there."""
    m1, m2 = 2610 / 2**14, 2523 / 2**12 * 2**7
    c1, c2, c3 = 3424 / 2**12, 2413 / 2**12 * 2**5, 2392 / 2**12 * 2**5
    power = (light / 10_000) ** m1
    return ((c1 + c2 * power) / (1 + c3 * power)) ** m2


def hlg_signal(light):
    """BT.2100 table 5, the OETF, as it is printed there."""
    a = 0.17883277
    b, c = 1 - 4 * a, 0.5 - a * math.log(4 * a)
    return math.sqrt(3 * light) if light <= 1 / 12 else a * math.log(12 * light - b) + c


def test_pq_at_published_points():
    # BT.2408 table 1: 58 % of the signal is 203 cd/m², 75 % are 983 cd/m²; 0.508 is 100 cd/m².
    light = decode_pq(np.array([0.0, 0.508078, 0.58069, 0.7518, 1.0, 1.2]))
    assert light == pytest.approx([0, 100, 203, 1000, 10_000, 10_000], rel=1e-3, abs=1e-6)


def test_hlg_at_published_points():
    # Both halves meet at 1/12; signal 0.75 is the light (e^((0.75 - c) / a) + b) / 12 = 0.2650.
    light = decode_hlg(np.array([0.0, 0.25, 0.5, 0.75, 1.0]))
    assert light == pytest.approx([0, 0.0625 / 3, 1 / 12, 0.26496, 1], abs=1e-5)


@given(st.floats(1e-3, 10_000))
def test_pq_undoes_the_printed_inverse(light):
    assert float(decode_pq(np.array(pq_signal(light)))) == pytest.approx(light, rel=1e-5)


@given(st.floats(0, 1))
def test_hlg_undoes_the_printed_oetf(light):
    assert float(decode_hlg(np.array(hlg_signal(light)))) == pytest.approx(
        light, rel=1e-5, abs=1e-7
    )


@pytest.mark.parametrize("coding", DECODERS)
def test_more_signal_is_more_light(coding):
    decode, white = DECODERS[coding]
    light = decode(np.linspace(0, 1, 1024))
    assert np.isfinite(light).all()
    assert np.all(np.diff(light) >= 0)
    assert 0 < white <= light[-1]


@pytest.mark.parametrize("decode", [decode_srgb, decode_pq, decode_hlg])
def test_nan_stays(decode):
    assert np.isnan(decode(np.array(np.nan)))


@given(st.floats(0, 60_000))
def test_half_floats_keep_light_to_a_2048th(light):
    level = encode_half(np.array(light)).item()
    assert float(decode_half(np.array(level / 65_535))) == pytest.approx(
        light, rel=1 / 2048, abs=6e-8
    )
