"""The pixels of a model on the GPU, and the two passes over the frames of a call: count, write."""

from __future__ import annotations

import abc
import math
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from texvent._require import require
from texvent.brightness import HIGHEST_INTENSITY
from texvent.errors import InputError
from texvent.simulation.gpu.intervals import Float64Array, Span
from texvent.simulation.gpu.kernel_types import (
    PIXELS_PER_MARK,
    Call,
    NoiseRules,
    PassCounts,
    Records,
    Tensor,
)
from texvent.simulation.gpu.launch import EXTRA, LAUNCH, LaunchSize, choose_launch_size, pixel_grid
from texvent.simulation.texvent.gpu.noise import NoiseDraw

Config = TypeVar("Config")


class GpuPixels(abc.ABC, Generic[Config]):
    """The pixels of a batch of clips under one model: options, state, and kernels to launch."""

    def __init__(self, config: Config, launch: LaunchSize) -> None:
        """Pixels that have seen no frame.

        Args:
            config: the options.
            launch: size of the programs of `find_events` on a GPU.
        """
        self.config = config
        self._launch = choose_launch_size(launch)

    @property
    def block(self) -> int:
        """Pixels of a program of `find_events`."""
        return self._launch.block

    @abc.abstractmethod
    def begin(self, frames: Tensor) -> None:
        """Make room for the state and put the options on the device of `frames`, [B, H, W]."""

    def shares(self, span: Span) -> Float64Array:
        """Share by which references move to the frame before every interval, [B, T], 0..1.

        By default they begin at the first frame and are never forgotten.
        """
        shares = np.zeros(span.start_us.shape)
        if span.is_new:
            shares[:, 0] = 1.0
        return shares

    def prepare(self, call: Call, span: Span) -> None:
        """Make what both passes over the frames of a call read; nothing by default."""

    def advance(self, span: Span) -> None:
        """Update what is kept on the host after a call; nothing by default."""

    def find_events(self, call: Call, tally: PassCounts, records: Records | Tensor | None) -> None:
        """Count the events of all intervals (`records` None), or write them and move on."""
        kernel, rules, state = self._scan(call)
        kernel[pixel_grid(call, self.block)](
            call.frames,
            call.intervals,
            rules,
            state,
            tally,
            records,
            ALIGN=call.align,
            BLOCK=self.block,
            num_warps=self._launch.warps,
            maxnreg=self._launch.registers,
            **LAUNCH,
        )

    @abc.abstractmethod
    def _scan(self, call: Call) -> tuple[Any, Any, Any]:
        """The kernel that finds events, the rules it reads and the state it moves along."""

    @abc.abstractmethod
    def records(self, count: int, words: Tensor) -> Records | Tensor:
        """Room for `count` events; `words` itself where `find_events` knows their times."""

    def timestamp(self, call: Call, records: Records, ends: Tensor, words: Tensor) -> None:
        """Give every record its time, and write it to `words`; nothing where it has one."""


@dataclass(frozen=True, eq=False)
class Words:
    """The events of a call, not in order."""

    words: Tensor
    """[n] int64, see `blocks_triton.pack_event`."""
    ends: Tensor
    """[S + 1] int64, on the device: events before each segment, and n."""
    host_ends: NDArray[np.int64]
    """The same on the host."""


def run_passes(
    pixels: GpuPixels[Any], call: Call, noise: NoiseRules | None, *, on_resting: bool
) -> Words:
    """Find the events of a call and move the pixels' state along.

    Args:
        pixels: the model.
        call: frames and intervals.
        noise: how noise is drawn; None for none.
        on_resting: whether noise falls on dark, resting pixels only.

    Raises:
        InputError: an intensity is NaN, negative or too high; the state is then as before.
    """
    torch = require("torch", extra=EXTRA)
    device, area = call.frames.pixels.device, call.frames.area
    blocks = math.ceil(area / pixels.block)
    tally = PassCounts(
        torch.empty(call.segments * blocks, dtype=torch.int32, device=device),
        torch.empty(
            call.segments, math.ceil(area / PIXELS_PER_MARK), dtype=torch.uint8, device=device
        )
        if noise is not None and on_resting
        else None,
        torch.zeros(1, dtype=torch.int32, device=device),
    )
    pixels.find_events(call, tally, None)
    starts, ends = scan_counts(tally.events, call.segments)
    drawn = NoiseDraw(call, noise, tally.fired) if noise is not None else None
    noise_starts, noise_ends = starts, torch.zeros_like(ends)
    if drawn is not None:
        noise_starts, noise_ends = scan_counts(drawn.per_block, call.segments)
    # The only place where the host waits for the device.
    counts = torch.cat((tally.bad.long(), ends, noise_ends)).cpu().numpy()
    _refuse_bad(int(counts[0]))
    host_ends, host_noise_ends = np.split(counts[1:], 2)
    signal = int(host_ends[-1])
    words = torch.empty(signal + int(host_noise_ends[-1]), dtype=torch.int64, device=device)
    records = pixels.records(signal, words)
    pixels.find_events(call, tally._replace(events=starts, bad=None), records)
    if signal:
        pixels.timestamp(call, records, ends, words)
    if drawn is not None and len(words) > signal:
        drawn.write(noise_starts + signal, words)
    return Words(words, ends + noise_ends, host_ends + host_noise_ends)


def scan_counts(counts: Tensor, segments: int) -> tuple[Tensor, Tensor]:
    """First event of each block and of each segment.

    Args:
        counts: [S · blocks] int32.
        segments: S.

    Returns:
        [S · blocks] int64: events before each block; [S + 1] int64: before each segment, and all.
    """
    torch = require("torch", extra=EXTRA)
    passed = torch.cumsum(counts, 0, dtype=torch.int64)
    ends = torch.zeros(segments + 1, dtype=torch.int64, device=counts.device)
    ends[1:] = passed.view(segments, -1)[:, -1]
    return passed - counts, ends


def _refuse_bad(bad: int) -> None:
    if bad:
        raise InputError(
            f"the frames have {bad} pixel(s) that are NaN, negative or above "
            f"{HIGHEST_INTENSITY:g}; intensities must be 0..{HIGHEST_INTENSITY:g}, where 255 is "
            "white"
        )
