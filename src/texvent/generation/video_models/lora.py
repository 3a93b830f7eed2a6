"""LoRA of `--lora` and of rows: notation, files, a look at their layers, loading by diffusers."""

from __future__ import annotations

import contextlib
import math
import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from texvent._require import require
from texvent.errors import ConfigError, FileFormatError, shown
from texvent.generation.video_models.model_files import find_file, loading, shapes_in
from texvent.networks import SAFETENSORS

if TYPE_CHECKING:
    from texvent.generation.video_models.config import VideoModel

EXTRA = "generate"
PARTS = ("transformer", "transformer_2")
"""Networks that the files of a row's LoRA belong to, in order."""
WAN_LAYERS = ("blocks.", "head.", "patch_embedding.", "text_embedding.", "time_", "img_emb.")
"""Beginnings of names of layers in Wan's own network."""


@dataclass(frozen=True)
class Lora:
    """One value of `--lora`, or one file of a row's LoRA."""

    file: Path
    weight: float = 1.0
    part: str = PARTS[0]
    """Network that it belongs to."""


def parse_lora(text: str) -> Lora:
    """A LoRA from `FILE[:WEIGHT]`.

    Raises:
        ConfigError: it has another form.

    Example:
        >>> parse_lora("fast.safetensors:0.5").weight
        0.5
    """
    file, _, tail = text.rpartition(":")
    try:
        weight = float(tail)
    except ValueError:
        file, weight = text, 1.0
    if not file.endswith(SAFETENSORS) or not math.isfinite(weight):
        raise ConfigError(
            f"lora is {shown(text)}; write FILE{SAFETENSORS}, then :WEIGHT if it is not 1, such as "
            f"fast{SAFETENSORS}:0.8"
        )
    return Lora(Path(file).expanduser(), weight)


def find_row_loras(
    model: VideoModel, announce: Callable[[str], None] | None = None
) -> tuple[Lora, ...] | None:
    """The files of a row's LoRA; None: some are not here, and none may be fetched.

    A folder of a model holds them beside its parts.

    Args:
        model: the row.
        announce: told before a download; None: nothing is fetched.

    Raises:
        InputError: the model's folder lacks one.
        TexventError: one is not here and cannot be fetched.
    """
    found = []
    for name, part in zip(model.loras, PARTS, strict=False):
        path = find_file(model, name, "LoRA", announce)
        if path is None:
            return None
        found.append(Lora(path, part=part))
    return tuple(found)


def check_loras(loras: Sequence[Lora], pipeline_class: Any, folder: Path) -> None:
    """Refuse LoRA that a pipeline cannot take, or that belong to another model.

    Only the LoRA themselves and the names and shapes of the model's weights are read.

    Raises:
        ConfigError: the pipeline class has no call that loads one.
        FileFormatError: a file fits no layer of the model, or has layers of another size.
        MissingDependencyError: PEFT is not installed.
    """
    if not loras:
        return
    if not hasattr(pipeline_class, "load_lora_weights"):
        raise ConfigError(f"lora is set, but {pipeline_class.__name__} takes none")
    require("peft", extra=EXTRA)
    for one in loras:
        role = f"a LoRA of {pipeline_class.__name__}"
        with loading(one.file, role):
            tensors = pipeline_class.lora_state_dict(
                _named(one.file, pipeline_class), use_safetensors=True
            )
        fault = _find_misfit(tensors, _shapes_of(folder / one.part))
        if fault is not None:
            raise FileFormatError(f"{one.file} cannot be loaded as {role}: {fault} of {folder}")


def _named(file: Path, pipeline_class: Any) -> str | dict[str, Any]:
    """A LoRA as diffusers knows it: the file; its tensors, where names of Wan's lack the prefix.

    Wan2.2-Lightning's own program reads either (wan/utils/utils.py); diffusers knows one.
    """
    load_file = require("safetensors.torch", extra=EXTRA).load_file
    if not pipeline_class.__name__.startswith("Wan"):
        return str(file)
    tensors = load_file(file)
    if not all(name.startswith(WAN_LAYERS) for name in tensors):
        return str(file)
    return {f"diffusion_model.{name}": tensor for name, tensor in tensors.items()}


def _find_misfit(tensors: dict[str, Any], shapes: dict[str, tuple[int, ...] | None]) -> str | None:
    """Why a LoRA, by the names of diffusers, is of another network."""
    layers: dict[str, dict[str, Any]] = {}
    for name, tensor in tensors.items():
        layer, is_factor, letter = name.removeprefix(f"{PARTS[0]}.").partition(".lora_")
        if is_factor and letter.endswith("weight"):
            layers.setdefault(layer, {})[letter[:1]] = tensor
    known = {name: factors for name, factors in layers.items() if f"{name}.weight" in shapes}
    if not known:
        return f"none of its {len(layers)} layers is one"
    for name, factors in known.items():
        shape = shapes[f"{name}.weight"]
        if shape is None or set(factors) != {"A", "B"} or len(shape) != 2:
            continue
        made = factors["B"].shape[0], factors["A"].shape[-1]
        if made != shape:
            return (
                f"layer {name} is {made[0]}x{made[1]} in it, and not {shape[0]}x{shape[1]} as that"
            )
    return None


def _shapes_of(folder: Path) -> dict[str, tuple[int, ...] | None]:
    """Name of each weight of a network → its shape; None where that is packed."""
    found: dict[str, tuple[int, ...] | None] = {}
    for file in sorted(folder.glob(f"*{SAFETENSORS}")):
        found |= shapes_in(file)
    return found


def load_loras(pipe: Any, loras: Sequence[Lora]) -> None:
    """Load LoRA into a pipeline that is not placed yet, each with its weight.

    Raises:
        FileFormatError: a file fits no part of the pipeline.
    """
    weights: dict[str, float] = {}
    for number, one in enumerate(loras):
        name = f"lora{number}"
        weights[name] = one.weight
        place = {} if one.part == PARTS[0] else {f"load_into_{one.part}": True}
        with loading(one.file, f"a LoRA of {type(pipe).__name__}"), _quiet_peft():
            source = _named(one.file, type(pipe))
            pipe.load_lora_weights(source, adapter_name=name, use_safetensors=True, **place)
            # Also refuses a file that fitted no part, which has no adapter now.
            pipe.set_adapters(list(weights), list(weights.values()))


@contextlib.contextmanager
def _quiet_peft() -> Iterator[None]:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # PEFT warns of several adapters
        yield
