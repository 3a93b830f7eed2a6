"""Effects made of many small things: smoke, sparks, drops, leaves; and the words for them.

How they look and move is in `staging.particles`; readers need only this table.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType


@dataclass(frozen=True)
class EffectWords:
    """How English names an effect."""

    nouns: tuple[str, ...] = ()
    """Singular or mass nouns that name it, such as "smoke": "smoke rises from a chimney"."""
    verbs: tuple[str, ...] = ()
    """Base forms said of the object it comes from, such as "smoke": "a chimney smokes"."""
    adjectives: tuple[str, ...] = ()
    """Said of the object it comes from, such as "steaming"."""
    happens_once: bool = False
    """Whether it begins at one instant (a burst) rather than going on."""
    needs_source: bool = True
    """Whether it comes from an object; otherwise it can be all around."""
    is_around: bool = False
    """Whether it is all around, whatever the prompt says that it comes from."""
    ends_source: bool = False
    """Whether the object it comes from is gone afterwards."""


LIQUID_COLOURS: Mapping[str, tuple[float, float, float]] = MappingProxyType({
    "milk": (0.9, 0.88, 0.82), "cream": (0.9, 0.86, 0.75), "coffee": (0.14, 0.06, 0.03),
    "tea": (0.35, 0.14, 0.04), "wine": (0.30, 0.01, 0.04), "juice": (0.9, 0.42, 0.05),
    "oil": (0.75, 0.55, 0.08), "honey": (0.75, 0.38, 0.04), "beer": (0.75, 0.42, 0.06),
    "sauce": (0.45, 0.06, 0.02), "chocolate": (0.18, 0.07, 0.03), "syrup": (0.4, 0.15, 0.03),
    "batter": (0.85, 0.72, 0.45), "whiskey": (0.55, 0.25, 0.05),
})  # fmt: skip
"""Word of a prompt → colour of what is poured."""

EFFECTS: Mapping[str, EffectWords] = MappingProxyType({
    "lightning": EffectWords(
        ("lightning", "lightening", "lightning bolt", "lightning flash", "thunder", "thunderstorm",
         "electrical storm", "lightning storm", "bolt of lightning", "flash of lightning",
         "lightning strike", "thunder and lightning"), ("thunder",), needs_source=False,
        is_around=True,
    ),
    "stage lights": EffectWords(
        ("spotlight", "stage lighting", "disco light", "moving spotlight", "concert light",
         "club light", "light show", "party light"), needs_source=False, is_around=True,
    ),
    "lasers": EffectWords(
        ("laser", "laser beam", "laser light", "laser show"), needs_source=False, is_around=True,
    ),
    "string lights": EffectWords(
        ("string light", "fairy light", "holiday light", "christmas light", "string of lights",
         "led strip", "light chain", "light string", "festive light", "led light strip"),
        needs_source=False,
    ),
    "blinking lights": EffectWords(needs_source=False),
    "beacon": EffectWords(
        ("beacon", "warning beacon", "emergency light", "warning light", "siren light",
         "police light", "rotating light", "siren"),
    ),
    "turn signal": EffectWords(("turn signal", "turn indicator", "blinker", "indicator light")),
    "hazard lights": EffectWords(("hazard light", "hazard warning light")),
    "smoke": EffectWords(
        ("smoke", "fume", "exhaust", "exhaust smoke", "smoke plume", "plume of smoke"), ("smoke",),
        ("smoking", "smoky"), needs_source=False,
    ),
    "steam": EffectWords(
        ("steam", "vapour", "vapor", "water vapour", "water vapor", "condensation"),
        ("steam", "boil", "simmer"),
        ("steaming", "steaming hot", "piping hot"), needs_source=False,
    ),
    "mist": EffectWords(
        ("mist", "fog bank", "haze", "dry ice", "ground fog", "bank of fog"), (), ("misty", "hazy"),
        needs_source=False,
    ),
    "fire": EffectWords(
        ("flame", "blaze"), ("burn", "catch fire", "blaze"),
        ("burning", "on fire", "in flames", "flaming", "ablaze"), needs_source=False,
    ),
    "embers": EffectWords(("ember", "glowing ash"), ("glow and crackle",), needs_source=False),
    "sparks": EffectWords(
        ("spark", "shower of sparks", "welding spark"), ("spark", "give off sparks", "weld"),
        ("sparking",), needs_source=False,
    ),
    "fireworks": EffectWords(
        ("firework", "fireworks", "firework display", "pyrotechnics"), needs_source=False
    ),
    "splash": EffectWords(
        ("splash",), ("splash", "splash into the water", "plop"), ("splashing",),
        happens_once=True, needs_source=False,
    ),
    "drip": EffectWords(
        ("drip", "water drop", "droplet", "drop", "drop of water", "water droplet"),
        ("drip", "leak"), ("dripping", "leaking", "leaky"), needs_source=False,
    ),
    "pour": EffectWords(
        ("stream of water", "jet of water", "water jet", "running water"),
        ("pour", "pour out", "run with water", "spill"), ("pouring",),
    ),
    "pour into": EffectWords(),
    "popcorn": EffectWords((), needs_source=False),
    "fountain": EffectWords(
        ("fountain", "water fountain", "geyser"), ("spout",), needs_source=False
    ),
    "falling water": EffectWords(("falling water", "cascading water")),
    "spray": EffectWords(
        ("spray", "sea spray", "water spray"), ("spray", "squirt"), ("spraying",),
        needs_source=False,
    ),
    "dust": EffectWords(
        ("dust", "dust cloud", "cloud of dust"), ("kick up dust", "raise dust", "stir up dust"),
        ("dusty",), needs_source=False,
    ),
    "sand": EffectWords(
        ("blowing sand", "sandstorm", "sand storm", "dust storm"), ("throw up sand",),
        needs_source=False,
    ),
    "leaves": EffectWords(
        ("falling leaf", "autumn leaf", "leaf in the wind"), ("lose leaves", "shed leaves"),
        needs_source=False,
    ),
    "petals": EffectWords(
        ("petal", "falling petal", "cherry blossom petal"), ("shed petals",), needs_source=False
    ),
    "confetti": EffectWords(("confetti", "streamer", "ticker tape"), needs_source=False),
    "bubbles": EffectWords(
        ("bubble", "soap bubble", "air bubble"), ("bubble", "blow bubbles", "fizz"),
        ("bubbling", "fizzing"), needs_source=False,
    ),
    "feathers": EffectWords(("falling feather", "feather"), ("moult",), needs_source=False),
    "hail": EffectWords(("hail", "hailstone", "hailstorm"), ("hail",), needs_source=False),
    "break": EffectWords(
        ("shard", "broken glass"),
        ("break", "shatter", "smash", "fall apart", "crumble", "collapse", "splinter",
         "break apart", "break into pieces", "fall to pieces", "go to pieces"),
        ("breaking", "shattering", "crumbling"), happens_once=True, ends_source=True,
    ),
    "burst": EffectWords(
        (), ("burst", "pop"), ("bursting", "popping"), happens_once=True, ends_source=True
    ),
    "explode": EffectWords(
        ("explosion", "blast", "detonation"), ("explode", "blow up", "detonate", "blast"),
        ("exploding",), happens_once=True, needs_source=False, ends_source=True,
    ),
})  # fmt: skip
"""Every effect the generator shows."""
