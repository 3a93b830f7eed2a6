"""Where the flows of both directions confirm each other."""

from __future__ import annotations

from types import ModuleType

import numpy as np

from texvent.interpolate.dis_flow.definitions import Floats, Mask

Flows = tuple[Floats, Floats]
"""From the one image to the other, and back, [2, H, W] px."""


def both_unconfirmed(
    start: Floats, stop: Floats, flows: Flows, kernels: ModuleType
) -> tuple[Mask, Mask]:
    """Pixels of both images whose flow is not confirmed, [H, W] each.

    Args:
        start: level of the one image.
        stop: level of the other.
        flows: from one to the other and back.
        kernels: `flow_reference` or `flow_cpu`.
    """
    ahead, back = (np.ascontiguousarray(flow) for flow in flows)
    return kernels.unconfirmed(start, stop, ahead, back), kernels.unconfirmed(
        stop, start, back, ahead
    )
