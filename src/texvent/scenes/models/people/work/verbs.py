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
    (HandWork("slice", "knife"), "slice cut carve chop"),
    (HandWork("slice", "knife", shown_as="slice"), "dice mince fillet julienne"),
    (HandWork("peel", "knife", "hands", shown_as="scrape with a knife"), "peel whittle pare"),
    (HandWork("snip", "scissors"), "trim snip clip"),
    (HandWork("snip", "scissors", shown_as="snip"), "prune shear"),
    (HandWork("saw", "saw"), "saw"),
    # Striking.
    (HandWork("strike", "hammer"), "hammer nail pound"),
    (HandWork("strike", "hammer", shown_as="hammer"), "forge chisel tenderize crush smash "
     "demolish"),
    (HandWork("strike", "stick", "there"), "hit strike whack beat thrash bash thump"),
    (HandWork("strike", "stick", "there", shown_as="hit"), "batter swat"),
    (HandWork("chop", "axe", "there"), "hew"),
    (HandWork("chop", "axe", "there", shown_as="chop"), "fell"),
    # Along a surface, to and fro.
    (HandWork("rub", "cloth"), "wipe polish rub dry dust buff towel clean wax shine"),
    (HandWork("rub", "sponge", "there"), "wash scrub scour"),
    (HandWork("rub", "sponge", "there", shown_as="scrub"), "rinse soap shampoo bathe lather"),
    (HandWork("rub", "", "there"), "smooth"),
    (HandWork("rub", "block"), "sand sandpaper"),
    (HandWork("rub", "block", shown_as="rub"), "grate"),
    (HandWork("rub", "iron"), "iron"),
    (HandWork("rub", "rolling pin", shown_as="roll a pin over"), "flatten"),
    (HandWork("stroke", "", "there"), "pet stroke pat caress touch"),
    (HandWork("stroke", "", "there", shown_as="stroke"), "fondle cuddle tickle comfort"),
    (HandWork("stroke", "brush", "there"), "brush groom comb"),
    (HandWork("stroke", "paintbrush", "there", "front"), "paint varnish lacquer whitewash"),
    (HandWork("stroke", "paintbrush", shown_as="brush"), "baste grease"),
    (HandWork("rub", "trowel"), "plaster"),
    (HandWork("rub", "trowel", shown_as="rub with a trowel"), "spread smear frost"),
    # Small movements at a spot.
    (HandWork("scribble", "pen"), "sign draw sketch trace doodle"),
    (HandWork("scribble", "pen", shown_as="draw"), "engrave label"),
    (HandWork("scribble", "pen", "there", "front"), "chalk"),
    (HandWork("pluck", "needle", "hands"), "sew stitch embroider mend darn suture"),
    (HandWork("knit", "needles", "hands"), "knit"),
    (HandWork("knit", "needles", "hands", shown_as="knit"), "crochet"),
    (HandWork("tie", shown_as="handle"), "tie untie knot lace unlace braid plait wrap unwrap "
     "bandage fasten buckle button unbutton zip unzip arrange decorate"),
    (HandWork("twist", "wrench"), "tighten loosen screw unscrew bolt unbolt repair fix service "
     "adjust tinker"),
    (HandWork("twist", "wrench", shown_as="work on"), "change replace maintain assemble "
     "disassemble install"),
    (HandWork("squeeze"), "squeeze wring"),
    (HandWork("squeeze", shown_as="squeeze"), "juice"),
    (HandWork("reel", shown_as="reel"), "unwind wind coil uncoil unroll"),
    (HandWork("uncork", "corkscrew"), "uncork"),
    (HandWork("unlock", "key", "there", "front"), "unlock lock"),
    (HandWork("drill", "drill", "there", "front"), "drill bore"),
    (HandWork("hold", "torch"), "weld solder braze"),
    (HandWork("hold", "magnifier"), "inspect examine study"),
    (HandWork("hold", "magnifier", shown_as="inspect"), "check measure investigate diagnose scan"),
    (HandWork("dab", "pipette"), "pipette dab"),
    (HandWork("dab", "pipette", shown_as="dab"), "inject vaccinate glue"),
    (HandWork("dab"), "poke prod tap press"),
    (HandWork("dab", shown_as="poke"), "pinch click"),
    (HandWork("knock", "", "there", "front"), "knock"),
    # Both hands.
    (HandWork("press"), "knead massage"),
    (HandWork("press", shown_as="press"), "squash stamp"),
    (HandWork("mould"), "shape mould mold sculpt"),
    (HandWork("fold", shown_as="handle"), "fold unfold sort crumple tear rip stack "
     "shuffle pack unpack"),
    (HandWork("stir", "spoon"), "stir mix"),
    (HandWork("stir", "spoon", shown_as="stir"), "whisk blend scramble season fry boil roast grill "
     "bake simmer saute sear"),
    (HandWork("sprinkle", "shaker"), "sprinkle"),
    (HandWork("sprinkle", "shaker", shown_as="sprinkle"), "garnish dredge"),
    (HandWork("pour", "jug"), "pour"),
    (HandWork("pour", "jug", shown_as="pour"), "refill spill decant"),
    (HandWork("water", "can", "there"), "water"),
    # Moving the thing itself.
    (HandWork("lift", "", "there"), "lift heave"),
    (HandWork("put", "", "there"), "put place put_down set_down lay_down"),
    (HandWork("take", "", "there"), "pick_up take_out pull_out lift_up"),
    (HandWork("take"), "grab snatch seize grasp"),
    (HandWork("drop", "", "there"), "drop"),
    (HandWork("punch", "", "there", "front"), "punch"),
    (HandWork("tug", "", "there"), "tug yank"),
    (HandWork("tug", "", "there", shown_as="tug at"), "milk"),
    (HandWork("rock", "", "there"), "shake rattle jiggle"),
    (HandWork("offer", "food", "there"), "feed"),
    (HandWork("reach", "", "there"), "reach"),
    (HandWork("reach", "", "there", shown_as="reach for"), "pick pluck harvest gather collect"),
    (HandWork("reach", "", "table", "front", "reach for"), "open close unlatch"),
    (HandWork("dig", "trowel", "there", shown_as="dig with a trowel"), "plant weed till hoe bury "
     "transplant"),
    (HandWork("spray", "can", "there", "front"), "spray"),
    (HandWork("spray", "can", "there", "front", "spray"), "hose"),
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

HOVERING = frozenset({"reel", "pour", "water", "sprinkle", "spray", "hold", "pluck", "knit"})
"""Patterns in which the tool stays above the thing, or goes out of it and comes back."""
