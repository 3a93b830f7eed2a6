"""RIFE: the paper's interpolator, with its published weights."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from texvent._require import require
from texvent.config import InterpolateConfig
from texvent.errors import FileFormatError, InputError
from texvent.interpolate.networks.device import (
    WHITE,
    Placement,
    explain_failures,
    luma_tensor,
    picture_of,
    place,
)
from texvent.interpolate.networks.files import EXTRA, Tensor
from texvent.interpolate.networks.torch_warp import warp
from texvent.interpolate.rife.estimator import PreparedPair, RifeEstimator
from texvent.interpolate.rife.network import Motion
from texvent.interpolate.rife.shared import MIDDLE, move_motion
from texvent.interpolate.rife.weights import (
    describe_rife_weights,
    find_rife_weights,
    read_rife_weights,
)
from texvent.pairs.instants import check_between, position
from texvent.video import Frame, FrameStream


class RifeInterpolator:
    """Moves both frames along the flow that a trained network estimates, and mixes them.

    The network only sees the frames; what is moved is their float32 luma, whatever the network's
    precision, so intermediate frames have no steps.

    Source: Huang et al., Real-Time Intermediate Flow Estimation for Video Frame Interpolation
        (ECCV 2022); section 3.2.1 of the paper.
    Deviation: grey frames are shown to the network as colour, edges are padded by repetition
        instead of with black, and the result is not clipped.
    """

    def __init__(self, config: InterpolateConfig, stream: FrameStream) -> None:
        """An interpolator with its weights loaded.

        Args:
            config: weights, device, precision, tiles, and how often the flow is estimated.
            stream: not used; every interpolator is built alike.

        Raises:
            MissingDependencyError: torch or safetensors is not installed.
            InputError: there are no weights.
            FileFormatError: the weights are damaged or of another network.
            ConfigError: "cuda" without a GPU.
        """
        del stream
        require("torch", extra=EXTRA)
        self._path: Path = find_rife_weights(config.interpolator_weights)
        self._placement: Placement = place(config)
        weights = read_rife_weights(self._path)
        self._estimator = RifeEstimator(weights, self._placement, config)
        self._is_shared = config.rife_flow == "shared"

    @staticmethod
    def provenance(config: InterpolateConfig) -> dict[str, str]:
        """Name, sha256 and layout of the weights file; stored with the events.

        Raises:
            MissingDependencyError, InputError, FileFormatError: as when it is built.
        """
        require("torch", extra=EXTRA)
        return describe_rife_weights(find_rife_weights(config.interpolator_weights))

    def between(self, first: Frame, second: Frame, times_us: Sequence[int]) -> Iterator[Frame]:
        """Frames with every point moved along its path from `first` to `second`.

        Args:
            first: the earlier source frame.
            second: the later source frame.
            times_us: times of the intermediate frames, µs.

        Yields:
            One frame per time, [H, W] float32 luma, 0..255 scale.

        Raises:
            InputError: the frames differ in size, a time is not between theirs, or they do not
                fit into the device's memory.
            FileFormatError: the weights give numbers that are NaN or infinite.
        """
        check_between(first, second, times_us)
        torch = require("torch", extra=EXTRA)
        device = self._placement.device
        with torch.inference_mode():
            lumas = luma_tensor(first, device), luma_tensor(second, device)
            positions = [position(first, second, t_us) for t_us in times_us]
            pair = self._estimator.prepare(first, second)
        moved = self._move(pair, lumas, positions)
        for t_us, picture in zip(times_us, moved, strict=True):
            if not bool(picture.isfinite().all()):
                raise FileFormatError(
                    f"{self._path}: the network's output is NaN or infinite; with float16 try "
                    "bfloat16 or float32"
                )
            yield Frame(picture.cpu().numpy(), t_us, is_source=False)

    def between_tensors(
        self, first: Tensor, second: Tensor, positions: Sequence[float]
    ) -> Iterator[Tensor]:
        """As `between`, for pictures that may lie on the device already; results stay on it.

        Nothing waits for the device, so the output is not looked at: the simulator of
        `texvent.simulate.gpu` refuses NaN and infinite intensities when it counts events.

        Args:
            first: the earlier picture, [H, W] luma or [3, H, W] RGB, 0..255 scale, uint8 or float.
            second: the later picture, alike.
            positions: where between them, 0..1, both excluded.

        Yields:
            One picture per position, [H, W] float32 luma, 0..255 scale.

        Raises:
            InputError: the pictures differ in shape, have another one than allowed, or do not fit
                into the device's memory.
        """
        if first.shape != second.shape:
            raise InputError(
                f"the pictures are {list(first.shape)} and {list(second.shape)}; both must have "
                "one shape"
            )
        torch = require("torch", extra=EXTRA)
        device = self._placement.device
        with torch.inference_mode():
            shown, lumas = zip(*(picture_of(one, device) for one in (first, second)), strict=True)
            # Scaled down together, so that a bright pair stays in the range the network knows.
            scale = 1.0 / torch.stack([one.amax() for one in shown]).amax().clamp(min=WHITE)
            pair = self._estimator.prepare_pictures(*(one * scale for one in shown))
        yield from self._move(pair, lumas, positions)

    def _move(
        self, pair: PreparedPair, lumas: tuple[Tensor, ...], positions: Sequence[float]
    ) -> Iterator[Tensor]:
        """Both lumas moved and mixed at every position, [H, W] each, on the device."""
        torch = require("torch", extra=EXTRA)
        middle = None
        for at in positions:
            # Not around the yield: the caller must not inherit the mode.
            with torch.inference_mode(), explain_failures(self._placement.device):
                if self._is_shared and middle is None:
                    middle = self._estimator.estimate(pair, MIDDLE)
                if middle is None:
                    motion = self._estimator.estimate(pair, at)
                else:
                    motion = move_motion(middle, at)
                picture = _mix(lumas, motion)
            yield picture


def _mix(lumas: tuple[Tensor, ...], motion: Motion) -> Tensor:
    torch = require("torch", extra=EXTRA)
    weight = torch.sigmoid(motion.mask)
    first, second = warp(lumas[0], motion.flow[:, :2]), warp(lumas[1], motion.flow[:, 2:])
    return (second + (first - second) * weight)[0, 0]
