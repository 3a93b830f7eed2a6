"""Lists of parts as nouns: the TOML files of `data/nouns/`, read when a noun is first built.

    [pendulum]
    colours = ["(.6 .3 .04)"]
    parts = '''
    box wood   0 0 .03   .4 .9 .06
    rod wood   0 ±.42 .05   0 ±.42 1.18   .025
    '''
    [[pendulum.moving]]
    joint = "swing x 0 0 1.17 22.9deg .541hz"
    parts = '''
    ball paint   0 0 .32   .2 .2 .2
    '''

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
from typing import Any, NoReturn

import numpy as np

from texvent.errors import FileFormatError
from texvent.scenes.models.articulated_model import STANDING_POSES, ArticulatedModel
from texvent.scenes.models.joints import Joint, Light, place, read_joint, read_light
from texvent.scenes.models.materials import Material
from texvent.scenes.models.part_lines import Placed, read_parts
from texvent.scenes.models.protocol import ModelPart, Noun, Pose
from texvent.scenes.models.riders import Rider, read_rider
from texvent.scenes.models.shapes import compose, half_extents, moved, part, shift, turn_y
from texvent.scenes.models.surfaces import PAINT, read_colour, read_surface
from texvent.scenes.models.variation import choose
from texvent.scenes.scene import Colour

_KEYS: Mapping[str, tuple[type, ...]] = {
    "names": (list,), "plurals": (list,), "place": (str,), "habitat": (str,), "motion": (str,),
    "speed": (float, int), "works": (bool,), "laid": (bool,), "like": (str,), "rider": (dict,),
    "colours": (list, dict), "varied": (dict,), "surfaces": (dict,), "variants": (dict,),
    "parts": (str,), "moving": (list,),
}  # fmt: skip
"""Keys of a noun, and what their values are."""
_OWN = ("names", "plurals")
"""Keys that no noun takes from the one that it is like."""
_HABITATS = ("ground", "air", "water", "fixed")
_GREY = "(.4 .4 .4)"


@dataclass(frozen=True)
class _Group:
    """Parts that move together, outermost joint first."""

    parts: tuple[Placed, ...]
    joints: tuple[Joint, ...]
    light: Light | None = None
    clip: tuple[int, float, float] | None = None
    """Axis, least and greatest coordinate between which its boxes are seen, m."""


@dataclass(frozen=True, eq=False)
class PartsBuilder:
    """Builds the models of one noun; implements `protocol.ModelBuilder`."""

    where: str
    """File and noun, for messages."""
    table: Mapping[str, Any]

    def __call__(self, *, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
        """Build it; `colour` takes the place of `colours`."""
        rigid, groups = self._drawing
        for label, texts in self._variants.items():
            rigid = (*rigid, *choose(seed, label, texts))
        surfaces = self._surfaces(colour, seed)
        rider = self._rider
        upper = rider.upper_body(seed) if rider is not None else []
        drawn = [(_draw(one.parts, surfaces), one) for one in groups]

        def articulate(pose: Pose) -> list[ModelPart]:
            parts = []
            for shapes, group in drawn:
                lit = group.light.shine(shapes, pose, seed) if group.light else shapes
                there = moved(lit, place(group.joints, pose, seed)) if group.joints else lit
                parts += there if group.clip is None else [_clip(one, *group.clip) for one in there]
            return parts + (rider.legs(seed, pose.distance_m) if rider is not None else [])

        return ArticulatedModel(
            [*_draw(rigid, surfaces), *upper],
            scale=scale,
            articulate=articulate if groups or rider is not None else None,
            is_centred=_is_centred(self.table),
            poses=STANDING_POSES,
            is_wheeled=any(one.rolls for group in groups for one in group.joints[:1]),
        )

    @cached_property
    def _drawing(self) -> tuple[tuple[Placed, ...], tuple[_Group, ...]]:
        rigid, wheels = self._read(self.table.get("parts", ""))
        if self.table.get("laid"):
            rigid = _laid(rigid)
        groups, named = [], dict[str, tuple[Joint, ...]]()
        for number, moving in enumerate(self.table.get("moving", ()), 1):
            parts, more = self._read(moving.get("parts", ""))
            if not (parts or more) or not {"joint", "light"} & set(moving):
                self._fail(f"moving part {number} needs 'parts' and a 'joint' or a 'light'")
            groups.append(self._group(moving, parts, named))
            wheels += more
        groups += [_Group(shapes, (joint,)) for shapes, joint in wheels]
        return rigid, tuple(groups)

    @cached_property
    def _rider(self) -> Rider | None:
        try:
            return read_rider(self.table["rider"]) if "rider" in self.table else None
        except (ValueError, TypeError) as error:
            self._fail(str(error))

    @cached_property
    def _variants(self) -> Mapping[str, Sequence[tuple[Placed, ...]]]:
        """Parts of which the seed chooses one list, by the label of the choice."""
        said = self.table.get("variants", {})
        return {label: [self._read(one)[0] for one in texts] for label, texts in said.items()}

    def _group(
        self,
        moving: Mapping[str, Any],
        parts: tuple[Placed, ...],
        named: dict[str, tuple[Joint, ...]],
    ) -> _Group:
        """A group, on another one where "on" names it."""
        said = moving.get("joint", ())
        try:
            joints = tuple(map(read_joint, [said] if isinstance(said, str) else said))
            light = read_light(moving["light"]) if "light" in moving else None
            clip = _read_clip(moving["clip"]) if "clip" in moving else None
        except ValueError as error:
            self._fail(str(error))
        if "on" in moving:
            if moving["on"] not in named:
                self._fail(f"no moving part before it has the name {moving['on']!r}")
            joints = named[moving["on"]] + joints
        if "name" in moving:
            named[moving["name"]] = joints
        return _Group(parts, joints, light, clip)

    def _read(self, text: str) -> tuple[tuple[Placed, ...], list[tuple[tuple[Placed, ...], Joint]]]:
        try:
            return read_parts(text)
        except ValueError as error:
            self._fail(str(error))

    def _surfaces(self, colour: Colour | None, seed: int) -> Mapping[str, Material]:
        """Every surface that the parts name."""
        said = self.table.get("colours", [_GREY])
        paints = said if isinstance(said, Mapping) else {PAINT: said}
        try:
            if not all({**paints, **self.table.get("varied", {})}.values()):
                raise ValueError("a list of colours is empty")
            hues = {
                name: choose(seed, name, [read_colour(one, {}) for one in options])
                for name, options in {**paints, **self.table.get("varied", {})}.items()
            }
            if colour is not None:
                hues.update(dict.fromkeys(paints, colour))
            own = self.table.get("surfaces", {})
            return {name: read_surface(own.get(name, name), hues) for name in self._named}
        except ValueError as error:
            self._fail(str(error))

    @cached_property
    def _named(self) -> frozenset[str]:
        rigid, groups = self._drawing
        chosen = [one for texts in self._variants.values() for one in texts]
        every = [rigid, *chosen, *(group.parts for group in groups)]
        return frozenset(one.surface for parts in every for one in parts)

    def _fail(self, what: str) -> NoReturn:
        raise FileFormatError(f"{self.where}: {what}") from None


def _draw(parts: Sequence[Placed], surfaces: Mapping[str, Material]) -> list[ModelPart]:
    return [part(one.shape, surfaces[one.surface], one.to_body) for one in parts]


def _read_clip(text: str) -> tuple[int, float, float]:
    axis, low, high = text.split()
    return "xyz".index(axis), float(low), float(high)


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
    turn = turn_y(-0.5 * math.pi)
    turned = [replace(one, to_body=compose(turn, one.to_body)) for one in parts]
    ends = [half_extents(one.shape, one.to_body) for one in turned]
    low = np.min([low for low, _ in ends], axis=0)
    high = np.max([high for _, high in ends], axis=0)
    drop = shift(-0.5 * (low[0] + high[0]), -0.5 * (low[1] + high[1]), -low[2])
    return tuple(replace(one, to_body=compose(drop, one.to_body)) for one in turned)


def _is_centred(table: Mapping[str, Any]) -> bool:
    """Whether the origin is its middle: of what flies or swims, not of what floats."""
    habitat = table.get("habitat", "fixed")
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
    nouns = {name: table for name, table in tables.items() if name not in usual}
    for name, table in nouns.items():
        like = table.get("like")
        if like is not None and like not in nouns:
            raise FileFormatError(f"{file.name}, {name!r}: there is no noun {like!r} to be like")
        model = nouns.get(like, {})
        table |= {key: value for key, value in model.items() if key not in {*_OWN, *table}}
    return tuple(
        _noun(f"{file.name}, {name!r}", name, {**usual, **table}) for name, table in nouns.items()
    )


def _noun(where: str, name: str, table: Mapping[str, Any]) -> Noun:
    for key, value in table.items():
        if key not in _KEYS:
            raise FileFormatError(f"{where}: unknown key {key!r}; known: {', '.join(_KEYS)}")
        if not isinstance(value, _KEYS[key]):
            raise FileFormatError(
                f"{where}: {key} must be a {_KEYS[key][0].__name__} but is {value!r}"
            )
    habitat = table.get("habitat", "fixed")
    if habitat not in _HABITATS:
        known = ", ".join(_HABITATS)
        raise FileFormatError(f"{where}: habitat must be one of {known} but is {habitat!r}")
    return Noun(
        name,
        PartsBuilder(where, table),
        habitat,
        float(table.get("speed", 0.0)),
        table.get("motion", "stand"),
        tuple(table.get("names", ())),
        tuple(table.get("plurals", ())),
        place=table.get("place", ""),
        is_working=bool(table.get("works", habitat == "fixed" and "moving" in table)),
    )
