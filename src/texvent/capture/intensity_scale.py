"""Pixel values → the 0..255 intensity scale, when their own type does not say the scale."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError, shown, warn
from texvent.options.arrays import as_array
from texvent.video import UINT16_PER_LEVEL, PixelArray

FULL_SCALE = 255.0
"""Intensity of white."""
GIVE_WHITE = (
    "Give white_level=1 if 1 means white, or white_level=255 if the images really are that dark"
)
FEW = 0.01
"""Share of pixels that highlights and the overshoot of resized images take up at most."""
OVERSHOOT = 1.25
"""The highest that resizing makes of white in 0..1."""
DIMMEST = 16.0
"""Levels of 255 that a video exceeds somewhere, unless it is nearly black."""
DARK_FRAMES = 3
"""Frames of whole levels, not black, after which a stream that goes on so dark is warned of."""
WHITES = (1023, 4095, 65535)
"""White of 10, 12 and 16 bits."""


def scale_to_levels(pixels: PixelArray, white_level: float) -> NDArray[np.float32]:
    """Intensity on the 0..255 scale, never rounded to whole levels.

    Args:
        pixels: [H, W] or [H, W, 3], any type of `Frame.pixels`.
        white_level: the value in `pixels` that means white.

    Returns:
        The same shape, float32: `pixels · 255 / white_level`.
    """
    return np.asarray(pixels * np.float32(FULL_SCALE / white_level), dtype=np.float32)


def float_levels(pixels: PixelArray) -> NDArray[np.float32]:
    """Pixels as float32 on the 0..255 scale; uint16 is full scale (65535 is white).

    Args:
        pixels: [H, W] or [H, W, 3], any type of `Frame.pixels`.
    """
    if pixels.dtype == np.uint16:
        return scale_to_levels(pixels, FULL_SCALE * UINT16_PER_LEVEL)
    return np.asarray(pixels, dtype=np.float32)


def usable_pixels(pixels: NDArray[Any], where: str) -> PixelArray:
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
    raise InputError(
        f"{where} has pixels of type {pixels.dtype}; allowed: uint8 (0..255), uint16 (0..65535), "
        "float (0..255 unless white_level says otherwise), bool. Convert with "
        ".astype(np.uint8) or .astype(np.uint16)"
    )


def caller_pixels(image: Any, where: str) -> PixelArray:
    """An image of a caller: an array, a tensor, nested lists, or an image of Pillow.

    Args:
        image: [H, W], [H, W, 1] or [H, W, 3]; of Pillow, any mode that means light.
        where: what to call it in messages.

    Returns:
        [H, W] or [H, W, 3], as `usable_pixels`; a view of the caller's where that is possible.

    Raises:
        InputError: another shape, type or mode, or masked values.
    """
    if image is None:
        raise InputError(f"{where} is None, no frame; did the reader fail or end?")
    if isinstance(image, (str, bytes, Path)):
        raise InputError(
            f"{where} is the name {shown(image)}; a list holds images, not their names: give the "
            "folder of the files, or open them one by one"
        )
    pixels = usable_pixels(as_array(image, where), where)
    if pixels.ndim == 3 and pixels.shape[-1] == 1:
        pixels = pixels[..., 0]
    if not (pixels.ndim == 2 or (pixels.ndim == 3 and pixels.shape[-1] == 3)) or 0 in pixels.shape:
        raise InputError(f"{where} must be [H, W] or [H, W, 3]; got shape {list(pixels.shape)}")
    return pixels


class ScaleCheck:
    """Evidence of the scale of pixels, gathered frame by frame until it is clear.

    Floats that hardly exceed 1 are most likely 0..1, where texvent's are 0..255; uint16 up to 1023
    or 4095 has 10 or 12 bits; levels 0 and 1 of uint8 are masks. All of them would be nearly black.
    Floats far above 255 would be nearly white.

    Args:
        advice: said of floats of 0..1.
    """

    def __init__(self, advice: str = GIVE_WHITE) -> None:
        self._advice = advice
        self._settled: set[np.dtype[Any]] = set()
        self._begin(np.dtype(object))  # of no frame

    def _begin(self, dtype: np.dtype[Any]) -> None:
        self._dtype = dtype
        self._lowest = self._highest = 0.0
        self._frames = self._pixels = self._above_1 = self._above_white = 0
        self._is_whole = True

    def look(self, pixels: PixelArray) -> bool:
        """Take a frame into account; whether the scale is clear, or was concluded before."""
        if pixels.dtype in self._settled:
            return True
        if pixels.dtype != self._dtype:
            self._begin(pixels.dtype)
        self._lowest = min(self._lowest, float(pixels.min()))
        highest = float(pixels.max())
        self._highest = max(self._highest, highest)
        self._frames += highest > 0
        if pixels.dtype.kind == "f":
            self._pixels += pixels.size
            self._above_1 += int(np.count_nonzero(pixels > 1))
            self._above_white += int(np.count_nonzero(pixels > FULL_SCALE))
            self._is_whole = self._is_whole and bool((np.rint(pixels) == pixels).all())
        if not np.isfinite(highest) or self._doubt() is None:  # NaN is refused elsewhere
            self._settled.add(pixels.dtype)
        return pixels.dtype in self._settled

    def look_at_stream(self, pixels: PixelArray, where: str) -> None:
        """The same, and `conclude` as soon as later frames of a stream cannot be waited for.

        Events of floats would be gone before a brighter frame comes; whole levels may fade in.
        """
        if not self.look(pixels) and (
            (pixels.dtype.kind == "f" and self._frames)
            or (pixels.dtype == np.uint16 and self._highest > FULL_SCALE)
            or self._frames >= DARK_FRAMES
        ):
            self.conclude(where)

    def conclude(self, where: str) -> None:
        """Say what the frames so far leave in doubt; nothing more is said of this type.

        Args:
            where: what to call them in messages.

        Raises:
            InputError: they are most likely 0..1, or -1..1.

        Warns:
            TexventWarning: they probably have another white than their type says.
        """
        if self._dtype in self._settled or not self._frames:
            return
        self._settled.add(self._dtype)
        match self._doubt():
            case (True, doubt):
                raise InputError(f"{where} holds {doubt}")
            case (False, doubt):
                warn(f"{where} holds {doubt}")

    def _doubt(self) -> tuple[bool, str] | None:
        """Whether the pixels so far are refused, and why, with the option that helps.

        Returns:
            None where nothing is doubtful.
        """
        if self._dtype.kind != "f":
            doubt = self._doubt_of_bits()
            return None if doubt is None else (False, doubt)
        highest = self._highest
        if highest <= 1 and self._lowest < -0.5:
            return True, (
                f"floats from {self._lowest:g} to {highest:g}, so they are probably -1..1, while "
                "texvent's intensities are 0..255. Give (frames + 1) / 2 and white_level=1"
            )
        is_few = self._above_1 <= FEW * self._pixels
        if highest <= OVERSHOOT or (not self._is_whole and (is_few or highest <= DIMMEST)):
            is_sure = highest <= OVERSHOOT or (is_few and not DIMMEST < highest <= FULL_SCALE)
            share = f", of which a share of {self._above_1 / self._pixels:.3g} exceeds 1"
            return is_sure, (
                f"floats that never exceed {highest:g}{share if highest > 1 else ''}, so they "
                f"{'are probably 0..1' if is_sure else 'may be 0..1 with highlights'}, while "
                f"texvent's intensities are 0..255. {self._advice}"
            )
        overexposed = self._pixels * (0.5 if highest <= WHITES[0] else 0.1)
        if highest > FULL_SCALE and (self._is_whole or self._above_white > overexposed):
            white = next((one for one in WHITES if highest <= one), highest)
            return False, (
                f"floats up to {highest:g}, while texvent's are 0..255. Give white_level={white:g} "
                "if that is white, or white_level=255 if they really are brighter than white"
            )
        return None

    def _doubt_of_bits(self) -> str | None:
        """The same of whole levels."""
        if self._dtype == np.uint8 and self._highest <= 1:
            return (
                "no level above 1 of 255, so it is probably a mask; give white_level=1, or "
                "white_level=255 if it really is that dark"
            )
        bits = next((bits for bits in (8, 10, 12) if self._highest < 1 << bits), None)
        if self._dtype != np.uint16 or bits is None:
            return None
        return (
            f"16-bit frames up to {self._highest:g}, so they probably have {bits} bits; give "
            f"white_level={(1 << bits) - 1}, or white_level=65535 if they really are that dark"
        )


def check_whole_scale(frames: Iterable[PixelArray], where: str) -> ScaleCheck:
    """Look at frames that can be read again until their scale is clear, which the first usually is.

    Returns:
        The check, which has nothing more to say of frames of this type.

    Raises:
        InputError: as `ScaleCheck.conclude`, which also warns.
    """
    scale = ScaleCheck()
    if not any(map(scale.look, frames)):
        scale.conclude(where)
    return scale
