"""Lists of parts in the tables of people: props, hats and garments."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from texvent.scenes.models.materials import Material
from texvent.scenes.models.part_lines import Placed, read_parts
from texvent.scenes.models.people.tables import read_table
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import part
from texvent.scenes.models.surfaces import read_surface

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
    surfaces = _surfaces(table)
    return [
        part(one.shape, paint if paint and one.surface == PAINT else surfaces[one.surface],
             one.to_body)
        for one in _placed(table, group, name)
    ]  # fmt: skip


@cache
def _placed(table: str, group: str, name: str) -> tuple[Placed, ...]:
    return read_parts(read_table(table)[group][name])[0]


@cache
def _surfaces(table: str) -> Mapping[str, Material]:
    return _Surfaces(read_table(table)["surfaces"])


class _Surfaces(dict[str, Material]):
    """Surfaces by name, or by their colour "(r g b)"."""

    def __init__(self, named: Mapping[str, str]) -> None:
        super().__init__({name: read_surface(text, {}) for name, text in named.items()})

    def __missing__(self, text: str) -> Material:
        self[text] = read_surface(text, {})
        return self[text]
