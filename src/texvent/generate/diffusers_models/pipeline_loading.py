"""Load a diffusers pipeline from a folder of its files, onto the device it will run on."""

from __future__ import annotations

import dataclasses
import inspect
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeAlias

from texvent._require import require
from texvent.errors import ConfigError, InputError
from texvent.generate.diffusers_models.adapter_loading import load_adapters
from texvent.generate.diffusers_models.device_placement import Placement
from texvent.generate.diffusers_models.guardrail import (
    GUARDRAIL_SWITCH,
    PART,
    check_wiring,
    load_guardrail,
    needs_guardrail,
)
from texvent.generate.diffusers_models.streamed_decoding import LTX
from texvent.generate.diffusers_models.torchvision_stub import install_torchvision_stub
from texvent.generate.video_models.adapters import AdapterFile
from texvent.generate.video_models.loading import loading, quiet_libraries
from texvent.generate.video_models.weight_files import read_pipeline_index

EXTRA = "generate"
Pipeline: TypeAlias = Any
"""diffusers.DiffusionPipeline; diffusers is imported only when a pipeline is loaded."""
DECODER = "vae"
TEXT_PARTS = ("text_encoder", "tokenizer")
MOTION_PIPELINE = "AnimateDiffPipeline"
"""Runs an image model with a motion adapter."""
QUANTIZED_PARTS = ("transformer", "transformer_2")
TILED_ONLY = ("AutoencoderKLAllegro",)
"""Decoders that diffusers runs in tiles only."""


_KEPT: dict[LoadRequest, Pipeline] = {}
"""At most one: a model of 14 billion weights leaves no room for another."""


@dataclass(frozen=True)
class LoadRequest:
    """What decides a loaded pipeline; equal requests share one."""

    folder: Path
    content: str
    """Digest of the files, so that changed ones are loaded again."""
    class_name: str | None
    """diffusers class, or None for the one the folder names."""
    placement: Placement
    decoder: Path | None
    """Folder of another decoder than the model's."""
    decoder_in_float32: bool
    motion_adapter: Path | None = None
    """Folder of the motion adapter of an image model."""
    adapters: tuple[AdapterFile, ...] = ()
    scheduler: tuple[tuple[str, Any], ...] = ()
    """Settings of the noise schedule beside the saved ones; "class": another diffusers class."""
    has_text_encoder: bool = True
    """False leaves the text encoder out: prompts come as embeddings."""


def resolve_device(wish: str, option: str = "generator_device") -> tuple[str, int | None]:
    """The device, and its free memory in bytes (None for a CPU).

    Args:
        wish: "auto", or a torch device such as "cuda:1".
        option: where the wish was given, for messages.

    Raises:
        ConfigError: there is no such device.
        MissingDependencyError: torch is not installed.
    """
    torch = require("torch", extra=EXTRA)
    if wish == "auto":
        wish = "cuda" if torch.cuda.is_available() else "cpu"
    try:
        device = torch.device(wish)
        torch.empty(1, device=device)
        free = int(torch.cuda.mem_get_info(device)[0]) if device.type == "cuda" else None
    except (RuntimeError, AssertionError) as error:
        reason = str(error).splitlines()[0]
        raise ConfigError(
            f"{option} is {wish!r}, which torch cannot use here ({reason}); "
            "allowed: auto, cpu, cuda, cuda:N, mps"
        ) from error
    return str(device), free


def load_pipeline(
    request: LoadRequest, announce: Callable[[str], None] = lambda line: None
) -> Pipeline:
    """The pipeline, in evaluation mode, placed as asked. The last one is kept for the next prompt.

    One that has a text encoder also serves requests without, so that a batch that mixes new and
    known prompts loads its model once.

    Args:
        request: what is loaded.
        announce: receives what of an adapter is left out.

    Raises:
        FileFormatError: a weight file does not fit its network.
        InputError: diffusers has no such class, or a file is missing.
        MissingDependencyError: a package is not installed.
    """
    kept = find_kept(request)
    if kept is None:
        forget_pipeline()  # before the next is loaded: memory holds one
        kept = _KEPT[request] = _load(request, announce)
    return kept


def find_kept(request: LoadRequest) -> Pipeline | None:
    """The pipeline for that request if it is loaded already, else None."""
    complete = dataclasses.replace(request, has_text_encoder=True)
    return _KEPT.get(request) or _KEPT.get(complete)


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
    with quiet_libraries():
        pipeline_class = getattr(require("diffusers", extra=EXTRA), name, None)
    if pipeline_class is None:
        raise InputError(
            f"{request.folder} needs the diffusers class {name}, which the installed diffusers "
            "does not have; install a newer one: pip install -U diffusers"
        )
    return pipeline_class


def _load(request: LoadRequest, announce: Callable[[str], None]) -> Pipeline:
    # By the class itself: DiffusionPipeline.from_pretrained ignores optional parts given to it.
    pipeline_class = find_pipeline_class(request)
    parts = _load_guardrail_part(pipeline_class, request)
    if not request.has_text_encoder:
        parts.update(dict.fromkeys(TEXT_PARTS))
    if request.decoder is not None:
        dtype = "float32" if request.decoder_in_float32 else request.placement.dtype
        parts[DECODER] = _load_network(request.decoder, dtype, "a decoder")
    if request.motion_adapter is not None:
        parts.update(_load_motion(request, request.motion_adapter))
    if request.placement.quantize != "none":
        parts["quantization_config"] = _quantization(request)
    pipe = _from_pretrained(pipeline_class, request, parts)
    if PART in parts:
        check_wiring(pipe)
    for note in load_adapters(pipe, request.adapters):
        announce(note)
    if request.scheduler:
        pipe.scheduler = _make_scheduler(pipe.scheduler, dict(request.scheduler))
    with quiet_libraries():
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
    install_torchvision_stub()
    has_switch = GUARDRAIL_SWITCH in inspect.signature(pipeline_class).parameters
    return {PART: load_guardrail(), **({GUARDRAIL_SWITCH: True} if has_switch else {})}


def _make_scheduler(saved: Any, settings: dict[str, Any]) -> Any:
    """A noise schedule with other settings than the saved one, or of another class."""
    name = settings.pop("class", None)
    kind = type(saved) if name is None else getattr(require("diffusers", extra=EXTRA), name)
    return kind.from_config(saved.config, **settings)


def _load_motion(request: LoadRequest, folder: Path) -> dict[str, Any]:
    """A motion adapter, and the noise schedule that it was trained with (its authors' example)."""
    scheduler = require("diffusers", extra=EXTRA).DDIMScheduler(
        beta_schedule="linear", steps_offset=1, clip_sample=False
    )
    adapter = _load_network(folder, request.placement.dtype, "a motion adapter")
    return {"motion_adapter": adapter, "scheduler": scheduler}


def _load_network(folder: Path, dtype: str, role: str) -> Any:
    """A network of any class that diffusers knows."""
    torch = require("torch", extra=EXTRA)
    with loading(folder, role):
        return require("diffusers", extra=EXTRA).AutoModel.from_pretrained(
            str(folder), dtype=getattr(torch, dtype), local_files_only=True, use_safetensors=True
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


def _quantization(request: LoadRequest) -> Any:
    index = read_pipeline_index(request.folder)
    parts = [part for part in QUANTIZED_PARTS if (index.get(part) or [None])[0] is not None]
    if not parts:
        raise ConfigError(
            f"quantize is {request.placement.quantize!r}, but {request.folder} has no video "
            "transformer, the only part that is quantised; give quantize='none'"
        )
    diffusers = require("diffusers", extra=EXTRA)
    require("bitsandbytes", extra="quantize")
    torch = require("torch", extra=EXTRA)
    if request.placement.quantize == "8bit":
        backend = "bitsandbytes_8bit"
        options: dict[str, Any] = {"load_in_8bit": True}
    else:
        backend = "bitsandbytes_4bit"
        options = {
            "load_in_4bit": True,
            "bnb_4bit_quant_type": "nf4",
            "bnb_4bit_compute_dtype": getattr(torch, request.placement.dtype),
        }
    return diffusers.PipelineQuantizationConfig(
        quant_backend=backend, quant_kwargs=options, components_to_quantize=parts
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
    is_tiled = placement.tiles_decoder or type(decoder).__name__ in TILED_ONLY
    if is_tiled and hasattr(decoder, "enable_tiling"):
        decoder.enable_tiling()
    if placement.tiles_decoder and type(decoder).__name__ == LTX:
        decoder.use_framewise_decoding = True
