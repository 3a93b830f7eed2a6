"""`texvent generators`: the text-to-video generators, and which are ready to use here."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Any

from rich.table import Table

from texvent._registry import GENERATORS
from texvent.cli.notices import result_console, write_out
from texvent.cli.options import parse_configs
from texvent.errors import FileFormatError
from texvent.generation.video_models.config import LEAST_FPS, VideoModel
from texvent.generation.video_models.known_models import MODELS
from texvent.generation.video_models.lora import find_row_loras
from texvent.generation.video_models.model_files import find_downloaded

DESCRIPTION = """List the text-to-video generators: what they make, what they need, under which
licence, and whether they are here. --generator takes a name of the list, a folder of a saved
diffusers pipeline, or any repository of the model hub.

  texvent generate "a red car" --generator wan2.2-5b
  texvent generate "a red car" --generator ./my-model --fps 24
  texvent generate "a red car" --generator hub:org/name --fps 24"""
NOT_KNOWN = "not known"
NOTES = f"""
Models below {LEAST_FPS} fps are marked low: much moves between two frames. GPU GB, as reported:
every part on the GPU / with --offload model. None was run here with its published weights; every
pipeline runs in texvent's tests with tiny random ones. Learned models need texvent[generate], and
are fetched from the model hub when first used, after showing the licence. --json has sources.
What people run most is first; * marks the families of the paper, with Open-Sora.
"""


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
        return 0
    parts = Table(box=None, pad_edge=False, show_header=False)
    for name in GENERATORS.entries():
        part = _part_facts(name)
        parts.add_row(name, "yes" if part["here"] else "", part["summary"], part["licence"])
    models = Table(
        *("name", "here", "fps", "frames", "size", "GPU GB", "licence"), box=None, pad_edge=False
    )
    for model in MODELS.values():
        models.add_row(*_describe_model(model))
    with result_console() as console:
        console.print(parts, "", models, sep="\n")
    write_out(NOTES)
    return 0


def _part_facts(name: str) -> dict[str, Any]:
    """A generator that is no row of the table of models."""
    part = GENERATORS.load(name)
    find_missing = getattr(part, "find_missing", None)
    return {
        "name": name,
        "here": find_missing is None or find_missing() is None,
        "summary": (part.__doc__ or "").strip().splitlines()[0],
        "licence": getattr(part, "licence", "part of texvent"),
    }


def _model_facts(model: VideoModel) -> dict[str, Any]:
    """Row for `--json`; null: not known, or the pipeline's own default."""
    facts = dataclasses.asdict(model)
    del facts["folder"]  # rows have none
    facts |= {"fps": None if model.fps is None else float(model.fps)}
    return {**facts, "is_low_fps": model.is_low_fps, "here": _is_here(model) == "yes"}


def _describe_model(model: VideoModel) -> tuple[str, ...]:
    """Cells of a row."""
    known = model.gpu_gb, model.offload_gb
    memory = (
        " / ".join("-" if gb is None else f"{gb:g}" for gb in known) if any(known) else NOT_KNOWN
    )
    return (
        f"{model.name}{' *' if model.of_paper else ''}",
        _is_here(model),
        NOT_KNOWN if model.fps is None else f"{model.fps}{' low' * model.is_low_fps}",
        str(model.frames),
        "image's" if model.width is None else f"{model.width}x{model.height}",
        memory if any(known) else NOT_KNOWN,
        model.licence_and_terms,
    )


def _is_here(model: VideoModel) -> str:
    if find_spec("huggingface_hub") is None:
        return ""
    try:
        found = find_downloaded(model)
    except FileFormatError:
        return "damaged"
    return "yes" if found is not None and find_row_loras(model) is not None else ""
