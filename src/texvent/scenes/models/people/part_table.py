"""Lists of parts in the tables of people: props, hats and garments."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

from texvent.scenes.models.materials import Material
from texvent.scenes.models.part_lines import Placed, read_parts
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.surfaces import FIXED_HUES, PAINT, Painted
from texvent.scenes.models.tables import read_table


def draw_parts(table: str, group: str, name: str, paint: Material | None = None) -> list[ModelPart]:
    """The parts of an entry.

    Args:
        table: "props" or "outfits".
        group: its table of part lists, such as "hats".
        name: of the entry.
        paint: surface of its parts that are of "paint".
    """
    painted = _painted(table)
    if paint is not None:
        painted = replace(painted, made={**painted.made, PAINT: paint})
    return painted.draw(_placed(table, group, name))


@cache
def _placed(table: str, group: str, name: str) -> tuple[Placed, ...]:
    return read_parts(read_table(table)[group][name])[0]


@cache
def _painted(table: str) -> Painted:
    return Painted(FIXED_HUES, read_table(table)["surfaces"])
