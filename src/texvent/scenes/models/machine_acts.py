"""Names of what machines and piles do in their place, besides working.

Loads nothing, so that the sentence reader can import it.
"""

from __future__ import annotations

PICK = "pick and place"
"""A robot arm takes a block from one pad to another, and back."""
GRASP = "grasp"
"""A gripper closes on a ball and lifts it."""
COLLAPSE = "collapse"
"""A row or a tower comes down."""
STRUCK = "struck"
"""What hangs swings away from the blow and back."""
STRUCK_SWING_S = 0.9
"""How long it is away from its place after a blow, s."""
LIFT = "lift load"
"""The forks of a forklift go up."""
PULSE = "pulse"
"""A heart beats."""
HANG = "hang"
"""On a cord from a ceiling."""
MACHINE_ACTS = frozenset({LIFT, PICK, GRASP, COLLAPSE, STRUCK, PULSE, HANG})
"""All of these: names of `Noun.acts` and kinds of `ObjectMotion`."""
