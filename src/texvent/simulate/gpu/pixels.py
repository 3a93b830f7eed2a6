"""What a pixel model offers to the GPU backend."""

from __future__ import annotations

import abc
from collections.abc import Sequence
from typing import Any, Generic, TypeVar

from texvent.simulate.gpu.device import LAUNCH
from texvent.simulate.gpu.intervals import Float64Array, Int64Array, Span
from texvent.simulate.gpu.kernel_types import Call, PassCounts, Records, Tensor
from texvent.simulate.gpu.launch import LaunchSize, choose_launch_size, pixel_grid

Config = TypeVar("Config")


class GpuPixels(abc.ABC, Generic[Config]):
    """The pixels of a batch of clips under one model: options, state, and kernels to launch."""

    def __init__(self, config: Config, seeds: Sequence[int], launch: LaunchSize) -> None:
        """Pixels that have seen no frame.

        Args:
            config: the options.
            seeds: one per clip.
            launch: size of the programs of `find_events` on a GPU.
        """
        self.config = config
        self._seeds = tuple(seeds)
        self._launch = choose_launch_size(launch)

    @property
    def block(self) -> int:
        """Pixels of a program of `find_events`."""
        return self._launch.block

    @abc.abstractmethod
    def begin(self, frames: Tensor) -> None:
        """Make room for the state and put the options on the device of `frames`, [B, H, W]."""

    @abc.abstractmethod
    def keys(self, span: Span) -> Int64Array:
        """Keys of the random draws of every interval, as bits, [B, T]."""

    @abc.abstractmethod
    def shares(self, span: Span) -> Float64Array:
        """Share by which references move to the frame before every interval, [B, T], 0..1."""

    def advance(self, span: Span) -> None:
        """Update what is kept on the host after a call; nothing by default."""

    def find_events(self, call: Call, tally: PassCounts, records: Records | None) -> None:
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
            **LAUNCH,
        )

    @abc.abstractmethod
    def _scan(self, call: Call) -> tuple[Any, Any, Any]:
        """The kernel that finds events, the rules it reads and the state it moves along."""

    @abc.abstractmethod
    def records(self, count: int) -> Records:
        """Room for `count` events."""

    @abc.abstractmethod
    def timestamp(self, call: Call, records: Records, ends: Tensor, words: Tensor) -> None:
        """Give every record its time, and write it to `words`."""
