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
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any

import numpy as np

from texvent.errors import FileFormatError, InputError
from texvent_scenes.models.animals.activities import ANIMAL_ACTIVITIES, MOUTH_ACTIVITIES
from texvent_scenes.models.animals.body import build_quadruped
from texvent_scenes.models.animals.build import QUADRUPED_KEYS
from texvent_scenes.models.joints import (
    RESTING,
    Joint,
    LightModulation,
    place,
    read_joint,
    read_light,
    read_wave,
)
from texvent_scenes.models.limbs import Chain, read_walk
from texvent_scenes.models.part_lines import Placed, read_groups, read_parts
from texvent_scenes.models.people.figure import read_rider
from texvent_scenes.models.protocol import ModelPart, Noun, Pose, between, choose, fraction
from texvent_scenes.models.shapes import (
    SAMPLE_POSES,
    STANDING_POSES,
    ArticulatedModel,
    ball,
    compose,
    half_extents,
    moved,
    shift,
    turn_about,
)
from texvent_scenes.models.surfaces import Painted, paint_model, toned
from texvent_scenes.rendered_scene import Colour

_KEYS: Mapping[str, tuple[type, ...]] = {
    "names": (list,), "plurals": (list,), "place": (str,), "habitat": (str,), "motion": (str,),
    "speed": (float, int), "works": (bool,), "laid": (bool,), "like": (str,), "rider": (dict,),
    "colours": (list, dict), "varied": (dict,), "surfaces": (dict,), "variants": (dict,),
    "parts": (str,), "more": (str,), "size": (float, int), "wave": (str,), "chains": (list,),
    "clumps": (list,), "legs": (list,), "gait": (dict,), "bob": (list,), **QUADRUPED_KEYS,
}  # fmt: skip
"""Keys of a noun, and what their values are."""
_OWN = ("names", "plurals", "more")
"""Keys that no noun takes from the one that it is like."""
_HABITATS: Mapping[str, str] = {
    **dict.fromkeys(("drive", "walk", "run", "roll", "slide"), "ground"),
    **dict.fromkeys(("fly", "float"), "air"),
    **dict.fromkeys(("swim", "sail", "paddle"), "water"),
    "stand": "fixed",
}
"""Usual motion → habitat, where an entry does not say it."""


@dataclass(frozen=True)
class _Group:
    """Parts that move together, outermost joint first."""

    parts: tuple[Placed, ...]
    joints: tuple[Joint, ...]
    at_rest: tuple[Joint, ...] | None = None
    """Its joints while the body stays where it is; None = the same."""
    light: LightModulation | None = None
    clip: tuple[int, float, float] | None = None
    """Axis, least and greatest coordinate between which its boxes are seen, m."""
    is_paired: bool = False
    """Whether the other side of the body has the same."""

    def draw(self, parts: Sequence[ModelPart], pose: Pose, seed: int) -> list[ModelPart]:
        """Its parts, painted, where they are at that pose."""
        is_resting = self.at_rest is not None and pose.activity in RESTING
        joints = self.at_rest if self.at_rest is not None and is_resting else self.joints
        lit = self.light.shine(parts, pose, seed) if self.light else list(parts)
        there = moved(lit, place(joints, pose, seed)) if joints else lit
        if self.clip is not None:
            there = [_clip(one, *self.clip) for one in there]
        return [*there, *mirrored(there)] if self.is_paired else there


def mirrored(parts: Sequence[ModelPart]) -> list[ModelPart]:
    """The same parts on the other side of the body, their surfaces not turned inside out."""
    return [each.at(_MIRROR[:, None] * each.to_body * _TURNED_BACK) for each in parts]


_MIRROR = np.array([1.0, -1.0, 1.0])
_TURNED_BACK = np.array([-1.0, 1.0, 1.0, 1.0])
"""Signs of the columns of a map: its first axis the other way round."""


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
            return self._build(colour, scale, seed)
        except InputError:
            raise
        except (KeyError, TypeError, ValueError) as error:
            raise FileFormatError(f"{self.where}: {error}") from None

    def _build(self, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
        table, is_centred = self.table, _is_centred(self.table)
        if "build" in table:
            return build_quadruped(table, is_centred, colour=colour, scale=scale, seed=seed)
        painted = paint_model(table, colour=colour, seed=seed)
        placed, groups = self._drawing
        for label, texts in self._variants.items():
            placed = (*placed, *choose(seed, label, texts))
        rigid = painted.draw(placed)
        drawn = [(painted.draw(one.parts), one) for one in groups]
        drawn += [_read_clump(one, painted, seed) for one in table.get("clumps", ())]
        chains = [Chain(**one).drawn_in(painted) for one in table.get("chains", ())]
        rider = read_rider(table["rider"]) if "rider" in table else None
        wave = read_wave(table["wave"]) if "wave" in table else None
        walk = read_walk(table, painted) if "gait" in table else None
        moves_all = wave is not None or walk is not None

        def articulate(pose: Pose) -> list[ModelPart]:
            parts = list(rigid) if moves_all else []
            if wave is not None:
                parts = [wave(part, pose, seed) for part in parts]
            parts += [part for shapes, group in drawn for part in group.draw(shapes, pose, seed)]
            parts += [part for draw in chains for part in draw(pose, seed)]
            if rider is not None:
                parts += rider.draw(seed, pose.distance_m)
            return parts if walk is None else walk(parts, pose, seed)

        rests = moves_all or any(one.at_rest is not None for one in groups)
        return ArticulatedModel(
            [] if moves_all else rigid,
            scale=scale * table.get("size", 1.0),
            articulate=articulate if moves_all or drawn or chains or rider is not None else None,
            is_centred=is_centred,
            poses=SAMPLE_POSES if rests else STANDING_POSES,
            is_wheeled=any(one.rolls for group in groups for one in group.joints[:1]),
        )

    @cached_property
    def _drawing(self) -> tuple[tuple[Placed, ...], tuple[_Group, ...]]:
        """Parts that stay in the body, and groups of those that move."""
        texts = [read_groups(self.table.get(key, "")) for key in ("parts", "more")]
        rigid, wheels = read_parts("\n".join(first[1] for first, *_ in texts))
        moving = [one for _, *rest in texts for one in rest]
        if self.table.get("laid"):
            rigid = _laid(rigid)
        groups, named = [], dict[str, tuple[Joint, ...]]()
        for how, lines in moving:
            parts, more = read_parts(lines)
            if not how or not (parts or more):
                raise ValueError(f"'moving {how}' needs a joint or a light, and parts below it")
            groups.append(_read_group(how, parts, named))
            wheels += more
        groups += [_Group(shapes, (joint,)) for shapes, joint in wheels]
        return rigid, tuple(groups)

    @cached_property
    def _variants(self) -> Mapping[str, Sequence[tuple[Placed, ...]]]:
        """Parts of which the seed chooses one list, by the label of the choice."""
        said = self.table.get("variants", {})
        return {label: [read_parts(one)[0] for one in texts] for label, texts in said.items()}


def _read_group(how: str, parts: tuple[Placed, ...], named: dict[str, tuple[Joint, ...]]) -> _Group:
    """A group from what stands after "moving", on another one where "on" names it."""
    joints: list[Joint] = []
    at_rest: list[Joint] | None = None
    light, clip, is_paired, name = None, None, False, ""
    for item in map(str.strip, how.rstrip(",").split(",")):
        first, _, rest = item.partition(" ")
        if first == "on":
            if rest not in named:
                raise ValueError(f"no moving part before it has the name {rest!r}")
            joints += named[rest]
        elif first == "called":
            name = rest
        elif first == "light":
            light = read_light(rest)
        elif first == "clip":
            axis, low, high = rest.split()
            clip = "xyz".index(axis), float(low), float(high)
        elif item == "pair":
            is_paired = True
        elif item == "at rest":
            at_rest = []
        else:
            (joints if at_rest is None else at_rest).append(read_joint(item))
    if name:
        named[name] = tuple(joints)
    resting = None if at_rest is None else tuple(at_rest)
    return _Group(parts, tuple(joints), resting, light, clip, is_paired)


def _read_clump(
    table: Mapping[str, Any], painted: Painted, seed: int
) -> tuple[list[ModelPart], _Group]:
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
    return parts, _Group((), tuple(map(read_joint, table.get("joints", ()))))


_SLIVER_M = 5e-5
"""Half of what is left of a box that is not seen."""


def _clip(box: ModelPart, axis: int, low: float, high: float) -> ModelPart:
    """A box along the axes, cut off at two planes across one of them."""
    to_body = box.to_body.copy()
    middle, half = to_body[axis, 3], to_body[axis, axis]
    first, last = max(middle - half, low), min(middle + half, high)
    to_body[axis, axis] = max(0.5 * (last - first), _SLIVER_M)
    to_body[axis, 3] = min(max(0.5 * (first + last), low + _SLIVER_M), high - _SLIVER_M)
    return box.at(to_body)


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
    """The nouns of a TOML file; what stands above its first table holds for all of them.

    Raises:
        FileFormatError: the file is damaged or has a key that no noun has; what is wrong with parts
            is said when the noun is first built.
    """
    try:
        tables = tomllib.loads(file.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise FileFormatError(f"{file}: {error}") from error
    usual = {key: value for key, value in tables.items() if not isinstance(value, Mapping)}
    entries: dict[str, Mapping[str, Any]] = {}
    for name in (key for key in tables if key not in usual):
        own, like = tables[name], tables[name].get("like")
        if like is not None and like not in entries:
            raise FileFormatError(
                f"{file.name}, {name!r}: there is no noun {like!r} above it to be like"
            )
        model = usual if like is None else entries[like]
        entries[name] = _merged({key: model[key] for key in model if key not in _OWN}, own)
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
    words = table.get("parts", "").split()
    mouth = MOUTH_ACTIVITIES if "bow" in words else frozenset()
    return Noun(
        name,
        PartsBuilder(where, table),
        habitat,
        float(table.get("speed", 0.0)),
        table.get("motion", "stand"),
        tuple(table.get("names", ())),
        tuple(table.get("plurals", ())),
        place=table.get("place", ""),
        acts=frozenset(ANIMAL_ACTIVITIES) if "build" in table else mouth,
        is_working=bool(table.get("works", habitat == "fixed" and "moving" in words)),
    )
