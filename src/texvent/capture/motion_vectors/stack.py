"""The fields of all frames, wherever they are, and what they are called."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError, shown

Role: TypeAlias = str
"""Which option named the file (a key of `ROLE_KIND`): what an array without a name holds."""
Fields: TypeAlias = Mapping[str, NDArray[Any]]
"""Kind → array of one frame: "vectors" (the convention says in which direction), "forward",
"backward" ([h, w, 2 or more]), "depth" and "instances" ([h, w])."""

ROLE_KIND: Mapping[str, str] = {
    "motion": "vectors",
    "motion_back": "backward",
    "depth": "depth",
    "instances": "instances",
}
NAMES: Mapping[str, tuple[str, ...]] = {
    "vectors": ("flow", "vectors", "motion_vectors", "optical_flow"),
    "forward": ("forward", "flow_forward", "forward_flow"),
    "backward": ("backward", "flow_back", "flow_backward", "backward_flow"),
    "depth": ("depth", "distance_to_image_plane"),
    "instances": ("instances", "instance", "ids", "instance_id"),
}
"""Kind → names of arrays in .npz files and of datasets in HDF5 files."""


@dataclass(frozen=True, eq=False)
class FieldStack:
    """The fields of all frames, read one by one."""

    name: str
    """What to call it in messages."""
    count: int
    """Frames, or pairs of frames, that it has fields of."""
    read: Callable[[int], Fields]
    found: frozenset[str]
    """Kinds of fields that it holds."""
    convention: str | None = None
    """The renderer that wrote it, where the file says so."""
    marks_unknown: bool = False
    """Whether the format has a way to say that a vector is not known."""

    gap: str | None = None
    """Between which of its files a number is missing, if one is."""

    def field(self, kind: str, index: int) -> NDArray[Any]:
        """One field of one frame.

        Raises:
            InputError: the file of this frame lacks what the first one has.
            FileFormatError: it is damaged.
        """
        fields = self.read(index)
        if kind not in fields:
            raise InputError(
                f"{self.name}: the fields of frame {index} lack {kind}, which those of the first "
                "frame have; write all files alike"
            )
        return fields[kind]


def stack_of_arrays(given: Any, role: Role) -> FieldStack:
    """Fields in memory: an array [N, ...] or a sequence of N arrays.

    Raises:
        InputError: it is neither.
    """
    if not hasattr(given, "__len__") or isinstance(given, Mapping):
        raise InputError(
            f"{role}: {shown(given)} is no field of motion; give a path, an array [N, H, W, 2] or "
            "a list of N arrays"
        )
    kind = ROLE_KIND[role]
    return FieldStack(
        role, len(given), lambda index: {kind: np.asarray(given[index])}, frozenset([kind])
    )


def stack_of_mapping(arrays: Fields, name: str) -> FieldStack:
    """Arrays of one file by kind, each [N, ...]."""
    count = one_count({kind: count_of(one.shape, name) for kind, one in arrays.items()}, name)
    return FieldStack(
        name,
        count,
        lambda index: {kind: array[index] for kind, array in arrays.items()},
        frozenset(arrays),
    )


def count_of(shape: tuple[int, ...], name: str) -> int:
    """The length of the first axis."""
    if not shape:
        raise InputError(f"{name} holds a single number; fields are arrays [N, H, W, ...]")
    return shape[0]


def one_count(counts: Mapping[str, int], name: str) -> int:
    """The number of frames that all fields have.

    Raises:
        InputError: they differ.
    """
    if len(set(counts.values())) > 1:
        said = ", ".join(f"{kind} {count}" for kind, count in counts.items())
        raise InputError(f"{name} holds fields of different numbers of frames ({said})")
    return next(iter(counts.values()))
