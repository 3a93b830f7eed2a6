"""`texvent bench page`: a stored result as a page with its chart."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED
from texvent.cli.options import parse_configs
from texvent.io.atomic import atomic_file, check_output
from texvent_lab.bench.document import read_document
from texvent_lab.bench.fidelity.table import BASELINE
from texvent_lab.bench.page import page_files, page_name


@dataclass(frozen=True, kw_only=True)
class PageOptions:
    """Result and folder of the page."""

    positional: ClassVar[tuple[str, ...]] = ("result",)
    short_flags: ClassVar[Mapping[str, str]] = {"out": "-o"}

    result: Path = REQUIRED
    """JSON file that --out of `texvent bench fidelity`, `real`, `digits`, `objects`, `selftest` or
    `paper` wrote, as it is or compressed (.json.gz)."""
    baseline: str = BASELINE
    """Row that the others are compared with, pair by pair; of fidelity and real."""
    out: Path | None = None
    """Folder of the page and its chart; default: that of the result."""
    overwrite: bool = False
    """Replace files that exist already."""


def run(arguments: Sequence[str]) -> None:
    """Run the command."""
    (options,) = parse_configs(
        arguments,
        {"options": PageOptions()},
        prog="texvent bench page",
        description="A result of bench fidelity, real, digits, objects, selftest or paper as a "
        "Markdown page with its tables and chart, named after the result.",
    )
    folder = options.out or options.result.parent
    page = folder / f"{page_name(options.result.name)}.md"
    check_output(page, overwrite=options.overwrite)
    files = page_files(
        read_document(options.result), options.result.name, baseline=options.baseline
    )
    for file, content in files.items():
        with atomic_file(folder / file, overwrite=options.overwrite) as part:
            part.write_bytes(content)
    write_out("".join(f"{folder / file}\n" for file in files))
