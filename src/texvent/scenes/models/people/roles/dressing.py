"""A person dressed in what the prompt says is worn."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import partial
from types import MappingProxyType
from typing import Any

from texvent.scenes.models.materials import CLOTH_COLOURS
from texvent.scenes.models.people.outfit import PersonKind
from texvent.scenes.models.protocol import Noun
from texvent.scenes.scene import Colour

_BLACK: Colour = (0.02, 0.02, 0.024)
_BLUE: Colour = (0.04, 0.10, 0.28)
_STRAW: Colour = (0.66, 0.50, 0.20)

_OVER: Mapping[str, tuple[str, Colour | None]] = MappingProxyType(
    {
        "coat": ("long coat", None),
        "apron": ("apron", (0.80, 0.80, 0.78)),
        "dress": ("skirt", None),
        "skirt": ("skirt", None),
        "robe": ("robe", None),
        "cape": ("cape", (0.55, 0.03, 0.02)),
        "overalls": ("overalls", _BLUE),
        "tutu": ("tutu", None),
    }
)
"""Garment → name of its `roles.garments.GARMENTS`, and its usual colour; None = of the shirt."""
_ON_HEAD: Mapping[str, tuple[str, Colour]] = MappingProxyType(
    {
        "cowboy hat": ("cowboy", (0.16, 0.08, 0.03)),
        "straw hat": ("straw", _STRAW),
        "top hat": ("top hat", _BLACK),
        "chef hat": ("toque", (0.80, 0.80, 0.78)),
        "witch hat": ("pointed", _BLACK),
        "santa hat": ("santa", (0.55, 0.03, 0.02)),
        "turban": ("turban", (0.60, 0.30, 0.05)),
        "woolly hat": ("woolly", (0.45, 0.05, 0.04)),
        "hood": ("hood", (0.20, 0.20, 0.21)),
        "goggles": ("flying cap", _BLACK),
    }
)
"""What is on the head → name of its `roles.hats.HATS`, and its usual colour."""
_SUITS = ("wetsuit", "suit", "pyjamas", "spacesuit")
_SLEEVED = ("coat", "jacket", "robe", "sweater", "hoodie", *_SUITS)
_ON_LIMBS: Mapping[str, Colour] = MappingProxyType(
    {
        "shoe": (0.10, 0.05, 0.03),
        "boot": (0.16, 0.08, 0.03),
        "sandal": (0.30, 0.16, 0.07),
        "high heel": (0.55, 0.03, 0.02),
        "glove": (0.45, 0.05, 0.04),
        "belt": (0.14, 0.07, 0.03),
    }
)
"""Footwear, gloves and belts → their usual colours."""
DRESSED = frozenset({*_OVER, *_ON_HEAD, *_SLEEVED, *_ON_LIMBS, "shirt", "shorts", "trousers"})
"""Nouns that show as clothes on a body and not as things of their own."""
_USUAL: Mapping[str, Colour] = MappingProxyType(
    {
        "wetsuit": _BLACK,
        "suit": _BLACK,
        "pyjamas": (0.35, 0.50, 0.68),
        "spacesuit": (0.8, 0.8, 0.78),
    }
)


def dress(noun: Noun, worn: Iterable[tuple[str, Colour | None]]) -> Noun:
    """The noun of a person in what it wears.

    Args:
        noun: a person; its builder is made of its `PersonKind`.
        worn: nouns of `DRESSED` with their colours; None = the usual one.
    """
    build: Any = noun.build
    kind: PersonKind = build.args[0]
    for name, colour in worn:
        kind = _put_on(kind if kind.creature is None else _cover(kind, name), name, colour)
    return replace(noun, build=partial(build.func, kind))


def _cover(kind: PersonKind, name: str) -> PersonKind:
    """An upright animal's garment in its usual colours; the rest of it stays bare."""
    if name in _TOPS and not kind.shirts:
        kind = replace(kind, shirts=CLOTH_COLOURS)
    if name == "dress":
        return replace(kind, garments=(*kind.garments, ("skirt", None)))
    if name in _BELOW and kind.trousers is None:
        kind = replace(kind, trousers=_USUAL.get(name, _DENIM))
    return kind


_TOPS = frozenset({*_SLEEVED, "shirt", "dress", "skirt", "tutu"})
"""Garments that cover chest and arms; a skirt has the shirt's cloth."""
_BELOW = frozenset({*_SUITS, "trousers", "shorts", "overalls"})
_DENIM: Colour = (0.05, 0.11, 0.26)


def _put_on(kind: PersonKind, name: str, colour: Colour | None) -> PersonKind:
    if name in _ON_HEAD:
        hat, usual = _ON_HEAD[name]
        return replace(kind, hat=hat, hat_colour=colour or usual)
    if name in _ON_LIMBS:
        return _put_on_limbs(kind, name, colour or _ON_LIMBS[name])
    if name in _OVER:
        garment, usual_hue = _OVER[name]
        others = tuple(one for one in kind.garments if one[0] != garment)
        kind = replace(kind, garments=(*others, (garment, colour or usual_hue)))
    if name in _SUITS:
        hue = colour or _USUAL[name]
        kind = replace(kind, shirts=(hue,), trousers=hue, dress="trousers")
    elif name == "shorts":
        kind = replace(kind, dress="shorts", trousers=colour or kind.trousers)
    elif name == "trousers":
        kind = replace(kind, dress="trousers", trousers=colour or kind.trousers)
    elif name == "dress":
        kind = replace(kind, dress="skirt", garments=kind.garments[:-1])
    elif colour is not None and name not in ("apron", "cape", "skirt", "tutu", "overalls"):
        kind = replace(kind, shirts=(colour,))
    if name == "spacesuit":
        kind = replace(kind, hat="bubble", bulk=1.45, garments=(("life pack", None),))
    return replace(kind, has_sleeves=kind.has_sleeves or name in _SLEEVED)


def _put_on_limbs(kind: PersonKind, name: str, hue: Colour) -> PersonKind:
    """Gloves, a belt, or shoes of that colour; boots reach up the shins."""
    if name == "glove":
        return replace(kind, gloves=hue)
    if name != "belt":
        kind = replace(kind, shoes=hue)
    over = {"boot": "boots", "belt": "belt"}.get(name)
    return replace(kind, garments=(*kind.garments, (over, hue))) if over else kind
