"""Times of every type and unit, in µs."""

import math
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from texvent.errors import FileFormatError
from texvent.io.reading import PER_SECOND, TimeUnit, are_times, to_microseconds

VALUES: dict[str, list[Any]] = {
    kind: values
    for kinds, values in {
        "i1 u1": [0, 1, 127],
        "i2 i4 >i4 i8": [-1501, -1, 0, 999, 1500],
        "u2 u4 >u8": [0, 999, 1500],
        "f2 f4": [-1.5, 0.0, 0.25, 3.0],
        "f8 >f8": [-1501.25, 0.0, 0.1234567, 2.0**30 + 0.5],
    }.items()
    for kind in kinds.split()
}
STRAY = {
    "f": [math.nan, math.inf, -math.inf, 1e19],
    "u": [2**64 - 1, 2**63],
    "i": [-(2**63)],
    "M": ["NaT"],
}
"""What is no time, by the kind of type."""


@pytest.mark.parametrize("unit", PER_SECOND)
@pytest.mark.parametrize("kind", VALUES)
def test_times_are_whole_us_whatever_their_type(kind: str, unit: TimeUnit) -> None:
    times = np.array(VALUES[kind], kind)
    exact = [Fraction(one) * 10**6 / PER_SECOND[unit] for one in times.tolist()]
    expected = [round(one) if times.dtype.kind == "f" else math.floor(one) for one in exact]
    assert to_microseconds(Path("it"), times, unit).tolist() == expected
    assert are_times(times, unit).all()


@pytest.mark.parametrize("unit", PER_SECOND)
@pytest.mark.parametrize("kind", ["f4", "f8", "u8", "i8", "M8[ms]", "m8[ms]"])
def test_one_value_that_is_no_time_is_refused_among_others(kind: str, unit: TimeUnit) -> None:
    for stray in STRAY["M" if kind[0] == "m" else kind[0]]:
        for place in range(3):
            times = np.arange(3).astype(kind)
            times[place] = stray
            assert are_times(times, unit).tolist() == [one != place for one in range(3)]
            with pytest.raises(FileFormatError, match=r"(are no numbers|beyond)"):
                to_microseconds(Path("it"), times, unit)


@pytest.mark.parametrize("unit", PER_SECOND)
def test_whole_times_reach_as_far_as_64_bits(unit: TimeUnit) -> None:
    last = (2**63 - 1) * PER_SECOND[unit] // 10**6 if PER_SECOND[unit] < 10**6 else 2**63 - 1
    times = np.array([-last, last])
    expected = [one * 10**6 // PER_SECOND[unit] for one in times.tolist()]
    assert to_microseconds(Path("it"), times, unit).tolist() == expected
    if last < 2**63 - 1:
        for beyond in (-last - 1, last + 1):
            with pytest.raises(FileFormatError, match=rf"beyond 2\^63 µs, as numbers of {unit}"):
                to_microseconds(Path("it"), np.array([0, beyond]), unit)


@pytest.mark.parametrize("scale", ["s", "ms", "us", "ns"])
@pytest.mark.parametrize("kind", ["M8", "m8"])
def test_dates_and_spans_have_a_unit_of_their_own(kind: str, scale: TimeUnit) -> None:
    times = np.array([-1501, 0, 1500]).astype(f"{kind}[{scale}]")
    expected = [one * 10**6 // PER_SECOND[scale] for one in (-1501, 0, 1500)]
    assert all(to_microseconds(Path("it"), times, one).tolist() == expected for one in PER_SECOND)


@pytest.mark.parametrize("times", [np.array(["1"]), np.array([1j]), np.array([None])])
def test_what_is_no_number_is_no_time(times: Any) -> None:
    assert not are_times(times, "s").any()
    with pytest.raises(FileFormatError, match="no numbers"):
        to_microseconds(Path("it"), times, "s")
