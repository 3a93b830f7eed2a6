"""Arrays, numbers and times as callers give them → NumPy's arrays and Python's numbers.

Frames, frame times and columns of events come as NumPy arrays, lists, tensors of any device, or
whatever has `__array__`. Nothing here rounds, and nothing is dropped without a word.
"""

from __future__ import annotations

import contextlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError, one_line, shown

HOW_TO_ROUND = "np.rint(seconds * 1e6).astype(np.int64)"


def is_array_like(values: Any) -> bool:
    """Whether an object says itself that it is an array, unlike a list or a generator."""
    names = ("__array__", "__array_interface__", "__cuda_array_interface__", "__dlpack__")
    return isinstance(values, memoryview) or any(hasattr(values, name) for name in names)


def as_array(values: Any, what: str) -> NDArray[Any]:
    """Values as a plain array of native byte order; a view of the caller's where that is possible.

    Args:
        values: anything array-like, or an image of Pillow. Tensors come from any device; narrow
            floats that NumPy does not have, such as bfloat16, become float32.
        what: how messages call them.

    Raises:
        InputError: some are masked, or they are no array.
    """
    _refuse_masked(values, what)
    try:
        if hasattr(values, "detach"):  # a torch tensor
            values = values.detach().cpu()
            if values.is_floating_point() and values.element_size() < np.float32().nbytes:
                values = values.float()
        elif hasattr(values, "__cuda_array_interface__"):  # CuPy
            values = values.get()
        elif hasattr(values, "getbands"):
            values = _levels_of_pillow(values)
        elif hasattr(values, "__dlpack__") and not hasattr(values, "__array__"):
            values = np.from_dlpack(values)
        array = np.asarray(values)
        if array.dtype.name.startswith(("bfloat16", "float8")):  # of JAX and TensorFlow
            array = array.astype(np.float32)
        return array.astype(array.dtype.newbyteorder("="), copy=False)
    except Exception as error:  # anyone's code turns itself into an array
        raise InputError(
            f"{what} cannot be read as an array ({one_line(error)}); give a NumPy array"
        ) from error


def usable_pixels(pixels: NDArray[Any], where: str) -> NDArray[Any]:
    """Pixels of a type that `Frame` takes, without loss, or a clear refusal.

    Args:
        pixels: [..., H, W] or [..., H, W, 3] of any type.
        where: what to call them in messages.

    Returns:
        uint8, uint16, float32 and float64 as they are; bool as uint8 0 and 255; float16 as
        float32.

    Raises:
        InputError: another type. Wide and signed integers are refused because they may mean
            0..255 or 0..65535, and guessing wrong gives dark frames and hardly any event.
    """
    if pixels.dtype in (np.uint8, np.uint16, np.float32, np.float64):
        return pixels
    if pixels.dtype == np.bool_:
        return pixels.astype(np.uint8) * np.uint8(255)
    if pixels.dtype == np.float16:
        return pixels.astype(np.float32)
    if pixels.dtype.kind == "i" and pixels.size and pixels.min() < 0:
        raise InputError(
            f"{where} has pixels from {pixels.min()} to {pixels.max()} ({pixels.dtype}); "
            "brightness is not negative: shift and scale them to 0..255"
        )
    raise InputError(
        f"{where} has pixels of type {pixels.dtype}; allowed: uint8 (0..255), uint16 (0..65535), "
        "float (0..255 unless white_level says otherwise), bool. Convert with "
        "np.asarray(frames, np.uint8) or np.asarray(frames, np.uint16)"
    )


def _levels_of_pillow(image: Any) -> Any:
    """An image of Pillow as grey, RGB or numbers; palettes by their colours, alpha goes."""
    mode = str(image.mode)
    if mode in ("L", "RGB", "F", "I") or mode.startswith("I;16"):
        return image
    return image.convert("L" if mode in ("1", "LA", "La") else "RGB")


def _refuse_masked(values: Any, what: str) -> None:
    """Refuse values below a mask: they are not meant.

    Raises:
        InputError: there is one.
    """
    parts = values if isinstance(values, (list, tuple)) else (values,)
    masked = sum(int(np.ma.getmaskarray(one).sum()) for one in parts if np.ma.isMA(one))
    if masked:
        raise InputError(
            f"{what} has {masked} masked value(s), which mean nothing here; leave them out, or "
            "fill them: values.filled(0)"
        )


def whole_numbers(values: Any, what: str, meant: str = "integers") -> NDArray[Any]:
    """Values as an array of integers that fit into int64; floats must be whole.

    Args:
        values: array-like.
        what: how messages call them.
        meant: what they must be.

    Raises:
        InputError: a value is not whole, or lies beyond what its type counts one by one; or as
            `as_array`.
    """
    array = as_array(values, what)
    if array.size == 0:
        return array.astype(np.int64)
    kind = array.dtype.kind
    if kind == "f":
        highest = float(2 ** (np.finfo(array.dtype).nmant + 1))
        with np.errstate(invalid="ignore"):
            is_whole = (np.abs(array) < highest) & (np.rint(array) == array)
        if is_whole.all():
            return array.astype(np.int64)
        found = array[~is_whole].flat[0]
        exact = f" ({array.dtype} is exact up to {highest:.0f})" if abs(found) >= highest else ""
        raise InputError(f"{what} must hold {meant}; got {array.dtype}, such as {found}{exact}")
    if kind in "mM":
        way = "(t - t[0]).astype('timedelta64[us]').astype(np.int64) counts from the first"
        raise InputError(f"{what} holds dates or spans ({array.dtype}); {way}")
    if kind not in "iub" or (array.dtype == np.uint64 and array.max() > np.iinfo(np.int64).max):
        raise InputError(f"{what} must hold {meant}; got {array.dtype}")
    return array


def whole_us(value: Any, what: str) -> int:
    """A time as whole µs: an integer, or a whole float, of Python, NumPy or torch.

    Raises:
        InputError: it is something else, such as 1.5, NaN, text, a date, or masked.

    Example:
        >>> whole_us(np.float32(2000), "t_us")
        2000
    """
    meant = "one number of whole microseconds, such as round(seconds * 1_000_000)"
    if hasattr(value, "__array__"):
        array = whole_numbers(value, what, meant)
        if array.ndim == 0 and array.dtype.kind != "b":
            return int(array)
    else:
        with contextlib.suppress(TypeError, ValueError, ArithmeticError):
            if not isinstance(value, (bool, str, bytes)) and int(value) == value:
                return int(value)
    raise InputError(f"{what} is {shown(value)}; it must be {meant}")


def as_number(value: Any) -> Any:
    """A number of NumPy, torch or the like as Python's; anything else as it is.

    A narrow float means the decimal number that it prints: float32's 29.97 is 29.97.

    Raises:
        TypeError: it is masked, or a date or a span of time.

    Example:
        >>> as_number(np.float32(29.97)), as_number(np.array(3, np.uint8))
        (29.97, 3)
    """
    if np.ma.is_masked(value):
        raise TypeError
    if hasattr(value, "detach") or (hasattr(value, "__array__") and not np.ndim(value)):
        array = as_array(value, "a number")
        if array.ndim:
            return value
        value = array[()]
    if not isinstance(value, np.generic):
        return value
    if value.dtype.kind not in "biufU":
        raise TypeError
    is_narrow = isinstance(value, np.floating) and not isinstance(value, np.float64)
    return float(str(value)) if is_narrow else value.item()
