"""Files of reconstruction networks: found, recognised, and checked tensor by tensor."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from texvent.errors import FileFormatError, InputError
from texvent.extending import require
from texvent.networks.layer_shapes import Shape
from texvent.networks.weight_files import (
    StandIn,
    Tensor,
    check_finite,
    describe_mismatch,
    read_mapping,
    shapes_of,
    state_tensors,
)
from texvent.runtime.cache_folder import cache_folder
from texvent_lab.networks import EXTRA
from texvent_lab.registries import RECONSTRUCTORS

if TYPE_CHECKING:
    from texvent_lab.reconstruct.recurrent_network import PublishedNetwork

LEFT_BY_TRAINING = (
    *("parse_config.ConfigParser", "utils.parse_config.ConfigParser", "logger.logger.Logger"),
    *("pathlib.PosixPath", "pathlib._local.PosixPath", "pathlib.WindowsPath"),
    *("numpy.core.multiarray.scalar", "numpy._core.multiarray.scalar", "numpy.dtype"),
)
"""Classes of objects that the programs which trained these networks stored with the weights."""
CONFIG = "config"


@dataclass(frozen=True, eq=False)
class Checkpoint:
    """The weights of one network."""

    tensors: Mapping[str, Tensor]
    """Name → tensor, float32, on the CPU; batch counters left out."""
    settings: Mapping[str, Any]
    """What the file says about the network, as its own program names it; {} if it says nothing."""
    sha256: str
    """Of the file."""


def find_weights(published: PublishedNetwork, path: Path | None = None) -> Path:
    """The weights file of a network: the one named, else the one in the weights folder.

    Raises:
        InputError: there is no such file; the message says where it comes from and where to put
            it.
    """
    usual = cache_folder("weights") / published.file_name
    chosen = path or usual
    if chosen.is_file():
        return chosen
    what = f"there is no weights file {chosen}" if path else f"{published.name} needs its weights"
    raise InputError(
        f"{what}; texvent neither carries nor downloads them: {published.where_from}. Pass its "
        f"path with `weights`, or put it at {usual}"
    )


def read_checkpoint(published: PublishedNetwork, path: Path) -> Checkpoint:
    """The weights of a network from its published file, or from its tensors alone.

    Args:
        published: the network that the file must hold.
        path: a training checkpoint, or tensors alone: `{name: tensor}`, `{"state_dict": ...}` or
            `.safetensors`.

    Raises:
        FileFormatError: the file is damaged, of another network, or holds objects that are not
            known.
        MissingDependencyError: torch is not installed.
    """
    digest = hashlib.sha256(path.read_bytes()).hexdigest()
    _refuse_another_published(published, path, digest)
    where = published.where_from
    content = read_mapping(path, where, extra=EXTRA, stand_ins=LEFT_BY_TRAINING)
    tensors = state_tensors(content, path, where, extra=EXTRA)
    _check_layout(published, tensors, path)
    check_finite(tensors, path)
    return Checkpoint(tensors, _network_settings(content), digest)


def _check_layout(published: PublishedNetwork, tensors: Mapping[str, Tensor], path: Path) -> None:
    """Refuse a tensor that is missing, unknown or of another shape."""
    found = shapes_of(tensors)
    problem = _describe_mismatch(published, found)
    if problem is None:
        return
    fitting = [
        name
        for name in RECONSTRUCTORS.names()
        if name != published.name and _describe_mismatch(RECONSTRUCTORS.load(name), found) is None
    ]
    hint = f"it fits {' and '.join(fitting)}" if fitting else published.where_from
    raise FileFormatError(f"{path} is not {published.name}'s: it {problem}; {hint}")


def _describe_mismatch(published: PublishedNetwork, found: Mapping[str, Shape]) -> str | None:
    """The first way in which tensors differ from a network's, or None."""
    try:
        with require("torch", extra=EXTRA).device("meta"):
            expected = published.network.like(found, {}).tensors
    except ValueError:  # the first kernel, of which the width is taken, has not four sides
        return "has a first layer of another kind"
    return describe_mismatch(found, shapes_of(expected))


def _refuse_another_published(published: PublishedNetwork, path: Path, digest: str) -> None:
    for name in RECONSTRUCTORS.names():
        other: PublishedNetwork = RECONSTRUCTORS.load(name)
        if other.name != published.name and digest in other.sha256:
            raise FileFormatError(
                f"{path} is the published file of {other.name}, not of {published.name}; choose "
                f"--network {other.name}"
            )


def _network_settings(content: Mapping[str, Any]) -> Mapping[str, Any]:
    """How the program that trained the network built it, wherever it stored that.

    One program stores `model`, another `config` with `model` in it, a third an object around
    `arch`, whose arguments are the network's own mapping alone.
    """
    config = content.get(CONFIG)
    if isinstance(config, StandIn):
        config = vars(config).get("_config")
    inner = config if isinstance(config, Mapping) else {}
    arch = inner.get("arch")
    arguments = arch.get("args") if isinstance(arch, Mapping) else None
    nested = list(arguments.values())[:1] if isinstance(arguments, Mapping) else []
    for one in (content.get("model"), inner.get("model"), *nested, arguments):
        if isinstance(one, Mapping):
            return one
    return {}
