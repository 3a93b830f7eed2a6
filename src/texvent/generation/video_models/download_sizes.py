"""Sizes of the files that a model would fetch, told by the model hub; no weights are fetched."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Collection
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING, Any

from texvent._require import require
from texvent.generation.diffusers_models.modular import MODULAR
from texvent.generation.video_models.controls import NAMES
from texvent.generation.video_models.model_files import INDEX
from texvent.networks import SAFETENSORS

if TYPE_CHECKING:
    from texvent.generation.video_models.config import VideoModel

EXTRA = "generate"
TIMEOUT_S = 10.0
GB = 1e9


def with_sizes(model: VideoModel, control: str | None) -> VideoModel:
    """The row, with the sizes of its files that the model hub tells in place of its own.

    Args:
        model: a row, or a repository of the model hub.
        control: kind of control video, for models whose network of it lies elsewhere.
    """
    hub = require("huggingface_hub", extra=EXTRA)
    # A base of its errors is that of the library by which it asks.
    known = require("huggingface_hub.errors", extra=EXTRA)
    errors = (*known.HfHubHTTPError.__bases__, ValueError)
    try:
        main = _sizes(hub, model.repo, model.revision)
        own = MODULAR.get(model.pipeline or "")
        if own is not None:
            parts: Collection[str] = own.parts
        else:
            index = Path(hub.hf_hub_download(model.repo, INDEX, revision=model.revision))
            entries = json.loads(index.read_text(encoding="utf-8"))
            parts = {name for name, one in entries.items() if isinstance(one, list) and one[0]}
        total = sum(size for name, size in main.items() if _is_needed(name, parts))
        if model.control_revision and control is not None:
            branch = model.control_revision.format(NAMES[control])
            total += sum(_sizes(hub, model.repo, branch).values())
        total += sum(_size_of(hub, name) for name in model.upscalers)
        lora = sum(_size_of(hub, name) for name in model.loras) or None
    except (*errors, LookupError):  # a file that is not there
        return model
    return dataclasses.replace(
        model,
        download_gb=_rounded(total) or model.download_gb,
        lora_gb=_rounded(lora) or model.lora_gb,
    )


def _is_needed(name: str, parts: Collection[str]) -> bool:
    """Whether a file is of a part; names of further number formats have a dot more."""
    path = PurePosixPath(name)
    return path.parts[0] in parts and len(path.parts) > 1 and "." not in path.stem


def _sizes(hub: Any, repo: str, revision: str | None) -> dict[str, int]:
    """Name of every file of weights → bytes."""
    told = hub.HfApi().model_info(repo, revision=revision, files_metadata=True, timeout=TIMEOUT_S)
    return {
        one.rfilename: one.size or 0 for one in told.siblings if one.rfilename.endswith(SAFETENSORS)
    }


def _size_of(hub: Any, name: str) -> int:
    """Bytes of one file, `organisation/name/path`."""
    organisation, repo, file = name.split("/", 2)
    return _sizes(hub, f"{organisation}/{repo}", None)[file]


def _rounded(size: int | None) -> float | None:
    """Bytes as GB, to three digits."""
    return None if not size else float(f"{size / GB:.3g}")
