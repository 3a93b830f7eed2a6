"""What a reconstruction network must offer."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol

from texvent.networks.layer_shapes import Shape, Shapes
from texvent.networks.weight_files import Tensor


class RecurrentNetwork(Protocol):
    """A network that sees one voxel grid after the other and gives an image for each.

    Built from named tensors, float32, whose names and shapes are those of `tensor_shapes`, and
    from what the file says about the network.
    """

    def __init__(self, tensors: Mapping[str, Tensor], settings: Mapping[str, Any]) -> None:
        """A network that has seen nothing."""
        ...

    @property
    def bins(self) -> int:
        """Bins of the voxel grids."""
        ...

    @property
    def multiple(self) -> int:
        """Both sides of a grid must be multiples of this, px."""
        ...

    @classmethod
    def tensor_shapes(cls, found: Mapping[str, Shape]) -> Shapes:
        """Name → shape of every tensor, batch counters left out.

        Args:
            found: names and shapes in a file; what can differ between files of this network, such
                as its width, is taken from there.
        """
        ...

    def reset(self) -> None:
        """Forget everything seen."""
        ...

    def step(self, voxel: Tensor) -> Tensor:
        """The image after one more voxel grid.

        Args:
            voxel: [1, bins, H, W] float32.

        Returns:
            [1, 1, H, W] float32, intensity, roughly 0..1.
        """
        ...


@dataclass(frozen=True)
class PublishedNetwork:
    """A network with published weights, and how they are meant to be used."""

    name: str
    """As in tables and options."""
    network: type[RecurrentNetwork]
    """Class of the network."""
    where_from: str
    """Where the weights were published."""
    is_normalised: bool = False
    """Whether the non-zero voxels are brought to mean 0 and deviation 1."""
    is_stretched: bool = False
    """Whether the image is stretched so that its 1st and 99th percentile become 0 and 1."""
    sha256: tuple[str, ...] = ()
    """Of the published files, where known."""

    @property
    def file_name(self) -> str:
        """Under which the weights are looked for in the weights folder."""
        return f"{self.name}.pth"
