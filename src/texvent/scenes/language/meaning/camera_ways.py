"""Words beside a verb of the camera: where it is, where it looks, which way it goes."""

from __future__ import annotations

SIDES = {"behind": "behind", "in front of": "front", "beside": "side", "alongside": "side",
          "next to": "side", "past": "side", "above": "above", "over": "above"}  # fmt: skip
IN_OUT = {"forward": "in", "backward": "out", "towards": "in", "away": "out", "in": "in",
           "out": "out"}  # fmt: skip
TRAVEL_PREPOSITIONS = frozenset(
    {"through", "along", "over", "across", "down", "up", "into", "past", "between", "throughout",
     "above", "in"}
)  # fmt: skip
AIMED = frozenset({"follow", "orbit", "zoom", "dolly", "dolly zoom", "crane", "tilt", "pan"})
PLACED = frozenset({"fix", "lock", "mount", "place", "position", "sit", "perch", "set", "attach",
                     "strap", "station"})  # fmt: skip
"""Verbs that say where the camera is, and nothing that it does after something else."""
STATIONS = {"behind": "back", "in front of": "front", "beside": "side", "next to": "side",
             "alongside": "side", "directly above": "top", "above": "aerial",
             "over": "aerial"}  # fmt: skip
"""Where the camera stands beside what has a front → view."""
ALONG = frozenset({"past", "along", "across", "by"})
WITH: dict[str, str | None] = {
    "alongside": "side", "beside": "side", "next to": "side", "with": None, "after": None,
    "behind": "behind", "in front of": "front", "ahead of": "front",
}  # fmt: skip
"""Preposition of a camera that goes with something → from where it follows."""
UPRIGHT = frozenset({"tilt", "crane", "pedestal"})
FREE = frozenset({"travel", "truck", "pan", "dolly", "pedestal"})
TRUCK = {"up": ("pedestal", "up"), "down": ("pedestal", "down"), "left": ("truck", "left"),
          "right": ("truck", "right"), "towards": ("dolly", "in"), "away": ("dolly", "out"),
          "forward": ("travel", "forward"), "backward": ("travel", "backward"),
          "across": ("truck", "right")}  # fmt: skip
ASIDE = frozenset({"left", "right", "up", "down", "towards", "away", "across"})
"""Directions that tell another move than travelling ahead."""
LOOKING = frozenset({"look", "face", "aim", "point", "watch", "film", "view", "observe"})
BOTH_WAYS = {"to and fro": ("right", "left"), "up and down": ("up", "down")}
"""Direction there and back → one way, then the other."""
BY_HAND = frozenset({"slip", "slide", "run", "walk", "drive", "fly", "hurry", "rush", "drift"})
"""Verbs of motion that are done to their object, if they have one."""
