"""Adapters (LoRA) that `--lora` names: how they are written, and where their files are."""

from __future__ import annotations

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
SAVED_NAMES = ("pytorch_lora_weights.safetensors", "adapter_model.safetensors")
"""What diffusers and PEFT call the weights of an adapter in a folder."""
_HUB_NAME = re.compile(rf"{HUB}({REPOSITORY})(?:@([^/]+))?(?:/(.+))?")
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
    adapter: Adapter

    @property
    def facts(self) -> dict[str, Any]:
        """For the provenance of a video."""
        one = self.adapter
        facts = {"source": one.source, "sha256": self.sha256, "weight": one.weight}
        return facts if one.noise is None else {**facts, "noise": one.noise}


def parse_adapter(text: str) -> Adapter:
    """What `--lora` says: `SOURCE[:WEIGHT][:high|:low]`.

    Raises:
        ConfigError: it is empty, of a wrong form, or names a pickle.

    Example:
        >>> parse_adapter("fast.safetensors:0.5")
        Adapter(source='fast.safetensors', weight=0.5, noise=None)
        >>> parse_adapter("hub:org/name/high_noise_model.safetensors").noise_or_name
        'high'
    """
    source, weight = text, 1.0
    noise: Noise | None = None
    head, _, tail = source.rpartition(":")
    if head and tail in NOISES:
        source, noise = head, NOISES[tail]
        head, _, tail = source.rpartition(":")
    if head and re.fullmatch(r"[-+]?[\d.]+(?:[eE][-+]?\d+)?|[-+]?(?:inf|nan)", tail):
        try:
            source, weight = head, float(tail)
        except ValueError:
            weight = math.nan
    if not source or source[0] == ":" or not math.isfinite(weight):
        raise ConfigError(
            f"lora is {shown(text)}; write FILE or FILE:WEIGHT, such as fast.safetensors:0.8"
        )
    if source.startswith(HUB) and not _HUB_NAME.fullmatch(source):
        raise ConfigError(
            f"lora {shown(source)} names no repository; write {HUB}organisation/name or "
            f"{HUB}organisation/name/file.safetensors"
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
            f"there is no adapter {shown(str(path))}; give --lora FILE{SAFETENSORS}[:WEIGHT], a "
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
    return AdapterFile(path, describe_file(path)["sha256"], adapter)


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
    except (
        errors.RepositoryNotFoundError,
        errors.RevisionNotFoundError,
        errors.RemoteEntryNotFoundError,
    ) as error:
        raise InputError(
            f"the model hub has no adapter {shown(adapter.source)}, or it is gated or private"
        ) from error
    except (OSError, ValueError) as error:
        raise TexventError(
            f"the adapter {adapter.source} is not on this machine and the model hub cannot be "
            f"reached: {one_line(error)}. Fetch it elsewhere (hf download {repo}) and name its file"
        ) from error
    path = Path(cached)
    check_safetensors(path)
    return path


def _list_files(repo: str, revision: str | None) -> list[str]:
    """Weights in a repository: of the copy on this machine, else as the hub lists them."""
    hub = require("huggingface_hub", extra=EXTRA)
    errors = require("huggingface_hub.errors", extra=EXTRA)
    try:
        folder = Path(hub.snapshot_download(repo, revision=revision, local_files_only=True))
        here = [str(path.relative_to(folder)) for path in folder.rglob(f"*{SAFETENSORS}")]
        if here:
            return here
    except errors.LocalEntryNotFoundError:
        pass
    names = hub.HfApi().list_repo_files(repo, revision=revision)
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
