"""Device of a run: a GPU where there is one and the pixel model has kernels, else the CPU."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

from texvent.config import RunConfig
from texvent.errors import ConfigError, InputError
from texvent.runtime.devices import (
    AUTO,
    CPU,
    Device,
    describe_device,
    find_gpu,
    total_bytes,
    triton_fault,
)
from texvent.sensor import SensorSize
from texvent.simulation.esim.config import EsimConfig
from texvent.simulation.physical.config import PhysicalConfig
from texvent.simulation.texvent.config import TexventConfig


class GpuModel(NamedTuple):
    """A simulator that has kernels."""

    config: type
    """Type of its options."""
    pixels: str
    """Its `GpuPixels` in `simulation/NAME/gpu/pixels.py`."""
    refused: Mapping[str, tuple[Callable[[Any], bool], str]]
    """Option → whether kernels lack a value of it, and the rest of the sentence that says so."""


_NORMAL = "normal numbers for every pixel and frame, which is not done on a GPU"
MODELS: Mapping[str, GpuModel] = {
    "texvent": GpuModel(
        TexventConfig,
        "TexventPixels",
        {
            "noise": (
                lambda noise: noise == "gaussian",
                f"draws {_NORMAL}; use noise 'adaptive', 'random' or 'none'",
            )
        },
    ),
    "esim": GpuModel(
        EsimConfig,
        "EsimGpuPixels",
        {
            "refractory_period_us": (bool, "is not kept on a GPU; use 0"),
            "threshold_sigma": (bool, f"draws {_NORMAL}; use 0"),
        },
    ),
    "physical": GpuModel(
        PhysicalConfig,
        "PhysicalGpuPixels",
        {
            "scan_period_ns": (
                bool,
                "lets events wait for a scan of the columns, which is not done on a GPU; use 0",
            )
        },
    ),
}
"""Simulators that have kernels, by name."""
BYTES_PER_PIXEL = 64
"""Memory of references, two frames and counts on a GPU, for each pixel; what is between comes on
top."""


@dataclass(frozen=True)
class RunDevice:
    """Device of one run."""

    gpu: Device | None = None
    """torch.device of the networks; None: all runs on the CPU."""
    obstacle: str | None = None
    """Why the pixel model runs on the CPU although there is a GPU."""

    @property
    def resident(self) -> Device | None:
        """The device on which frames stay; None where the pixel model runs on the CPU."""
        return self.gpu if self.obstacle is None else None

    def check_memory(self, size: SensorSize) -> None:
        """Refuse frames that do not fit into the memory of the GPU.

        Raises:
            InputError: they do not fit.
        """
        needed = BYTES_PER_PIXEL * size.width * size.height
        if self.resident is None or self.resident.type != "cuda":
            return
        has = total_bytes(self.resident)
        if needed > has:
            raise InputError(
                f"frames of {size} pixels need at least {needed / 1e9:.3g} GB of memory on "
                f"{self.resident}, which has {has / 1e9:.3g} GB: give a smaller sensor, or "
                "device='cpu'"
            )

    @cached_property
    def facts(self) -> dict[str, Any]:
        """Device and versions, for the provenance, under "device"; nothing where no GPU is used."""
        if self.gpu is None:
            return {}
        pixels = {} if self.obstacle is None else {"pixel_model": "cpu"}
        return {"device": describe_device(self.gpu) | pixels}

    @property
    def note(self) -> str | None:
        """Device in a line, where there is a GPU."""
        if self.gpu is None:
            return None
        name = f"{self.gpu} ({self.facts['device'].get('name', 'interpreted')})"
        return name if self.obstacle is None else f"pixel model on the CPU: {self.obstacle}"


def choose_device(run: RunConfig, config: Any) -> RunDevice:
    """The device of a run.

    Args:
        run: its option `device`.
        config: options of the pixel model.

    Raises:
        ConfigError: a GPU is wanted, and there is none, or the model does not run on it.
        MissingDependencyError: one is wanted, and torch or Triton is not installed.
    """
    if run.device == CPU:
        return RunDevice()
    obstacle = None
    try:
        if run.simulator not in MODELS:  # of another package, which may have their options
            raise _unknown(run.simulator)
        find_model(config)
    except ConfigError as error:
        obstacle = str(error)
    # A model without kernels is refused where there is no GPU too.
    gpu = find_gpu(run.device) if obstacle is None or run.device == AUTO else None
    if gpu is not None:
        obstacle = obstacle or triton_fault()
    if obstacle is not None and run.device != AUTO:
        raise ConfigError(f"device is {run.device!r}: {obstacle}; or device='auto'")
    return RunDevice() if gpu is None else RunDevice(gpu, obstacle)


def _unknown(model: str) -> ConfigError:
    *most, last = MODELS
    known = f"{', '.join(most)} and {last}"
    return ConfigError(f"simulator {model!r} does not run on a GPU; {known} do")


def find_model(config: object) -> str:
    """Name of the simulator with these options, which has kernels for them.

    Args:
        config: options of the model, whose type says which it is.

    Raises:
        ConfigError: it has none; with the model or option, and what to use.
    """
    for name, model in MODELS.items():
        if isinstance(config, model.config):
            for option, (is_refused, reason) in model.refused.items():
                if is_refused(value := getattr(config, option)):
                    raise ConfigError(f"{option} {value!r} {reason}")
            return name
    raise _unknown(type(config).__name__.removesuffix("Config").lower())
