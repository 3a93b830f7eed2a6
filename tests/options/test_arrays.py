"""Arrays, numbers and times as callers give them: each is taken as it is meant, or refused."""

import datetime
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest

from texvent.errors import ConfigError, InputError
from texvent.options.arrays import as_array, usable_pixels, whole_numbers, whole_us
from texvent.options.values import convert

LEVELS = np.arange(12).reshape(3, 4)


class Convertible:
    """What xarray, dask and TensorFlow have."""

    def __array__(self, dtype=None, copy=None):
        return LEVELS


class Exported:
    """What JAX and CuPy have."""

    def __dlpack__(self, **options):
        return LEVELS.__dlpack__()

    def __dlpack_device__(self):
        return LEVELS.__dlpack_device__()


@pytest.mark.parametrize(
    "given",
    [
        LEVELS.tolist(),
        LEVELS.astype(">u2"),
        np.asfortranarray(LEVELS),
        LEVELS[::-1, ::-1][::-1, ::-1],
        np.ma.masked_array(LEVELS),
        Convertible(),
        Exported(),
    ],
    ids=lambda one: type(one).__name__,
)
def test_whatever_is_an_array_is_read_in_native_byte_order(given):
    array = as_array(given, "it")
    assert type(array) is np.ndarray
    assert array.dtype.isnative
    assert np.array_equal(array, LEVELS)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (np.ma.masked_less(LEVELS, 3), "it has 3 masked"),
        ([1, np.ma.masked], "it has 1 masked"),
        ([np.ma.masked_less(LEVELS, 3), LEVELS], "it has 3 masked"),
        ([[1, 2], [3]], "cannot be read as an array"),
    ],
)
def test_masked_and_ragged_values_are_refused(given, words):
    with pytest.raises(InputError, match=words):
        as_array(given, "it")


@pytest.mark.parametrize("kind", [int, float, Fraction, Decimal, np.int16, np.float32, np.array])
def test_a_whole_number_of_any_type_is_a_time(kind):
    found = whole_us(kind(2000), "t_us")
    assert (found, type(found)) == (2000, int)


@pytest.mark.parametrize(
    "given",
    [
        *(1.5, float("nan"), float("inf"), 1j, True, None, "2000", b"1", [1], np.array([1])),
        *(np.float32(2**24 + 2), np.bool_(True), np.ma.masked, datetime.datetime(2026, 1, 1)),
        *(np.datetime64("2026"), np.timedelta64(3, "us"), Fraction(1, 3), Decimal("0.1")),
    ],
    ids=repr,
)
def test_what_is_no_whole_time_is_refused_by_its_name(given):
    with pytest.raises(InputError, match=r"t_us .*(whole microseconds|1 masked|dates)"):
        whole_us(given, "t_us")


@pytest.mark.parametrize("kind", ["M8[us]", "m8[ns]", "m8[s]"])
def test_dates_and_spans_are_named_as_such(kind):
    with pytest.raises(InputError, match=r"holds dates or spans \(.*timedelta64\[us\]"):
        whole_numbers(np.arange(3).astype(kind), "t_us")


@pytest.mark.parametrize("kind", [np.int8, np.int16, np.int64])
def test_negative_pixels_are_named_as_such(kind):
    with pytest.raises(InputError, match=r"pixels from -3 to 2 .*not negative"):
        usable_pixels(np.arange(-3, 3, dtype=kind), "frame 0")


@pytest.mark.parametrize(
    "given", [[0.5], [np.nan], np.float32([2**24]), np.uint64([2**63]), ["1"], [None], [10**30]]
)
def test_columns_are_whole_and_exact(given):
    with pytest.raises(InputError, match="t must hold integers"):
        whole_numbers(given, "t")


@pytest.mark.parametrize("kind", [float, np.float16, np.float32, np.longdouble, Decimal, np.array])
def test_narrow_floats_mean_the_decimal_number_that_they_print(kind):
    number = kind("29.97") if kind is not np.array else np.array(29.97, np.float32)
    assert convert(number, float, "it") == 29.97
    assert convert(number, Fraction, "it") == Fraction(2997, 100)


@pytest.mark.parametrize(
    ("given", "hint", "value"),
    [(np.uint8(3), int, 3), (np.bool_(True), bool, True), (np.str_("a"), str, "a")],
)
def test_options_take_numpys_scalars(given, hint, value):
    found = convert(given, hint, "it")
    assert (found, type(found)) == (value, hint)


@pytest.mark.parametrize(
    "given", [np.ma.masked, np.timedelta64(3, "s"), np.datetime64("2026"), np.array([3]), 3j]
)
def test_options_refuse_what_only_looks_like_a_number(given):
    with pytest.raises(ConfigError, match="it is "):
        convert(given, Fraction, "it")


@pytest.mark.torch
def test_tensors_of_narrow_floats_and_with_gradients_are_read():
    torch = pytest.importorskip("torch")
    levels = torch.from_numpy(LEVELS).float()
    for tensor in (levels.bfloat16(), levels.half(), levels.requires_grad_()):
        array = as_array(tensor, "it")
        assert array.dtype == np.float32
        assert np.array_equal(array, LEVELS)
    assert whole_us(torch.tensor(2000), "t_us") == whole_us(torch.tensor(2000.0), "t_us") == 2000
    assert convert(torch.tensor(29.97), float, "it") == 29.97
    with pytest.raises(InputError, match="to_dense"):
        as_array(levels.detach().to_sparse(), "it")
