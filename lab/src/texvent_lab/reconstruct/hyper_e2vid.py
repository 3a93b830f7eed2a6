"""HyperE2VID: E2VID+ whose first decoder has another kernel at every pixel."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.extending import require
from texvent.networks import Tensor
from texvent_lab.networks import EXTRA
from texvent_lab.reconstruct.recurrent_network import EVREAL, PublishedNetwork
from texvent_lab.reconstruct.recurrent_unet import E2vidPlus, UNetVariant

_torch: Any = require("torch", extra=EXTRA)
_nn: Any = require("torch.nn", extra=EXTRA)
_Module: Any = _nn.Module

ATOMS = 6
"""Kernels per pixel, of which every output channel takes its own mixture."""
PATTERNS = 6
"""Fourier-Bessel patterns per kernel side 3, 5, ...; every atom is a mixture of all of them."""
CONTEXT, HIDDEN = 32, 64
"""Channels of the context, and of the layer between it and the atoms."""
BESSEL_ZEROS = (
    *((0, 2.40482556), (1, 3.83170597), (2, 5.1356223), (0, 5.52007811)),
    *((3, 6.3801619), (1, 7.01558667), (4, 7.58834243), (2, 8.41724414)),
)
"""Order and zero of the Bessel functions that the two published sides are made of; the smaller one
takes the first four."""


class HyperE2vid(E2vidPlus):
    """HyperE2VID: the kernels are made from the events and from the image before.

    Source: B. Ercan et al., "HyperE2VID: improving event-based video reconstruction via
        hypernetworks", TIP 2024, section III, and its program.
    """

    def _decoder(self, one: UNetVariant, number: int) -> Any:
        if number:
            return super()._decoder(one, number)
        wide = one.width << one.encoders
        return DynamicDecoder(wide, wide // 2, one.side, one.bins + 1)

    def reset(self) -> None:
        """See `RecurrentNetwork`."""
        super().reset()
        self._image: Tensor | None = None

    def step(self, voxel: Tensor) -> Tensor:
        """See `RecurrentNetwork`."""
        seen = _torch.zeros_like(voxel[:, :1]) if self._image is None else self._image
        self.unetrecurrent["decoders"][0].context = _torch.cat([voxel, seen], 1)
        image = super().step(voxel)
        self._image = image.detach()
        return image


class DynamicDecoder(_Module):
    """Bilinear interpolation to twice the size, a convolution by kernels of each pixel, ReLU."""

    context: Tensor
    """Voxel grid and the image before, [n, bins + 1, 4 H, 4 W] for an output of [n, ..., H, W]."""

    def __init__(self, wide: int, narrow: int, side: int, seen: int) -> None:
        super().__init__()
        bases = _torch.from_numpy(fourier_bessel(side))
        mixed = ATOMS * len(bases)
        fuse = _nn.Conv2d(seen, CONTEXT, 3, padding=1)
        self.context_fusion = _nn.ModuleDict({"conv": fuse})
        layers = (
            *(_nn.Conv2d(CONTEXT, HIDDEN, 3, padding=1), _nn.BatchNorm2d(HIDDEN), _nn.Tanh()),
            *(_nn.Conv2d(HIDDEN, mixed, 3, padding=1), _nn.BatchNorm2d(mixed), _nn.Tanh()),
        )
        self.dynamic_atom_generation = _nn.ModuleDict({"bases_net": _nn.Sequential(*layers)})
        self.dynamic_atom_generation.register_buffer("bases", bases)
        mixture = _torch.empty(narrow, wide * ATOMS, 1, 1)
        _nn.init.kaiming_normal_(mixture, mode="fan_out", nonlinearity="relu")
        self.dynamic_conv = _nn.ParameterDict(
            {"compositional_coefficients": mixture, "bias": _torch.zeros(narrow)}
        )

    def forward(self, x: Tensor) -> Tensor:
        """Twice the size and fewer channels."""
        upsample = _nn.functional.interpolate
        x = upsample(x, scale_factor=2, mode="bilinear", align_corners=False)
        small = upsample(self.context, scale_factor=0.25, mode="bilinear", align_corners=False)
        generator = self.dynamic_atom_generation
        coefficients = generator["bases_net"](self.context_fusion["conv"](small))
        coefficients = coefficients.unflatten(1, (ATOMS, -1))
        atoms = _torch.einsum("nakhw,kp->naphw", coefficients, generator.bases)
        side, (height, width) = round(atoms.shape[2] ** 0.5), x.shape[-2:]
        padded = _nn.functional.pad(x, (side // 2,) * 4)
        mixed = x.new_zeros(*x.shape[:2], ATOMS, height, width)
        # One kernel position after the other: all at once would take side² times the memory.
        for position in range(side * side):
            row, column = divmod(position, side)
            shifted = padded[..., row : row + height, column : column + width]
            mixed.addcmul_(shifted[:, :, None], atoms[:, None, :, position])
        mixture, bias = (self.dynamic_conv[one] for one in ("compositional_coefficients", "bias"))
        return _nn.functional.conv2d(mixed.flatten(1, 2), mixture, bias).relu()


def fourier_bessel(side: int) -> NDArray[np.float32]:
    """Fourier-Bessel patterns on discs of 3, 5, ... px, the finest first, [patterns, side²].

    Source: Q. Qiu et al., "DCFNet: deep neural network with decomposed convolutional filters", ICML
        2018, whose program scales the patterns of a disc to a mean energy of 1.

    Raises:
        ValueError: the side is neither 3 nor 5 px, as in every published file.
    """
    if side not in (3, 5):
        raise ValueError(f"a kernel of {side} px")
    reach, found = side // 2, []
    y, x = np.mgrid[-reach : reach + 1, -reach : reach + 1]
    angle = np.arctan2(x, y)
    for scale in range(1, reach + 1):
        place, patterns = np.hypot(x, y) / (scale + 0.5), []
        for order, zero in BESSEL_ZEROS[: 4 * scale]:
            radial = (place < 1) * _bessel(order, place * zero) / abs(_bessel(order + 1, zero))
            waves = (np.cos(order * angle), np.sin(order * angle)) if order else (np.sqrt(0.5),)
            patterns += [radial * wave for wave in waves]
        disc = np.reshape(patterns, (-1, side * side))
        found.append(disc[:PATTERNS] / np.sqrt((disc**2).sum(1).mean()))
    return np.concatenate(found).astype(np.float32)


def _bessel(order: int, z: NDArray[np.float64] | float) -> NDArray[np.float64]:
    """Bessel function of the first kind, as the mean of cos(order τ − z sin τ) over a turn."""
    turn = np.arange(64) * (2 * np.pi / 64)
    waves = np.cos(order * turn - np.asarray(z)[..., None] * np.sin(turn))
    return np.asarray(waves.mean(-1))


HYPER_E2VID = PublishedNetwork(
    "hypere2vid",
    HyperE2vid,
    f"{EVREAL.format('HyperE2VID')}, and ercanburak/HyperE2VID links to it",
)
