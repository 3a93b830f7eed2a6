"""Choose a step; see the package."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from texvent.errors import TexventError
from texvent_lab.measure.prompts import score, sheet


def main() -> int:
    """Run a step; returns the exit code."""
    chosen = _parser().parse_args()
    try:
        chosen.run(chosen)
    except TexventError as error:
        print(f"error: {error}", file=sys.stderr)
        return error.exit_code
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m texvent_lab.measure.prompts")
    commands = parser.add_subparsers(required=True)
    one = commands.add_parser("sheet", help="film strips of prompts, for grading")
    one.add_argument("prompts", type=Path, help=".csv with columns id, prompt, and perhaps style")
    one.add_argument("-o", "--out", type=Path, required=True, help="folder")
    one.add_argument("--jobs", type=int, default=1, help="processes")
    one.set_defaults(run=sheet.run)
    one = commands.add_parser("score", help="the table of a grader's sheet")
    one.add_argument("grades", type=Path, help=".csv; columns: " + ", ".join(score.COLUMNS))
    one.set_defaults(run=score.run)
    return parser


if __name__ == "__main__":
    sys.exit(main())
