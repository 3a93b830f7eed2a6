"""E2Depth: E2VID's network, trained to give depth.

Deviation: voxels are normalised by the deviation of a sample, n − 1; the authors' program takes n.
"""

from __future__ import annotations

import cv2
import numpy as np

from texvent_lab.reconstruct.recurrent_network import Picture, PublishedNetwork
from texvent_lab.reconstruct.recurrent_unet import E2vid

FARTHEST_M, LOG_RANGE = 80.0, 3.70378
"""Depth of an output of 1, and the natural logarithm of it over that of an output of 0."""


def depth_in_metres(output: Picture) -> Picture:
    """Depth of E2Depth's output, m: `80 exp(3.7 (output − 1))`.

    Source: J. Hidalgo-Carrió, D. Gehrig, D. Scaramuzza, "Learning monocular dense depth from
        events", 3DV 2020, section 3.1, and the constants of its program.

    Example:
        >>> depth_in_metres(np.array([0.0, 1.0], np.float32)).round(2).tolist()
        [1.97, 80.0]
    """
    return np.asarray(FARTHEST_M * np.exp(LOG_RANGE * (output - 1.0)), np.float32)


def depth_colours(output: Picture) -> Picture:
    """Logarithm of inverse depth in the colours of magma, near bright, [H, W, 3] RGB, 0..1.

    Source: `--save_inv_log --save_color_map` of the authors' program: from the farthest pixel to
        the 95th percentile.
    """
    near = 1.0 - (output - output.min())
    span = np.percentile(near, 95.0) - near.min()
    levels = np.clip((near - near.min()) / (span or 1.0), 0.0, 1.0)
    bgr = cv2.applyColorMap(np.rint(levels * 255).astype(np.uint8), cv2.COLORMAP_MAGMA)
    return np.asarray(bgr[..., ::-1] / 255.0, np.float32)


E2DEPTH = PublishedNetwork(
    "e2depth",
    E2vid,
    "uzh-rpg/rpg_e2depth on GitHub links to it: E2DEPTH_si_grad_loss_mixed.pth.tar",
    is_normalised=True,
    padding="reflect",
    colours=depth_colours,
)
