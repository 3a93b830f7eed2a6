"""Names of the motions of whole bodies: kinds of `ObjectMotion` besides activities.

Loads nothing, so that readers can import it.
"""

from __future__ import annotations

MOTIONS = frozenset(
    {"move", "drive", "walk", "run", "fly", "swim", "sail", "paddle", "roll", "slide",
     "float",
     "hover", "blow", "turn", "reverse", "enter", "leave", "appear",
     "spin", "rotate", "orbit", "swing", "sway", "bounce", "jump", "fall", "rise", "sink", "throw",
     "topple", "flip", "roll over", "work", "hang", "stand", "sit", "lie"}
)  # fmt: skip
"""Travel, manoeuvres, and motions in place; "move" is the usual motion of a noun, "work" that of a
machine, "stand" rest."""
