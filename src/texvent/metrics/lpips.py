"""LPIPS: how different two images look, by the features of a trained network.

Source: R. Zhang et al., "The unreasonable effectiveness of deep features as a perceptual metric"
(CVPR 2018), and the published package, version 0.1.4.
"""

from __future__ import annotations

import pickle
import zlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from texvent._require import require
from texvent.errors import FileFormatError, InputError, one_line
from texvent.io.arrays.npz import read_arrays
from texvent.io.atomic import atomic_file
from texvent.metrics.protocol import UNDEFINED
from texvent.networks import DAMAGE, Shape, Tensor
from texvent.runtime.files.cache_folder import cache_folder

Float32Array = NDArray[np.float32]

EXTRA = "torch"
"""The texvent extra that brings torch."""
SHIFT = np.array([-0.030, -0.088, -0.188], np.float32)
SPREAD = np.array([0.458, 0.448, 0.450], np.float32)
"""Mean and spread of red, green and blue in training, of values from −1 to 1."""
LEAST_LENGTH = 1e-10
"""Added to the length of a feature vector, so that a vector of zeros can be divided by it."""
COLOURS = 3
PUBLISHED_NAME = "AlexNet_0"
"""Key of the convolutions in the published file."""
FILE_NAME = "lpips-alex.npz"
"""Name, in the weights folder, of the file that `texvent weights pull lpips` leaves there."""
WHERE_FROM = "fetch them with: texvent weights pull lpips"


@dataclass(frozen=True, kw_only=True)
class Convolution:
    """One convolution of AlexNet and the ReLU after it, whose output the distance looks at."""

    channels: int
    """Channels that come out."""
    kernel: int = 3
    """Side of the kernel, px."""
    stride: int = 1
    padding: int = 1
    """Zeros around the map, px."""
    pools: int = 0
    """Side of the maximum that is taken before, every second pixel; 0 for none."""


ALEX = (
    Convolution(channels=64, kernel=11, stride=4, padding=2),
    Convolution(channels=192, kernel=5, padding=2, pools=3),
    Convolution(channels=384, pools=3),
    Convolution(channels=256),
    Convolution(channels=256),
)
"""AlexNet."""
LEAST_SIDE = 31
"""Images with a shorter side leave nothing for the last layer, px."""
LpipsWeights = Mapping[str, Float32Array]
"""Arrays by name, with the shapes of `array_shapes`."""


def array_shapes(layers: Sequence[Convolution]) -> dict[str, Shape]:
    """Name → shape of every array: kernels are [rows, columns, channels in, channels out]."""
    shapes: dict[str, Shape] = {}
    channels_in = COLOURS
    for number, layer in enumerate(layers):
        shapes[f"kernel{number}"] = (layer.kernel, layer.kernel, channels_in, layer.channels)
        shapes[f"bias{number}"] = shapes[f"head{number}"] = (layer.channels,)
        channels_in = layer.channels
    return shapes


def find_lpips_weights() -> Path:
    """The file with the pulled weights.

    Raises:
        InputError: they were not pulled.
    """
    path = cache_folder("weights") / FILE_NAME
    if not path.is_file():
        raise InputError(f"LPIPS's weights are not here: {path}; {WHERE_FROM}")
    return path


def read_lpips_weights(path: Path, layers: Sequence[Convolution] = ALEX) -> LpipsWeights:
    """Weights from the published file, or from one that `texvent weights pull` converted.

    Args:
        path: `.npz`, or the published pickle of NumPy arrays under any other name.
        layers: of the network.

    Raises:
        FileFormatError: the file is damaged or holds another network.
    """
    try:
        arrays = read_arrays(path) if path.suffix == ".npz" else _read_published(path)
        shapes = {name: array.shape for name, array in arrays.items()}
    except (*DAMAGE, zlib.error, MemoryError) as error:
        reason = f"{type(error).__name__}: {one_line(error)}"
        raise FileFormatError(
            f"{path} cannot be read as LPIPS's weights, it is damaged or of another kind "
            f"({reason}); {WHERE_FROM}"
        ) from error
    if shapes != array_shapes(layers):
        raise FileFormatError(
            f"{path} does not hold the arrays of LPIPS's network, AlexNet; {WHERE_FROM}"
        )
    for name, array in arrays.items():
        if array.dtype != np.float32 or not np.isfinite(array).all():
            raise FileFormatError(
                f"{path}: {name} holds {array.dtype} values that are not all finite float32 numbers"
            )
    return arrays


def write_lpips_weights(weights: LpipsWeights, path: Path) -> None:
    """Store weights as a NumPy archive, replacing a file of that name.

    Raises:
        OutputError: the file cannot be written.
    """
    arrays: dict[str, Any] = dict(weights)
    with atomic_file(path, overwrite=True) as part, part.open("wb") as file:
        np.savez(file, **arrays)


def _read_published(path: Path) -> dict[str, Any]:
    """The arrays under our names: {net: {Conv_i: {kernel, bias}}, NetLinLayer_i: {Conv_0: …}}."""
    with path.open("rb") as file:
        content = _ArrayUnpickler(file).load()
    arrays: dict[str, Any] = {}
    for number in range(len(content[PUBLISHED_NAME])):
        layer = content[PUBLISHED_NAME][f"Conv_{number}"]
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


class Lpips:
    """LPIPS version 0.1 as a differentiable function of images.

    Each layer's features are scaled to length 1 at every pixel; the squared differences are
    weighted per channel, averaged over pixels, and added up over the layers.
    """

    def __init__(self, weights: LpipsWeights) -> None:
        """Copy the weights to torch's order, on the CPU.

        Raises:
            MissingDependencyError: torch is not installed.
        """
        torch = require("torch", extra=EXTRA)
        # Kernels are [rows, columns, channels in, channels out].
        self._tensors: dict[str, Tensor] = {
            name: torch.from_numpy(array.transpose(3, 2, 0, 1).copy() if array.ndim > 1 else array)
            for name, array in weights.items()
        }
        self._tensors |= {"shift": torch.from_numpy(SHIFT), "spread": torch.from_numpy(SPREAD)}

    def to(self, device: object) -> Lpips:
        """Move the weights."""
        self._tensors = {name: one.to(device) for name, one in self._tensors.items()}
        return self

    def __call__(self, images: Tensor, true: Tensor) -> Tensor:
        """Distances of images.

        Args:
            images: [n, 1 or 3, H, W], 0..1; values beyond are taken as they are.
            true: alike.

        Returns:
            [n].
        """
        linalg = require("torch", extra=EXTRA).linalg
        total: Tensor = 0
        pairs = zip(self._features(images), self._features(true), strict=True)
        for number, maps in enumerate(pairs):
            # vector_norm has a gradient of 0 at features that are all 0; a square root has none.
            one, other = (
                x / (linalg.vector_norm(x, dim=1, keepdim=True) + LEAST_LENGTH)
                for x in (y.float() for y in maps)
            )
            head = self._tensors[f"head{number}"][:, None, None]
            total = total + ((one - other) ** 2 * head).sum(dim=1).mean(dim=(1, 2))
        return total

    def _features(self, images: Tensor) -> Iterator[Tensor]:
        functional = require("torch", extra=EXTRA).nn.functional
        shift, spread = (self._tensors[name][:, None, None] for name in ("shift", "spread"))
        x = (2 * images.expand(-1, COLOURS, -1, -1) - 1 - shift) / spread
        for number, layer in enumerate(ALEX):
            if layer.pools:
                x = functional.max_pool2d(x, layer.pools, stride=2)
            kernel, bias = self._tensors[f"kernel{number}"], self._tensors[f"bias{number}"]
            x = functional.conv2d(x, kernel, bias, stride=layer.stride, padding=layer.padding)
            x = functional.relu(x)
            yield x


def lpips_distance(a: ArrayLike, b: ArrayLike, network: Lpips) -> float:
    """LPIPS distance of two images.

    Args:
        a: [H, W] grey or [H, W, 3] RGB, 0..1.
        b: alike, of the same height and width.
        network: `Lpips(read_lpips_weights(find_lpips_weights()))`.

    Returns:
        0 for equal images, about 1 for unrelated ones; NaN if a side is too short for the
        network (31 px).

    Raises:
        InputError: the shapes differ or are no images, or a value is outside 0..1.
    """
    torch = require("torch", extra=EXTRA)
    first, second = _image(a), _image(b)
    if first.shape[1:] != second.shape[1:]:
        raise InputError(
            f"cannot compare an image of {first.shape[2]}x{first.shape[1]} px with one of "
            f"{second.shape[2]}x{second.shape[1]} px; crop or resize one of them"
        )
    if min(first.shape[1:]) < LEAST_SIDE:
        return UNDEFINED
    with torch.inference_mode():
        pair = (torch.from_numpy(one)[None] for one in (first, second))
        return float(network(*pair)[0])


def _image(values: ArrayLike) -> Float32Array:
    """[1 or 3, H, W]."""
    pixels = np.asarray(values, np.float32)
    is_grey = pixels.ndim == 2
    if (not is_grey and (pixels.ndim != 3 or pixels.shape[2] != COLOURS)) or not pixels.size:
        raise InputError(
            f"an image has shape {list(np.shape(values))}; it must be [height, width] or "
            "[height, width, 3]"
        )
    low, high = float(pixels.min()), float(pixels.max())
    if not (low >= 0 and high <= 1):
        raise InputError(
            f"an image holds values from {low:g} to {high:g}; they must be from 0 to 1: "
            "divide 8-bit images by 255"
        )
    return np.ascontiguousarray(pixels[None] if is_grey else pixels.transpose(2, 0, 1))
