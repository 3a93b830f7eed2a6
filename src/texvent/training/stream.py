"""Stream of training batches: videos in, frames and their events as dense arrays out, in torch."""

from __future__ import annotations

from collections.abc import Generator, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent._registry import suggest
from texvent._require import require
from texvent.config import check_range, check_whole
from texvent.dataset.torch_samples import EventBatch
from texvent.errors import ConfigError, InputError, TexventError, few, one_line, shown, warn
from texvent.represent.tensors import Tensor
from texvent.represent.time_surface import MAX_TAU_US
from texvent.runtime.array_pool import ArrayPool
from texvent.runtime.devices import check_device_name, explain_device_memory, find_gpu, triton_fault
from texvent.runtime.work.worker_threads import prefetch
from texvent.sensor import SizeLike, as_size
from texvent.simulation.clips.pixels import ClipOutputs, check_clips
from texvent.training.clip_store import ClipStore
from texvent.training.cuts import Cut, CutPlan, cut_clip
from texvent.training.draws import (
    RANGES,
    ClipDraw,
    ClipRanges,
    PhysicalRanges,
    Ranges,
    draw_clip,
    order_of_pass,
)
from texvent.training.simulated import events_of, simulate_clips
from texvent.training.sources import TRUTH, Clip, find_source

_torch: Any = require("torch", extra="torch")
_data: Any = require("torch.utils.data", extra="torch")
_IterableDataset: Any = _data.IterableDataset

OUTPUTS = ("grids", "counts", "surfaces", "events")
AHEAD = 2
"""Batches whose frames are cut ahead."""
GIB = 2**30
THRESHOLDS = ("threshold_on", "threshold_off")


@dataclass(frozen=True, eq=False)
class Batch:
    """B clips of W frames each, on the device of the stream.

    Example:
        >>> from texvent.training import EventStream, PromptClips
        >>> clips = PromptClips(["a red ball rolls left"], sensor="32x24", duration=0.4)
        >>> stream = EventStream(clips, batch=1, frames=4, size="32x24", device="cpu")
        >>> batch = next(iter(stream))
        >>> batch.number, batch.frames.shape
        (0, torch.Size([1, 4, 24, 32]))
    """

    number: int
    """Number of the batch in the stream of all ranks, from 0."""
    first: Tensor
    """[B, H, W] uint8: the frame at which events begin."""
    frames: Tensor
    """[B, W, H, W] uint8: the frame at the end of each grid."""
    times_us: Tensor
    """[B, W + 1] int64: times of these frames since the first."""
    grids: Tensor
    """[B, W, bins, H, W] float32, events (signed), as `voxel_e2vid` makes them; None if not asked
    for, as all below."""
    counts: Tensor
    """[B, W, 2, H, W] int32: events; index 0 is OFF, 1 is ON."""
    surfaces: Tensor
    """[B, W, 2, H, W] float32: `time_surface` of the events of a window at its end."""
    events: EventBatch | None
    """The events themselves; times count from the first frame."""
    truth: Mapping[str, Any]
    """`flow` [B, W, 2, H, W]: px from the frame before each grid to that at its end, x right and y
    down, of what is seen before; `depth` [B, W, H, W]: m; `boxes`: of each clip and frame, as
    `texvent.truth.boxes.detection_target` gives them."""
    draws: Mapping[str, NDArray[Any]]
    """[B] each: what was drawn, and `source`, `start`, `top`, `left`, `speed`, `is_flipped`."""


class _Prepared(NamedTuple):
    """The frames of a batch, before they are simulated."""

    number: int
    frames: NDArray[np.uint8]
    """[B, T + 1, H, W]."""
    cuts: list[Cut]
    draws: list[ClipDraw]
    sources: list[int]


@dataclass(kw_only=True, eq=False)
class EventStream(_IterableDataset):  # type: ignore[misc]
    """Batches of simulated clips without end; equal seeds give equal batches on any ranks.

    Batch i holds the clips i · B .. i · B + B − 1 of the stream, whose draws depend on the seed and
    their number alone. Rank r of R takes batches r, r + R, ..., worker w of W every W-th of these,
    so a DataLoader with `batch_size=None` gives the same ones in the same order. A pass shows
    every source once; another loop continues after the last batch.

    Raises:
        InputError: nothing is there, or no source is large and long enough.
        ConfigError: an unknown name, a value out of range, a device that torch does not find.
        MissingDependencyError: torch is not installed; on a GPU, Triton.

    Example:
        >>> from texvent.training import EventStream, PromptClips
        >>> clips = PromptClips(["a red ball rolls left"], sensor="32x24", duration=0.4)
        >>> stream = EventStream(clips, batch=1, frames=4, size="32x24", device="cpu")
        >>> next(iter(stream)).grids.shape
        torch.Size([1, 4, 5, 24, 32])
    """

    source: Any = field(kw_only=False)
    """A folder of videos or image folders, a pattern, a file that lists prompts or videos, a data
    set that `texvent dataset make` made; several of these; or a `ClipSource`, such as
    `PromptClips`."""
    fps: float | None = None
    """Frame rate of videos, in place of their own times."""
    batch: int = 12
    """Clips of a batch, B."""
    frames: int = 40
    """Frames of a clip, each at the end of a grid, W."""
    size: SizeLike = (128, 128)
    """Width and height of the crops."""
    bins: int = 5
    """Bins of a grid."""
    frames_per_grid: int = 1
    """Frames of the video from one grid to the next; V2V takes as many as bins."""
    outputs: Sequence[str] = ("grids",)
    """Parts of a `Batch` to make: grids, counts, surfaces, events."""
    tau_us: int = 30_000
    """Decay time of surfaces, µs."""
    device: str = "cpu"
    """Device of the tensors: cpu, cuda, cuda:N, or auto; a GPU simulates there."""
    randomize: str | ClipRanges | PhysicalRanges = "recommended"
    """Draws per clip: "recommended", the pixel model closest to recordings with the noise and
    thresholds that teach; "physical", a DAVIS346's noise; "v2v"; "none" (the place in the video
    alone); or ranges."""
    truth: Sequence[str] | None = None
    """Truth to bring along: flow, depth, boxes; from prompts and data sets."""
    seed: int = 0
    """Seed of all draws, 0..2⁶³−1."""
    memory: int = 2 * GIB
    """Bytes of decoded clips and their truth in memory, of each worker. Of a longer video than half
    of it, the beginning counts."""
    disk: int = 16 * GIB
    """Bytes of decoded clips on disk of each worker, among the temporary files, while it runs."""
    rank: int | None = None
    """Rank, and how many there are; None: those of torch.distributed, if it runs."""
    world: int | None = None

    def __post_init__(self) -> None:
        for name, low in (("batch", 1), ("frames", 1), ("frames_per_grid", 1), ("memory", 1)):
            check_whole(name, getattr(self, name), low)
        check_whole("disk", self.disk, 0)
        check_whole("seed", self.seed, 0, 2**63 - 1)
        check_range("tau_us", self.tau_us, 1, MAX_TAU_US)
        self._ranges = _ranges_of(self.randomize)
        self._names = _names("truth", self.truth, TRUTH)
        chosen = _names("outputs", self.outputs, OUTPUTS)
        self._outputs = ClipOutputs(
            bins=self.bins, intervals_per_window=self.frames_per_grid, grids="grids" in chosen,
            counts="counts" in chosen, latest="surfaces" in chosen, events="events" in chosen,
        )  # fmt: skip
        self._device = _checked_device(self.device)
        self._is_on_gpu = self._device.type != "cpu"
        self._plan = CutPlan(
            as_size(self.size), self.frames * self.frames_per_grid, self.frames_per_grid,
            self._ranges, self._names,
        )  # fmt: skip
        if "flow" in self._names and (self.frames_per_grid > 1 or self._ranges.speed[1] > 1):
            raise ConfigError(
                "flow is from frame to frame; it needs frames_per_grid 1, speed (1, 1)"
            )
        self._place()
        self._source = find_source(self.source, self._plan.size, self.fps, str(self._device))
        lacking = [name for name in self._names if name not in self._source.known_truth]
        if lacking:
            known = ", ".join(self._source.known_truth) or "none: take PromptClips or a data set"
            raise ConfigError(
                f"the source brings no {lacking[0]} as truth; what it brings is {known}"
            )
        self._store = ClipStore(self._source, self._names, self.memory, self.disk)
        self._pool = ArrayPool()
        self._next = 0
        self._reported = 0
        self.skipped: dict[int, str] = {}
        """Number of a source that cannot be used → why."""
        self._check_some()

    def state_dict(self) -> dict[str, int]:
        """Place in the stream: the same for all ranks that have taken as many batches."""
        return {"seed": self.seed, "next": self._next}

    def load_state_dict(self, state: Mapping[str, int]) -> None:
        """Go on where another stream of the same options was.

        Raises:
            ConfigError: it is the state of another seed, or none.
        """
        if state.get("seed") != self.seed:
            raise ConfigError(
                f"the state is of seed {shown(state.get('seed'))}, the stream of {self.seed}"
            )
        check_whole("next", state.get("next"), 0)
        self._next = int(state["next"])

    def __iter__(self) -> Generator[Batch, None, None]:
        """Batches of this rank and worker, from where the stream is."""
        rank, world = self._place()
        info = _data.get_worker_info()
        worker, workers = (info.id, info.num_workers) if info is not None else (0, 1)
        if info is not None and self._is_on_gpu:
            raise ConfigError(
                f"workers cannot simulate on {self.device}; take a DataLoader without workers: "
                "frames are cut ahead in a thread"
            )
        begin = self._next
        own = begin + (rank - begin) % world + world * worker
        prepared = prefetch(self._prepare_all(own, world * workers), depth=AHEAD)
        try:
            for ready in prepared:
                with self._explain_memory():
                    batch = self._simulate(ready)
                # Of the worker too: the round at which worker 0 begins, for this one to go on here.
                done = (ready.number - begin) // world + workers - worker
                self._next = begin + done * world
                self._report(((ready.number + 1) * self.batch) // len(self._source))
                yield batch
        finally:
            prepared.close()

    def _place(self) -> tuple[int, int]:
        """Rank, and how many there are."""
        distributed = _torch.distributed
        is_run = distributed.is_available() and distributed.is_initialized()
        world = self.world or (distributed.get_world_size() if is_run else 1)
        rank = self.rank if self.rank is not None else (distributed.get_rank() if is_run else 0)
        check_whole("world", world, 1)
        check_whole("rank", rank, 0, world - 1)
        return rank, world

    def _check_some(self) -> None:
        """Refuse sources none of which can be used; reads until one can."""
        for index in range(len(self._source)):
            if self._usable(index) is not None:
                return
        reasons = list(self.skipped.values())
        raise InputError(
            reasons[0]
            if len(reasons) == 1
            else f"none of {len(reasons)} sources can be used; the first: {reasons[0]}"
        )

    def _usable(self, index: int) -> Clip | None:
        """A clip; None, and noted once, where it cannot be used."""
        if index in self.skipped:
            return None
        try:
            clip = self._store.get(index)
            self._plan.check(clip, self._source.name(index))
        except (TexventError, OSError) as error:
            self.skipped[index] = one_line(error)
            return None
        return clip

    def _report(self, passes: int) -> None:
        """Say at the end of a pass what has been skipped since the last one."""
        new = list(self.skipped.values())[self._reported :]
        if new and passes > 0:
            self._reported = len(self.skipped)
            warn(f"{len(self.skipped)} of {len(self._source)} sources are skipped: {few(new, 3)}")

    def _prepare_all(self, first: int, step: int) -> Iterator[_Prepared]:
        number = first
        while True:
            yield self._prepare(number)
            number += step

    def _prepare(self, number: int) -> _Prepared:
        size = self._plan.size
        shape = (self.batch, self._plan.intervals + 1, size.height, size.width)
        ready = _Prepared(number, self._pool.take(shape, np.uint8), [], [], [])
        for clip_number, frames in enumerate(ready.frames, number * self.batch):
            draw = draw_clip(self._ranges, self.seed, clip_number, self._plan.intervals)
            index, clip = self._choose(clip_number)
            ready.cuts.append(cut_clip(clip, draw, self._plan, frames))
            ready.draws.append(draw)
            ready.sources.append(index)
        return ready

    def _choose(self, clip_number: int) -> tuple[int, Clip]:
        """Source of a clip: the next that can be used in the order of its pass."""
        count = len(self._source)
        order = _order(self.seed, clip_number // count, count)
        for offset in range(count):
            index = int(order[(clip_number + offset) % count])
            clip = self._usable(index)
            if clip is not None:
                return index, clip
        raise InputError("no source can be used any more")

    def _simulate(self, ready: _Prepared) -> Batch:
        ranges, per = self._ranges, self.frames_per_grid
        numbers = np.stack([draw.numbers for draw in ready.draws])
        keys = np.array([draw.key for draw in ready.draws], np.uint64)
        frames = _torch.from_numpy(ready.frames).to(self._device)
        times_us = np.stack([cut.times_us for cut in ready.cuts])
        check_clips(frames, times_us, self._outputs)
        made = simulate_clips(
            frames, times_us, ranges, (numbers, keys), self._outputs, self._pool,
            on_gpu=self._is_on_gpu,
        )  # fmt: skip
        windows = _torch.from_numpy(times_us[:, ::per].copy()).to(self._device)
        places = np.array([cut.place for cut in ready.cuts])
        draws = dict(zip((*THRESHOLDS, *ranges.drawn), numbers.T, strict=False))
        draws |= dict(zip(("start", "top", "left", "speed"), places.T, strict=True))
        draws["source"] = np.array(ready.sources)
        draws["is_flipped"] = np.array([draw.is_flipped for draw in ready.draws])
        return Batch(
            number=ready.number,
            first=frames[:, 0],
            frames=frames[:, per::per],
            times_us=windows,
            grids=made.grids,
            counts=made.counts,
            surfaces=None if made.latest is None else self._surfaces(made.latest, windows),
            events=None if made.words is None else events_of(made, self._plan.size),
            truth={name: self._truth_of(name, ready.cuts) for name in self._names},
            draws=draws,
        )

    def _explain_memory(self) -> AbstractContextManager[None]:
        """Turn a failure of memory inside into one line."""
        plan, count = self._plan, self.batch
        needed = self._outputs.count_bytes(count, plan.intervals, plan.size) / 1e9
        return explain_device_memory(
            self._device,
            f"{count} clips of {plan.intervals + 1} frames of {plan.size}, whose arrays alone take "
            f"{needed:.3g} GB,",
            subject="batches of",
            advice="take a smaller `batch` or `size`, or fewer `frames` or `outputs`",
        )

    def _surfaces(self, latest: Tensor, times_us: Tensor) -> Tensor:
        age = times_us.diff(dim=1)[..., None, None, None] - latest
        recency = _torch.exp(-(age.double() / self.tau_us))
        return _torch.where(latest >= 0, recency, 0.0).float()

    def _truth_of(self, name: str, cuts: Sequence[Cut]) -> Any:
        if name != "boxes":
            stacked = np.stack([cut.truth[name] for cut in cuts])
            return _torch.from_numpy(stacked).to(self._device)
        return [
            [{key: _torch.from_numpy(one).to(self._device) for key, one in boxes.items()}
             for boxes in cut.truth["boxes"]]
            for cut in cuts
        ]  # fmt: skip


_order = lru_cache(maxsize=4)(order_of_pass)


def _ranges_of(randomize: object) -> Ranges:
    if isinstance(randomize, ClipRanges | PhysicalRanges):
        return randomize
    if not isinstance(randomize, str) or randomize not in RANGES:
        raise ConfigError(
            f"randomize is {shown(randomize)}; {suggest(str(randomize), tuple(RANGES))}, or give "
            "ClipRanges or PhysicalRanges"
        )
    return RANGES[randomize]


def _names(option: str, given: Sequence[str] | None, known: Sequence[str]) -> tuple[str, ...]:
    names = (given,) if isinstance(given, str) else tuple(given or ())
    for name in names:
        if name not in known:
            raise ConfigError(f"{option} names {shown(name)}; {suggest(str(name), tuple(known))}")
    return names


def _checked_device(name: str) -> Any:
    """The device, which must be there."""
    gpu = find_gpu(check_device_name(name))
    if gpu is None:
        return _torch.device("cpu")
    fault = triton_fault()
    if fault is not None:
        raise ConfigError(f"device is {shown(name)}: {fault}; take 'cpu'")
    return gpu
