"""Lists of parts in the tables of people: props, hats and garments."""

from __future__ import annotations

from functools import cache

from texvent.scenes.models.materials import Material
from texvent.scenes.models.part_lines import Placed, read_parts
from texvent.scenes.models.people.tables import read_table
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import part
from texvent.scenes.models.surfaces import read_surface, shared_surfaces

PAINT = "paint"
"""The surface that stands for the wearer's choice."""


def draw_parts(table: str, group: str, name: str, paint: Material | None = None) -> list[ModelPart]:
    """The parts of an entry.

    Args:
        table: "props" or "outfits".
        group: its table of part lists, such as "hats".
        name: of the entry.
        paint: surface of its parts that are of "paint".
    """
    return [
        part(one.shape, paint if paint and one.surface == PAINT else _surface(table, one.surface),
             one.to_body)
        for one in _placed(table, group, name)
    ]  # fmt: skip


@cache
def _placed(table: str, group: str, name: str) -> tuple[Placed, ...]:
    return read_parts(read_table(table)[group][name])[0]


@cache
def _surface(table: str, name: str) -> Material:
    """A surface of the table or of all nouns by its name, or by its colour "(r g b)"."""
    own = read_table(table)["surfaces"]
    if name in own or name not in shared_surfaces():
        return read_surface(own.get(name, name), {})
    return shared_surfaces()[name]
