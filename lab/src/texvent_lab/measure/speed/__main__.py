"""Measure and print; see the package."""

from __future__ import annotations

import argparse
from pathlib import Path

from texvent_lab.bench.document import write_document
from texvent_lab.measure.speed.measure import Options, measure
from texvent_lab.measure.speed.tables import as_markdown


def main() -> None:
    """Measure, print the tables, write the JSON."""
    parser = argparse.ArgumentParser(prog="python -m texvent_lab.measure.speed")
    parser.add_argument("--quick", action="store_true", help="fewer repeats: under a minute")
    parser.add_argument("--json", type=Path, help="write the figures here")
    parser.add_argument(
        "--heavy-clip", type=Path, help=".npz with gray [N, H, W] and t_us [N]; else embedded"
    )
    parser.add_argument("--video", type=Path, help="real video; else a short excerpt")
    chosen = parser.parse_args()
    for path in (chosen.heavy_clip, chosen.video):
        if path is not None and not path.is_file():
            parser.error(f"no such file: {path}")
    document = measure(Options(chosen.quick, chosen.heavy_clip, chosen.video))
    if chosen.json is not None:
        write_document(chosen.json, document, overwrite=True)
    print(as_markdown(document))


if __name__ == "__main__":
    main()
