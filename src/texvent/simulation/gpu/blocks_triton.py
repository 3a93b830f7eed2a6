"""Functions of the GPU kernels of all models: keyed draws, reading frames, writing events."""

from __future__ import annotations

import triton
import triton.language as tl

from texvent.brightness import HIGHEST_INTENSITY
from texvent.simulation.gpu import kernel_types
from texvent.simulation.random import draws

# The twin of `texvent.simulation.random.draws`: same bits. Kernels may read module-level numbers
# only as constexpr.
_GOLDEN = tl.constexpr(draws.GOLDEN)
_MULTIPLIER_1 = tl.constexpr(draws.MULTIPLIER_1)
_MULTIPLIER_2 = tl.constexpr(draws.MULTIPLIER_2)
_UNIT = tl.constexpr(draws.UNIT)


@triton.jit
def _mix(word: tl.tensor) -> tl.tensor:
    word = (word ^ (word >> 30)) * _MULTIPLIER_1
    word = (word ^ (word >> 27)) * _MULTIPLIER_2
    return word ^ (word >> 31)


@triton.jit
def draw_word(key: tl.tensor, y: tl.tensor, x: tl.tensor, draw: tl.tensor) -> tl.tensor:
    """64 random bits, uint64; see `draws.draw_words`. `key` must be a uint64."""
    place = (y.to(tl.uint64) << 16) | x.to(tl.uint64)
    counter = (draw.to(tl.uint64) << 32) | place
    return _mix(_mix(counter * _GOLDEN + key) ^ key)


@triton.jit
def to_uniform(word: tl.tensor) -> tl.tensor:
    """Uniform number in [0, 1) of a word, float64; see `draws.draw_uniforms`."""
    return (word >> 11).to(tl.float64) * _UNIT


HIGHEST = tl.constexpr(HIGHEST_INTENSITY)
_PER_MARK = tl.constexpr(kernel_types.PIXELS_PER_MARK)


@triton.jit
def own_pixels(frames: tl.tuple, ALIGN: tl.constexpr, BLOCK: tl.constexpr) -> tl.tuple:
    """The pixels of a program that scans.

    Returns:
        The clip; the pixels' flat index; whether they exist; their place in arrays [B, area]; and
        the address of their intensities in the clip's first frame.
    """
    clip = tl.program_id(1).to(tl.int64)
    area = tl.multiple_of(tl.cast(frames.area, tl.int32), ALIGN)
    at = tl.program_id(0) * BLOCK + tl.arange(0, BLOCK)
    home = tl.multiple_of(clip * area, ALIGN) + at
    address = frames.pixels + tl.multiple_of(clip * frames.clip_stride, ALIGN) + at
    return clip, at, at < area, home, address


@triton.jit
def skip_frames(frames: tl.tuple, count: tl.tensor, ALIGN: tl.constexpr) -> tl.tensor:
    """Distance of a frame from the first one of its clip, pixels."""
    return tl.multiple_of(tl.cast(count, tl.int64) * frames.frame_stride, ALIGN)


@triton.jit
def find_cell(tally: tl.tuple, segment: tl.tensor) -> tl.tensor:
    """Address of what `PassCounts.events` holds for a program in a segment."""
    return tally.events + segment * tl.num_programs(0) + tl.program_id(0)


@triton.jit
def read(pointer: tl.tensor, inside: tl.tensor) -> tl.tensor:
    """Numbers in the type that they are compared in: bytes as int32, others as they are."""
    value = tl.load(pointer, mask=inside, other=0)
    return value.to(tl.int32) if value.dtype == tl.uint8 else value


@triton.jit
def read_now(
    frames: tl.tuple, segment: tl.tensor, pixel: tl.tensor, inside: tl.tensor
) -> tl.tensor:
    """Intensities of single pixels in the frame that ends a segment."""
    clip = segment // frames.intervals
    interval = segment % frames.intervals
    frame = clip * frames.clip_stride + interval * frames.frame_stride
    return read(frames.pixels + frame + pixel, inside)


@triton.jit
def read_before(
    frames: tl.tuple, segment: tl.tensor, pixel: tl.tensor, inside: tl.tensor
) -> tl.tensor:
    """Intensities of single pixels in the frame that a segment starts at."""
    clip = segment // frames.intervals
    is_first = segment % frames.intervals == 0
    earlier = read_now(frames, segment - 1, pixel, inside & (not is_first))
    kept = read(frames.previous + clip * frames.area + pixel, inside & is_first)
    return tl.where(is_first, kept, earlier)


@triton.jit
def count_bad(intensity: tl.tensor, inside: tl.tensor) -> tl.tensor:
    """1 where an intensity is NaN, negative or above `HIGHEST_INTENSITY`, int32."""
    if intensity.dtype == tl.int32:
        bad = tl.zeros(intensity.shape, tl.int32)
    else:
        is_good = (intensity >= 0) & (intensity <= HIGHEST)
        bad = (inside & (is_good == 0)).to(tl.int32)
    return bad


@triton.jit
def mark_fired(
    tally: tl.tuple,
    segment: tl.tensor,
    area: tl.tensor,
    fired: tl.tensor,
    BLOCK: tl.constexpr,
) -> None:
    """Keep a bit for every pixel that fired, if noise needs it (`PassCounts.fired`)."""
    if tally.fired is not None:
        size = (area + _PER_MARK - 1) // _PER_MARK
        bits = fired.to(tl.int32) << (tl.arange(0, BLOCK) % _PER_MARK)
        byte = tl.sum(tl.reshape(bits, [BLOCK // _PER_MARK, _PER_MARK]), axis=1)
        at = tl.program_id(0) * (BLOCK // _PER_MARK) + tl.arange(0, BLOCK // _PER_MARK)
        tl.store(tally.fired + segment * size + at, byte.to(tl.uint8), mask=at < size)


@triton.jit
def write_events(records: tl.tuple, first: tl.tensor, fires: tl.tensor, event: tl.tuple) -> None:
    """Write (pixel, order, reference) of the pixels that fire, one after the other."""
    number = fires.to(tl.int32)
    # Apart from `first`, which is wide, so that every lane adds 32 bits only.
    rank = tl.cumsum(number, 0) - number
    tl.store(records.pixel + first + rank, event[0], mask=fires)
    if records.order is not None:
        tl.store(records.order + first + rank, event[1], mask=fires)
    tl.store(records.reference + first + rank, event[2], mask=fires)


@triton.jit
def read_share(intervals: tl.tuple, segment: tl.tensor) -> tl.tensor:
    """Share by which references move to the frame before an interval, float64."""
    return tl.load(intervals.share + segment).to(tl.float64, bitcast=True)


@triton.jit
def read_order(records: tl.tuple, at: tl.tensor, inside: tl.tensor) -> tl.tensor:
    """Number of a record among its pixel's events."""
    if records.order is not None:
        order = tl.load(records.order + at, mask=inside, other=1)
    else:
        order = tl.full(at.shape, 1, tl.int32)
    return order


@triton.jit
def place_in(intervals: tl.tuple, segment: tl.tensor, fraction: tl.tensor) -> tl.tensor:
    """Times at fractions 0..1 of an interval, on the common axis; see `interval.place_in`."""
    duration = tl.load(intervals.duration_us + segment)
    start = tl.load(intervals.start_us + segment) + tl.load(intervals.origin_us + segment)
    offset = tl.floor(fraction * duration.to(tl.float64)).to(tl.int64)
    return start + tl.minimum(offset, duration - 1)


@triton.jit
def pack_event(
    t: tl.tensor, pixel: tl.tensor, is_on: tl.tensor, label: tl.tensor, area: tl.tensor
) -> tl.tensor:
    """An event as one int64 that sorts by (t, y, x, p, label); `ordering` takes it apart."""
    return ((t * area + pixel) * 2 + is_on) * 2 + label
