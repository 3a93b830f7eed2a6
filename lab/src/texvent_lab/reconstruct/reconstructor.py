"""Events to images: voxel grid, network, and the normalisations that belong to it."""

from __future__ import annotations

import copy
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.errors import ConfigError, FileFormatError, InputError
from texvent.events import EventStream
from texvent.extending import require
from texvent.networks import Tensor, describe_file
from texvent.represent.voxel_grid import voxel_e2vid
from texvent.runtime.devices import say_no_gpu
from texvent.runtime.memory import explain_memory
from texvent.sensor import SensorSize
from texvent_lab.networks import EXTRA, Padding
from texvent_lab.reconstruct.checkpoint import find_weights, read_network
from texvent_lab.registries import RECONSTRUCTORS

if TYPE_CHECKING:
    from texvent_lab.reconstruct.recurrent_network import PublishedNetwork, RecurrentNetwork

Device: TypeAlias = Literal["auto", "cpu", "cuda"]


@dataclass(frozen=True, kw_only=True)
class ReconstructConfig:
    """Network that turns events into images, and its options."""

    network: str = "pie-net"
    """Network: pie-net, e2vid, e2vid+, firenet, firenet+, hypere2vid or et-net; e2depth for depth,
    near things bright."""
    weights: Path | None = None
    """File with its published weights, which texvent neither carries nor downloads; default: that
    of pie-net's package, or its place in the weights folder."""
    device: Device = "auto"
    """Device: cpu, cuda (an NVIDIA GPU), or auto for a GPU if there is one."""


Intensity: TypeAlias = NDArray[np.float32]
"""An image, [H, W] float32, 0..1."""

LOWEST, HIGHEST = 1.0, 99.0
"""Percentiles that become black and white where a network's images are stretched."""


def find_network(name: str) -> PublishedNetwork:
    """A network whose images can be compared with frames.

    Raises:
        ConfigError: unknown name, or it gives depth.
    """
    published: PublishedNetwork = RECONSTRUCTORS.load(name)
    if published.colours is not None:
        raise ConfigError(
            f"network is {name}, which gives depth; frames are compared with images: give e2vid or "
            "another, or see depth by texvent reconstruct"
        )
    return published


def load_reconstructor(
    name: str, weights: Path | None = None, *, device: Device = "auto"
) -> Reconstructor:
    """A network ready to see its first events.

    Args:
        name: such as "firenet"; `RECONSTRUCTORS` lists all.
        weights: file with its published weights; default: its place in the weights folder.
        device: where it runs: cpu, cuda (an NVIDIA GPU), or auto for a GPU if there is one.

    Raises:
        ConfigError: unknown name, or "cuda" without a GPU that torch can use.
        InputError: there is no weights file; the message says where it comes from.
        FileFormatError: the file is damaged or of another network.
        MissingDependencyError: torch is not installed.
    """
    published: PublishedNetwork = RECONSTRUCTORS.load(name)
    path = find_weights(published, weights)
    torch = require("torch", extra=EXTRA)
    has_gpu = torch.cuda.is_available()
    if device == "cuda" and not has_gpu:
        raise ConfigError(f"device is cuda, and {say_no_gpu(torch)}; use device='cpu' or auto")
    chosen = ("cuda" if has_gpu else "cpu") if device == "auto" else device
    network = read_network(published, path)
    return Reconstructor(published, network, sha256=describe_file(path)["sha256"], device=chosen)


class Reconstructor:
    """A published network, used as its authors do.

    The events between two instants go in, and the image at the second one comes out. It
    remembers what it has seen until `reset`.

    Source of the protocol: B. Ercan et al., "EVREAL", CVPRW 2023, section 3, and its program.
    Deviations: events that all have one time fall in the first bin of the voxel grid (the program
        spreads them over all bins); an image whose percentiles coincide is not stretched (the
        program divides by zero); the first image is at the second frame (the program first shows
        the network an empty grid, for the first frame); an event at a frame's own time belongs to
        the slice after it (the program also moves the last event before it there); a grid smaller
        than a network's least side is padded like one whose sides are no multiples (the program
        of such a network stops).
    """

    def __init__(
        self,
        published: PublishedNetwork,
        network: RecurrentNetwork,
        *,
        sha256: str = "",
        device: str = "cpu",
    ) -> None:
        """A network that has seen nothing.

        Args:
            published: which one.
            network: with its weights; its memory is used from now on.
            sha256: of the weights file.
            device: "cpu" or "cuda".
        """
        self._network = network.to(device).eval()
        self._published = published
        self._device = device
        self.sha256 = sha256
        """Digest of the weights file."""
        self.reset()

    @property
    def name(self) -> str:
        """Name of the network."""
        return self._published.name

    def picture(self, output: Intensity) -> Intensity:
        """An output as it is shown: depth in colours, brightness as it is."""
        colours = self._published.colours
        return output if colours is None else colours(output)

    def twin(self) -> Reconstructor:
        """The same network, having seen nothing; both share their weights."""
        twin = copy.copy(self)
        twin._network = copy.copy(self._network)
        twin.reset()
        return twin

    def reset(self) -> None:
        """Forget everything seen, as before another recording."""
        self._network.reset()
        self._size: SensorSize | None = None

    def reconstruct(self, events: EventStream) -> Intensity:
        """The image at the end of a slice of events; slices follow one another in time.

        Args:
            events: the slice, which may be empty.

        Returns:
            [H, W] float32, 0..1.

        Raises:
            InputError: another sensor size than before, or the slice does not fit into the
                device's memory.
            FileFormatError: the weights give numbers that are NaN or infinite.
        """
        if self._size not in (None, events.size):
            raise InputError(
                f"these events are of a {events.size} sensor, those before of a {self._size} one; "
                "reset the reconstructor between recordings"
            )
        self._size = events.size
        published = self._published
        grid = voxel_e2vid(events, bins=self._network.bins, normalise=published.is_normalised)
        image = self._run(grid)
        if not np.isfinite(image).all():
            raise FileFormatError(
                f"the output of {self.name} is NaN or infinite; its weights are damaged"
            )
        if published.is_stretched:
            image = stretch(image)
        return np.clip(image, 0.0, 1.0)

    def reconstruct_all(
        self, slices: Iterable[tuple[int, EventStream]]
    ) -> Iterator[tuple[int, Intensity]]:
        """The images of a whole recording.

        Args:
            slices: (instant in µs, the events up to it) in time order.

        Yields:
            (instant, image), one per slice.

        Raises:
            InputError, FileFormatError: as `reconstruct`.
        """
        self.reset()
        for t_us, events in slices:
            yield t_us, self.reconstruct(events)

    def _run(self, grid: Intensity) -> Intensity:
        """The network's output for a voxel grid, [H, W]."""
        torch = require("torch", extra=EXTRA)
        network = self._network
        padding = Padding.centred(grid.shape[1:], network.multiple, network.least_side)
        what = (
            f"{self.name} does not fit into the memory of device {self._device} at "
            f"{grid.shape[2]}x{grid.shape[1]} px; crop or scale the events down first (texvent "
            "convert)"
        )
        with explain_memory(what), torch.inference_mode():
            padded = padding.around(grid, self._published.padding)
            voxel: Tensor = torch.from_numpy(padded)[None].to(self._device)
            output = network.step(voxel)
            image: Intensity = padding.off(output)[0, 0].cpu().numpy()
        return image


def stretch(image: Intensity) -> Intensity:
    """The image scaled so that its 1st percentile becomes 0 and its 99th 1.

    Source: robust normalisation of EVREAL; rpg_e2vid does the same.

    Example:
        >>> stretch(np.linspace(0, 100, 101, dtype=np.float32))[[1, 50, 99]].tolist()
        [0.0, 0.5, 1.0]
    """
    low, high = np.percentile(image, (LOWEST, HIGHEST))
    if high <= low:
        return image
    return np.asarray((image - low) / (high - low), np.float32)
