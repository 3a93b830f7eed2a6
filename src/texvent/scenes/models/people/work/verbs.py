"""Verbs of hand work: how the hands move, with which tool, and where the thing is meanwhile.

Loads nothing but the standard library, so that the sentence reader can import it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType


@dataclass(frozen=True)
class HandWork:
    """What one verb means for hands; the verb is an `ObjectMotion.kind`."""

    pattern: str
    """How the hands move: a name of `patterns.PATTERNS`."""
    tool: str = ""
    """What the right hand uses unless the prompt names something: a name of `tools.TOOLS`, or ""
    for the bare hand."""
    place: str = "table"
    """Where a small thing is meanwhile: "table" (one is put there), "hands" (in the left hand) or
    "there" (where it is)."""
    side: str = ""
    """"front" = on the upright face of a thing, not on its top."""
    shown_as: str = ""
    """What is seen, where it is less than the verb says; "" = the verb itself."""


_TABLE: tuple[tuple[HandWork, str], ...] = (
    # Cutting.
    (HandWork("slice", "knife"), "slice cut carve dice mince fillet chop julienne"),
    (HandWork("peel", "knife", "hands"), "peel whittle pare"),
    (HandWork("snip", "scissors"), "trim snip prune clip shear"),
    (HandWork("saw", "saw"), "saw"),
    # Striking.
    (HandWork("strike", "hammer"), "hammer nail forge chisel pound tenderize crush smash demolish"),
    (HandWork("strike", "stick", "there"), "hit strike whack beat thrash bash thump batter swat"),
    (HandWork("chop", "axe", "there"), "hew fell"),
    # Along a surface, to and fro.
    (HandWork("rub", "cloth"), "wipe polish rub dry dust buff towel wax clean"),
    (HandWork("rub", "sponge", "there"), "wash scrub rinse scour soap shampoo bathe lather"),
    (HandWork("rub", "block"), "sand grate sandpaper"),
    (HandWork("rub", "iron"), "iron"),
    (HandWork("rub", "rolling pin"), "flatten"),
    (HandWork("stroke", "", "there"), "pet stroke pat caress fondle cuddle tickle touch comfort"),
    (HandWork("stroke", "brush", "there"), "brush groom comb"),
    (HandWork("stroke", "paintbrush", "there", "front"), "paint varnish lacquer whitewash"),
    (HandWork("stroke", "paintbrush"), "baste grease"),
    (HandWork("rub", "trowel"), "plaster spread smear frost"),
    # Small movements at a spot.
    (HandWork("scribble", "pen"), "sign draw sketch trace engrave label doodle"),
    (HandWork("scribble", "pen", "there", "front"), "chalk"),
    (HandWork("pluck", "needle", "hands"), "sew stitch embroider mend darn suture"),
    (HandWork("knit", "needles", "hands"), "knit crochet"),
    (HandWork("tie"), "tie untie knot lace unlace braid plait wrap unwrap bandage fasten buckle "
     "button unbutton zip unzip arrange decorate"),
    (HandWork("twist", "wrench"), "tighten loosen screw unscrew bolt unbolt repair fix service "
     "assemble disassemble install adjust tinker"),
    (HandWork("twist", "wrench", shown_as="work on"), "change replace maintain"),
    (HandWork("twist"), "uncork unlock wring squeeze juice unwind"),
    (HandWork("drill", "drill", "there", "front"), "drill bore"),
    (HandWork("hold", "torch"), "weld solder braze"),
    (HandWork("hold", "magnifier"), "inspect examine study measure investigate diagnose scan"),
    (HandWork("dab", "pipette"), "pipette inject vaccinate dab glue"),
    (HandWork("dab"), "pinch poke prod tap press click"),
    (HandWork("knock", "", "there", "front"), "knock"),
    # Both hands.
    (HandWork("press"), "knead massage squash stamp"),
    (HandWork("mould"), "shape mould mold sculpt"),
    (HandWork("fold", shown_as="handle"), "fold unfold sort crumple tear rip stack "
     "shuffle pack unpack"),
    (HandWork("stir", "spoon"), "stir mix whisk blend scramble season"),
    (HandWork("stir", "spoon", shown_as="stir"), "fry boil roast grill bake simmer saute sear"),
    (HandWork("sprinkle", "shaker"), "sprinkle garnish dredge"),
    (HandWork("pour", "jug"), "pour refill spill decant"),
    (HandWork("water", "can", "there"), "water"),
    # Moving the thing itself.
    (HandWork("lift", "", "there"), "lift heave"),
    (HandWork("put", "", "there"), "put place put_down set_down lay_down"),
    (HandWork("take", "", "there"), "pick_up take_out pull_out lift_up"),
    (HandWork("drop", "", "there"), "drop"),
    (HandWork("punch", "", "there", "front"), "punch"),
    (HandWork("tug", "", "there"), "tug yank"),
    (HandWork("tug", "", "there", shown_as="tug at"), "milk"),
    (HandWork("rock", "", "there"), "shake rattle jiggle"),
    (HandWork("offer", "food", "there"), "feed"),
    (HandWork("reach", "", "there"), "pick pluck harvest gather collect"),
    (HandWork("reach", "", "table", "front", "reach for"), "open close unlatch"),
    (HandWork("dig", "trowel", "there"), "plant weed till hoe bury transplant"),
    (HandWork("spray", "can", "there", "front"), "spray hose"),
)  # fmt: skip

HANDWORK: Mapping[str, HandWork] = MappingProxyType(
    {verb.replace("_", " "): work for work, verbs in _TABLE for verb in verbs.split()}
)
"""Verb → how hands do it."""

WITH_PARTICLE = frozenset(verb for verb in HANDWORK if " " in verb)
"""Verbs of hand work with a particle: "pick up"."""

MOVED = frozenset({"put", "take", "drop"})
"""Patterns that are nothing without the thing they move."""

ONTO = frozenset({"pour", "sprinkle", "dab", "offer"})
"""Patterns of what is done with one thing to another: the last one named is worked on."""

HOVERING = frozenset({"pour", "water", "sprinkle", "spray", "hold", "pluck", "knit"})
"""Patterns in which the tool stays above the thing, or goes out of it and comes back."""
