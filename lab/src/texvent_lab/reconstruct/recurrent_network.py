"""Recurrent networks from voxel grids to images: the interface of all reconstruction networks."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.extending import require
from texvent.networks import Shape, Tensor, shapes_of
from texvent_lab.networks import EXTRA
from texvent_lab.networks.layers import Network

EVREAL = "the project ercanburak/EVREAL on GitHub carries it as pretrained/{}/model.pth"
"""Source of the files and normalisations of the published networks: B. Ercan et al., "EVREAL:
towards a comprehensive benchmark and analysis suite for event-based video reconstruction", CVPRW
2023."""
Picture: TypeAlias = NDArray[np.float32]
"""[H, W], or [H, W, 3] RGB, 0..1."""
_torch: Any = require("torch", extra=EXTRA)


class RecurrentNetwork(Network):
    """A network that sees one voxel grid after the other and gives an image for each."""

    bins: int
    """Bins of the voxel grids."""
    multiple: int = 1
    """Both sides of a grid must be multiples of this, px."""
    least_side: int = 1
    """Both sides of a grid must be at least this, px."""

    @classmethod
    def like(cls, found: Mapping[str, Shape], settings: Mapping[str, Any]) -> RecurrentNetwork:
        """A network of the variant in a file, its weights random.

        Args:
            found: names and shapes in the file, from which the width and other differences between
                files of this network are taken; {} gives the published variant.
            settings: description of the network in the file.

        Raises:
            ValueError: the first kernel is no kernel of a convolution.
        """
        raise NotImplementedError

    @classmethod
    def from_tensors(
        cls, tensors: Mapping[str, Tensor], settings: Mapping[str, Any]
    ) -> RecurrentNetwork:
        """A network over tensors, which are not copied; it has seen nothing.

        Raises:
            RuntimeError: a tensor is missing, unknown or of another shape.
        """
        with _torch.device("meta"):
            network = cls.like(shapes_of(tensors), settings)
        network.load_state_dict(dict(tensors), assign=True)
        network.eval()
        return network

    def reset(self) -> None:
        """Forget everything seen."""
        raise NotImplementedError

    def step(self, voxel: Tensor) -> Tensor:
        """The image after one more voxel grid.

        Args:
            voxel: [n, bins, H, W] float32.

        Returns:
            [n, 1, H, W] float32, intensity, roughly 0..1.
        """
        raise NotImplementedError

    def forward(self, voxels: Tensor) -> Tensor:
        """Images [n, windows, 1, H, W] of voxel grids [n, windows, bins, H, W].

        The state begins empty; gradients go back through all windows.
        """
        self.reset()
        images = _torch.stack([self.step(one) for one in voxels.unbind(dim=1)], dim=1)
        self.reset()
        return images


@dataclass(frozen=True)
class PublishedNetwork:
    """A network with published weights, and how they are meant to be used."""

    name: str
    """As in tables and options."""
    network: type[RecurrentNetwork]
    """Class of the network."""
    where_from: str
    """Place where the weights were published."""
    is_normalised: bool = False
    """Whether the non-zero voxels are brought to mean 0 and deviation 1."""
    is_stretched: bool = False
    """Whether the image is stretched so that its 1st and 99th percentile become 0 and 1."""
    padding: Literal["constant", "reflect"] = "constant"
    """Values around a grid whose sides are no multiples: 0, or the grid mirrored."""
    colours: Callable[[Picture], Picture] | None = None
    """Picture of an output that is depth; None: the output is brightness."""
    file: Path | None = None
    """Weights that an installed package brings; None: they are the user's."""

    @property
    def file_name(self) -> str:
        """File name of the weights in the weights folder."""
        return f"{self.name}.pth"
