"""`texvent generators`: the text-to-video generators, and which are ready to use here."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Any

from rich.console import Console
from rich.table import Table

from texvent._registry import GENERATORS
from texvent.cli.notices import write_out
from texvent.cli.options import parse_configs
from texvent.errors import FileFormatError
from texvent.generate.video_models.download import find_downloaded
from texvent.generate.video_models.known_models import MODELS, VideoModel

HUB_PACKAGE = "huggingface_hub"
PIPELINE_PACKAGE = "diffusers"
MAKES_WIDTH = len("81 x 1360x768, 16 fps low")
LEAST_FPS = 24
"""Models of a lower frame rate are marked: much moves far between their frames."""
ROOMY_WIDTH = 120
"""Columns of a terminal in which sentences need not be narrow."""
DESCRIPTION = """List the text-to-video generators: what they make, under which licence, and
whether they are here. --generator takes a name of the list, a folder of a saved diffusers pipeline,
or any repository of the model hub.

  texvent generate "a red car" --generator wan-1.3b
  texvent generate "a red car" --generator ./my-model --fps 16
  texvent generate "a red car" --generator hub:org/name --fps 16"""


@dataclass(frozen=True, kw_only=True)
class GeneratorsOptions:
    """How to list them."""

    json: bool = False
    """Print JSON, with the source of every licence."""


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
        _print_table()
    return 0


def _part_facts(name: str) -> dict[str, Any]:
    here, summary, _, licence = _describe_part(name)
    return {"name": name, "here": here == "yes", "summary": summary, "licence": licence}


def _model_facts(model: VideoModel) -> dict[str, Any]:
    """What `--json` prints of a row; null: not known, or the pipeline's own default."""
    facts = dataclasses.asdict(model)
    del facts["folder"]  # rows have none
    rate = {"fps": None if model.fps is None else float(model.fps), "is_low_fps": _is_low(model)}
    return {**facts, **rate, "here": _is_here(model) == "yes"}


def _print_table() -> None:
    console = Console(highlight=False)
    table = Table(box=None, pad_edge=False, header_style="bold")
    for title in ("name", "here", "makes", "GPU GB", "licence"):
        # Sentences wrap in a narrow terminal; what is typed or compared stays whole.
        table.add_column(
            title,
            no_wrap=title in ("name", "here", "GPU GB"),
            # A least width alone would let rich cut the last column by what it lacks.
            width=MAKES_WIDTH if title == "makes" and console.width < ROOMY_WIDTH else None,
        )
    for name in GENERATORS.entries():
        table.add_row(name, *_describe_part(name))
    for model in MODELS.values():
        table.add_row(model.name, *_describe_model(model))
    console.print(table)
    for line in _notes():
        console.print(line, style="dim", markup=False, soft_wrap=True)


def _describe_part(name: str) -> tuple[str, str, str, str]:
    """Cells of a generator that is no row of the table of models."""
    part = GENERATORS.load(name)
    summary = (part.__doc__ or "").strip().splitlines()[0]
    find_missing = getattr(part, "find_missing", None)
    here = "yes" if find_missing is None or find_missing() is None else ""
    return here, summary, "", getattr(part, "licence", "part of texvent")


def _describe_model(model: VideoModel) -> tuple[str, str, str, str]:
    makes = f"{model.frames} x {model.width}x{model.height}, {model.fps} fps"
    makes += " low" if _is_low(model) else ""
    memory = " / ".join("-" if gb is None else f"{gb:g}" for gb in (model.gpu_gb, model.offload_gb))
    footnotes = ("" if model.licence_source else " ?") + ("" if model.is_verified else " *")
    return _is_here(model), makes, memory, model.licence_and_terms + footnotes


def _is_low(model: VideoModel) -> bool:
    return model.fps is not None and model.fps < LEAST_FPS


def _is_here(model: VideoModel) -> str:
    if find_spec(HUB_PACKAGE) is None:
        return ""
    try:
        found = find_downloaded(model)
    except FileFormatError:
        return "damaged"
    return "yes" if found is not None else ""


def _sources() -> list[str]:
    """One line for every source of licences, with the models it is for."""
    names: dict[str, list[str]] = {}
    for model in MODELS.values():
        if model.licence_source:
            names.setdefault(model.licence_source, []).append(model.name)
    return [f"  {', '.join(models)}: {source}" for source, models in names.items()]


def _notes() -> list[str]:
    notes = [
        "makes: frames x size. GPU GB, as reported: every part on the GPU / with --offload model.",
        f"low: {LEAST_FPS} fps and more suit events. * pipeline not tried by texvent's tests.",
        "? licence not read. The others were read at the publisher's, and may change:",
        *_sources(),
        "Learned models are fetched from the model hub when first used, after showing the licence.",
    ]
    if find_spec(PIPELINE_PACKAGE) is None:
        notes.append("They need an extra: pip install 'texvent[generate]'")
    return notes
