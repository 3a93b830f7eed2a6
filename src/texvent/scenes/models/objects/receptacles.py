"""Nouns of what holds other things: dishes, vessels, carriers, cups."""

from __future__ import annotations

CUPS = ("cup", "bottle", "glass", "mug", "wine glass", "beer glass", "soda can")
"""From what one drinks."""
_LIFTED = frozenset({"basket", "bowl", "box", "cup", "glass", "jar", "mug", "pan", "pot", "vase"})
"""Vessels that one lifts with what is in them."""
VESSELS = _LIFTED | {"bathtub", "bucket", "flower pot", "shopping cart", "sink", "stroller",
                     "wine glass"}  # fmt: skip
"""What has the things in it that are "with" it."""
CARRIERS = frozenset(
    {"conveyor belt", "tray", "turntable", "plate", "table", "desk", "shelf", "forklift", "pickup",
     "truck", "wheelbarrow", "sled", "cart", "wagon", "bench", "towel", "raft"}
)  # fmt: skip
"""What has the things on it that are "with" it."""
LIFTED_LADEN = _LIFTED | {"frying pan", "plate", "tray"}
"""What one holds by whom something is on or in it that one is "with"."""
_SERVING = frozenset({"plate", "bowl", "frying pan", "pizza pan"})
SERVED_IN = _SERVING | {"pot", "cup", "mug"}
"""What food is on or in without a dish of its own."""
SERVED_IN_VIEW = _SERVING | {"tray", "chopping board", "cake"}
"""What food lies on in full view; candles stand on a cake."""
