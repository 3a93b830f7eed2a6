"""Definitions of the kernels, in readable NumPy; `definitions()` runs the models by them.

A kernel of texvent must return the bits of its definition.
"""

import importlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TypeVar

import pytest

Result = TypeVar("Result")

KERNELS = {
    "texvent.simulation.kernels.radix_sort:sort_events": "sorting:sort_events",
    "texvent.simulation.random.poisson_noise:draw_arrivals": "poisson_arrivals:draw_arrivals",
    "texvent.simulation.texvent.noise:place_noise": "noise_blocks:place_noise",
    "texvent.simulation.texvent.pixels:SparsePixels": "texvent:TexventPixels",
    "texvent.simulation.texvent.pixels:GaussianPixels": "texvent:TexventPixels",
    "texvent.simulation.esim.pixels:cross_thresholds": "esim:cross_thresholds",
    "texvent.simulation.v2e.pixels:apply_low_pass": "v2e:apply_low_pass",
    "texvent.simulation.v2e.pixels:emit_and_reset": "v2e:emit_and_reset",
    "texvent.simulation.voltmeter.first_passage:find_first_passages": (
        "voltmeter:find_first_passages"
    ),
    "texvent.simulation.senpi.pixels:SenpiPixels": "senpi:SenpiPixels",
    "texvent.simulation.physical.pixels:advance_pixels": "physical:advance_pixels",
}
"""Kernel → its definition, in a module of this folder."""


@contextmanager
def definitions() -> Iterator[None]:
    """Inside the block, pixel models step by their definitions."""
    with pytest.MonkeyPatch.context() as patch:
        for kernel, definition in KERNELS.items():
            module, name = kernel.split(":")
            home, function = definition.split(":")
            found = getattr(importlib.import_module(f"{__name__}.{home}"), function)
            patch.setattr(importlib.import_module(module), name, found)
        yield


def in_both_forms(work: Callable[[], Result]) -> tuple[Result, Result]:
    """Results of some work by the definitions, and by the kernels."""
    with definitions():
        defined = work()
    return defined, work()
