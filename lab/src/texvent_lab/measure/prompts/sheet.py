"""Film strips of prompts, for a grader who sees the images and the report, not the code.

For every prompt `strips/ID.png`: six stills over 2 s at 173x130 pixels, the prompt, and what its
report says is not shown as it says. `contact-NN.png` holds twelve of them. `reports.json` holds the
whole report of each prompt, which things are in view, events per pixel and second for the presets
`paper` and of the physical model, and the local contrast. The same command goes on where it was
stopped; an error of a prompt is noted and harms no other. `grades.csv` is for the grader to fill
in.
"""

from __future__ import annotations

import argparse
import csv
import functools
import json
import re
import statistics
import textwrap
import time
import unicodedata
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from texvent.batch.identity import digest
from texvent.batch.processes import interruptible, processes
from texvent.errors import InputError, OutputError, TexventError, shown
from texvent.extending import full_version
from texvent.io.atomic import atomic_file
from texvent.scenes.report import PromptReport, ReportTally
from texvent_lab.measure.prompts.measure import SETTINGS, SIZE, STILLS, measure_prompt
from texvent_lab.measure.prompts.score import COLUMNS, Share

GAP_PX = 2
LINE_PX, LETTERS = 15, 158
"""Height of a line of text, and its letters at most."""
MOST_LINES = 9
PAGE_COLUMNS = 2
TILE, LABEL_PX, TILES_PER_ROW = (86, 65), 12, 8
"""Size of a still in the mosaic, height of its label, px, and prompts in a row."""
WIDTH = STILLS * SIZE.width + (STILLS - 1) * GAP_PX
_FONT, _SCALE = cv2.FONT_HERSHEY_SIMPLEX, 0.38
_PLAIN = {"→": "->", "’": "'", "‘": "'", "“": '"', "”": '"', "–": "-", "—": "-"}

Image = NDArray[np.uint8]


def draw_strip(stills: Sequence[Image], caption: Sequence[str]) -> Image:
    """Stills [H, W, 3] in a row, black where there are none, with lines of text below."""
    lines = [part for line in caption for part in textwrap.wrap(_ascii(line), LETTERS)]
    if len(lines) > MOST_LINES:
        lines = [*lines[: MOST_LINES - 1], f"... {len(lines) - MOST_LINES + 1} more lines"]
    image = np.full((SIZE.height + LINE_PX * (len(lines) + 1), WIDTH, 3), 255, np.uint8)
    image[: SIZE.height] = 0
    for number, still in enumerate(stills):
        left = number * (SIZE.width + GAP_PX)
        image[: SIZE.height, left : left + SIZE.width] = still
    for number, line in enumerate(lines):
        colour = (0, 0, 0) if number == 0 else (70, 70, 70)
        place = (3, SIZE.height + LINE_PX * (number + 1))
        cv2.putText(image, line, place, _FONT, _SCALE, colour, 1, cv2.LINE_AA)
    return image


def draw_page(strips: Sequence[Image]) -> Image:
    """Strips in two columns, row by row, each row as high as its higher strip."""
    rows = []
    for start in range(0, len(strips), PAGE_COLUMNS):
        row = strips[start : start + PAGE_COLUMNS]
        height = max(strip.shape[0] for strip in row)
        band = np.full((height + 8, PAGE_COLUMNS * WIDTH + 10, 3), 255, np.uint8)
        for number, strip in enumerate(row):
            left = number * (WIDTH + 10)
            band[: strip.shape[0], left : left + strip.shape[1]] = strip
        rows.append(band)
    return np.concatenate(rows)


def draw_tile(strip: Image, name: str) -> Image:
    """The second and the last but one still of a strip, small, with the name of the prompt."""
    stills = []
    for number in (1, STILLS - 2):
        left = number * (SIZE.width + GAP_PX)
        still = strip[: SIZE.height, left : left + SIZE.width]
        stills.append(cv2.resize(still, TILE, interpolation=cv2.INTER_AREA))
    label = np.full((LABEL_PX, 2 * TILE[0], 3), 255, np.uint8)
    cv2.putText(label, _ascii(name), (2, LABEL_PX - 3), _FONT, 0.3, (0, 0, 0), 1, cv2.LINE_AA)
    return np.concatenate([np.concatenate(stills, axis=1), label])


def draw_grid(tiles: Sequence[Image]) -> Image:
    """Tiles of one size, in rows of `TILES_PER_ROW`."""
    blank = np.full_like(tiles[0], 255)
    filled = [*tiles, *[blank] * (-len(tiles) % TILES_PER_ROW)]
    rows = [
        np.concatenate(filled[start : start + TILES_PER_ROW], axis=1)
        for start in range(0, len(filled), TILES_PER_ROW)
    ]
    return np.concatenate(rows)


def write_image(path: Path, image: Image) -> None:
    """Write RGB as PNG or JPEG, by the name, whole or not at all."""
    is_made, data = cv2.imencode(path.suffix, image[..., ::-1])
    if not is_made:
        raise OutputError(f"cannot encode {path}")
    with atomic_file(path, overwrite=True) as part:
        part.write_bytes(data.tobytes())


def read_image(path: Path) -> Image:
    """The RGB image of a file."""
    image = cv2.imdecode(np.frombuffer(path.read_bytes(), np.uint8), cv2.IMREAD_COLOR)
    if image is None:
        raise InputError(f"{path} is no image; run with --again")
    return np.asarray(image[..., ::-1], np.uint8)


def _ascii(text: str) -> str:
    """The text in the letters that the font has."""
    for letter, plain in _PLAIN.items():
        text = text.replace(letter, plain)
    return unicodedata.normalize("NFKD", text).encode("ascii", "replace").decode()


PER_PAGE = 12
RATES = (0.5, 10.0)
"""Events per pixel and second that the issue asks for."""
CONTRASTS = (0.10, 0.20)
"""Local log-contrast of real scenes with ground, median."""


@dataclass(frozen=True)
class Prompt:
    """A row of the list."""

    id: str
    prompt: str
    style: str = ""


def run(options: argparse.Namespace) -> None:
    """Draw all strips that are not there, then the pages and the figures."""
    if options.jobs < 1:
        raise InputError(f"jobs is {options.jobs}; it must be at least 1")
    prompts = read_prompts(options.prompts)
    folder: Path = options.out
    for name in ("strips", "results"):
        (folder / name).mkdir(parents=True, exist_ok=True)
    make = functools.partial(make_strip, folder=folder, with_events=not options.no_events)
    todo = [one for one in prompts if options.again or _kept(one, folder, options) is None]
    started = time.perf_counter()
    for number, one in enumerate(_made(make, todo, options.jobs), 1):
        spent = time.perf_counter() - started
        left = spent / number * (len(todo) - number)
        print(f"{number}/{len(todo)}  {one}  ({left / 60:.0f} min left)", flush=True)
    results = [_result(folder, one) for one in prompts]
    write_pages(folder, prompts)
    write_blank_grades(folder / "grades.csv", prompts)
    summary = summarise(results)
    text = json.dumps({"settings": SETTINGS, "summary": summary, "prompts": results}, indent=1)
    with atomic_file(folder / "reports.json", overwrite=True) as part:
        part.write_text(text + "\n", encoding="utf-8")
    print("\n".join(f"{name}: {value}" for name, value in summary.items()))


def read_prompts(path: Path) -> list[Prompt]:
    """The prompts of a CSV file.

    Raises:
        InputError: it cannot be read, a column or a cell is missing, or an id is not usable as the
            name of a file or there twice.
    """
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            rows = list(csv.DictReader(file))
    except OSError as error:
        raise InputError(f"cannot read {path}: {error.strerror}") from error
    if not rows or not {"id", "prompt"} <= set(rows[0]):
        raise InputError(f"{path} needs the columns id and prompt, and at least one row")
    prompts: dict[str, Prompt] = {}
    for number, row in enumerate(rows, 2):
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


def _made(make: Callable[[Prompt], str], prompts: Sequence[Prompt], jobs: int) -> Iterator[str]:
    """Make strips; a line for each."""
    if jobs == 1 or len(prompts) < 2:
        yield from map(make, prompts)
        return
    with processes(jobs) as pool:
        yield from pool.map(functools.partial(_make_in_process, make), prompts)


def _make_in_process(make: Callable[[Prompt], str], prompt: Prompt) -> str:
    with interruptible():
        return make(prompt)


def make_strip(prompt: Prompt, *, folder: Path, with_events: bool) -> str:
    """Draw and measure a prompt; returns a line that says how it went."""
    try:
        stills, facts = measure_prompt(prompt.prompt, with_events=with_events)
        error = None
    except TexventError as problem:
        stills, facts, error = [], {}, str(problem)
    except Exception as problem:  # noqa: BLE001  # a fault of a scene must not end the benchmark
        stills, facts, error = [], {}, f"{type(problem).__name__}: {problem}"
    result = {
        **asdict(prompt), "key": _key(prompt, with_events), "version": full_version(),
        "error": error, **facts,
    }  # fmt: skip
    image = draw_strip(stills, _caption(prompt, result))
    write_image(_strip(folder, prompt), image)
    with atomic_file(folder / "results" / f"{prompt.id}.json", overwrite=True) as part:
        part.write_text(json.dumps(result) + "\n", encoding="utf-8")
    return f"{prompt.id}: {error or 'drawn'}"


def _caption(prompt: Prompt, result: dict[str, Any]) -> list[str]:
    """Lines below a strip."""
    style = f" [{prompt.style}]" if prompt.style else ""
    lines = [f"{prompt.id}{style}: {prompt.prompt}"]
    if result["error"] is not None:
        return [*lines, f"error: {result['error']}"]
    report = PromptReport.from_json(result["prompt_report"])
    return [*lines, *report.notes, *(report.faults() or ["report: all is shown as it says"])]


def _key(prompt: Prompt, with_events: bool) -> str:
    return digest([prompt.prompt, prompt.style, SETTINGS, with_events])


def _kept(prompt: Prompt, folder: Path, options: argparse.Namespace) -> dict[str, Any] | None:
    """The result that is there already; None where it is to make."""
    try:
        result: dict[str, Any] = _result(folder, prompt)
    except (OSError, ValueError):
        return None
    is_current = result.get("key") == _key(prompt, not options.no_events)
    return result if is_current and _strip(folder, prompt).is_file() else None


def _strip(folder: Path, prompt: Prompt) -> Path:
    return folder / "strips" / f"{prompt.id}.png"


def _result(folder: Path, prompt: Prompt) -> Any:
    return json.loads((folder / "results" / f"{prompt.id}.json").read_text(encoding="utf-8"))


def write_pages(folder: Path, prompts: Sequence[Prompt]) -> None:
    """Contact sheets of twelve strips each."""
    for number, start in enumerate(range(0, len(prompts), PER_PAGE), 1):
        strips = [read_image(_strip(folder, one)) for one in prompts[start : start + PER_PAGE]]
        write_image(folder / f"contact-{number:02d}.png", draw_page(strips))


def write_blank_grades(path: Path, prompts: Sequence[Prompt]) -> None:
    """A sheet for the grader to fill in, as `score` reads it; one that is there stays."""
    if path.exists():
        return
    with (
        atomic_file(path, overwrite=False) as part,
        part.open("w", encoding="utf-8", newline="") as file,
    ):
        writer = csv.writer(file)
        writer.writerow([COLUMNS[0], "style", *COLUMNS[1:]])
        writer.writerows([one.id, one.style, *[""] * (len(COLUMNS) - 1)] for one in prompts)


def write_mosaic(options: argparse.Namespace) -> None:
    """Two stills of every prompt of a sheet, with its id, in one JPEG.

    Raises:
        InputError: the folder holds no sheet, or the name does not end in .jpg.
    """
    if options.out.suffix != ".jpg":
        raise InputError(f"{options.out} is to hold a JPEG; its name must end in .jpg")
    try:
        text = (options.folder / "reports.json").read_text(encoding="utf-8")
        names = [str(one["id"]) for one in json.loads(text)["prompts"]]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise InputError(f"{options.folder} holds no sheet; make it with sheet") from error
    tiles = [
        draw_tile(read_image(options.folder / "strips" / f"{name}.png"), name) for name in names
    ]
    write_image(options.out, draw_grid(tiles))


def summarise(results: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """Figures over all prompts."""
    tally = ReportTally()
    for one in results:
        report = one.get("prompt_report")
        tally.add(None if report is None else PromptReport.from_json(report))
    drawn = [one for one in results if one["error"] is None]
    summary: dict[str, Any] = {"prompts": tally.line()}
    unseen = [one for one in drawn if one["hardly_in_view"]]
    versions = sorted({str(one["version"]) for one in results})
    if len(versions) > 1:
        summary["versions"] = f"{', '.join(versions)}: draw all anew with --again"
    summary["a thing hardly in view"] = str(Share(len(unseen), len(drawn)))
    contrasts = [one["contrast"] for one in drawn]
    if contrasts:
        summary["local log-contrast, median"] = round(statistics.median(contrasts), 3)
        summary["contrast within .10 to .20"] = _within(contrasts, CONTRASTS)
    for preset in SETTINGS["presets"]:
        found = [one["events"][preset] for one in drawn if preset in one.get("events", {})]
        rates = [one["per_pixel_and_second"] for one in found]
        if rates:
            summary[f"{preset}: events per pixel and second, median"] = round(
                statistics.median(rates), 3
            )
            summary[f"{preset}: rate within .5 to 10"] = _within(rates, RATES)
        moving = [
            one["events"][preset]["pixels_with_two"]
            for one in drawn
            if one["is_camera_moving"] and preset in one.get("events", {})
        ]
        if moving:
            summary[f"{preset}: pixels with 2 events in 1 s, moving camera, median"] = round(
                statistics.median(moving), 3
            )
    return summary


def _within(values: Sequence[float], limits: tuple[float, float]) -> str:
    low, high = limits
    return str(Share(sum(low <= value <= high for value in values), len(values)))
