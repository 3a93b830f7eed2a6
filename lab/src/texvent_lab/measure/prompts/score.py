"""A grader's sheet, summed.

The columns of the sheet, one row per prompt; yes and no may be 1 and 0, and an empty cell is no:

* `id`, and perhaps `style`;
* `nouns_asked`, `nouns_shown`: how many things the sentence names, how many a stranger recognises;
* `motion`: yes, partly or no; none where the sentence asks for no motion;
* `silently_wrong`: something is shown that the sentence does not say, or missing, and not reported;
* `fully_right`: all is shown as the sentence says; `fully_reported`: all that is not is reported;
* `stand_in`: what is shown has nothing to do with the sentence, or nothing is shown;
* `grade`: 0 to 5; `remark`.
"""

from __future__ import annotations

import argparse
import csv
import math
import statistics
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from texvent.errors import InputError, one_line, shown
from texvent.io.atomic import atomic_file
from texvent_lab.bench.document import markdown_table

COLUMNS = (
    "id", "nouns_asked", "nouns_shown", "motion", "silently_wrong", "fully_right",
    "fully_reported", "stand_in", "grade", "remark",
)  # fmt: skip
MOTIONS = ("yes", "partly", "no", "none")
FLAGS = ("silently_wrong", "fully_right", "fully_reported", "stand_in")
YES, NO = ("yes", "y", "1", "true", "x"), ("no", "n", "0", "false", "")
Z95 = 1.959964
"""Standard normal quantile of .975."""


@dataclass(frozen=True)
class Share:
    """A number of successes and of trials.

    Example:
        >>> str(Share(8, 10)), str(Share(0, 0))
        ('80 % (49 to 94; 8 of 10)', '-')
    """

    count: float
    of: int

    @property
    def value(self) -> float:
        """The share, 0..1; NaN of nothing."""
        return self.count / self.of if self.of else math.nan

    @property
    def interval(self) -> tuple[float, float]:
        """Wilson's interval at 95 %: E. B. Wilson, J. Am. Stat. Assoc. 22, 209 (1927)."""
        if not self.of:
            return math.nan, math.nan
        share, weight = self.value, Z95**2 / self.of
        middle = (share + weight / 2) / (1 + weight)
        half = math.sqrt(share * (1 - share) * weight + weight**2 / 4) / (1 + weight)
        return max(0.0, middle - half), min(1.0, middle + half)

    def __str__(self) -> str:
        if not self.of:
            return "-"
        low, high = self.interval
        return (
            f"{100 * self.value:.0f} % ({100 * low:.0f} to {100 * high:.0f}; "
            f"{self.count:g} of {self.of})"
        )


def run(options: argparse.Namespace) -> None:
    """Print the table, for all prompts and for each style."""
    rows = read_grades(options.grades)
    styles = list(dict.fromkeys(row["style"] for row in rows if row["style"]))
    parts = {"all": rows, **{one: [row for row in rows if row["style"] == one] for one in styles}}
    sums = {name: sum_grades(part) for name, part in parts.items()}
    print(as_markdown(sums))


def read_grades(path: Path) -> list[dict[str, Any]]:
    """The rows of a grader's sheet.

    Raises:
        InputError: a column is missing, or a cell is none of the allowed ones.
    """
    rows = read_csv(path, [name for name in COLUMNS if name != "remark"])
    return [_read_row(row, f"{path} line {number}") for number, row in enumerate(rows, 2)]


def _read_row(row: Mapping[str, str | None], where: str) -> dict[str, Any]:
    cells = {name: (row.get(name) or "").strip() for name in (*COLUMNS, "style")}
    asked, shows = (_number(cells[name], name, where) for name in ("nouns_asked", "nouns_shown"))
    if shows > asked:
        raise InputError(f"{where}: {shows:g} nouns are shown of {asked:g} that are asked")
    motion = cells["motion"].lower() or "none"
    if motion not in MOTIONS:
        raise InputError(
            f"{where}: motion is {shown(motion)}; it must be one of {', '.join(MOTIONS)}"
        )
    flags = {name: _flag(cells[name], name, where) for name in FLAGS}
    grade = _number(cells["grade"], "grade", where)
    if not 0 <= grade <= 5:
        raise InputError(f"{where}: grade is {grade:g}; it must lie within 0 and 5")
    return {
        "id": cells["id"], "style": cells["style"], "nouns_asked": asked, "nouns_shown": shows,
        "motion": motion, "grade": grade, **flags,
    }  # fmt: skip


def _number(text: str, name: str, where: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    if not (math.isfinite(number) and number >= 0):
        raise InputError(f"{where}: {name} is {shown(text)}; it must be a number, 0 or more")
    return number


def _flag(text: str, name: str, where: str) -> bool:
    if text.lower() not in (*YES, *NO):
        raise InputError(f"{where}: {name} is {shown(text)}; it must be yes or no")
    return text.lower() in YES


def sum_grades(rows: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """The figures of the issue's table, by name.

    Nouns of one prompt are not independent, so that the interval of `nouns shown` is a little too
    narrow.
    """
    moving = [row for row in rows if row["motion"] != "none"]
    grades = [row["grade"] for row in rows]

    def share(test: Any) -> Share:
        return Share(sum(map(test, rows)), len(rows))

    asked = round(sum(row["nouns_asked"] for row in rows))
    return {
        "prompts": len(rows),
        "nouns shown": Share(sum(row["nouns_shown"] for row in rows), asked),
        "motion right": Share(sum(row["motion"] == "yes" for row in moving), len(moving)),
        "motion right or partly": Share(
            sum(row["motion"] in ("yes", "partly") for row in moving), len(moving)
        ),
        "silently wrong": share(lambda row: row["silently_wrong"]),
        "fully right": share(lambda row: row["fully_right"]),
        "fully right or fully reported": share(
            lambda row: row["fully_right"] or row["fully_reported"]
        ),
        "stand-in": share(lambda row: row["stand_in"]),
        "mean grade": statistics.fmean(grades),
        "standard error of the grade": (
            statistics.stdev(grades) / math.sqrt(len(grades)) if len(grades) > 1 else math.nan
        ),
    }


def as_markdown(sums: Mapping[str, Mapping[str, Any]]) -> str:
    """A table with a column for each part; shares with Wilson's interval at 95 %."""
    names = next(iter(sums.values()))
    rows = [(name, *(_cell(one[name]) for one in sums.values())) for name in names]
    return markdown_table(("", *sums), rows)


def _cell(value: Any) -> str:
    return f"{value:.2f}" if isinstance(value, float) else str(value)


def read_csv(path: Path, columns: Sequence[str]) -> list[dict[str, Any]]:
    """Rows of a table with a line of titles.

    Raises:
        InputError: it cannot be read, has no row, or lacks a column.
    """
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            rows: list[dict[str, Any]] = list(csv.DictReader(file))
    except OSError as error:
        raise InputError(f"cannot read {path}: {error.strerror}") from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise InputError(
            f"{path} is no table in UTF-8 ({one_line(error)}); save it as CSV in UTF-8"
        ) from error
    missing = [name for name in columns if not rows or name not in rows[0]]
    if missing:
        raise InputError(f"{path} needs the columns {', '.join(columns)}, and at least one row")
    return rows


def write_csv(path: Path, rows: Sequence[Sequence[str]]) -> None:
    """Write a table, over one that is there."""
    with (
        atomic_file(path, overwrite=True) as part,
        part.open("w", encoding="utf-8", newline="") as file,
    ):
        csv.writer(file).writerows(rows)
