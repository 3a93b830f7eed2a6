"""`texvent generators`: the text-to-video generators, and which are ready to use here."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.util import find_spec

from rich.console import Console
from rich.table import Table

from texvent._registry import GENERATORS
from texvent.cli.options import refuse_arguments
from texvent.errors import FileFormatError
from texvent.generate.video_models.download import find_downloaded
from texvent.generate.video_models.known_models import MODELS, VideoModel

HUB_PACKAGE = "huggingface_hub"
PIPELINE_PACKAGE = "diffusers"
MAKES_WIDTH = len("121 x 1280x704, 24 fps")
ROOMY_WIDTH = 120
"""Columns of a terminal in which sentences need not be narrow."""
DESCRIPTION = """List the text-to-video generators: what they make, under which licence, and
whether they are here. --generator takes a name of the list, a folder of a saved diffusers pipeline,
or any repository of the model hub.

  texvent generate "a red car" --generator wan-1.3b
  texvent generate "a red car" --generator ./my-model --fps 16
  texvent generate "a red car" --generator hub:org/name --fps 16"""


def run(arguments: Sequence[str]) -> int:
    """Print the table; returns exit code 0."""
    refuse_arguments(arguments, prog="texvent generators", description=DESCRIPTION)
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
    return 0


def _describe_part(name: str) -> tuple[str, str, str, str]:
    """Cells of a generator that is no row of the table of models."""
    part = GENERATORS.load(name)
    summary = (part.__doc__ or "").strip().splitlines()[0]
    find_missing = getattr(part, "find_missing", None)
    here = "yes" if find_missing is None or find_missing() is None else ""
    return here, summary, "", getattr(part, "licence", "part of texvent")


def _describe_model(model: VideoModel) -> tuple[str, str, str, str]:
    makes = f"{model.frames} x {model.width}x{model.height}, {model.fps} fps"
    memory = " / ".join("-" if gb is None else f"{gb:g}" for gb in (model.gpu_gb, model.offload_gb))
    footnotes = ("" if model.is_licence_verified else " ?") + ("" if model.is_verified else " *")
    return _is_here(model), makes, memory, model.licence + footnotes


def _is_here(model: VideoModel) -> str:
    if find_spec(HUB_PACKAGE) is None:
        return ""
    try:
        found = find_downloaded(model)
    except FileFormatError:
        return "damaged"
    return "yes" if found is not None else ""


def _notes() -> list[str]:
    notes = [
        "makes: frames x size. GPU GB, as reported: every part on the GPU / with --offload model.",
        "? licence not read from the model's own page: check it before use. * pipeline not tried "
        "by texvent's tests.",
        "Learned models are fetched from the model hub when first used, after showing the licence.",
    ]
    if find_spec(PIPELINE_PACKAGE) is None:
        notes.append("They need an extra: pip install 'texvent[generate]'")
    return notes
