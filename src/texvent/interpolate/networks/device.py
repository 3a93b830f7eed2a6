"""Where and how precisely an interpolating network runs, and what it is shown."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import numpy as np

from texvent.config import InterpolateConfig
from texvent.errors import ConfigError, InputError
from texvent.interpolate.networks.torch_import import Tensor, import_torch
from texvent.pairs.instants import matching_levels
from texvent.video import UINT16_PER_LEVEL, Frame

WHITE = 255.0


@dataclass(frozen=True, eq=False)
class Placement:
    """A device and a number type."""

    device: str
    """cpu or cuda."""
    dtype: Any
    """torch.float32, torch.float16 or torch.bfloat16."""


def place(config: InterpolateConfig) -> Placement:
    """The device and number type that a configuration asks for.

    Raises:
        ConfigError: "cuda" without a GPU that torch can use.
        MissingDependencyError: torch is not installed.
    """
    torch = import_torch()
    has_gpu = torch.cuda.is_available()
    wanted = config.interpolator_device
    if wanted == "cuda" and not has_gpu:
        raise ConfigError(
            "interpolator_device is cuda, but torch finds no GPU here; use cpu or auto"
        )
    device = ("cuda" if has_gpu else "cpu") if wanted == "auto" else wanted
    return Placement(device, getattr(torch, config.interpolator_precision))


def image_tensors(first: Frame, second: Frame) -> tuple[Tensor, Tensor]:
    """Both frames of a pair as a network expects them.

    Grey frames are repeated in all three channels. Levels above white are compressed
    (`pairs.instants.matching_levels`) and both frames are scaled together, so that they stay in
    the range the network knows.

    Returns:
        Two tensors [1, 3, H, W] float32, 0..1, on the CPU.
    """
    torch = import_torch()
    levels = [_levels(first), _levels(second)]
    scale = np.float32(1.0 / max(WHITE, *(float(one.max()) for one in levels)))
    earlier, later = (
        torch.from_numpy(np.ascontiguousarray(one * scale)).expand(1, 3, -1, -1) for one in levels
    )
    return earlier, later


def _levels(frame: Frame) -> np.ndarray[Any, np.dtype[np.float32]]:
    """[1 or 3, H, W] float32, 0..255 scale, as `pairs.instants.matching_levels` has them."""
    pixels = np.asarray(frame.pixels, dtype=np.float32)
    if frame.pixels.dtype == np.uint16:
        pixels = pixels / np.float32(UINT16_PER_LEVEL)
    pixels = matching_levels(pixels, frame.transfer)
    return pixels[None] if pixels.ndim == 2 else np.moveaxis(pixels, 2, 0)


def luma_tensor(frame: Frame, device: str) -> Tensor:
    """Luma of a frame, [1, 1, H, W] float32, 0..255 scale, on the device."""
    torch = import_torch()
    luma = np.array(frame.luma, dtype=np.float32)
    return torch.from_numpy(luma)[None, None].to(device)


def pad_to_multiple(image: Tensor, multiple: int) -> Tensor:
    """The image with its right and lower edges repeated up to a multiple of a number of px."""
    torch = import_torch()
    height, width = image.shape[-2:]
    below, right = -height % multiple, -width % multiple
    return torch.nn.functional.pad(image, (0, right, 0, below), mode="replicate")


@contextmanager
def explain_failures(device: str, *, is_compiled: bool = False) -> Iterator[None]:
    """Turn the failures of torch that a user can remedy into one line.

    Raises:
        InputError: the images do not fit into the device's memory.
        ConfigError: torch.compile does not work here.
    """
    try:
        yield
    except RuntimeError as error:
        if "memory" in str(error):
            raise InputError(
                f"a pair of frames does not fit into the memory of device {device}; "
                "set interpolator_tile=512 (or less), or choose a smaller `sensor`"
            ) from error
        if is_compiled and type(error).__module__.startswith(("torch._dynamo", "torch._inductor")):
            reason = str(error).strip().splitlines()[0][:120]
            raise ConfigError(
                f"torch.compile does not work here ({reason}); leave out `interpolator_compile`"
            ) from error
        raise
