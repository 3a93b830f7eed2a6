"""V2CE's 3-D U-Net for inference. Needs torch to import.

The names are those of the published file, `v2ce_3d.pt` (Zhang et al., ICRA 2024, section on the
network): head, four encoders that halve the image and double the channels, two residual blocks,
four decoders, and a last layer that gives 2 polarities × 10 nodes.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent._require import require
from texvent.errors import FileFormatError, InputError
from texvent.networks.weight_files import Tensor, load_strictly, named_tensors, read_mapping

Float32Array: TypeAlias = NDArray[np.float32]
torch: Any = require("torch", extra="v2ce")
nn: Any = torch.nn
_Module: Any = nn.Module

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
HEAD_LEAK = 0.01
"""Slope of the head's activation below 0."""
FIRST_TENSOR = "UNet.head.conv3d.weight"


class _SpectralConvolution(_Module):
    """A convolution whose weight is divided by its largest singular value, without bias."""

    def __init__(self, before: int, after: int) -> None:
        super().__init__()
        self.module = nn.ParameterDict(
            {
                "weight_bar": torch.empty(after, before, 3, 3, 3),
                # Power-iteration estimate of its first singular vectors, as stored.
                "weight_u": torch.empty(after),
                "weight_v": torch.empty(before * 27),
            }
        )

    def normalise(self) -> None:
        """Set the weight, by one power iteration from the stored vector.

        Deviation: the original iterates again before every window, so that its weights drift a
            little with the number of windows it has seen; here they stay.
        """
        bar, left = self.module["weight_bar"], self.module["weight_u"]
        matrix = bar.reshape(bar.shape[0], -1)
        right = nn.functional.normalize(matrix.T @ left, dim=0)
        left = nn.functional.normalize(matrix @ right, dim=0)
        self.register_buffer("weight", bar / (left @ (matrix @ right)))
        del self.module

    def forward(self, x: Tensor) -> Tensor:
        return nn.functional.conv3d(x, self.weight, padding=1)


class _Block(_Module):
    """Convolution, batch norm, ReLU, convolution, batch norm; a 1×1×1 convolution around them."""

    def __init__(
        self, before: int, after: int, *, is_halved: bool = False, is_spectral: bool = False
    ) -> None:
        super().__init__()
        stride = (1, 2, 2) if is_halved else 1
        if is_spectral:
            self.conv1, self.conv2 = (
                _SpectralConvolution(channels, after) for channels in (before, after)
            )
        else:
            self.conv1 = nn.Conv3d(before, after, 3, stride=stride, padding=1, bias=False)
            self.conv2 = nn.Conv3d(after, after, 3, padding=1, bias=False)
        self.bn1, self.bn2 = nn.BatchNorm3d(after), nn.BatchNorm3d(after)
        self.downsample = nn.Sequential(
            nn.Conv3d(before, after, 1, stride=stride), nn.BatchNorm3d(after)
        )

    def forward(self, x: Tensor) -> Tensor:
        inner = self.bn2(self.conv2(torch.relu(self.bn1(self.conv1(x)))))
        return torch.relu(inner + self.downsample(x))


class V2ceUnet(_Module):
    """A U-Net over time, rows and columns; every convolution also looks one pair back and ahead.

    Each decoder first doubles the image by repeating pixels, and reads the encoder's input of its
    level beside it. [1, 2, N, H, W] to [1, 20, N, H, W], at least 0.
    """

    def __init__(self, base_channels: int = BASE_CHANNELS) -> None:
        super().__init__()
        wide = [base_channels << level for level in range(LEVELS + 1)]
        encoders = (_Block(wide[i], wide[i + 1], is_halved=True) for i in range(LEVELS))
        middle = (_Block(wide[-1], wide[-1], is_spectral=True) for _ in range(RESIDUAL_BLOCKS))
        decoders = (
            _Block(wide[i + 1] + wide[i], wide[i], is_spectral=True)
            for i in reversed(range(LEVELS))
        )
        head = nn.Conv3d(FRAMES, base_channels, 3, padding=1)
        last = nn.Conv3d(base_channels, POLARITIES * NODES, 1)
        self.UNet = nn.ModuleDict(
            {
                "head": nn.ModuleDict({"conv3d": head}),
                "encoders": nn.ModuleList(encoders),
                "resblocks": nn.ModuleList(middle),
                "decoders": nn.ModuleList(decoders),
                "pred": nn.ModuleDict({"conv3d": last}),
            }
        )

    def forward(self, x: Tensor) -> Tensor:
        """Voxel counts of N pairs."""
        parts = self.UNet
        x = nn.functional.leaky_relu(parts["head"]["conv3d"](x), HEAD_LEAK)
        skipped = []
        for encoder in parts["encoders"]:
            skipped.append(x)
            x = encoder(x)
        for block in parts["resblocks"]:
            x = block(x)
        for decoder in parts["decoders"]:
            beside = skipped.pop()
            x = nn.functional.interpolate(x, size=beside.shape[2:], mode="nearest")
            x = decoder(torch.cat([x, beside], dim=1))
        return torch.relu(parts["pred"]["conv3d"](x))


class V2ceNetwork:
    """The network of a weights file, on a GPU if torch finds one."""

    def __init__(self, path: Path, where_from: str) -> None:
        """Read the file.

        A plain state dict is read, one saved from several GPUs (`module.` before every name), and a
        training checkpoint that holds one beside other things. The network's width is taken from
        the file; the published one has 32 channels.

        Args:
            path: of the file.
            where_from: where to get the right file, for messages.

        Raises:
            FileFormatError: it is no such file, is damaged, or a tensor is missing, unknown or of
                another shape.
        """
        self._path, self._device = path, "cuda" if torch.cuda.is_available() else "cpu"
        tensors = _read_tensors(path, where_from)
        with torch.device("meta"):
            self._unet = V2ceUnet(tensors[FIRST_TENSOR].shape[0])
        load_strictly(self._unet, tensors, path, where_from)
        with torch.no_grad():
            for part in self._unet.modules():
                if isinstance(part, _SpectralConvolution):
                    part.normalise()
        self._unet.eval().to(self._device)

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
        count, _, height, width = pairs.shape
        try:
            with torch.inference_mode():
                x = torch.from_numpy(np.ascontiguousarray(pairs.swapaxes(0, 1)))
                voxel = self._unet(x.to(self._device).reshape(1, FRAMES, count, height, width))
                grids = voxel[0].transpose(0, 1).cpu().numpy()
        except RuntimeError as error:
            if "memory" not in str(error):
                raise
            raise InputError(
                f"{count} pairs of {width}x{height} frames do not fit into the memory of device "
                f"{self._device}; lower `sequence_length` or choose a smaller `sensor`"
            ) from error
        if not np.isfinite(grids).all():
            raise FileFormatError(f"{self._path}: the network's output is NaN or infinite")
        return np.asarray(grids.reshape(count, POLARITIES, NODES, height, width))


def _read_tensors(path: Path, where_from: str) -> dict[str, Tensor]:
    """The network's tensors under their own names; what else a checkpoint holds is left out."""
    content = read_mapping(path, where_from, extra="v2ce")
    state = content.get("state_dict", content)
    if not isinstance(state, Mapping) or not all(isinstance(name, str) for name in state):
        raise FileFormatError(
            f"{path} holds {type(state).__name__}, not named tensors; {where_from}"
        )
    prefixes = [name.removesuffix(FIRST_TENSOR) for name in state if name.endswith(FIRST_TENSOR)]
    if not prefixes:
        raise FileFormatError(
            f"{path} has no tensor {FIRST_TENSOR}; it holds other weights than V2CE's. {where_from}"
        )
    own = {
        name.removeprefix(prefixes[0]): tensor
        for name, tensor in state.items()
        if name.startswith(prefixes[0])
    }
    return named_tensors(own, extra="v2ce")
