"""`texvent generators`: the text-to-video generators, and which are ready to use here."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Any

from rich.console import Console
from rich.table import Table

from texvent._registry import GENERATORS
from texvent.cli.notices import result_console, write_out
from texvent.cli.options import parse_configs
from texvent.errors import FileFormatError
from texvent.generate.video_models.known_models import LEAST_FPS, MODELS, VideoModel
from texvent.generate.video_models.model_files import find_downloaded

HUB_PACKAGE = "huggingface_hub"
PIPELINE_PACKAGE = "diffusers"
TITLES = ("name", "here", "fps", "frames", "size", "steps", "GPU GB", "time s", "licence")
LICENCE_WIDTH = len("Tencent Hunyuan")
"""Columns in which the names of licences wrap at their spaces; with fewer they stand below only."""
DESCRIPTION = """List the text-to-video generators: what they make, what they need, under which
licence, and whether they are here. --generator takes a name of the list, a folder of a saved
diffusers pipeline, or any repository of the model hub.

  texvent generate "a red car" --generator wan2.2-5b
  texvent generate "a red car" --generator ./my-model --fps 24
  texvent generate "a red car" --generator hub:org/name --fps 24"""


@dataclass(frozen=True, kw_only=True)
class GeneratorsOptions:
    """Format of the list."""

    json: bool = False
    """Print JSON, with the source of every licence and time."""


def run(arguments: Sequence[str]) -> int:
    """Print the table; returns exit code 0."""
    (options,) = parse_configs(
        arguments,
        {"list": GeneratorsOptions()},
        prog="texvent generators",
        description=DESCRIPTION,
    )
    if options.json:
        facts = [_part_facts(name) for name in GENERATORS.entries()]
        facts += [_model_facts(model) for model in MODELS.values()]
        write_out(json.dumps(facts, indent=1) + "\n")
    else:
        _print_list()
    return 0


def _part_facts(name: str) -> dict[str, Any]:
    here, summary, licence = _describe_part(name)
    return {"name": name, "here": here == "yes", "summary": summary, "licence": licence}


def _model_facts(model: VideoModel) -> dict[str, Any]:
    """Row for `--json`; null: not known, or the pipeline's own default."""
    facts = dataclasses.asdict(model)
    del facts["folder"]  # rows have none
    rate = {
        "fps": None if model.fps is None else float(model.fps),
        "is_low_fps": model.is_low_fps,
        "is_recommended": not model.is_low_fps,
    }
    return {**facts, **rate, "here": _is_here(model) == "yes"}


def _print_list() -> None:
    with result_console() as console:
        _print_tables(console)


def _print_tables(console: Console) -> None:
    parts = Table(box=None, pad_edge=False, show_header=False)
    for name in GENERATORS.entries():
        parts.add_row(name, *_describe_part(name))
    console.print(parts)
    models = list(MODELS.values())
    cells = {model.name: _describe_model(model) for model in models}
    widths = [max(map(len, column)) for column in zip(TITLES, *cells.values(), strict=True)]
    rest = console.width - sum(width + 2 for width in widths[:-1])
    shown = len(TITLES) if rest >= LICENCE_WIDTH else len(TITLES) - 1
    for title, is_low in (
        (f"recommended for events: {LEAST_FPS} frames per second and more", False),
        (f"fewer than {LEAST_FPS}: much moves between two frames; texvent warns", True),
    ):
        table = Table(box=None, pad_edge=False, header_style="bold")
        for name, width in list(zip(TITLES, widths, strict=True))[:shown]:
            is_last = name == TITLES[-1]
            table.add_column(
                name, no_wrap=not is_last, width=min(width, rest) if is_last else width
            )
        for model in models:
            if model.is_low_fps == is_low:
                table.add_row(*cells[model.name][:shown])
        console.print(f"\n{title}", markup=False)
        console.print(table)
    for line in _notes():
        console.print(line, style="dim", markup=False, soft_wrap=True)


def _describe_part(name: str) -> tuple[str, str, str]:
    """Cells of a generator that is no row of the table of models: here, what it is, licence."""
    part = GENERATORS.load(name)
    summary = (part.__doc__ or "").strip().splitlines()[0]
    find_missing = getattr(part, "find_missing", None)
    here = "yes" if find_missing is None or find_missing() is None else ""
    return here, summary, getattr(part, "licence", "part of texvent")


def _describe_model(model: VideoModel) -> tuple[str, ...]:
    """Cells of a row, by `TITLES`."""
    size = "image's" if model.width is None else f"{model.width}x{model.height}"
    memory = " / ".join("-" if gb is None else f"{gb:g}" for gb in (model.gpu_gb, model.offload_gb))
    rate = f"{model.fps} low" if model.is_low_fps else f"{model.fps}"
    mark = "" if model.licence_source else " ?"
    return (
        model.name,
        _is_here(model),
        rate,
        str(model.frames),
        size,
        "fixed" if model.steps is None else str(model.steps),
        memory,
        "-" if model.time_s is None else f"{model.time_s:g}",
        model.licence + mark,
    )


def _is_here(model: VideoModel) -> str:
    if find_spec(HUB_PACKAGE) is None:
        return ""
    try:
        found = find_downloaded(model)
    except FileFormatError:
        return "damaged"
    return "yes" if found is not None else ""


def _grouped(lines: Iterable[tuple[str, str]]) -> list[str]:
    """One line for every text, before it the names of the models that it is for."""
    names: dict[str, list[str]] = {}
    for name, text in lines:
        names.setdefault(text, []).append(name)
    return [f"  {', '.join(models)}: {text}" for text, models in names.items()]


def _notes() -> list[str]:
    models = MODELS.values()
    images = ", ".join(model.name for model in models if model.needs_image)
    notes = [
        "",
        "GPU GB, as reported: every part on the GPU / with --offload model. time s: one video of",
        "that many frames, as its publisher says. These start from an image (--image):",
        f"  {images}",
        "None was run here with its published weights. Every pipeline runs in texvent's tests with",
        "tiny random ones. Times were read in:",
        *_grouped((model.name, model.time_source) for model in models if model.time_s),
        "Licences (? not read), read at the publisher's unless a line says otherwise:",
        *_grouped(
            (model.name, f"{model.licence_and_terms} ({model.licence_source})") for model in models
        ),
        "Learned models are fetched from the model hub when first used, after showing the licence.",
    ]
    if find_spec(PIPELINE_PACKAGE) is None:
        notes.append("They need an extra: pip install 'texvent[generate]'")
    return notes
