"""Frames in memory: NumPy arrays, anything that converts to one, and iterables of images."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator, Mapping, Sequence, Sized
from typing import Any

from numpy.typing import NDArray

from texvent.capture.frame_source import FrameSource
from texvent.capture.given_times import FrameTimes
from texvent.capture.intensity_scale import caller_pixels, shape_hint
from texvent.errors import InputError, shown, warn
from texvent.frames import Frame, PixelArray
from texvent.io.arrays.npy_file import StoredArray
from texvent.options.arrays import as_array, is_array_like
from texvent.runtime.read_once import ReadOnce
from texvent.sensor import checked_size

ONE_IMAGE = ". One image holds no change; stack at least two"
SLENDER = 8
"""Images are hardly more slender than this, nor fewer than the columns of one."""


class ArrayFrames(FrameSource):
    """Frames from an array [N, H, W] or [N, H, W, 3] (RGB), or from an iterable of images.

    An array or a list can be read again; an iterator (a generator, a camera loop) only once.

    Args:
        frames: uint8, uint16 (65535 is white), float on the 0..255 scale, or bool.
        times: a frame rate, or one time per frame.
        metadata: where they come from.

    Raises:
        InputError: wrong shape or pixel type, no frame, or another number of times than frames.
    """

    def __init__(
        self,
        frames: Iterable[Any],
        times: FrameTimes,
        *,
        metadata: Mapping[str, Any] | None = None,
    ) -> None:
        if is_array_like(frames) and not isinstance(frames, Iterator):
            frames = _checked_array(as_array(frames, "the array"))
        elif isinstance(frames, StoredArray):
            _check_shape(frames.shape)
        self._frames: Iterable[Any] = frames
        is_live = isinstance(frames, Iterator)
        self._times = times
        count = len(frames) if isinstance(frames, Sized) else None
        if count is not None:
            _refuse_if_empty(count == 0)
            times.check_count(count)
        first = self._peek(is_live)
        origin = metadata or {"source": "array", "kind": "array"}
        facts = {**origin, "pixel_type": str(first.dtype)}
        size = checked_size(first.shape[1], first.shape[0])
        super().__init__(size, times.fps, count, facts, is_live=is_live)

    @property
    def times_us(self) -> Sequence[int] | None:
        """Times of all frames, µs; None of an iterator."""
        return None if self.frame_count is None else self._times.of(self.frame_count)

    def __iter__(self) -> Iterator[Frame]:
        """Frames in order.

        Raises:
            InputError: an image of an iterable has a wrong shape or type, or an iterator is read a
                second time.
        """
        return self._run(iter(self._frames))

    def _run(self, images: Iterable[Any]) -> Iterator[Frame]:
        count = 0
        for count, image in enumerate(images, start=1):
            yield Frame(caller_pixels(image, f"frame {count - 1}"), self._times(count - 1))
        self._times.check_count(count)

    def _peek(self, is_live: bool) -> PixelArray:
        """The first image; an iterator gets it back in front."""
        iterator = iter(self._frames)
        first = [*itertools.islice(iterator, 1)]
        if is_live and not first:
            raise InputError("the generator has no frame (left); if it was read, make it again")
        _refuse_if_empty(not first)
        if is_live:
            whole = itertools.chain(first, iterator)
            self._frames = ReadOnce(whole, "a generator of frames")
        return caller_pixels(first[0], "frame 0")


def _checked_array(array: NDArray[Any]) -> NDArray[Any]:
    """[N, H, W] or [N, H, W, 3]; a single grey channel is dropped."""
    _check_shape(array.shape)
    return array[..., 0] if array.ndim == 4 and array.shape[-1] == 1 else array


def _check_shape(shape: tuple[int, ...]) -> None:
    if len(shape) == 3 or (len(shape) == 4 and shape[-1] in (1, 3)):
        if len(shape) == 3 and SLENDER * shape[2] < min(shape[:2]):
            warn(
                f"frames of shape {list(shape)} are read as {shape[0]} frames of "
                f"{shape[2]}x{shape[1]}; if the last axis is colour, give several images, and if "
                "it is time, np.moveaxis(frames, -1, 0)"
            )
        return
    raise InputError(
        f"frames must be [N, H, W] or [N, H, W, 3]; got shape {shown(list(shape))}"
        + (ONE_IMAGE if len(shape) == 2 else shape_hint(shape[1:]))
    )


def _refuse_if_empty(is_empty: bool) -> None:
    if is_empty:
        raise InputError("there is no frame; give at least two")
