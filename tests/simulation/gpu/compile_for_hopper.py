"""Compile every launch of the GPU backend for an H100 or H200, without one; prints JSON.

Run by `test_compiled`, in a process where Triton's interpreter is off. The engine launches its
kernels as it would on a GPU; each launch is compiled for exactly its arguments and then left out,
so that what the engine counts is made up.
"""

import json
import re
import subprocess
import sys
import tempfile
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import torch
import triton
from triton.backends.compiler import GPUTarget
from triton.runtime import driver
from triton.runtime.jit import JITFunction

from texvent.simulation.clips import scan_triton
from texvent.simulation.clips.pixels import ClipOutputs, ClipPixels
from texvent.simulation.esim.config import EsimConfig
from texvent.simulation.gpu import engine
from texvent.simulation.physical.simulator import PhysicalConfig, PhysicalSimulator
from texvent.simulation.random.draws import frame_keys
from texvent.simulation.texvent.simulator import TexventConfig, TexventSimulator

TOOL = Path(triton.__file__).parent / "backends" / "nvidia" / "bin" / "cuobjdump"
PAPER = TexventSimulator.presets["paper"]
RANDOM = {"noise": "random", "timestamp_rule": "random"}
DECAYING = {"residual_decay_hz": 3.0}
CONFIGS: dict[str, Any] = {
    "paper": PAPER,
    "random": replace(PAPER, **RANDOM),
    "linear": TexventConfig(**DECAYING, timestamp_rule="linear"),
    "end": TexventConfig(cache="global", reset="step", timestamp_rule="end"),
    "esim": EsimConfig(),
    "physical": PhysicalConfig(hot_pixel_fraction=0.1),
    "clean": PhysicalSimulator.presets["clean"],
}
USUAL = (2, 4, 260, 346)
ODD = (1, 2, 5, 7)
"""[B, T, H, W] with one interval, and rows that align with nothing."""
ONE = (1, 3, 1, 1)
EVERYTHING = ClipOutputs(counts=True, latest=True, events=True)
CASES = [
    *((name, torch.uint8, USUAL) for name in CONFIGS),
    *((name, torch.float32, USUAL) for name in ("paper", "linear", "esim", "physical")),
    *((name, torch.uint8, ODD) for name in ("paper", "linear", "esim", "clean")),
    ("linear", torch.uint8, ONE),
]


class Hopper:
    """What Triton asks a driver before it compiles."""

    def get_current_target(self) -> GPUTarget:
        return GPUTarget("cuda", 90, 32)

    def get_current_device(self) -> int:
        return 0

    def get_current_stream(self, device: int = 0) -> int:
        return 0


def measure_usage(cubin: bytes) -> dict[str, int]:
    """Registers of a thread, and bytes of the stack and of local memory that it spills to."""
    with tempfile.NamedTemporaryFile(suffix=".cubin") as file:
        file.write(cubin)
        file.flush()
        words = [str(TOOL), "--dump-resource-usage", file.name]
        text = subprocess.run(words, capture_output=True, text=True, check=True).stdout
    return {name: int(number) for name, number in re.findall(r"\b(REG|STACK|LOCAL):(\d+)", text)}


def compile_all() -> dict[str, dict[str, int]]:
    """Name of each launch → what its machine code uses."""
    usage: dict[str, dict[str, int]] = {}
    where = ""
    launch = JITFunction.run

    def compile_only(kernel: Any, *arguments: Any, grid: Any, warmup: bool, **options: Any) -> Any:
        compiled = launch(kernel, *arguments, grid=grid, warmup=True, **options)
        name = f"{kernel.__name__}, {where}, launch {len(usage)}"
        usage[name] = measure_usage(compiled.asm["cubin"])
        return compiled

    JITFunction.run = compile_only
    driver.set_active(Hopper())
    engine.check_device = scan_triton.check_device = lambda device: None
    # The counts that no kernel has written: one event everywhere.
    torch.empty = torch.ones
    for name, dtype, shape in CASES:
        where = f"{name}, {dtype}, {list(shape)}"
        frames = torch.zeros(shape, dtype=dtype)
        engine.GpuSimulator(CONFIGS[name]).step(frames, range(shape[1]))
    for shape in (USUAL, ODD):
        where, (count, steps) = f"clips, {list(shape)}", shape[:2]
        pixels = ClipPixels(np.ones((count, 8)), frame_keys(0, np.arange(count)), np.ones(256))
        times_us = np.tile(np.arange(steps), (count, 1))
        for outputs in (EVERYTHING, ClipOutputs(bins=1)):
            scan_triton.simulate_on_gpu(
                torch.zeros(shape, dtype=torch.uint8), times_us, pixels, outputs
            )
    return usage


if __name__ == "__main__":
    json.dump(compile_all(), sys.stdout)
