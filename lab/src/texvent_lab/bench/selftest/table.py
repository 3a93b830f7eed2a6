"""The self-test's result: a document with a schema, and the table in docs/metrics.md."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any

from texvent.errors import FileFormatError, shown
from texvent.metrics.compare import plain_values
from texvent_lab.bench.document import read_document, restore_nan
from texvent_lab.bench.document_types import check_record
from texvent_lab.bench.machine import describe_environment
from texvent_lab.bench.selftest.perturbations import PERTURBATIONS, SERIES
from texvent_lab.bench.selftest.run import (
    RECORDING_SEEDS,
    SCENE,
    TEXTURE_SEED,
    SelftestRow,
    SelftestRows,
    ranked_rows,
)

SCHEMA = "texvent-selftest-1"
"""Name of the document's layout: one entry of `rows` per `SelftestRow`."""
MOST_NAMES = 8
"""Missed perturbations that a row of the table names; of more, one less and dots."""


def selftest_table(rows: Sequence[SelftestRow]) -> str:
    """The result as a Markdown table, best metrics first."""
    lines = [
        f"| metric | floor | found /{len(PERTURBATIONS)} | monotone /{len(SERIES)} | missed |",
        "|---|---|---|---|---|",
    ]
    for row in ranked_rows(rows):
        missed = row.missed
        if len(missed) > MOST_NAMES:
            missed = (*missed[: MOST_NAMES - 1], "...")
        lines.append(
            f"| {row.metric} | {row.floor:.4g} ± {row.floor_sd:.1g} | {len(row.found)} "
            f"| {sum(row.monotone.values())} | {', '.join(missed) or '–'} |"
        )
    return "\n".join(lines) + "\n"


def selftest_document(rows: Sequence[SelftestRow]) -> dict[str, Any]:
    """The result as plain values, ready for JSON; NaN becomes None."""
    return {
        "schema": SCHEMA,
        "environment": describe_environment(),
        "scene": SCENE,
        "texture_seed": TEXTURE_SEED,
        "recording_seeds": list(RECORDING_SEEDS),
        "series": {name: list(steps) for name, steps in SERIES.items()},
        "rows": [plain_values(asdict(row)) for row in rows],
    }


def read_selftest(path: Path) -> SelftestRows:
    """The rows of a document that `texvent bench selftest --out` wrote.

    Raises:
        InputError: there is no such file.
        FileFormatError: it is no self-test of this layout.
    """
    document = read_document(path)
    if document.get("schema") != SCHEMA:
        raise FileFormatError(
            f"{path} has the schema {shown(document.get('schema'))}, expected {SCHEMA!r}; "
            "write one with texvent bench selftest --out"
        )
    names = {field.name for field in fields(SelftestRow)}
    rows = restore_nan(document.get("rows"))
    if not isinstance(rows, list):
        raise FileFormatError(f"{path} has no list of rows")
    for number, row in enumerate(rows):
        check_record(SelftestRow, row, f"{path}: row {number}")
    return SelftestRows(SelftestRow(**{name: row[name] for name in names}) for row in rows)
