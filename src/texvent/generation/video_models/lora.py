"""LoRA of `--lora`: its notation, and loading by diffusers' own call."""

from __future__ import annotations

import contextlib
import math
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from texvent._require import require
from texvent.errors import ConfigError, shown
from texvent.generation.video_models.model_files import loading
from texvent.networks import SAFETENSORS

EXTRA = "generate"


@dataclass(frozen=True)
class Lora:
    """One value of `--lora`."""

    file: Path
    weight: float = 1.0


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


def check_loras(loras: Sequence[Lora], pipeline_class: Any) -> None:
    """Refuse LoRA that a pipeline cannot take; nothing is loaded.

    Raises:
        ConfigError: the pipeline class has no call that loads one.
        MissingDependencyError: PEFT is not installed.
    """
    if not loras:
        return
    if not hasattr(pipeline_class, "load_lora_weights"):
        raise ConfigError(f"lora is set, but {pipeline_class.__name__} takes none")
    require("peft", extra=EXTRA)


def load_loras(pipe: Any, loras: Sequence[Lora]) -> None:
    """Load LoRA into a pipeline that is not placed yet, each with its weight.

    Raises:
        FileFormatError: a file fits no part of the pipeline.
    """
    weights: dict[str, float] = {}
    for number, one in enumerate(loras):
        name = f"lora{number}"
        weights[name] = one.weight
        with loading(one.file, f"a LoRA of {type(pipe).__name__}"), _quiet_peft():
            pipe.load_lora_weights(str(one.file), adapter_name=name, use_safetensors=True)
            # Also refuses a file that fitted no part, which has no adapter now.
            pipe.set_adapters(list(weights), list(weights.values()))


@contextlib.contextmanager
def _quiet_peft() -> Iterator[None]:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # PEFT warns of several adapters
        yield
