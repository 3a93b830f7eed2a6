import math

import numpy as np
import pytest

from texvent.errors import ConfigError
from texvent.simulate.physical.config import DAVIS346_NOISE, parse_noise_curve


def test_points_are_met_exactly_and_joined_by_exponentials():
    curve = parse_noise_curve("2:0.5 20:0.1,60:0.004")
    assert curve.rate_at(np.array([2.0, 20.0, 60.0])) == pytest.approx([0.5, 0.1, 0.004])
    assert curve.rate_at(np.array([11.0])) == pytest.approx([math.sqrt(0.5 * 0.1)])


def test_the_rate_is_constant_outside_the_points():
    curve = parse_noise_curve("2:0.5 60:0.004")
    assert curve.rate_at(np.array([[0.0, 255.0]])) == pytest.approx(np.array([[0.5, 0.004]]))


def test_a_curve_reads_back_what_it_writes():
    curve = parse_noise_curve(DAVIS346_NOISE)
    again = parse_noise_curve(str(curve))
    assert np.array_equal(curve.levels, again.levels)
    assert np.array_equal(curve.rates_hz, again.rates_hz)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "LEVEL:RATE"),
        ("dark", "LEVEL:RATE"),
        ("1:2:3", "LEVEL:RATE"),
        ("1:0.5 0.3", "LEVEL:RATE"),
        ("5:0.1 5:0.2", "increase"),
        ("-1:0.1", "increase"),
        ("5:0.1 300:0.2", "increase"),
        ("5:0", "above 0"),
        ("5:nan", "above 0"),
        ("nan:1", "increase"),
    ],
)
def test_other_texts_fail_and_say_what_is_wanted(text, message):
    with pytest.raises(ConfigError, match=message):
        parse_noise_curve(text)
