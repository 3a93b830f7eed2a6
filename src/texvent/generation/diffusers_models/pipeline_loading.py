"""Load a diffusers pipeline from a folder of its files, onto the device it will run on."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeAlias

from texvent._require import install_command, require
from texvent.errors import ConfigError, FileFormatError, InputError
from texvent.generation.diffusers_models.guardrail import (
    GUARDRAIL_SWITCH,
    PART,
    check_wiring,
    load_guardrail,
    needs_guardrail,
)
from texvent.generation.diffusers_models.modular import find_class
from texvent.generation.video_models.config import DiffusersConfig, VideoModel
from texvent.generation.video_models.lora import Lora, load_loras
from texvent.generation.video_models.model_files import loading, read_pipeline_index, without_bars
from texvent.generation.video_models.upscalers import load_upscaler

EXTRA = "generate"
Pipeline: TypeAlias = Any
"""diffusers.DiffusionPipeline; diffusers is imported only when a pipeline is loaded."""
DECODER = "vae"
GB = 1e9
SEQUENTIAL_BELOW_GB = 9.0
"""Free GPU memory below which even one whole part of a common model does not fit."""
ROOMY_GB = 75.0
"""Free GPU memory above which a model of unknown needs is put on the device as a whole."""


@dataclass(frozen=True)
class Placement:
    """Loading of a pipeline."""

    device: str
    dtype: str
    offload: str
    """"none", "model" or "sequential"."""
    tiles_decoder: bool
    """Decode in tiles: less memory, faint differences where tiles meet."""

    def describe(self) -> str:
        """Device, number format and memory savings, for messages."""
        saved = "" if self.offload == "none" else f", offload {self.offload}"
        return f"{self.device}, {self.dtype}{saved}"


_KEPT: dict[LoadRequest, Pipeline] = {}
"""At most one: a model of 14 billion weights leaves no room for another."""


@dataclass(frozen=True)
class LoadRequest:
    """Facts that decide a loaded pipeline; equal requests share one."""

    folder: Path
    content: str
    """Digest of the files, so that changed ones are loaded again."""
    class_name: str | None
    """diffusers class, or None for the one the folder names."""
    placement: Placement
    decoder_in_float32: bool = False
    loras: tuple[Lora, ...] = ()
    scheduler: tuple[tuple[str, Any], ...] = ()
    """Settings of the noise schedule that replace the saved ones."""
    parts: tuple[tuple[str, Path], ...] = ()
    """Name and folder, or file, of networks that lie elsewhere."""


def load_pipeline(request: LoadRequest, announce: Callable[[str], None] | None = None) -> Pipeline:
    """The pipeline, in evaluation mode, placed as asked. The last one is kept for the next prompt.

    Raises:
        FileFormatError: a weight file does not fit its network.
        InputError: diffusers has no such class, or a file is missing.
        MissingDependencyError: a package is not installed.
    """
    if request not in _KEPT:
        forget_pipeline()  # before the next is loaded: memory holds one
        if announce is not None:
            announce(f"loading {request.folder} ({request.placement.describe()})")
        _KEPT[request] = _load(request)
    return _KEPT[request]


def resolve_device(name: str = "auto", option: str = "device") -> tuple[str, int | None]:
    """Device, and its free memory in bytes (None for a CPU).

    Args:
        name: "auto" (a GPU that torch finds, else the CPU), or a torch device such as "cuda:1".
        option: option that named it, for messages.

    Raises:
        ConfigError: there is no such device.
        MissingDependencyError: torch is not installed.
    """
    torch = require("torch", extra=EXTRA)
    if name == "auto":
        name = "cuda" if torch.cuda.is_available() else "cpu"
    try:
        device = torch.device(name)
        torch.empty(1, device=device)
        free = int(torch.cuda.mem_get_info(device)[0]) if device.type == "cuda" else None
    except (RuntimeError, AssertionError) as error:
        reason = str(error).splitlines()[0]
        raise ConfigError(
            f"{option} is {name!r}, which torch cannot use here ({reason}); "
            "allowed: auto, cpu, cuda, cuda:N, mps"
        ) from error
    return str(device), free


def place(
    model: VideoModel, config: DiffusersConfig, device: str, free_bytes: int | None
) -> Placement:
    """Choose the placement that is fastest and fits; what the user set is kept.

    Args:
        model: the model and its memory needs.
        config: options; "auto" leaves the choice open.
        device: resolved device, such as "cpu" or "cuda:0".
        free_bytes: free memory of the GPU, or None on a CPU.

    Raises:
        ConfigError: `offload` needs a GPU and there is none.
    """
    if free_bytes is None:
        if config.offload not in ("auto", "none"):
            raise ConfigError(
                f"offload is {config.offload!r}, which needs a GPU, but the video is made on "
                f"{device}; leave --offload out"
            )
        return Placement(device, "float32", "none", tiles_decoder=False)
    offload: str = config.offload
    if offload == "auto":
        free_gb = free_bytes / GB
        offload = "model" if free_gb >= (model.offload_gb or SEQUENTIAL_BELOW_GB) else "sequential"
        offload = "none" if free_gb >= (model.gpu_gb or ROOMY_GB) else offload
    return Placement(device, model.dtype, offload, tiles_decoder=offload != "none")


def forget_pipeline() -> None:
    """Release the pipeline that `load_pipeline` keeps."""
    _KEPT.clear()


def find_pipeline_class(request: LoadRequest) -> Any:
    """The diffusers class that runs the model; nothing of the model is loaded.

    Raises:
        InputError: the installed diffusers has no such class.
        MissingDependencyError: diffusers is not installed.
    """
    name = request.class_name or str(read_pipeline_index(request.folder)["_class_name"])
    pipeline_class = find_class(name)
    if pipeline_class is None:
        raise InputError(
            f"{request.folder} needs the diffusers class {name}, which the installed diffusers "
            f"does not have; install a newer one: {install_command('-U', 'diffusers')}"
        )
    return pipeline_class


def _load(request: LoadRequest) -> Pipeline:
    # By the class itself: DiffusionPipeline.from_pretrained ignores optional parts given to it.
    pipeline_class = find_pipeline_class(request)
    parts = _load_guardrail_part(pipeline_class, request)
    parts |= {name: _load_network(path, request) for name, path in request.parts}
    pipe = _from_pretrained(pipeline_class, request, parts)
    _check_embeddings(pipe, request.folder)
    if PART in parts:
        check_wiring(pipe)
    load_loras(pipe, request.loras)
    if request.scheduler:
        saved = pipe.scheduler
        pipe.scheduler = type(saved).from_config(saved.config, **dict(request.scheduler))
    with without_bars():
        place_pipeline(pipe, request.placement)
    for part in pipe.components.values():
        # A text encoder in training mode drops units at random.
        if hasattr(part, "eval") and callable(part.eval):
            part.eval()
    pipe.set_progress_bar_config(disable=True)
    return pipe


def _load_guardrail_part(pipeline_class: Any, request: LoadRequest) -> dict[str, Any]:
    """The guardrail, for models that must not run without it."""
    if not needs_guardrail(read_pipeline_index(request.folder)):
        return {}
    has_switch = GUARDRAIL_SWITCH in inspect.signature(pipeline_class).parameters
    return {PART: load_guardrail(), **({GUARDRAIL_SWITCH: True} if has_switch else {})}


def _load_network(folder: Path, request: LoadRequest) -> Any:
    """A network with a folder of its own, such as a ControlNet, or an upscaler's file."""
    kind = require("diffusers", extra=EXTRA).AutoModel
    dtype = getattr(require("torch", extra=EXTRA), request.placement.dtype)
    if folder.is_file():
        return load_upscaler(folder, dtype)
    with loading(folder, "a network"):
        return kind.from_pretrained(
            str(folder), dtype=dtype, local_files_only=True, use_safetensors=True
        )


def _from_pretrained(pipeline_class: Any, request: LoadRequest, parts: dict[str, Any]) -> Pipeline:
    torch = require("torch", extra=EXTRA)
    dtype: Any = getattr(torch, request.placement.dtype)
    if request.decoder_in_float32 and dtype is not torch.float32:
        dtype = {"default": dtype, DECODER: torch.float32}
    with loading(request.folder, pipeline_class.__name__):
        return pipeline_class.from_pretrained(
            str(request.folder), dtype=dtype, local_files_only=True, use_safetensors=True, **parts
        )


def _check_embeddings(pipe: Pipeline, folder: Path) -> None:
    """Refuse words that all mean nothing: transformers before 5.3 loses UMT5's embeddings."""
    torch = require("torch", extra=EXTRA)
    for name, part in pipe.components.items():
        for module in part.modules() if isinstance(part, torch.nn.Module) else ():
            if isinstance(module, torch.nn.Embedding) and not bool(module.weight.any()):
                raise FileFormatError(
                    f"{folder}: an embedding of {name} is all 0, so no word would count; install "
                    f"the latest transformers ({install_command('-U', 'transformers')}), or fetch "
                    "the model again"
                )


def place_pipeline(pipe: Pipeline, placement: Placement) -> None:
    """Bring a pipeline to its device, whole or part by part."""
    if placement.offload == "model":
        pipe.enable_model_cpu_offload(device=placement.device)
    elif placement.offload == "sequential":
        pipe.enable_sequential_cpu_offload(device=placement.device)
    else:
        pipe.to(placement.device)
    decoder: Any = getattr(pipe, DECODER, None)
    if placement.tiles_decoder and hasattr(decoder, "enable_tiling"):
        decoder.enable_tiling()
