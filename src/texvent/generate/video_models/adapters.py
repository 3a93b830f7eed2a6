"""Adapters (LoRA) that `--lora` names: how they are written, and where their files are."""

from __future__ import annotations

import contextlib
import hashlib
import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import Any, Literal

from texvent._require import require
from texvent.errors import ConfigError, InputError, TexventError, one_line, shown
from texvent.generate.video_models.hub_names import HUB, REPOSITORY
from texvent.generate.video_models.weight_files import PICKLES, check_safetensors
from texvent.networks.weight_files import SAFETENSORS, describe_file

EXTRA = "generate"
Noise = Literal["high", "low"]
"""Of two video transformers: the one for the noisy beginning, or the one for the rest."""
NOISES: dict[str, Noise] = {"high": "high", "low": "low"}
PEFT_NAME = "adapter_model.safetensors"
SAVED_NAMES = ("pytorch_lora_weights.safetensors", PEFT_NAME)
"""What diffusers and PEFT call the weights of an adapter in a folder."""
PEFT_CONFIG = "adapter_config.json"
"""File beside the weights in which PEFT keeps their scale."""
_HUB_NAME = re.compile(rf"{HUB}({REPOSITORY})(?:@([^/:]+))?(?:/([^:]+))?")
_WEIGHT = re.compile(r"[-+]?[\d.]+(?:[eE][-+]?\d+)?|[-+]?(?:inf|nan)")
_NOISE = re.compile(r"(?i:(high|low)[ _-]?noise)|(?<![A-Za-z])(HIGH|LOW)(?![A-Za-z])")
"""How files say which transformer they are for: high_noise_model, ..._HIGH_fp16."""


@dataclass(frozen=True)
class Adapter:
    """One value of `--lora`."""

    source: str
    """A file, a folder, or `hub:org/name[@revision][/file]`."""
    weight: float = 1.0
    noise: Noise | None = None
    """Which of two transformers it is for, if that was said."""

    @property
    def noise_or_name(self) -> Noise | None:
        """`noise`, or what the file's name says."""
        named = _NOISE.search(PurePosixPath(self.source).name)
        said = "" if named is None else (named[1] or named[2]).lower()
        return self.noise or NOISES.get(said)


@dataclass(frozen=True)
class AdapterFile:
    """An adapter whose file is on this machine and was checked."""

    path: Path
    sha256: str
    """See `digest_adapter`."""
    adapter: Adapter

    @property
    def facts(self) -> dict[str, Any]:
        """For the provenance of a video."""
        one = self.adapter
        facts = {"source": one.source, "sha256": self.sha256, "weight": one.weight}
        return facts if one.noise is None else {**facts, "noise": one.noise}


def parse_adapter(text: str) -> Adapter:
    """What `--lora` says: `SOURCE[:WEIGHT][:high|:low]`, the last two in any order.

    Raises:
        ConfigError: it is empty, of a wrong form, or names a pickle.

    Example:
        >>> parse_adapter("fast.safetensors:0.5")
        Adapter(source='fast.safetensors', weight=0.5, noise=None)
        >>> parse_adapter("hub:org/name/high_noise_model.safetensors").noise_or_name
        'high'
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
    if not source or source[0] == ":" or not math.isfinite(weight):
        raise ConfigError(
            f"lora is {shown(text)}; write FILE or FILE:WEIGHT, such as fast.safetensors:0.8"
        )
    if source.startswith(HUB) and not _HUB_NAME.fullmatch(source):
        raise ConfigError(
            f"lora {shown(source)} names no repository or file; write {HUB}organisation/name or "
            f"{HUB}organisation/name/file.safetensors, then :WEIGHT"
        )
    if PurePosixPath(source).suffix in PICKLES:
        raise ConfigError(
            f"lora {shown(source)} is a pickle, which can run code when it is read; texvent reads "
            f"adapters from {SAFETENSORS} only"
        )
    return Adapter(source, weight, noise)


def find_local(adapter: Adapter) -> Path | None:
    """The file of an adapter that names a file or folder, checked; None for one of the hub.

    Raises:
        InputError: it is not there, or the folder does not say which file.
        FileFormatError: the file is damaged.
    """
    if adapter.source.startswith(HUB):
        return None
    path = Path(adapter.source).expanduser()
    if path.is_dir():
        path = path / _choose([one.name for one in path.glob(f"*{SAFETENSORS}")], str(path))
    if not path.is_file():
        raise InputError(
            f"there is no adapter {shown(str(path))}; give lora=FILE{SAFETENSORS}[:WEIGHT], a "
            f"folder with one, or {HUB}organisation/name"
        )
    if path.suffix != SAFETENSORS:
        raise InputError(f"{path} is no adapter: texvent reads adapters from {SAFETENSORS} only")
    check_safetensors(path)
    return path


def find_adapter(adapter: Adapter, announce: Callable[[str], None]) -> AdapterFile:
    """The file of an adapter, fetched first where it is on the hub and not on this machine.

    Raises:
        InputError, FileFormatError: as `find_local`; or the hub has no such file.
        TexventError: the hub cannot be reached.
        MissingDependencyError: huggingface-hub is not installed.
    """
    path = find_local(adapter) or _find_on_hub(adapter, announce)
    return AdapterFile(path, digest_adapter(path), adapter)


def files_of(path: Path) -> list[Path]:
    """The files that decide what an adapter adds: its weights, and PEFT's scale beside them."""
    config = path.with_name(PEFT_CONFIG)
    return [path, config] if config.is_file() else [path]


def digest_adapter(path: Path) -> str:
    """sha256 of the weights; where PEFT's scale is beside them, of the digests of both."""
    digests = [describe_file(one)["sha256"] for one in files_of(path)]
    return (
        digests[0] if len(digests) == 1 else hashlib.sha256("".join(digests).encode()).hexdigest()
    )


def _find_on_hub(adapter: Adapter, announce: Callable[[str], None]) -> Path:
    named = _HUB_NAME.fullmatch(adapter.source)
    if named is None:
        raise ConfigError(f"lora {shown(adapter.source)} names no repository")
    repo, revision, file = named.groups()
    hub = require("huggingface_hub", extra=EXTRA)
    errors = require("huggingface_hub.errors", extra=EXTRA)
    try:
        if file is None:
            file = _choose(_list_files(repo, revision), adapter.source)
        cached = hub.try_to_load_from_cache(repo, file, revision=revision)
        if not isinstance(cached, str):
            announce(
                f"fetching the adapter {adapter.source} from the model hub; licence: read its page"
            )
            cached = hub.hf_hub_download(repo, file, revision=revision)
        if PurePosixPath(file).name == PEFT_NAME:
            _fetch_scale(repo, file, Path(cached))
    except InputError:  # of `_choose`; it is a ValueError too
        raise
    except (
        errors.RepositoryNotFoundError,
        errors.RevisionNotFoundError,
        errors.RemoteEntryNotFoundError,
    ) as error:
        raise InputError(
            f"the model hub has no adapter {shown(adapter.source)}, or it is gated or private"
        ) from error
    except (OSError, ValueError, errors.HTTPError) as error:
        raise TexventError(
            f"the adapter {adapter.source} is not on this machine and the model hub cannot be "
            f"reached: {one_line(error)}. Fetch it elsewhere (hf download {repo}) and name its file"
        ) from error
    path = Path(cached)
    check_safetensors(path)
    return path


def _fetch_scale(repo: str, file: str, weights: Path) -> None:
    """Bring PEFT's scale to the weights it is beside, unless the repository has none."""
    hub = require("huggingface_hub", extra=EXTRA)
    errors = require("huggingface_hub.errors", extra=EXTRA)
    name = PurePosixPath(file)
    commit = weights.parents[len(name.parts) - 1].name
    config = str(name.with_name(PEFT_CONFIG))
    if hub.try_to_load_from_cache(repo, config, revision=commit) is None:
        with contextlib.suppress(errors.RemoteEntryNotFoundError):
            hub.hf_hub_download(repo, config, revision=commit)


def _list_files(repo: str, revision: str | None) -> list[str]:
    """Weights in a repository as the hub lists them.

    Without a network, of the copy here, which may lack some: those whose name needs no choice.
    """
    hub = require("huggingface_hub", extra=EXTRA)
    errors = require("huggingface_hub.errors", extra=EXTRA)
    try:
        names = hub.HfApi().list_repo_files(repo, revision=revision)
    except (errors.RepositoryNotFoundError, errors.RevisionNotFoundError):
        raise
    except (OSError, errors.HTTPError):
        with contextlib.suppress(errors.LocalEntryNotFoundError):
            folder = Path(hub.snapshot_download(repo, revision=revision, local_files_only=True))
            here = [name for name in SAVED_NAMES if (folder / name).is_file()]
            if here:
                return here
        raise
    return [name for name in names if name.endswith(SAFETENSORS)]


def _choose(names: list[str], place: str) -> str:
    """The adapter among the files of a folder."""
    saved = [name for name in SAVED_NAMES if name in names]
    if saved:
        return saved[0]
    if len(names) != 1:
        found = ", ".join(sorted(names)[:5]) or f"none ends in {SAFETENSORS}"
        raise InputError(
            f"{place} does not say which adapter: {found}; name one, {place}/FILE{SAFETENSORS}"
        )
    return names[0]
