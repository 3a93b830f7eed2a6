"""Files of reconstruction networks: found, read and checked."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from texvent.errors import FileFormatError
from texvent.extending import require
from texvent.networks import (
    StandIn,
    load_strictly,
    read_mapping,
    shapes_of,
    state_tensors,
)
from texvent_lab.networks import EXTRA, locate_weights

if TYPE_CHECKING:
    from texvent_lab.reconstruct.recurrent_network import PublishedNetwork, RecurrentNetwork

LEFT_BY_TRAINING = (
    *("parse_config.ConfigParser", "utils.parse_config.ConfigParser", "logger.logger.Logger"),
    *("pathlib.PosixPath", "pathlib._local.PosixPath", "pathlib.WindowsPath"),
    *("numpy.core.multiarray.scalar", "numpy._core.multiarray.scalar", "numpy.dtype"),
)
"""Classes of objects that the programs which trained these networks stored with the weights."""
CONFIG = "config"


def find_weights(published: PublishedNetwork, path: Path | None = None) -> Path:
    """The weights file of a network: the one named, else the one in the weights folder.

    Raises:
        InputError: there is no such file; the message says where it comes from and where to put
            it.
    """
    usual = published.file or published.file_name
    return locate_weights(published.name, usual, published.where_from, path)


def read_network(published: PublishedNetwork, path: Path) -> RecurrentNetwork:
    """A network with the weights of its published file, or of its tensors alone.

    Args:
        published: the network that the file must hold.
        path: a training checkpoint, or tensors alone: `{name: tensor}`, `{"state_dict": ...}` or
            `.safetensors`.

    Raises:
        FileFormatError: the file is damaged, of another network, or holds objects that are not
            known.
        MissingDependencyError: torch is not installed.
    """
    where = published.where_from
    content = read_mapping(path, where, extra=EXTRA, stand_ins=LEFT_BY_TRAINING)
    tensors = state_tensors(content, path, where, extra=EXTRA)
    shapes = shapes_of(tensors)
    try:
        with require("torch", extra=EXTRA).device("meta"):
            network = published.network.like(shapes, network_settings(content))
    except ValueError as error:  # the first kernel has not four sides
        raise FileFormatError(
            f"{path} is not {published.name}'s: its first layer is of another kind; {where}"
        ) from error
    load_strictly(network, tensors, path, where)
    network.eval()
    return network


def network_settings(content: Mapping[str, Any]) -> Mapping[str, Any]:
    """Settings with which the network was built for training, wherever they are stored.

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
