"""Film strips of prompts, for a grader who sees the images and the report, not the code.

For every prompt `strips/ID.png`: six stills over 2 s at 173x130 pixels, the prompt, and the faults
that its report names. `contact-NN.png` holds twelve of them, `reports.json` the whole reports.
`grades.csv` is for the grader to fill in. An error of a prompt is noted and harms no other.
"""

from __future__ import annotations

import argparse
import json
import re
import textwrap
import unicodedata
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from texvent.errors import InputError, TexventError, TexventWarning, shown
from texvent.extending import full_version
from texvent.frames import MICROSECONDS
from texvent.io.atomic import atomic_file
from texvent.prompt_report import REPORT_KEY, PromptReport
from texvent.sensor import SensorSize
from texvent.view.drawing.canvas import Image, blank, draw_text, png_bytes, tile
from texvent_lab.bench.jobs import run_jobs
from texvent_lab.measure.prompts.score import COLUMNS, read_csv, write_csv
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator

SIZE, DURATION_S, STILLS, SEED = SensorSize(173, 130), 2.0, 6, 0
GAP_PX, LINE_PX, LETTERS, LINES = 2, 15, 158, 9
"""Gap between stills; height of a line of text; most letters of a line, and most lines."""
PAGE_COLUMNS, PER_PAGE = 2, 12
WHITE, BLACK, GREY = (255, 255, 255), (0, 0, 0), (70, 70, 70)


class Prompt(NamedTuple):
    """A row of the list."""

    id: str
    prompt: str
    style: str = ""


def run(options: argparse.Namespace) -> None:
    """Draw all strips, then the pages and the blank table of grades."""
    prompts = read_prompts(options.prompts)
    (options.out / "strips").mkdir(parents=True, exist_ok=True)
    strips, reports = [], []
    work = [(prompt, options.out / "strips") for prompt in prompts]
    for number, (strip, report) in enumerate(run_jobs(make_strip, work, options.jobs), start=1):
        print(f"{number}/{len(work)}  {report['id']}: {report['error'] or 'drawn'}", flush=True)
        strips.append(strip)
        reports.append(report)
    for number, start in enumerate(range(0, len(strips), PER_PAGE), 1):
        page = tile(strips[start : start + PER_PAGE], PAGE_COLUMNS, WHITE, gap=10)
        _write(options.out / f"contact-{number:02d}.png", png_bytes(page))
    text = json.dumps({"version": full_version(), "prompts": reports}, indent=1)
    _write(options.out / "reports.json", f"{text}\n".encode())
    if not (options.out / "grades.csv").exists():
        blank_cells = [""] * (len(COLUMNS) - 1)
        rows = [[COLUMNS[0], "style", *COLUMNS[1:]]]
        rows += [[one.id, one.style, *blank_cells] for one in prompts]
        write_csv(options.out / "grades.csv", rows)


def read_prompts(path: Path) -> list[Prompt]:
    """The prompts of a CSV file.

    Raises:
        InputError: it cannot be read, a column or a cell is missing, or an id is not usable as the
            name of a file or there twice.
    """
    prompts: dict[str, Prompt] = {}
    for number, row in enumerate(read_csv(path, ("id", "prompt")), 2):
        name, text = (row["id"] or "").strip(), (row["prompt"] or "").strip()
        if not re.fullmatch(r"[\w-]{1,60}", name) or name in prompts:
            raise InputError(
                f"{path} line {number}: id is {shown(name)}; it must be letters, digits, _ and -, "
                "and of one prompt"
            )
        if not text:
            raise InputError(f"{path} line {number} has no prompt")
        prompts[name] = Prompt(name, text, (row.get("style") or "").strip())
    return list(prompts.values())


def make_strip(prompt: Prompt, folder: Path) -> tuple[Image, dict[str, Any]]:
    """Draw a prompt; returns the strip, and its report as plain values."""
    style = f" [{prompt.style}]" if prompt.style else ""
    caption = [f"{prompt.id}{style}: {prompt.prompt}"]
    stills: list[Image] = []
    report = None
    try:
        stills, report = render_stills(prompt.prompt)
        error = None
        caption += [*report.notes, *(report.faults() or ["report: all is shown as it says"])]
    except TexventError as problem:
        error = str(problem)
        caption.append(f"error: {error}")
    strip = draw_strip(stills, caption)
    _write(folder / f"{prompt.id}.png", png_bytes(strip))
    facts = None if report is None else report.to_json()
    return strip, {**prompt._asdict(), "error": error, "report": facts}


def render_stills(prompt: str) -> tuple[list[Image], PromptReport]:
    """Stills of a prompt, and its report.

    Raises:
        InputError: nothing of the prompt is understood.
    """
    generator = ProceduralGenerator(ProceduralConfig(duration=DURATION_S), seed=SEED, size=SIZE)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", TexventWarning)
        video = generator.generate(prompt)
        frames = [np.asarray(video.at(t_us).pixels, np.float32) for t_us in still_times_us()]
    report = PromptReport.from_json(video.metadata[REPORT_KEY])
    return [np.clip(np.rint(frame), 0, 255).astype(np.uint8) for frame in frames], report


def still_times_us() -> list[int]:
    """Instants of the stills: uneven, so that periodic motion is not at rest in them.

    Example:
        >>> still_times_us()
        [0, 430902, 811803, 1242705, 1623607, 2000000]
    """
    step_us = DURATION_S * MICROSECONDS / (STILLS - 1)
    early = [round(k * step_us + 50_000 * (0.618034 * k % 1.0)) for k in range(STILLS - 1)]
    return [*early, round(DURATION_S * MICROSECONDS)]


def draw_strip(stills: Sequence[Image], caption: Sequence[str]) -> Image:
    """Stills [H, W, 3] in a row, black where there are none, with lines of text below."""
    lines = [part for line in caption for part in textwrap.wrap(_ascii(line), LETTERS)]
    if len(lines) > LINES:
        lines = [*lines[: LINES - 1], f"... {len(lines) - LINES + 1} more lines"]
    empty = blank(*SIZE, BLACK)
    image = blank(STILLS * (SIZE.width + GAP_PX) - GAP_PX, SIZE.height + LINE_PX * 10, WHITE)
    image[: SIZE.height] = tile(list(stills) or [empty] * STILLS, STILLS, BLACK, gap=GAP_PX)
    for number, line in enumerate(lines, start=1):
        baseline = SIZE.height + LINE_PX * number
        draw_text(image, line, 3, baseline, height=8, colour=BLACK if number == 1 else GREY)
    return image


def _ascii(text: str) -> str:
    """The text in the letters that the font has."""
    for letter, plain in (("→", "->"), ("’", "'"), ("‘", "'"), ("“", '"'), ("”", '"'), ("–", "-")):
        text = text.replace(letter, plain)
    return unicodedata.normalize("NFKD", text).encode("ascii", "replace").decode()


def _write(path: Path, content: bytes) -> None:
    with atomic_file(path, overwrite=True) as part:
        part.write_bytes(content)
