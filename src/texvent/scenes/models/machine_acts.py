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
MACHINE_ACTS = frozenset({PICK, GRASP, COLLAPSE})
"""All of these: names of `Noun.acts` and kinds of `ObjectMotion`."""
