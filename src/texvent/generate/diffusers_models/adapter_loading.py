"""Put adapters (LoRA) into a loaded pipeline, and see that every tensor of them found its place.

An adapter adds weight · scale · B·A to matrices W of the video transformer. Names of other trainers
(Wan's own, Kohya's, musubi-tuner's) are translated by diffusers, those of a PEFT folder here.
"""

from __future__ import annotations

import inspect
import json
import math
import re
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from texvent._require import require
from texvent.errors import ConfigError, FileFormatError, InputError
from texvent.generate.video_config import DiffusersConfig
from texvent.generate.video_models.adapters import PEFT_CONFIG, Adapter, AdapterFile
from texvent.generate.video_models.hub_names import HUB
from texvent.generate.video_models.loading import loading
from texvent.networks.weight_files import Tensor

EXTRA = "generate"
PARTS = ("transformer", "transformer_2", "unet", "text_encoder", "connectors")
"""Parts of a pipeline that adapters may change."""
PEFT_PREFIX = "base_model.model."
LEFT_OUT = (".diff", ".diff_b")
"""Differences of norms and biases beside the matrices; diffusers leaves some of them out."""
FEW_STEPS = re.compile(
    r"(?i)(?<!\d)\d{1,2}[ _-]?steps?"
    r"|lightning|lightx2v|distill|turbo|causvid|accvid|(?<![a-z])(?:lcm|dmd)"
)
"""Words in the names of adapters that make a model need few steps."""
MANY_STEPS = 10
GUIDED = 1.0
"""Guidance above which every step takes a second pass, which those adapters do without."""


def check_adapters(
    adapters: Sequence[Adapter], pipeline_class: Any, index: Mapping[str, Any]
) -> None:
    """Refuse adapters that a pipeline cannot take; nothing is loaded.

    Args:
        adapters: what `--lora` says.
        pipeline_class: diffusers class that runs the model.
        index: `model_index.json` of the model.

    Raises:
        ConfigError: see above.
        MissingDependencyError: PEFT is not installed.
    """
    if not adapters:
        return
    if not hasattr(pipeline_class, "load_lora_weights"):
        raise ConfigError(f"lora is set, but {pipeline_class.__name__} takes no adapters")
    require("peft", extra=EXTRA)
    entry = index.get("transformer_2")
    has_two = isinstance(entry, list) and entry[0] is not None
    for one in adapters:
        if has_two and one.noise_or_name is None:
            raise ConfigError(
                f"lora {one.source}: this model has two video transformers, for high and for low "
                "noise, and the file's name does not say which it is for; add :high or :low"
            )
        if not has_two and one.noise is not None:
            raise ConfigError(
                f"lora {one.source}: this model has one video transformer; leave :{one.noise} out"
            )


def load_adapters(pipe: Any, files: Sequence[AdapterFile]) -> list[str]:
    """Load adapters into a pipeline that is not placed yet, each with its weight.

    Args:
        pipe: of a class that `check_adapters` passed.
        files: the adapters, in the order given.

    Returns:
        What to tell the user: tensors that diffusers leaves out.

    Raises:
        FileFormatError: a file is no adapter, or one of its tensors fits nothing.
    """
    notes: list[str] = []
    by_part: dict[str, list[tuple[str, float]]] = {}
    for number, file in enumerate(files):
        name = f"adapter{number}"
        has_two = getattr(pipe, "transformer_2", None) is not None
        is_second = has_two and file.adapter.noise_or_name == "low"
        second = {"load_into_transformer_2": True} if is_second else {}
        notes += _load(pipe, file.path, name, second)
        for part in _parts_with(pipe, name):
            by_part.setdefault(part, []).append((name, file.adapter.weight))
    for part, loaded in by_part.items():
        names, weights = zip(*loaded, strict=True)
        _set_weights(getattr(pipe, part), list(names), list(weights))
    return notes


def describe_few_steps(
    adapters: Iterable[Adapter], pipeline_class: Any, config: DiffusersConfig
) -> str | None:
    """A hint where an adapter's name says few steps and the call will make many, or None."""
    names = [one.source for one in adapters]
    names = [name if name.startswith(HUB) else Path(name).name for name in names]
    names = [name for name in names if FEW_STEPS.search(name)]
    accepted = inspect.signature(pipeline_class.__call__).parameters
    used = {"steps": config.steps, "guidance": config.guidance}
    for option, argument in (("steps", "num_inference_steps"), ("guidance", "guidance_scale")):
        if used[option] is None and argument in accepted:
            used[option] = accepted[argument].default
    steps, guidance = used["steps"] or 0, used["guidance"] or 0
    if not names or (steps <= MANY_STEPS and guidance <= GUIDED):
        return None
    return (
        f"{names[0]} is named like an adapter for few steps, most of which want steps=4 to 8 and "
        f"guidance=1; now: {steps:g} steps, guidance {guidance:g}"
    )


def _load(pipe: Any, path: Path, name: str, options: Mapping[str, Any]) -> list[str]:
    tensors = _read(path)
    given: Any = _from_peft(path, tensors)
    where: dict[str, Any] = {}
    if given is None:
        # The file itself: its header may hold the scale.
        given = str(path.parent)
        where = {"weight_name": path.name, "local_files_only": True, "use_safetensors": True}
    with loading(path, f"an adapter of {type(pipe).__name__}"), warnings.catch_warnings():
        # PEFT warns of several adapters, and of keys that are checked below.
        warnings.simplefilter("ignore", UserWarning)
        known = pipe.lora_state_dict(given, **where)
        pipe.load_lora_weights(given, adapter_name=name, **where, **options)
    known = known[0] if isinstance(known, tuple) else known
    if not known:
        raise FileFormatError(f"{path} holds no adapter (LoRA)")
    _check_placed(pipe, path, known, name, is_second=bool(options))
    lost = [key for key in tensors if key.endswith(LEFT_OUT)]
    missing = sum(not key.endswith(".alpha") for key in tensors) - len(known)
    if missing > len(lost):
        raise FileFormatError(f"{path}: {missing} of its {len(tensors)} tensors fit nothing")
    if missing <= 0:
        return []
    return [
        f"{path.name}: diffusers leaves {missing} of {len(tensors)} tensors out, differences of "
        "norms and biases"
    ]


def _read(path: Path) -> dict[str, Tensor]:
    with loading(path, "an adapter"):
        return dict(require("safetensors.torch", extra=EXTRA).load_file(str(path)))


def _from_peft(path: Path, tensors: Mapping[str, Tensor]) -> dict[str, Tensor] | None:
    """The tensors of a folder that PEFT saved, scaled, by diffusers' names; None for other files.

    Raises:
        InputError: its configuration is missing, or asks for more than a scale.
    """
    if not tensors or not all(name.startswith(PEFT_PREFIX) for name in tensors):
        return None
    config_path = path.parent / PEFT_CONFIG
    try:
        config = json.loads(config_path.read_text(encoding="utf-8"))
        alpha = float(config["lora_alpha"])
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise InputError(
            f"{path} was saved by PEFT, which keeps its scale in {config_path}; put that file there"
        ) from error
    if config.get("use_dora") or config.get("alpha_pattern"):
        raise InputError(f"{path} is no plain adapter (DoRA, or scales by layer); merge it first")
    scaled = {}
    for name, tensor in tensors.items():
        first = tensors.get(name.replace(".lora_B.", ".lora_A."))
        if ".lora_B." in name and first is not None:
            rank = len(first)
            tensor = tensor * (alpha / (math.sqrt(rank) if config.get("use_rslora") else rank))
        scaled[f"transformer.{name.removeprefix(PEFT_PREFIX)}"] = tensor
    return scaled


def _parts_with(pipe: Any, name: str) -> list[str]:
    """Parts that hold an adapter of that name."""
    return [
        part
        for part in PARTS
        if name in (getattr(getattr(pipe, part, None), "peft_config", None) or {})
    ]


def _check_placed(
    pipe: Any, path: Path, known: Mapping[str, Tensor], name: str, *, is_second: bool
) -> None:
    """Refuse an adapter of which a tensor, by diffusers' names, is nowhere in the pipeline.

    Raises:
        FileFormatError: see above.
    """
    peft_names: Callable[[Any], Any]
    peft_names = require("diffusers.utils", extra=EXTRA).convert_unet_state_dict_to_peft
    if not any(".lora_A." in key for key in known):
        known = peft_names(known)
    placed = set()
    for part in _parts_with(pipe, name):
        prefix = "transformer" if part == "transformer_2" and is_second else part
        for key, _ in getattr(pipe, part).named_parameters():
            if f".{name}." in key:
                placed.add(f"{prefix}.{key.replace(f'.{name}.', '.')}")
    lost = sorted(set(known) - placed)
    if lost:
        raise FileFormatError(
            f"{path} does not fit {type(pipe).__name__}: {len(lost)} of its {len(known)} tensors "
            f"fit nothing, such as {lost[0]}"
        )
    if half := sorted(placed - set(known)):
        raise FileFormatError(f"{path} is damaged: it lacks {half[0]}")


def _set_weights(part: Any, names: list[str], weights: list[float]) -> None:
    if hasattr(part, "set_adapters"):
        part.set_adapters(names, weights)
    else:  # a text encoder, of transformers
        base = require("diffusers.loaders.lora_base", extra=EXTRA)
        base.set_adapters_for_text_encoder(names, part, weights)
