"""Nouns as data: the TOML files of `data/nouns/` and `data/bodies/`, built when they are shown.

    [pendulum]
    colours = ["(.6 .3 .04)"]
    parts = '''
    box wood   0 0 .03   .4 .9 .06
    rod wood   0 ±.42 .05   0 ±.42 1.18   .025
    moving swing x 0 0 1.17 22.9deg .541hz
    ball paint   0 0 .32   .2 .2 .2'''

docs/nouns.md describes the format.
"""

from __future__ import annotations

import math
import re
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property, lru_cache
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any

import numpy as np

from texvent.errors import FileFormatError, InputError
from texvent_scenes.models.activities import ANIMAL_ACTIVITIES, USUAL, limbs_of, motion_of
from texvent_scenes.models.gait import read_walk
from texvent_scenes.models.joints import Joint, read_joint, read_joints, read_wave
from texvent_scenes.models.limbs import Chain, read_legs
from texvent_scenes.models.part_lines import Placed, read_parts
from texvent_scenes.models.people.person import read_rider
from texvent_scenes.models.postures import Postures, list_channels
from texvent_scenes.models.protocol import (
    ModelPart,
    Noun,
    PartChoice,
    between,
    choose,
    fraction,
)
from texvent_scenes.models.shapes import (
    SAMPLE_POSES,
    STANDING_POSES,
    ArticulatedModel,
    ball,
    compose,
    half_extents,
    shift,
    turn_about,
)
from texvent_scenes.models.skeleton import Anchor, Body, PartGroup, read_anchor, read_skeleton
from texvent_scenes.models.surfaces import WORDS, Painted, paint_model, toned
from texvent_scenes.models.tables import fill_in, fill_in_each
from texvent_scenes.rendered_scene import Colour

_KEYS: Mapping[str, tuple[type, ...]] = {
    "names": (list,), "plurals": (list,), "place": (str,), "habitat": (str,), "motion": (str,),
    "speed": (float, int), "works": (bool,), "laid": (bool,), "like": (str,), "rider": (dict,),
    "colours": (list, dict), "varied": (dict,), "surfaces": (dict,), "variants": (dict,),
    "parts": (str,), "more": (str,), "size": (float, int), "wave": (str,), "chains": (list,),
    "clumps": (list,), "legs": (list,), "gait": (dict,), "run": (dict,), "trot": (dict,),
    "runs": (bool,),
    "body": (str,), "sizes": (dict,), "acts": (str,), "anchors": (dict,), "options": (dict,),
    "with": (list,), "usual_more": (str,), "own_parts": (dict,),
    "each": (dict,),
}  # fmt: skip
"""Keys of a noun, and what their values are."""
_ACTS = ("animal_activities", "hand_gestures")
"""Tables of activities that the joints of a noun may follow, the usual one first."""
_OWN = ("names", "plurals", "more", "usual_more")
"""Keys that no noun takes from the one that it is like."""
_COUNTED = ("each", "own_parts")
"""Keys that go with `parts`: what is drawn otherwise has no such parts."""
_HABITATS: Mapping[str, str] = {
    **dict.fromkeys(("drive", "walk", "run", "roll", "slide"), "ground"),
    **dict.fromkeys(("fly", "float"), "air"),
    **dict.fromkeys(("swim", "sail", "paddle"), "water"),
    "stand": "fixed",
}
"""Usual motion → habitat, where an entry does not say it."""


@dataclass(frozen=True, eq=False)
class PartsBuilder:
    """Builds the models of one noun; implements `protocol.ModelBuilder`."""

    where: str
    """File and noun, for messages."""
    table: Mapping[str, Any]

    def __call__(self, *, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
        """Build it; `colour` takes the place of `colours`.

        Raises:
            FileFormatError: its table cannot be read.
        """
        try:
            return _build(self, colour, seed).scaled(scale * self._filled.get("size", 1.0))
        except InputError:
            raise
        except (KeyError, TypeError, ValueError) as error:
            raise FileFormatError(f"{self.where}: {error}") from None

    def with_parts(self, said: Sequence[tuple[str, int | None, Colour | None]]) -> PartsBuilder:
        """The same noun with other numbers and colours of parts; their count is a size of it."""
        sizes, surfaces = dict(self.table.get("sizes", {})), dict(self.table.get("surfaces", {}))
        for name, count, colour in said:
            surface = self.table["own_parts"][name].get("surface")
            sizes |= {name: count} if count is not None else {}
            if surface and colour is not None:
                words = WORDS.findall(surfaces[surface].replace(":", " "))
                hue = " ".join(f"{one:.6g}" for one in colour)
                surfaces[surface] = " ".join((f"({hue})", *words[1:]))
        return replace(self, table={**self.table, "sizes": sizes, "surfaces": surfaces})

    def build(self, colour: Colour | None, seed: int) -> ArticulatedModel:
        """Build it at its usual size."""
        table = self._filled
        painted = paint_model(table, colour=colour, seed=seed)
        placed, groups = self._drawing
        for label, texts in self._variants.items():
            placed = (*placed, *choose(seed, label, texts))
        rigid = painted.draw(placed)
        is_usual = colour is None
        drawn = [(one, painted.draw(one.parts) if is_usual or not one.is_usual else [])
                 for one in groups]  # fmt: skip
        drawn += [_read_clump(one, painted, seed) for one in table.get("clumps", ())]
        extras = [Chain(**one).drawn_in(painted) for one in table.get("chains", ())]
        rider = read_rider(table["rider"]) if "rider" in table else None
        if rider is not None:
            extras.append(lambda now, _: rider.draw(seed, now.pose.distance_m))
        acts, joints = table.get("acts", _ACTS[0]), read_joints(table.get("body", ""))
        _check_channels((*joints, *(one for group in groups for one in group.joints)), acts)
        body = Body(
            seed,
            Postures(acts).find_channels,
            drawn,
            self._anchors,
            extras,
            rigid=rigid,
            joints=joints,
            wave=read_wave(table["wave"]) if "wave" in table else None,
            walk=read_walk(table),
            legs=read_legs(table, painted),
        )
        locate = body.locate if self._anchors else None
        if rider is not None:
            locate = lambda name, pose: rider.locate(seed, name, pose.distance_m)  # noqa: E731
        return ArticulatedModel(
            [] if body.moves_all else rigid,
            articulate=body.articulate if body.moves_all or drawn or extras else None,
            is_centred=_is_centred(table),
            anchor=locate,
            poses=SAMPLE_POSES if body.rests else STANDING_POSES,
            is_wheeled=any(one.rolls for group, _ in drawn for one in group.joints[:1]),
        )

    @cached_property
    def _filled(self) -> Mapping[str, Any]:
        """Its table with numbers in place of formulas."""
        return fill_in(self.table)

    @cached_property
    def _anchors(self) -> Mapping[str, Anchor]:
        said = self._filled.get("anchors", {})
        names = {one.name for one in self._drawing[1] if one.name}
        return {name: read_anchor(text, names) for name, text in said.items()}

    @cached_property
    def _drawing(self) -> tuple[tuple[Placed, ...], tuple[PartGroup, ...]]:
        """Parts that stay in the body, and groups of those that move."""
        table = self._filled
        texts = [
            (table.get(key, ""), key == "usual_more") for key in ("parts", "more", "usual_more")
        ]
        options = table.get("options", {})
        if not set(table.get("with", ())) <= options.keys():
            raise ValueError(f"with is {table['with']}; known: {', '.join(options) or 'none'}")
        texts += [(options[name], False) for name in table.get("with", ())]
        texts += [(one, False) for one in fill_in_each(self.table)]
        rigid, groups = read_skeleton(texts)
        return _laid(rigid) if table.get("laid") else rigid, groups

    @cached_property
    def _variants(self) -> Mapping[str, Sequence[tuple[Placed, ...]]]:
        """Parts of which the seed chooses one list, by the label of the choice."""
        said = self._filled.get("variants", {})
        return {label: [read_parts(one)[0] for one in texts] for label, texts in said.items()}


@lru_cache(maxsize=1024)  # of 10 to 30 kB each
def _build(builder: PartsBuilder, colour: Colour | None, seed: int) -> ArticulatedModel:
    """The body at its usual size: most of a scene's time is measuring those of its scenery."""
    return builder.build(colour, seed)


@lru_cache(maxsize=256)
def with_parts(noun: Noun, said: tuple[tuple[str, int | None, Colour | None], ...]) -> Noun:
    """A noun with other parts: name, number and colour of each; None = as usual."""
    known = {one.name for one in noun.choices}
    own = [one for one in said if one[0] in known]
    build = noun.build
    if not own or not isinstance(build, PartsBuilder):
        return noun
    return replace(noun, build=build.with_parts(own))


def _check_channels(joints: Sequence[Joint], acts: str) -> None:
    """Refuse channels that nothing gives a value."""
    known = {*list_channels(acts), "step", "walk", "run"}
    for name in (name for joint in joints for name in joint.channels):
        if name not in known:
            raise ValueError(f"no channel {name!r}; known: {', '.join(sorted(known))}")


def _read_clump(
    table: Mapping[str, Any], painted: Painted, seed: int
) -> tuple[PartGroup, list[ModelPart]]:
    """Balls around an upright axis, their places, sizes and shades chosen by the seed.

    Its table: count, surface; lowest and highest `out` (from the axis), `up`, `size` (m) and
    `shade`; `across` (their places and extents along y compared with those along x), `flat`
    (their extents along z); joints.
    """
    material, count = painted.material(table["surface"]), table["count"]
    across, flat = table.get("across", 1.0), table.get("flat", 1.0)
    parts = []
    for index in range(count):
        angle = math.tau * (index + 0.6 * fraction(seed, f"angle {index}")) / count
        out, up, size, tint = (
            between(seed, f"{name} {index}", *table[name])
            for name in ("out", "up", "size", "shade")
        )
        at = (out * math.cos(angle), across * out * math.sin(angle), up)
        parts.append(ball(toned(material, tint), at, (size, across * size, flat * size)))
    return PartGroup((), tuple(map(read_joint, table.get("joints", ())))), parts


def _laid(parts: Sequence[Placed]) -> tuple[Placed, ...]:
    """Parts drawn upright, laid on their backs over the origin."""
    turn = turn_about("y", -0.5 * math.pi)
    turned = [replace(one, to_body=compose(turn, one.to_body)) for one in parts]
    ends = [half_extents(one.shape, one.to_body) for one in turned]
    low = np.min([low for low, _ in ends], axis=0)
    high = np.max([high for _, high in ends], axis=0)
    drop = shift(-0.5 * (low[0] + high[0]), -0.5 * (low[1] + high[1]), -low[2])
    return tuple(replace(one, to_body=compose(drop, one.to_body)) for one in turned)


def _is_centred(table: Mapping[str, Any]) -> bool:
    """Whether the origin is its middle: of what flies or swims, not of what floats."""
    habitat = _habitat(table)
    return habitat == "air" or (habitat == "water" and table.get("motion") == "swim")


def read_nouns(file: Path | Traversable) -> tuple[Noun, ...]:
    """The nouns of a TOML file; what stands above its first table, or in "usual", holds for all.

    Raises:
        FileFormatError: the file is damaged or has a key that no noun has; what is wrong with parts
            is said when the noun is first built.
    """
    try:
        tables = tomllib.loads(file.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise FileFormatError(f"{file}: {error}") from error
    usual = {key: value for key, value in tables.items() if not isinstance(value, Mapping)}
    nouns = [key for key in tables if key not in usual and key != USUAL]
    usual |= tables.get(USUAL, {})
    entries: dict[str, Mapping[str, Any]] = {}
    for name in nouns:
        own, like = tables[name], tables[name].get("like")
        if like is not None and like not in entries:
            raise FileFormatError(
                f"{file.name}, {name!r}: there is no noun {like!r} above it to be like"
            )
        model = usual if like is None else entries[like]
        left = (*_OWN, *(_COUNTED if "parts" in own else ()))
        entries[name] = _merged({key: model[key] for key in model if key not in left}, own)
    return tuple(_noun(f"{file.name}, {name!r}", name, entries[name]) for name in entries)


def _merged(model: Mapping[str, Any], own: Mapping[str, Any]) -> Mapping[str, Any]:
    """A table with what it does not say taken from another, in the tables within it too."""
    return {
        key: _merged(model[key], own[key])
        if isinstance(own.get(key), Mapping) and isinstance(model.get(key), Mapping)
        else own.get(key, model.get(key))
        for key in {**model, **own}
    }


def _habitat(table: Mapping[str, Any]) -> Any:
    return table.get("habitat") or _HABITATS.get(table.get("motion", "stand"), "ground")


def _noun(where: str, name: str, table: Mapping[str, Any]) -> Noun:
    for key, value in table.items():
        if key not in _KEYS:
            raise FileFormatError(f"{where}: unknown key {key!r}; known: {', '.join(_KEYS)}")
        if not isinstance(value, _KEYS[key]):
            raise FileFormatError(
                f"{where}: {key} must be a {_KEYS[key][0].__name__} but is {value!r}"
            )
    habitat = _habitat(table)
    if habitat not in _HABITATS.values():
        known = ", ".join(dict.fromkeys(_HABITATS.values()))
        raise FileFormatError(f"{where}: habitat must be one of {known} but is {habitat!r}")
    if table.get("acts", _ACTS[0]) not in _ACTS:
        raise FileFormatError(f"{where}: acts must be one of {', '.join(_ACTS)}")
    return Noun(
        name,
        PartsBuilder(where, table),
        habitat,
        float(table.get("speed", 0.0)),
        table.get("motion", "stand"),
        tuple(table.get("names", ())),
        tuple(table.get("plurals", ())),
        place=table.get("place", ""),
        acts=_acts_of(table) if "acts" not in table else frozenset(),
        is_working=bool(table.get("works", habitat == "fixed" and _moves_by_itself(table))),
        choices=tuple(_read_choice(where, key, table) for key in table.get("own_parts", ())),
    )


def _read_choice(where: str, name: str, table: Mapping[str, Any]) -> PartChoice:
    """Parts that may be said: `most` of them, of the usual number in `sizes`; their `surface`."""
    row = table["own_parts"][name]
    most, surface = row.get("most", 0), row.get("surface")
    usual = table.get("sizes", {}).get(name) if most else 0
    is_so = isinstance(usual, int) and surface in (None, *table.get("surfaces", {}))
    if not is_so or not {*row} <= {"most", "surface", "names"}:
        raise FileFormatError(
            f"{where}: own_parts.{name} may have most, where sizes.{name} is a whole number; a "
            f"surface, which surfaces has; and names; but it is {row}"
        )
    return PartChoice(name, usual, most, surface is not None, tuple(row.get("names", ())))


def _moves_by_itself(table: Mapping[str, Any]) -> bool:
    """Whether parts of it move whatever it does: no door, which an act opens."""
    lines = table.get("parts", "").splitlines()
    return any(one.startswith("moving") and " by " not in one for one in lines)


@cache
def _channels_of(act: str) -> frozenset[str]:
    """Channels that an activity of animals decides."""
    row = motion_of("animal_activities", act)
    return frozenset((*row, *row.get("keys", ()))) - {"idle"}


def _acts_of(table: Mapping[str, Any]) -> frozenset[str]:
    """Activities of animals that its joints follow."""
    text = f"{table.get('parts', '')} {table.get('body', '')}"
    followed = set(" ".join(re.findall(r"\bby ([\w. ]+)", text)).split())
    followed |= {"down"} & {"down" if word == "bow" else "" for word in text.split()}
    for leg in table.get("legs", ()):
        followed |= {
            f"{side}_{one}" for one in leg.get("feet_by", ()) for side in ("left", "right")
        }
    return frozenset(
        name
        for name in ANIMAL_ACTIVITIES
        if followed & _channels_of(name) and limbs_of(name) <= followed
    )
