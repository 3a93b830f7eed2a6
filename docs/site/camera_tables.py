"""Tables of the constants of cameras and their sources, made from the presets of `physical`."""

from collections.abc import Iterable, Iterator

from texvent.simulate.physical.cameras import CAMERAS, Constant, camera_table

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
    columns = [camera_table(name) for name in CAMERAS]
    rows = ([f"`{same[0].option}`", *map(_cell, same)] for same in zip(*columns, strict=True))
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


def _cell(constant: Constant) -> str:
    value = constant.value if isinstance(constant.value, str) else f"{constant.value:.6g}"
    value = "curve" if constant.option == "noise_curve" else value
    return f"{value}\\*" if constant.basis == "unmeasured" else value
