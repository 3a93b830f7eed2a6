"""All instants of a pair from one estimate at its middle."""

from __future__ import annotations

import math

from texvent.interpolate.networks.torch_warp import warp
from texvent.interpolate.rife.network import Motion

MIDDLE = 0.5


def move_motion(middle: Motion, position: float) -> Motion:
    """The motion at an instant, from that at the middle, if points move straight and evenly.

    A point that is at x at the instant was at x − (τ − 1/2)·V at the middle, where its path
    V = flow to the second − flow to the first; its flows there are scaled by the time left. The
    path is looked up at x, which is the point's own unless a border passes between. The frames'
    weights shift towards the nearer one.

    Args:
        middle: the motion at τ = 1/2.
        position: τ, 0..1, both excluded.

    Source: the linear motion model of Jiang et al., Super SloMo (CVPR 2018), section 3.2, with the
        flow looked up where the point was instead of in place.
    """
    path = middle.flow[:, 2:] - middle.flow[:, :2]
    back = path * (MIDDLE - position)
    flow = warp(middle.flow, back)
    flow[:, :2] *= position / MIDDLE
    flow[:, 2:] *= (1.0 - position) / MIDDLE
    return Motion(flow, warp(middle.mask, back) + math.log((1.0 - position) / position))
