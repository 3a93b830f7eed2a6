"""V2CE's 3-D U-Net for inference: layout and reading of its weights, and the network.

The names are those of the published file, `v2ce_3d.pt`. It describes a 3-D U-Net (Zhang et al.,
ICRA 2024, section on the network): head, four encoders that halve the image and double the
channels, two residual blocks, four decoders, and a last layer that gives 2 polarities × 10 nodes.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from types import ModuleType
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent._require import require
from texvent.errors import ConfigError, FileFormatError, InputError
from texvent.networks.weight_files import (
    Tensor,
    check_finite,
    describe_mismatch,
    named_tensors,
    read_mapping,
    shapes_of,
)

Shape: TypeAlias = tuple[int, ...]

FRAMES = 2
"""Channels that go in: the frames at both ends of an interval."""
POLARITIES = 2
NODES = 10
"""Voxel nodes per polarity and interval."""
BASE_CHANNELS = 32
"""Channels after the head in the published network."""
LEVELS = 4
"""Encoders, and as many decoders."""
RESIDUAL_BLOCKS = 2

HEAD, PREDICTION = "UNet.head.conv3d", "UNet.pred.conv3d"
ENCODERS = tuple(f"UNet.encoders.{level}" for level in range(LEVELS))
MIDDLE = tuple(f"UNet.resblocks.{block}" for block in range(RESIDUAL_BLOCKS))
DECODERS = tuple(f"UNet.decoders.{level}" for level in range(LEVELS))

SPECTRAL = "module.weight_bar"
"""Name of the direction of a spectrally normalised convolution's weight."""
SPECTRAL_LEFT, SPECTRAL_RIGHT = "module.weight_u", "module.weight_v"
"""Power-iteration estimate of its first singular vectors, as stored in the checkpoint."""
BATCH_COUNTER = "num_batches_tracked"
"""A counter that only training reads."""


def tensor_shapes(base_channels: int = BASE_CHANNELS) -> dict[str, Shape]:
    """Name → shape of every tensor of a network whose head gives `base_channels` channels.

    Example:
        >>> shapes = tensor_shapes()
        >>> len(shapes), shapes["UNet.pred.conv3d.weight"]
        (218, (20, 32, 1, 1, 1))
    """
    return dict(_tensors(base_channels))


def _tensors(base: int) -> Iterator[tuple[str, Shape]]:
    yield f"{HEAD}.weight", (base, FRAMES, 3, 3, 3)
    yield f"{HEAD}.bias", (base,)
    for level, name in enumerate(ENCODERS):
        yield from _block(name, base << level, base << (level + 1), is_spectral=False)
    for name in MIDDLE:
        yield from _block(name, base << LEVELS, base << LEVELS, is_spectral=True)
    for level, name in enumerate(DECODERS):
        channels = base << (LEVELS - level)
        # A decoder reads the level below and, beside it, the encoder's input of its own level.
        yield from _block(name, channels + channels // 2, channels // 2, is_spectral=True)
    yield f"{PREDICTION}.weight", (POLARITIES * NODES, base, 1, 1, 1)
    yield f"{PREDICTION}.bias", (POLARITIES * NODES,)


def _block(name: str, before: int, after: int, *, is_spectral: bool) -> Iterator[tuple[str, Shape]]:
    """A residual block: two convolutions, and one of a single pixel around them."""
    for number, channels in ((1, before), (2, after)):
        if is_spectral:
            yield f"{name}.conv{number}.{SPECTRAL_LEFT}", (after,)
            yield f"{name}.conv{number}.{SPECTRAL_RIGHT}", (channels * 27,)
            yield f"{name}.conv{number}.{SPECTRAL}", (after, channels, 3, 3, 3)
        else:
            yield f"{name}.conv{number}.weight", (after, channels, 3, 3, 3)
        yield from _batch_norm(f"{name}.bn{number}", after)
    yield f"{name}.downsample.0.weight", (after, before, 1, 1, 1)
    yield f"{name}.downsample.0.bias", (after,)
    yield from _batch_norm(f"{name}.downsample.1", after)


def _batch_norm(name: str, channels: int) -> Iterator[tuple[str, Shape]]:
    for part in ("weight", "bias", "running_mean", "running_var"):
        yield f"{name}.{part}", (channels,)
    yield f"{name}.{BATCH_COUNTER}", ()


FILE_NAME = "v2ce_3d.pt"
WHERE_FROM = (
    f"the published file is {FILE_NAME}; its authors' project V2CE-Toolbox "
    "(github.com/ucsd-hdsi-dvs/V2CE-Toolbox) links to it"
)
FIRST_TENSOR = f"{HEAD}.weight"


def check_weights_path(path: Path | None) -> Path:
    """The path of a weights file that exists.

    Raises:
        ConfigError: no file was named.
        InputError: there is no such file.
    """
    if path is None:
        raise ConfigError(
            f"simulator v2ce needs its network's weights and downloads nothing; {WHERE_FROM}. "
            "Then pass weights=PATH"
        )
    if not path.is_file():
        raise InputError(f"there is no weights file {path}; {WHERE_FROM}")
    return path


def read_weights(path: Path, device: str) -> dict[str, Tensor]:
    """Tensors of a weights file, ready for inference.

    A plain state dict is read, one saved from several GPUs (`module.` before every name), and a
    training checkpoint that holds one beside other things. The network's width is taken from the
    file; the published one has 32 channels.

    Args:
        path: the file.
        device: "cpu" or "cuda".

    Returns:
        Name → tensor, float32, on `device`, spectral normalisation applied, without counters.

    Raises:
        FileFormatError: it is no such file, is damaged, or a tensor is missing, unknown or of
            another shape.
        MissingDependencyError: torch is not installed.
    """
    tensors = named_tensors(_strip_prefix(_read_state(path), path), extra="v2ce")
    expected = tensor_shapes(tensors[FIRST_TENSOR].shape[0])
    needed = [name for name in expected if not name.endswith(BATCH_COUNTER)]
    wanted = {name: expected[name] for name in expected if name in needed or name in tensors}
    problem = describe_mismatch(shapes_of(tensors), wanted)
    if problem is not None:
        raise FileFormatError(f"{path} {problem}; it is not the layout of {FILE_NAME}")
    used = {name: tensors[name].to(device) for name in needed}
    check_finite(used, path)
    return apply_spectral_norm(used)


def _read_state(path: Path) -> Mapping[str, Any]:
    content = read_mapping(path, WHERE_FROM, extra="v2ce")
    state = content.get("state_dict", content)
    if not isinstance(state, Mapping) or not all(isinstance(name, str) for name in state):
        raise FileFormatError(
            f"{path} holds {type(state).__name__}, not named tensors; {WHERE_FROM}"
        )
    return state


def _strip_prefix(state: Mapping[str, Any], path: Path) -> dict[str, Any]:
    """The network's tensors under their own names; what else a checkpoint holds is left out."""
    for name in state:
        if name.endswith(FIRST_TENSOR):
            prefix = name.removesuffix(FIRST_TENSOR)
            break
    else:
        raise FileFormatError(
            f"{path} has no tensor {FIRST_TENSOR}; it holds other weights than V2CE's. {WHERE_FROM}"
        )
    return {
        name.removeprefix(prefix): tensor
        for name, tensor in state.items()
        if name.startswith(prefix)
    }


def apply_spectral_norm(tensors: Mapping[str, Tensor]) -> dict[str, Tensor]:
    """Spectrally normalised weights as plain ones: divided by their largest singular value.

    The value is estimated as the original does before its first window, by one power iteration
    from the stored vector.

    Deviation: the original iterates again before every window, so that its weights drift a little
        with the number of windows it has seen; here they stay.
    """
    torch = require("torch", extra="v2ce")
    plain: dict[str, Tensor] = {}
    for name, tensor in tensors.items():
        layer = name.removesuffix(f".{SPECTRAL}")
        if layer != name:
            matrix = tensor.reshape(tensor.shape[0], -1)
            left = tensors[f"{layer}.{SPECTRAL_LEFT}"]
            right = torch.nn.functional.normalize(matrix.T @ left, dim=0)
            left = torch.nn.functional.normalize(matrix @ right, dim=0)
            plain[f"{layer}.weight"] = tensor / (left @ (matrix @ right))
        elif ".module." not in name:
            plain[name] = tensor
    return plain


Float32Array: TypeAlias = NDArray[np.float32]

HALVED = (1, 2, 2)
"""Stride of an encoder: half the image size, all of the time."""
HEAD_LEAK = 0.01
"""Slope of the head's activation below 0."""


def load_network(path: Path) -> V2ceNetwork:
    """The network of a weights file, on a GPU if torch finds one.

    Raises:
        FileFormatError: the file does not hold this network.
        MissingDependencyError: torch is not installed.
    """
    torch = require("torch", extra="v2ce")
    device = "cuda" if torch.cuda.is_available() else "cpu"
    return V2ceNetwork(read_weights(path, device), device, name=str(path))


class V2ceNetwork:
    """A U-Net over time, rows and columns; every convolution also looks one pair back and ahead.

    Each residual block is convolution, batch norm, ReLU, convolution, batch norm, plus a
    convolution of one pixel around them, then ReLU. Each decoder first doubles the image by
    repeating pixels. The output is at least 0.
    """

    def __init__(self, tensors: Mapping[str, Tensor], device: str, *, name: str) -> None:
        """A network from tensors as `read_weights` gives them.

        Args:
            tensors: name → tensor.
            device: where they are.
            name: what to call the weights in messages.
        """
        self._tensors = tensors
        self._device = device
        self._name = name

    @property
    def _torch(self) -> ModuleType:
        # Not kept as an attribute: a module cannot be copied, a simulator can.
        return require("torch", extra="v2ce")

    def predict(self, pairs: Float32Array) -> Float32Array:
        """Voxel grids of a sequence of frame pairs.

        Args:
            pairs: normalised intensities, [N, 2, H, W], in time order, any N, H, W.

        Returns:
            [N, 2, 10, H, W], at least 0: ON and OFF counts at ten nodes in time.

        Raises:
            FileFormatError: the weights give numbers that are NaN or infinite.
            InputError: the frames do not fit into the device's memory.
        """
        torch = self._torch
        count, _, height, width = pairs.shape
        try:
            with torch.inference_mode():
                x = torch.from_numpy(np.ascontiguousarray(pairs.swapaxes(0, 1)))
                voxel = self._forward(x.to(self._device).reshape(1, FRAMES, count, height, width))
                grids = voxel[0].transpose(0, 1).cpu().numpy()
        except RuntimeError as error:
            if "memory" not in str(error):
                raise
            raise InputError(
                f"{count} pairs of {width}x{height} frames do not fit into the memory of device "
                f"{self._device}; lower `sequence_length` or choose a smaller `sensor`"
            ) from error
        if not np.isfinite(grids).all():
            raise FileFormatError(f"{self._name}: the network's output is NaN or infinite")
        return np.asarray(grids.reshape(count, POLARITIES, NODES, height, width))

    def _forward(self, x: Tensor) -> Tensor:
        """[1, 2, N, H, W] to [1, 20, N, H, W]."""
        functional = self._torch.nn.functional
        x = functional.leaky_relu(self._convolve(x, HEAD, padding=1), HEAD_LEAK)
        skipped = []
        for name in ENCODERS:
            skipped.append(x)
            x = self._pass_block(x, name, stride=HALVED)
        for name in MIDDLE:
            x = self._pass_block(x, name)
        for name in DECODERS:
            beside = skipped.pop()
            x = functional.interpolate(x, size=beside.shape[2:], mode="nearest")
            x = self._pass_block(self._torch.cat([x, beside], dim=1), name)
        return self._torch.relu(self._convolve(x, PREDICTION))

    def _pass_block(self, x: Tensor, name: str, *, stride: Any = 1) -> Tensor:
        inner = self._convolve(x, f"{name}.conv1", stride=stride, padding=1)
        inner = self._torch.relu(self._normalise(inner, f"{name}.bn1"))
        inner = self._normalise(self._convolve(inner, f"{name}.conv2", padding=1), f"{name}.bn2")
        around = self._convolve(x, f"{name}.downsample.0", stride=stride)
        return self._torch.relu(inner + self._normalise(around, f"{name}.downsample.1"))

    def _convolve(self, x: Tensor, name: str, *, stride: Any = 1, padding: int = 0) -> Tensor:
        weight, bias = self._tensors[f"{name}.weight"], self._tensors.get(f"{name}.bias")
        return self._torch.nn.functional.conv3d(x, weight, bias, stride=stride, padding=padding)

    def _normalise(self, x: Tensor, name: str) -> Tensor:
        """Batch norm with the means and variances of training."""
        parts = ("running_mean", "running_var", "weight", "bias")
        return self._torch.nn.functional.batch_norm(
            x, *(self._tensors[f"{name}.{part}"] for part in parts), training=False
        )
