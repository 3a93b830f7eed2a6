"""LoRA of `--lora`: its notation, and loading by diffusers' own call."""

from __future__ import annotations

import contextlib
import math
import re
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from texvent._require import require
from texvent.errors import ConfigError, FileFormatError, InputError, shown
from texvent.generate.video_models.loading import loading
from texvent.generate.video_models.model_files import HUB, REPOSITORY, check_safetensors
from texvent.networks.weight_files import SAFETENSORS

EXTRA = "generate"
Noise = Literal["high", "low"]
"""Which of two video transformers: that of the noisy beginning, or the other one."""
NOISES: dict[str, Noise] = {"high": "high", "low": "low"}
PARTS = ("transformer", "transformer_2", "connectors")
_HUB_NAME = re.compile(rf"{HUB}({REPOSITORY})(?:@([^/:]+))?(?:/([^:]+{re.escape(SAFETENSORS)}))?")
_WEIGHT = re.compile(r"[-+]?[\d.]+(?:[eE][-+]?\d+)?|[-+]?(?:inf|nan)")


@dataclass(frozen=True)
class Lora:
    """One value of `--lora`."""

    source: str
    """A file, or `hub:org/name[@revision][/file]`."""
    weight: float = 1.0
    noise: Noise | None = None

    @property
    def file(self) -> Path | None:
        """The local file; None for a repository of the hub."""
        return None if self.source.startswith(HUB) else Path(self.source).expanduser()

    def check_file(self) -> None:
        """Refuse a local file that is missing or damaged.

        Raises:
            InputError: there is no such file.
            FileFormatError: it is damaged.
        """
        path = self.file
        if path is None:
            return
        if not path.is_file() or path.suffix != SAFETENSORS:
            raise InputError(
                f"there is no LoRA {shown(str(path))}; give lora=FILE{SAFETENSORS}[:WEIGHT] or "
                f"{HUB}organisation/name[/FILE{SAFETENSORS}]"
            )
        check_safetensors(path)


def parse_lora(text: str) -> Lora:
    """A LoRA from `SOURCE[:WEIGHT][:high|:low]`, the last two in any order.

    Raises:
        ConfigError: it has another form.

    Example:
        >>> parse_lora("fast.safetensors:0.5")
        Lora(source='fast.safetensors', weight=0.5, noise=None)
        >>> parse_lora("hub:org/name/fast.safetensors:low").noise
        'low'
    """
    source = text
    weight: float | None = None
    noise: Noise | None = None
    for _ in range(2):
        head, _, tail = source.rpartition(":")
        if head and noise is None and tail.lower() in NOISES:
            source, noise = head, NOISES[tail.lower()]
        elif head and weight is None and _WEIGHT.fullmatch(tail):
            source, weight = head, math.nan
            with contextlib.suppress(ValueError):
                weight = float(tail)
    weight = 1.0 if weight is None else weight
    is_named = bool(_HUB_NAME.fullmatch(source)) or not source.startswith(HUB)
    if not source or source[0] == ":" or not math.isfinite(weight) or not is_named:
        raise ConfigError(
            f"lora is {shown(text)}; write FILE{SAFETENSORS} or {HUB}organisation/name[/FILE"
            f"{SAFETENSORS}], then :WEIGHT if it is not 1, such as fast{SAFETENSORS}:0.8"
        )
    return Lora(source, weight, noise)


def check_loras(loras: Sequence[Lora], pipeline_class: Any, *, has_two: bool) -> None:
    """Refuse LoRA that a pipeline cannot take; nothing is loaded.

    Args:
        loras: values of `--lora`.
        pipeline_class: diffusers class that runs the model.
        has_two: whether the model has a second video transformer, as Wan 2.2 14B.

    Raises:
        ConfigError: see above.
        MissingDependencyError: PEFT is not installed.
    """
    if not loras:
        return
    if not hasattr(pipeline_class, "load_lora_weights"):
        raise ConfigError(f"lora is set, but {pipeline_class.__name__} takes none")
    require("peft", extra=EXTRA)
    for one in loras:
        if has_two and one.noise is None:
            raise ConfigError(
                f"lora {one.source}: this model has two video transformers, for high and for low "
                "noise; add :high or :low"
            )
        if not has_two and one.noise is not None:
            raise ConfigError(
                f"lora {one.source}: this model has one video transformer; leave :{one.noise} out"
            )


def load_loras(pipe: Any, loras: Sequence[Lora]) -> None:
    """Load LoRA into a pipeline that is not placed yet, each with its weight.

    Args:
        pipe: of a class that `check_loras` passed.
        loras: in the order given.

    Raises:
        FileFormatError: a file fits no part of the pipeline.
    """
    adapters = {f"lora{number}": one for number, one in enumerate(loras)}
    for name, one in adapters.items():
        options: dict[str, Any] = {"load_into_transformer_2": True} if one.noise == "low" else {}
        where: str | Path | None = one.file
        hub = _HUB_NAME.fullmatch(one.source)
        if hub is not None:
            where, revision, file = hub.groups()
            options |= {"revision": revision, "weight_name": file}
        with loading(Path(one.source), f"a LoRA of {type(pipe).__name__}"), _quiet_peft():
            pipe.load_lora_weights(str(where), adapter_name=name, use_safetensors=True, **options)
        if not _parts_with(pipe, name):
            raise FileFormatError(f"{one.source} holds no LoRA for {type(pipe).__name__}")
    for part in {part for name in adapters for part in _parts_with(pipe, name)}:
        held = [name for name in adapters if part in _parts_with(pipe, name)]
        getattr(pipe, part).set_adapters(held, [adapters[name].weight for name in held])


def _parts_with(pipe: Any, name: str) -> list[str]:
    """Parts of a pipeline that hold an adapter of that name."""
    return [
        part
        for part in PARTS
        if name in (getattr(getattr(pipe, part, None), "peft_config", None) or {})
    ]


@contextlib.contextmanager
def _quiet_peft() -> Any:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # PEFT warns of several adapters
        yield
