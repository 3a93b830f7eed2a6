"""LoRA of `--lora`: its notation, and loading by diffusers' own call."""

from __future__ import annotations

import contextlib
import math
import re
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from texvent._require import require
from texvent.errors import ConfigError, InputError, shown
from texvent.generate.video_models.loading import loading
from texvent.generate.video_models.model_files import HUB, REPOSITORY
from texvent.networks.weight_files import SAFETENSORS

EXTRA = "generate"
_HUB_NAME = re.compile(rf"{HUB}({REPOSITORY})(?:@([^/:]+))?(?:/([^:]+{re.escape(SAFETENSORS)}))?")
_WEIGHT = re.compile(r"[-+]?[\d.]+(?:[eE][-+]?\d+)?|[-+]?(?:inf|nan)")


@dataclass(frozen=True)
class Lora:
    """One value of `--lora`."""

    source: str
    """A file, or `hub:org/name[@revision][/file]`."""
    weight: float = 1.0

    @property
    def file(self) -> Path | None:
        """The local file; None for a repository of the hub."""
        return None if self.source.startswith(HUB) else Path(self.source).expanduser()

    def check_file(self) -> None:
        """Refuse a local file that is missing.

        Raises:
            InputError: there is no such file.
        """
        path = self.file
        if path is not None and not (path.is_file() and path.suffix == SAFETENSORS):
            raise InputError(
                f"there is no LoRA {shown(str(path))}; give lora=FILE{SAFETENSORS}[:WEIGHT] or "
                f"{HUB}organisation/name[/FILE{SAFETENSORS}]"
            )


def parse_lora(text: str) -> Lora:
    """A LoRA from `SOURCE[:WEIGHT]`.

    Raises:
        ConfigError: it has another form.

    Example:
        >>> parse_lora("fast.safetensors:0.5")
        Lora(source='fast.safetensors', weight=0.5)
    """
    source, weight = text, 1.0
    head, _, tail = text.rpartition(":")
    if head and _WEIGHT.fullmatch(tail):
        source, weight = head, math.nan
        with contextlib.suppress(ValueError):
            weight = float(tail)
    is_named = bool(_HUB_NAME.fullmatch(source)) or not source.startswith(HUB)
    if not source or source[0] == ":" or not math.isfinite(weight) or not is_named:
        raise ConfigError(
            f"lora is {shown(text)}; write FILE{SAFETENSORS} or {HUB}organisation/name[/FILE"
            f"{SAFETENSORS}], then :WEIGHT if it is not 1, such as fast{SAFETENSORS}:0.8"
        )
    return Lora(source, weight)


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
        hub = _HUB_NAME.fullmatch(one.source)
        where, revision, file = hub.groups() if hub else (str(one.file), None, None)
        options = {} if hub is None else {"revision": revision, "weight_name": file}
        with loading(Path(one.source), f"a LoRA of {type(pipe).__name__}"), _quiet_peft():
            pipe.load_lora_weights(where, adapter_name=name, use_safetensors=True, **options)
            # Also refuses a file that fitted no part, which has no adapter now.
            pipe.set_adapters(list(weights), list(weights.values()))


@contextlib.contextmanager
def _quiet_peft() -> Iterator[None]:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # PEFT warns of several adapters
        yield
