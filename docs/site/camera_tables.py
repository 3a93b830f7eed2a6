"""Tables of the constants of cameras and their sources, made from the presets of `physical`."""

import dataclasses
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from texvent.simulation.physical.cameras import CAMERAS
from texvent.simulation.physical.config import PhysicalConfig

NOT_OF_A_CAMERA = ("gamma", "initial_phase", "sensor_seed", "threshold_map")
"""Options of the frames, the run or the model."""
MARK = "<!-- cameras: "
"""Begins the line of the page that the tables take the place of."""


def with_tables(page: str) -> str:
    """The page with the tables in place of its mark."""
    lines = page.split("\n")
    (number,) = [n for n, line in enumerate(lines) if line.startswith(MARK)]
    return "\n".join([*lines[:number], *camera_tables(), *lines[number + 1 :]])


def camera_tables() -> Iterator[str]:
    """Lines of Markdown: constants of every camera, then the source of each measured one."""
    yield from ("\\* not measured: the model's default.", "")
    known = [{one.option: one.value for one in camera.constants} for camera in CAMERAS.values()]
    rows = (
        [f"`{field.name}`", *(_cell(field, values) for values in known)]
        for field in dataclasses.fields(PhysicalConfig)
        if field.name not in NOT_OF_A_CAMERA
    )
    yield from _table(["option", *(f"`{name}`" for name in CAMERAS)], rows)
    yield ""
    sources = (
        [f"`{name}`", f"`{one.option}`", one.basis, one.reference]
        for name, camera in CAMERAS.items()
        for one in camera.constants
    )
    yield from _table(["preset", "option", "basis", "source"], sources)


def _table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> list[str]:
    lines = [list(head), *map(list, rows)]
    lines.insert(1, ["---"] * len(lines[0]))
    return [f"| {' | '.join(line)} |" for line in lines]


def _cell(field: dataclasses.Field[Any], known: Mapping[str, float | str]) -> str:
    value = known.get(field.name, field.default)
    text = "curve" if field.name == "noise_curve" else f"{value:.6g}"
    return text if field.name in known else f"{text}\\*"
