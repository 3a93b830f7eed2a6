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

`data/nouns/README.md` describes the format.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any

from texvent.errors import FileFormatError
from texvent.scenes.models.articulated_model import STANDING_POSES, ArticulatedModel
from texvent.scenes.models.joints import Joint, Light, place, read_joint, read_light
from texvent.scenes.models.materials import Material
from texvent.scenes.models.part_lines import Placed, read_parts
from texvent.scenes.models.protocol import ModelPart, Noun, Pose
from texvent.scenes.models.shapes import moved, part
from texvent.scenes.models.surfaces import PAINT, read_colour, read_surface
from texvent.scenes.models.variation import choose
from texvent.scenes.scene import Colour

_KEYS = frozenset({"names", "plurals", "place", "habitat", "speed", "motion", "works", "colours",
                   "varied", "surfaces", "parts", "moving"})  # fmt: skip
_HABITATS = ("ground", "air", "water", "fixed")
_GREY = "(.4 .4 .4)"


@dataclass(frozen=True)
class _Group:
    """Parts that move together, outermost joint first."""

    parts: tuple[Placed, ...]
    joints: tuple[Joint, ...]
    light: Light | None = None


@dataclass(frozen=True)
class PartsBuilder:
    """Builds the models of one noun; implements `protocol.ModelBuilder`."""

    where: str
    """File and noun, for messages."""
    table: Mapping[str, Any]

    def __call__(self, *, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
        """Build it; `colour` takes the place of `colours`."""
        rigid, groups = self._drawing
        surfaces = self._surfaces(colour, seed)
        drawn = [(_draw(one.parts, surfaces), one) for one in groups]

        def articulate(pose: Pose) -> list[ModelPart]:
            parts = []
            for shapes, group in drawn:
                lit = group.light.shine(shapes, pose, seed) if group.light else shapes
                parts += moved(lit, place(group.joints, pose, seed)) if group.joints else lit
            return parts

        return ArticulatedModel(
            _draw(rigid, surfaces),
            scale=scale,
            articulate=articulate if groups else None,
            is_centred=_is_centred(self.table),
            poses=STANDING_POSES,
            is_wheeled=any(one.rolls for group in groups for one in group.joints[:1]),
        )

    @cached_property
    def _drawing(self) -> tuple[tuple[Placed, ...], tuple[_Group, ...]]:
        rigid, wheels = self._read(self.table.get("parts", ""))
        groups = []
        for number, moving in enumerate(self.table.get("moving", ()), 1):
            parts, more = self._read(moving.get("parts", ""))
            if not parts and not more or not {"joint", "light"} & set(moving):
                self._fail(f"moving part {number} needs 'parts' and a 'joint' or a 'light'")
            groups.append(self._group(moving, parts))
            wheels += more
        groups += [_Group(shapes, (joint,)) for shapes, joint in wheels]
        return rigid, tuple(groups)

    def _group(self, moving: Mapping[str, Any], parts: tuple[Placed, ...]) -> _Group:
        said = moving.get("joint", ())
        try:
            joints = tuple(map(read_joint, [said] if isinstance(said, str) else said))
            light = read_light(moving["light"]) if "light" in moving else None
        except ValueError as error:
            self._fail(str(error))
        return _Group(parts, joints, light)

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
        return frozenset(one.surface for parts in (rigid, *(group.parts for group in groups))
                         for one in parts)  # fmt: skip

    def _fail(self, what: str) -> Any:
        raise FileFormatError(f"{self.where}: {what}") from None


def _draw(parts: Sequence[Placed], surfaces: Mapping[str, Material]) -> list[ModelPart]:
    return [part(one.shape, surfaces[one.surface], one.to_body) for one in parts]


def _is_centred(table: Mapping[str, Any]) -> bool:
    """Whether the origin is its middle: of what flies or swims, not of what floats."""
    habitat = table.get("habitat", "fixed")
    return habitat == "air" or (habitat == "water" and table.get("motion") == "swim")


def read_nouns(file: Path | Traversable) -> tuple[Noun, ...]:
    """The nouns of a TOML file.

    Raises:
        FileFormatError: the file is damaged or has a key that no noun has; what is wrong with parts
            is said when the noun is first built.
    """
    try:
        tables = tomllib.loads(file.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise FileFormatError(f"{file}: {error}") from error
    return tuple(_noun(f"{file.name}, {name!r}", name, table) for name, table in tables.items())


def _noun(where: str, name: str, table: Any) -> Noun:
    if not isinstance(table, Mapping):
        raise FileFormatError(f"{where}: a noun is a table, [{name}]")
    for key in table:
        if key not in _KEYS:
            raise FileFormatError(f"{where}: unknown key {key!r}; known: {', '.join(sorted(_KEYS))}")
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
        is_working=bool(table.get("works", False)),
    )
