"""Where a model runs and in which number format, from the memory there is."""

from __future__ import annotations

from dataclasses import dataclass
from importlib.util import find_spec

from texvent.errors import ConfigError
from texvent.generate.video_config import DiffusersConfig
from texvent.generate.video_models.known_models import VideoModel

GB = 1e9
SEQUENTIAL_BELOW_GB = 9.0
"""Free GPU memory below which even one whole part of a common model does not fit."""
ROOMY_GB = 75.0
"""Free GPU memory above which a model of unknown needs is put on the device as a whole."""
QUANTIZED_SHARE = {"none": 1.0, "8bit": 0.6, "4bit": 0.45}
"""Rough share of the memory that remains; decoder and text encoder are not quantised."""


@dataclass(frozen=True)
class Placement:
    """How a pipeline is loaded."""

    device: str
    dtype: str
    offload: str
    """"none", "model" or "sequential"."""
    tiles_decoder: bool
    """Decode in tiles: less memory, faint differences where tiles meet."""
    quantize: str = "none"
    """Bits of the video transformer's weights: "none" (all), "8bit" or "4bit"."""


def place(
    model: VideoModel, config: DiffusersConfig, device: str, free_bytes: int | None
) -> Placement:
    """Choose the placement that is fastest and fits; what the user set is kept.

    Args:
        model: the model and its memory needs.
        config: options; "auto" leaves a choice open.
        device: resolved device, such as "cpu" or "cuda:0".
        free_bytes: free memory of the GPU, or None on a CPU.

    Raises:
        ConfigError: an option needs a GPU and there is none.
    """
    if free_bytes is None:
        for name, value in (("offload", config.offload), ("quantize", config.quantize)):
            if value not in ("auto", "none"):
                raise ConfigError(
                    f"{name} is {value!r}, which needs a GPU, but the video is made on {device}; "
                    f"leave --{name} out"
                )
        format_on_cpu = "float32" if config.dtype == "auto" else config.dtype
        return Placement(device, format_on_cpu, "none", tiles_decoder=False)
    quantize = _choose_quantization(model, config, free_bytes / GB)
    offload: str = config.offload
    if offload == "auto":
        offload = _choose_offload(model, free_bytes / GB, QUANTIZED_SHARE[quantize])
    dtype = model.dtype if config.dtype == "auto" else config.dtype
    return Placement(device, dtype, offload, tiles_decoder=offload != "none", quantize=quantize)


def _choose_quantization(model: VideoModel, config: DiffusersConfig, free_gb: float) -> str:
    """As many bits as keep whole parts on the GPU; layer by layer is slower by an order."""
    if config.quantize != "auto":
        return config.quantize
    if config.offload != "auto" or find_spec("bitsandbytes") is None:
        return "none"
    fitting = (
        bits
        for bits, share in QUANTIZED_SHARE.items()
        if _choose_offload(model, free_gb, share) != "sequential"
    )
    return next(fitting, "none")


def _choose_offload(model: VideoModel, free_gb: float, share: float) -> str:
    if free_gb >= (model.gpu_gb or ROOMY_GB) * share:
        return "none"
    if free_gb >= (model.offload_gb or SEQUENTIAL_BELOW_GB) * share:
        return "model"
    return "sequential"
