"""Time of a training step of reconstruction networks: forward, loss, backward, optimiser.

    python -m texvent_lab.measure.train_gpu [--json FILE]
    python -m texvent_lab.measure.train_gpu --tiny           on a CPU, to see that it runs

The sizes are those of published trainings: sequences of 40 windows of 112×112 px, LPIPS with VGG,
temporal consistency. Sequences are random numbers that lie on the device, and the weights of LPIPS
are random too: the time depends on neither. Loading is not timed. The first step, which compiles,
is stated by itself. A case that does not fit into memory is stated as such.
"""

from __future__ import annotations

import argparse
import itertools
import sys
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np

from texvent.errors import MissingDependencyError
from texvent.extending import require
from texvent.metrics.lpips import LAYOUTS, LpipsNet, LpipsWeights
from texvent_lab.bench.document import write_document
from texvent_lab.bench.machine import describe_environment
from texvent_lab.measure.speed.timing import Quartiles, rounded
from texvent_lab.registries import RECONSTRUCTORS
from texvent_lab.train.reconstruction.config import ReconstructionConfig, ReconstructionLoss
from texvent_lab.train.reconstruction.network import new_network
from texvent_lab.train.reconstruction.sequence_loss import SequenceLoss
from texvent_lab.train.schedule import EXTRA, Hardware

SCHEMA = "texvent-train-gpu-1"
Precision = Literal["float32", "bfloat16"]


@dataclass(frozen=True)
class Plan:
    """What is measured."""

    networks: tuple[str, ...] = ("firenet+", "e2vid+")
    batches: tuple[int, ...] = (2, 8)
    precisions: tuple[Precision, ...] = ("float32", "bfloat16")
    compiled: tuple[bool, ...] = (False, True)
    windows: int = 40
    side: int = 112
    lpips_net: LpipsNet = "vgg"
    warm_up: int = 3
    repeats: int = 20


TINY = Plan(
    networks=("firenet+", "e2vid+"),
    batches=(1,),
    compiled=(False,),
    windows=3,
    side=32,
    lpips_net="alex",
    warm_up=1,
    repeats=2,
)


def measure(plan: Plan, device: Literal["cpu", "cuda"]) -> dict[str, Any]:
    """All figures, ready for JSON."""
    torch = require("torch", extra=EXTRA)
    is_gpu = device == "cuda"
    return {
        "schema": SCHEMA,
        "environment": {
            **describe_environment(),
            "gpu": torch.cuda.get_device_name() if is_gpu else None,
            "cuda": torch.version.cuda if is_gpu else None,
        },
        "windows": plan.windows,
        "side": plan.side,
        "lpips_net": plan.lpips_net,
        "rows": list(measure_cases(plan, device)),
    }


def measure_cases(plan: Plan, device: Literal["cpu", "cuda"]) -> Iterator[dict[str, Any]]:
    """A row per network, batch, precision, and with or without compilation."""
    torch = require("torch", extra=EXTRA)
    cases = itertools.product(plan.networks, plan.batches, plan.precisions, plan.compiled)
    for network, batch, precision, is_compiled in cases:
        hardware = Hardware(device=device, precision=precision, compile=is_compiled)
        facts = {
            "network": network,
            "batch": batch,
            "precision": precision,
            "is_compiled": is_compiled,
        }
        try:
            yield {**facts, **measure_steps(plan, network, batch, hardware)}
        except torch.cuda.OutOfMemoryError:
            yield {**facts, "problem": "out of memory"}


def measure_steps(plan: Plan, name: str, batch: int, hardware: Hardware) -> dict[str, Any]:
    """Time of the steps of one case."""
    torch = require("torch", extra=EXTRA)
    device = hardware.find_device()
    step = _Step(plan, name, batch, hardware)
    is_gpu = device.type == "cuda"
    if is_gpu:
        torch.cuda.reset_peak_memory_stats()
    times = []
    for _ in range(1 + plan.warm_up + plan.repeats):
        start = time.perf_counter()
        step()
        if is_gpu:
            torch.cuda.synchronize()
        times.append(time.perf_counter() - start)
    steps = Quartiles.of(times[1 + plan.warm_up :], scale=1e3)
    return {
        "step_ms": steps.as_json(),
        "windows_per_s": rounded(batch * plan.windows / steps.median * 1e3),
        "first_step_s": rounded(times[0]),
        "peak_gib": rounded(torch.cuda.max_memory_allocated() / 2**30) if is_gpu else None,
        "loss": rounded(step.loss),
    }


class _Step:
    """A step on the same sequences again and again."""

    def __init__(self, plan: Plan, name: str, batch: int, hardware: Hardware) -> None:
        torch = require("torch", extra=EXTRA)
        self._hardware, self._device = hardware, hardware.find_device()
        draws = torch.Generator().manual_seed(0)
        shape = (batch, plan.windows)

        def normal(channels: int) -> Any:
            values = torch.randn((*shape, channels, plan.side, plan.side), generator=draws)
            return values.to(self._device)

        self._voxels, self._true, self._flow = normal(5), normal(1).sigmoid(), normal(2)
        self._network = new_network(RECONSTRUCTORS.load(name), 0).to(self._device)
        self._computed = torch.compile(self._network) if hardware.compile else self._network
        self._optimizer = ReconstructionConfig().schedule.make_optimizer(self._network)
        options = ReconstructionLoss(lpips_net=plan.lpips_net)
        self._compare = SequenceLoss(options, _random_weights(plan.lpips_net)).to(self._device)
        self.loss = 0.0

    def __call__(self) -> None:
        with self._hardware.autocast(self._device):
            images = self._computed(self._voxels).float()
            loss = self._compare(images, self._true, self._flow)
        self.loss = float(loss.detach())
        self._optimizer.zero_grad()
        loss.backward()
        self._optimizer.step()


def _random_weights(net: LpipsNet) -> LpipsWeights:
    layout = next(one for one in LAYOUTS if one.name == net)
    rng = np.random.default_rng(0)
    arrays = {
        name: np.abs(rng.normal(0, 0.05, shape)).astype(np.float32)
        for name, shape in layout.array_shapes().items()
    }
    return LpipsWeights(layout, arrays)


def as_text(document: dict[str, Any]) -> str:
    """The figures as a table."""
    lines = ["network   batch  precision  compiled  ms/step (q1..q3)  windows/s  peak GiB"]
    for row in document["rows"]:
        text = (
            f"{row['network']:9} {row['batch']:5}  {row['precision']:9}  {row['is_compiled']!s:8}"
        )
        if "problem" in row:
            lines.append(f"{text}  {row['problem']}")
            continue
        step = row["step_ms"]
        spread = f"({step['q1']:.1f}..{step['q3']:.1f})"
        peak = "–" if row["peak_gib"] is None else f"{row['peak_gib']:.1f}"
        lines.append(
            f"{text}  {step['median']:7.1f} {spread}  {row['windows_per_s']:9,.0f}  {peak}"
        )
    return "\n".join(lines)


def main(words: list[str] | None = None) -> int:
    """Measure, print, write; 2 without a GPU."""
    parser = argparse.ArgumentParser(
        prog="python -m texvent_lab.measure.train_gpu", description=(__doc__ or "").split("\n")[0]
    )
    parser.add_argument("--tiny", action="store_true", help="small, and on the CPU")
    parser.add_argument("--json", type=Path, help="write the figures here")
    chosen = parser.parse_args(words)
    try:
        torch = require("torch", extra=EXTRA)
    except MissingDependencyError as error:
        print(f"nothing was measured: {error}", file=sys.stderr)
        return 2
    if not chosen.tiny and not torch.cuda.is_available():
        print(
            "nothing was measured: torch finds no GPU here; --tiny runs on a CPU", file=sys.stderr
        )
        return 2
    document = measure(TINY, "cpu") if chosen.tiny else measure(Plan(), "cuda")
    if chosen.json is not None:
        write_document(chosen.json, document, overwrite=True)
    print(as_text(document))
    return 0


if __name__ == "__main__":
    sys.exit(main())
