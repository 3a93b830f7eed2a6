"""Files of network weights: read without running their code, and checked tensor by tensor."""

from __future__ import annotations

import datetime
import functools
import hashlib
import pickle
import re
import zipfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, TypeAlias

from texvent._require import require
from texvent.errors import FileFormatError
from texvent.runtime.memory import check_claim, check_proportion

Tensor: TypeAlias = Any
"""torch.Tensor; torch is imported only when weights are read."""

Shape: TypeAlias = tuple[int, ...]

BATCH_COUNTER = "num_batches_tracked"
"""A counter that only training reads; some files have it and some have not."""
SAFETENSORS = ".safetensors"
STATE = "state_dict"
FLOAT_BYTES = 4
NOTES, TRAINING = "texvent", "training"
"""Entries in which `texvent train` notes how weights were made, and the training file in it."""
DAMAGE = (
    *(RuntimeError, OSError, EOFError, ValueError, LookupError, AttributeError, TypeError),
    *(pickle.UnpicklingError, zipfile.BadZipFile),
)
"""Exceptions of reading arbitrary bytes as a pickle."""
PARALLEL_PREFIX = "module."
"""Put before every name by training on several GPUs."""


class StandIn:
    """Replaces an object of an unknown class: its attributes without its behaviour."""

    def __init__(self, *arguments: object) -> None:
        """Ignore the arguments."""
        del arguments

    def __setstate__(self, state: object) -> None:
        """Keep named attributes; ignore any other state."""
        if isinstance(state, Mapping):
            vars(self).update(state)


def read_mapping(
    path: Path, where_from: str, *, extra: str, stand_ins: Sequence[str] = ()
) -> Mapping[str, Any]:
    """The top level of a weights file: names → tensors, or → further mappings.

    Args:
        path: a `.safetensors` file, or a torch checkpoint of any other name.
        where_from: where to get the right file, for messages.
        extra: the texvent extra that installs torch and safetensors.
        stand_ins: `module.Class` of objects that training left in the file; each becomes a
            `StandIn`, so their code is neither needed nor run.

    Raises:
        FileFormatError: it is damaged, or holds something else.
        MissingDependencyError: torch or safetensors is not installed.
    """
    torch = require("torch", extra=extra)
    try:
        if path.suffix.lower() == SAFETENSORS:
            content: Any = _read_safetensors(path, extra)
        else:
            if zipfile.is_zipfile(path):
                with zipfile.ZipFile(path) as archive:
                    check_proportion(sum(one.file_size for one in archive.infolist()), path)
                    if (torn := archive.testzip()) is not None:  # torch does not look
                        raise zipfile.BadZipFile(f"{torn} fails its checksum")
            # Training stores the date; a date runs no code.
            known = [datetime.datetime, *map(_make_stand_in, stand_ins)]
            with torch.serialization.safe_globals(known):
                content = torch.load(path, map_location="cpu", weights_only=True)
    except FileFormatError:
        raise
    except DAMAGE as error:
        raise _damaged(path, error, where_from) from error
    if not isinstance(content, Mapping) or not all(isinstance(name, str) for name in content):
        raise FileFormatError(
            f"{path} holds {type(content).__name__}, not named tensors; {where_from}"
        )
    return content


def describe_file(path: Path) -> dict[str, str]:
    """Name and sha256 of a weights file, for the provenance of events."""
    state = path.stat()
    return {"file": path.name, "sha256": _digest(path, state.st_size, state.st_mtime_ns)}


@functools.cache
def _digest(path: Path, size: int, changed_ns: int) -> str:
    """Digest of a file; its size and time of change make the cache read a changed file again."""
    del size, changed_ns
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def named_tensors(mapping: Mapping[str, Any], path: Path, *, extra: str) -> dict[str, Tensor]:
    """The tensors of a mapping under their own names, as float32; other entries are left out.

    Raises:
        FileFormatError: they are sparse, complex, or far more numbers than are in the file.
    """
    torch = require("torch", extra=extra)
    tensors = {name: one for name, one in mapping.items() if isinstance(one, torch.Tensor)}
    if any(one.is_complex() or one.layout != torch.strided for one in tensors.values()):
        raise FileFormatError(f"{path}: network weights must be dense tensors of real numbers")
    # A view of one stored number may claim any shape, and float() would write it out.
    check_claim(FLOAT_BYTES * sum(one.numel() for one in tensors.values()), path)
    return {name.removeprefix(PARALLEL_PREFIX): one.float() for name, one in tensors.items()}


def state_tensors(
    content: Mapping[str, Any], path: Path, where_from: str, *, extra: str
) -> dict[str, Tensor]:
    """The network's tensors in a checkpoint, without counters that nothing computes with.

    Args:
        content: of the file: `{"state_dict": {name: tensor}}`, or the tensors themselves.
        path: of the file, for messages.
        where_from: as in `read_mapping`.
        extra: as in `read_mapping`.

    Raises:
        FileFormatError: the state holds no named tensors.
    """
    state = content.get(STATE, content)
    if not isinstance(state, Mapping):
        raise FileFormatError(
            f"{path}: its {STATE} is {type(state).__name__}, not named tensors; {where_from}"
        )
    named = named_tensors(state, path, extra=extra)
    return {name: one for name, one in named.items() if not name.endswith(BATCH_COUNTER)}


def trained_with(content: Mapping[str, Any], table: str) -> Mapping[str, Any]:
    """A table of the training file that weights were trained with; empty if it is not known."""
    found = content
    for name in (NOTES, TRAINING, table):
        inner = found.get(name)
        found = inner if isinstance(inner, Mapping) else {}
    return found


def check_finite(tensors: Mapping[str, Tensor], path: Path) -> None:
    """Refuse weights that are NaN or infinite, or all 0, as in a file that was never filled.

    Raises:
        FileFormatError: with the name of the first such tensor.
    """
    for name, tensor in tensors.items():
        if not bool(tensor.isfinite().all()):
            raise FileFormatError(f"{path}: {name} holds values that are NaN or infinite")
    if tensors and not any(bool(tensor.any()) for tensor in tensors.values()):
        raise FileFormatError(f"{path} holds weights that are all 0; get the file again")


def load_strictly(network: Any, tensors: Mapping[str, Tensor], path: Path, hint: str) -> None:
    """Fill a network, which may be on the device "meta", with the float32 tensors of a file.

    Raises:
        FileFormatError: a tensor is missing, unknown, of another shape, or not finite.
    """
    try:
        network.load_state_dict(tensors, strict=True, assign=True)
    except RuntimeError as error:
        problem = str(error).splitlines()[1].strip().rstrip(". ")
        raise FileFormatError(f"{path} holds another network: {problem[:300]}; {hint}") from error
    check_finite(tensors, path)


def shapes_of(tensors: Mapping[str, Tensor]) -> dict[str, Shape]:
    """Name → shape."""
    return {name: tuple(tensor.shape) for name, tensor in tensors.items()}


def _make_stand_in(name: str) -> type[StandIn]:
    """A class that a pickle finds under that name."""
    module, _, qualname = name.rpartition(".")
    return type(qualname, (StandIn,), {"__module__": module})


def _read_safetensors(path: Path, extra: str) -> dict[str, Tensor]:
    module = require("safetensors", extra=extra)
    loader = require("safetensors.torch", extra=extra)
    try:
        tensors: dict[str, Tensor] = loader.load_file(path)
    except module.SafetensorError as error:
        raise ValueError(str(error)) from error
    return tensors


def _damaged(path: Path, error: Exception, where_from: str) -> FileFormatError:
    foreign = re.search(r"Unsupported global: GLOBAL ([\w.]+)", str(error))
    if foreign and not foreign[1].startswith("torch._utils."):  # a name cut off in the middle
        return FileFormatError(
            f"{path} holds not only tensors but an object of class {foreign[1]}, whose code would "
            "have to be run; where that class is known, save the tensors alone, as "
            'torch.save({"state_dict": model.state_dict()}, "plain.pth"), and give that file'
        )
    reason = f"{type(error).__name__}: {error}".splitlines()[0][:120]
    if "weights_only" in reason:  # torch's advice to its own callers, of no use to a user
        reason = type(error).__name__
    return FileFormatError(
        f"{path} cannot be read as network weights, it is damaged or of another kind "
        f"({reason}); {where_from}"
    )
