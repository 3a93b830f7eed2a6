"""PIE-Net, by its authors' package, whose wheel brings the weights.

Source: "PIE-Net: probabilistic intensity-event modeling for high quality event-based video
generation", package event-pienet (MIT). Its requirements name torchvision and opencv-python, which
its network does not import and which disturb a CPU build of torch and texvent's own OpenCV.
"""

from __future__ import annotations

import importlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from texvent.errors import MissingDependencyError
from texvent.extending import install_command
from texvent.networks import Shape, Tensor
from texvent_lab.reconstruct.recurrent_network import PublishedNetwork, RecurrentNetwork

INSTALL = install_command("--no-deps", "event-pienet==1.1.3")
try:
    _package: Any = importlib.import_module("pie_net")
except ImportError as error:
    raise MissingDependencyError(
        f"pie-net is in the package event-pienet, which is not installed: {INSTALL}"
    ) from error

_PieNet: Any = _package.PIENet


class PieNet(RecurrentNetwork, _PieNet):
    """The full variant: a recurrent U-Net that also sees its last image and its variance."""

    bins = 5
    least_side = 2 * 2 * 5  # its three poolings leave one pixel

    def __init__(self) -> None:
        """Random weights."""
        _PieNet.__init__(self)

    @classmethod
    def like(cls, found: Mapping[str, Shape], settings: Mapping[str, Any]) -> PieNet:
        """See `RecurrentNetwork`."""
        del found, settings
        return cls()

    def load_state_dict(
        self, state_dict: Mapping[str, Tensor], strict: bool = True, assign: bool = False
    ) -> Any:
        """Take over tensors; the file also holds blocks that its variant does not have."""
        own = self.state_dict().keys() & state_dict.keys()
        return super().load_state_dict({name: state_dict[name] for name in own}, strict, assign)

    def reset(self) -> None:
        """See `RecurrentNetwork`."""
        self.reset_states()

    def step(self, voxel: Tensor) -> Tensor:
        """See `RecurrentNetwork`."""
        return _PieNet.forward(self, voxel)["image"]


PIE_NET = PublishedNetwork(
    "pie-net",
    PieNet,
    f"the package event-pienet carries them: {INSTALL}",
    file=Path(_package.__file__).parent / "pretrained" / "model.pth",
)
