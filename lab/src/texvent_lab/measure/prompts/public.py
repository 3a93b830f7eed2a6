"""Prompts of public benchmarks, drawn by digest: nobody of this project wrote or chose them.

* `short` (V): VBench, `prompts/all_dimension.txt` of its repository (Huang et al., CVPR 2024).
* `detailed` (M): Movie Gen Video Bench, `benchmark/MovieGenVideoBench.txt` (Polyak et al., 2024),
  prompts of 20 words or more. 93 of those 322 fill one template ("... taking a pleasant stroll in
  ... during ..."), which is left out.
* `caption` (K): COCO, `annotations/captions_val2017.json` (Chen et al., 2015).

The files are not part of this repository; `public/digests.csv` holds what was drawn as SHA-256. The
text before the first comma says which half a prompt belongs to, so that a subject of VBench, which
stands there in twenty styles, is in one half only. Within a half the first by digest are drawn. A
second draw of the test half, for a later version, takes the next ones, of other subjects.
"""

from __future__ import annotations

import argparse
import hashlib
import json
from collections.abc import Sequence
from io import StringIO
from pathlib import Path

from texvent.errors import InputError
from texvent_lab.measure.prompts.score import read_csv, write_csv
from texvent_lab.measure.prompts.sheet import Prompt

STYLES = {"short": "V", "detailed": "M", "caption": "K"}
"""Letter of the ids of each style."""
HALVES = ("development", "test")
SECOND = "second-test"
DRAWS = (*HALVES, SECOND)
PER_DRAW = 40
"""Prompts of each style in a draw."""
_WORDS_OF_DETAIL = 20
_TEMPLATE = "pleasant stroll"
_DIGESTS = Path(__file__).parent / "public" / "digests.csv"


def run(options: argparse.Namespace) -> None:
    """Write development.csv and both test files, and say whether they are what was graded.

    Raises:
        InputError: a file cannot be read, or holds fewer prompts than are drawn.
    """
    texts = {
        "short": _lines(options.vbench),
        "detailed": [one for one in _lines(options.moviegen) if _is_detailed(one)],
        "caption": _captions(options.coco),
    }
    known = {row["id"]: row["sha256"] for row in read_csv(_DIGESTS, ("id", "sha256"))}
    options.out.mkdir(parents=True, exist_ok=True)
    for name in DRAWS:
        prompts = [one for style in STYLES for one in draw(texts[style], style, name)]
        rows = [[one.id, one.style, one.prompt] for one in prompts]
        write_csv(options.out / f"{name}.csv", [["id", "style", "prompt"], *rows])
        same = sum(known.get(one.id) == digest(one.prompt) for one in prompts)
        print(f"{name}: {len(prompts)} prompts, {same} of them those that were graded")


def draw(texts: Sequence[str], style: str, name: str) -> list[Prompt]:
    """The prompts of one style and draw; ids count on from draw to draw.

    Raises:
        InputError: there are fewer than `PER_DRAW`.
    """
    half = "test" if name == SECOND else name
    mine = sorted({one for one in texts if half_of(one) == half}, key=digest)
    if name == SECOND:
        used = {subject_of(one) for one in mine[:PER_DRAW]}
        mine = [one for one in mine[PER_DRAW:] if subject_of(one) not in used]
    if len(mine) < PER_DRAW:
        raise InputError(
            f"the {style} prompts of the draw {name} are {len(mine)}; at least {PER_DRAW} are "
            "needed: is the file complete?"
        )
    first = 1 + PER_DRAW * DRAWS.index(name)
    letter = STYLES[style]
    return [
        Prompt(f"{letter}{number:02d}", text, style)
        for number, text in enumerate(mine[:PER_DRAW], first)
    ]


def half_of(text: str) -> str:
    """Half of a prompt, by the digest of its subject."""
    return HALVES[int(digest(f"half {subject_of(text)}"), 16) % 2]


def subject_of(text: str) -> str:
    """Text before the first comma."""
    return text.split(",")[0].lower()


def digest(text: str) -> str:
    """SHA-256 of a text, in hexadecimal digits."""
    return hashlib.sha256(text.encode()).hexdigest()


def _is_detailed(text: str) -> bool:
    return len(text.split()) >= _WORDS_OF_DETAIL and _TEMPLATE not in text


def _lines(path: Path) -> list[str]:
    lines = (line.strip() for line in StringIO(_read(path)))
    return [line for line in lines if line]


def _captions(path: Path) -> list[str]:
    try:
        annotations = json.loads(_read(path))["annotations"]
        return [" ".join(one["caption"].split()) for one in annotations]
    except (ValueError, KeyError, TypeError) as error:
        raise InputError(
            f"{path} is no file of COCO captions: it needs annotations, each with a caption"
        ) from error


def _read(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"cannot read {path}: {error}") from error
