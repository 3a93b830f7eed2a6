"""Nouns of bodies that bend or depend on the seed, from the TOML files of `data/bodies/`.

An entry has the keys of a noun (names, plurals, place, habitat, motion, speed, works), `size`, and
those of a four-legged animal, which `quadruped.build` describes, or of a figure:

    colours    {paint = ["(.5 .3 .1)"]}: usual ones; the one that a prompt says takes their place
    surfaces   {wing = "paint*.8 feathers"}
    parts      part lines of what stays in place
    wave       of a swimmer, which takes `parts` along: see `joints.read_wave`
    moving     groups of parts by name, with `joints`, the outermost first; `rest` = its joints
               while the body stays where it is; `pair` = the same group on the other side
    chains     see `limbs.Chain`
    clumps     see `figure._read_clump`
    gait, legs, bob    {stride, duty, lift}, see `limbs.Legs`; how far the body is lifted m, how
               often each stride, how late
    like       an entry above, whose keys it has where it has none of its own

What stands above a file's first entry holds for all of them.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.resources import files
from types import MappingProxyType
from typing import Any

from texvent.errors import FileFormatError, InputError
from texvent.scenes.models.animals.acts import ANIMAL_ACTS, MOUTH_ACTS
from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.bodies.figure import build_figure
from texvent.scenes.models.bodies.quadruped.body import build_quadruped
from texvent.scenes.models.protocol import Noun
from texvent.scenes.scene import Colour


def _read_family(text: str) -> tuple[Noun, ...]:
    tables = tomllib.loads(text)
    usual = {key: value for key, value in tables.items() if not isinstance(value, Mapping)}
    entries: dict[str, Mapping[str, Any]] = {}
    for noun in (key for key in tables if key not in usual):
        entry = tables[noun]
        model = entries[entry["like"]] if "like" in entry else usual
        inherited = {key: value for key, value in model.items() if key not in _OWN}
        entries[noun] = _merged(inherited, entry)
    return tuple(_read_noun(noun, entry) for noun, entry in entries.items())


def _merged(model: Mapping[str, Any], own: Mapping[str, Any]) -> Mapping[str, Any]:
    """A table with what it does not say taken from another, in the tables within it too."""
    return {
        key: _merged(model[key], own[key])
        if isinstance(own.get(key), Mapping) and isinstance(model.get(key), Mapping)
        else own.get(key, model.get(key))
        for key in {**model, **own}
    }


_OWN = ("names", "plurals")
"""Keys that no other entry inherits."""


@dataclass(frozen=True, eq=False)
class BodyBuilder:
    """Builds the models of one noun from its table; implements `protocol.ModelBuilder`."""

    name: str
    table: Mapping[str, Any]
    is_centred: bool

    def __call__(self, *, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
        """Build it; `colour` takes the place of its usual ones.

        Raises:
            FileFormatError: its table cannot be read.
        """
        build = build_quadruped if "build" in self.table else build_figure
        try:
            return build(self.table, self.is_centred, colour=colour, scale=scale, seed=seed)
        except InputError:
            raise
        except (KeyError, TypeError, ValueError) as error:
            raise FileFormatError(f"data/bodies, {self.name!r}: {error}") from error


def _read_noun(name: str, table: Mapping[str, Any]) -> Noun:
    habitat = table.get("habitat", "fixed")
    motion = table.get("motion", "stand")
    is_centred = habitat == "air" or (habitat == "water" and motion == "swim")
    return Noun(
        name,
        BodyBuilder(name, table, is_centred),
        habitat,
        table.get("speed", 0.0),
        motion,
        tuple(table.get("names", ())),
        tuple(table.get("plurals", ())),
        place=table.get("place", ""),
        acts=_acts_of(table),
        is_working=table.get("works", False),
    )


def _acts_of(table: Mapping[str, Any]) -> frozenset[str]:
    """What a body does in its place: all with four legs, what the mouth does if it bows."""
    if "build" in table:
        return frozenset(ANIMAL_ACTS)
    groups = table.get("moving", {}).values()
    joints = [joint for one in groups for joint in (*one.get("joints", ()), *one.get("rest", ()))]
    bows = any(joint.startswith("bow ") for joint in joints)
    return MOUTH_ACTS if bows else frozenset()


def _read_families() -> Mapping[str, tuple[Noun, ...]]:
    folder = files("texvent.scenes.models") / "data" / "bodies"
    found = sorted(folder.iterdir(), key=lambda file: file.name)
    return {
        file.name.removesuffix(".toml").replace("_", " "): _read_family(
            file.read_text(encoding="utf-8")
        )
        for file in found
        if file.name.endswith(".toml")
    }


BODY_FAMILIES: Mapping[str, tuple[Noun, ...]] = MappingProxyType(_read_families())
"""Nouns of bodies by family, such as "quadrupeds"."""
