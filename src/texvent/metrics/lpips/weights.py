"""LPIPS's weights: where they are, and reading them without running what a file holds."""

from __future__ import annotations

import pickle
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError, InputError, one_line
from texvent.io.arrays.npz import read_arrays
from texvent.io.atomic import atomic_file
from texvent.metrics.lpips.layout import LAYOUTS, LpipsLayout, LpipsNet
from texvent.networks.weight_files import DAMAGE
from texvent.runtime.cache_folder import cache_folder

Float32Array = NDArray[np.float32]

ARCHIVE_SUFFIX = ".npz"


@dataclass(frozen=True, eq=False)
class LpipsWeights:
    """The arrays of one network."""

    layout: LpipsLayout
    arrays: Mapping[str, Float32Array]
    """Names and shapes as `layout.array_shapes()`."""


def weights_file_name(net: LpipsNet) -> str:
    """Name, in the weights folder, of what `texvent weights pull` leaves there."""
    return f"lpips-{net}{ARCHIVE_SUFFIX}"


def where_from(net: LpipsNet) -> str:
    """How to get the weights of a network."""
    return f"fetch them with: texvent weights pull {'lpips' if net == 'alex' else f'lpips-{net}'}"


def find_lpips_weights(net: LpipsNet = "alex") -> Path:
    """The file with the pulled weights of a network.

    Raises:
        InputError: they were not pulled.
    """
    path = cache_folder("weights") / weights_file_name(net)
    if not path.is_file():
        raise InputError(f"LPIPS's weights are not here: {path}; {where_from(net)}")
    return path


def read_lpips_weights(path: Path) -> LpipsWeights:
    """Weights from the published file, or from one that `texvent weights pull` converted.

    Args:
        path: `.npz`, or the published pickle of NumPy arrays under any other name. The network is
            recognised from the shapes of the arrays.

    Raises:
        FileFormatError: the file is damaged or holds another network.
    """
    try:
        arrays = read_arrays(path) if path.suffix == ARCHIVE_SUFFIX else _read_published(path)
        shapes = {name: array.shape for name, array in arrays.items()}
    except (*DAMAGE, zlib.error, MemoryError) as error:
        reason = f"{type(error).__name__}: {one_line(error)}"
        raise FileFormatError(
            f"{path} cannot be read as LPIPS's weights, it is damaged or of another kind "
            f"({reason}); {where_from('alex')}"
        ) from error
    layout = next((one for one in LAYOUTS if one.array_shapes() == shapes), None)
    if layout is None:
        raise FileFormatError(
            f"{path} does not hold the arrays of LPIPS's network "
            f"({' or '.join(one.name for one in LAYOUTS)}); {where_from('alex')}"
        )
    for name, array in arrays.items():
        if array.dtype != np.float32 or not np.isfinite(array).all():
            raise FileFormatError(
                f"{path}: {name} holds {array.dtype} values that are not all finite float32 numbers"
            )
    return LpipsWeights(layout, arrays)


def write_lpips_weights(weights: LpipsWeights, path: Path) -> None:
    """Store weights as a NumPy archive, replacing a file of that name.

    Raises:
        OutputError: the file cannot be written.
    """
    arrays: dict[str, Any] = dict(weights.arrays)
    with atomic_file(path, overwrite=True) as part, part.open("wb") as file:
        np.savez(file, **arrays)


def _read_published(path: Path) -> dict[str, Any]:
    """The arrays under our names: {net: {Conv_i: {kernel, bias}}, NetLinLayer_i: {Conv_0: …}}."""
    with path.open("rb") as file:
        content = _ArrayUnpickler(file).load()
    nets = [layout.published_name for layout in LAYOUTS if layout.published_name in content]
    arrays: dict[str, Any] = {}
    for number in range(len(content[nets[0]])):
        layer = content[nets[0]][f"Conv_{number}"]
        arrays[f"kernel{number}"], arrays[f"bias{number}"] = layer["kernel"], layer["bias"]
    for number in range(len(content) - 1):
        # A convolution of one pixel with one channel out: [1, 1, C, 1].
        arrays[f"head{number}"] = content[f"NetLinLayer_{number}"]["Conv_0"]["kernel"].reshape(-1)
    return arrays


class _ArrayUnpickler(pickle.Unpickler):
    """Unpickles dictionaries of NumPy arrays and refuses every other class."""

    _RECONSTRUCT = np.empty(0).__reduce__()[0]
    """The function that pickled arrays name; NumPy has moved it between releases."""

    def find_class(self, module: str, name: str) -> Any:
        """The class or function that a pickle names, if it is one that arrays need."""
        if module in ("numpy", "numpy.core.multiarray", "numpy._core.multiarray"):
            allowed = {
                "_reconstruct": self._RECONSTRUCT,
                "ndarray": np.ndarray,
                "dtype": np.dtype,
            }
            if name in allowed:
                return allowed[name]
        raise pickle.UnpicklingError(f"it names {module}.{name}, which weights do not need")
