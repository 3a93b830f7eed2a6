"""Results of benchmarks, and network weights that are read without torch."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from lab.tests.bench.synthetic_report import synthetic_report

from texvent.metrics import lpips
from texvent.metrics.lpips import read_lpips_weights, write_lpips_weights
from texvent_lab.bench.document import read_document, write_document
from texvent_lab.bench.fidelity.page import page_files
from texvent_lab.bench.fidelity.results import read_report
from texvent_lab.bench.selftest.run import SelftestRow
from texvent_lab.bench.selftest.table import read_selftest, selftest_document, selftest_table

from ..metrics.lpips.lpips_files import NARROW, narrow_weights, write_published
from .reader import Reader, digest


def document_readers() -> list[Reader]:
    """Results and weights."""
    return [
        Reader("bench .json", partial(_make_report, "result.json"), _read_page, 3),
        Reader("bench .json.gz", partial(_make_report, "result.json.gz"), _read_page),
        Reader("bench selftest", _make_selftest, lambda path: selftest_table(read_selftest(path))),
        Reader("weights .npz", _make_weights, _read_weights),
        Reader("weights pickle", _make_published, _read_weights),
    ]


def _make_report(name: str, folder: Path) -> Path:
    path = folder / name
    write_document(path, synthetic_report().document(), overwrite=True)
    return path


def _read_page(path: Path) -> str:
    report = read_report(read_document(path))
    return digest(page_files(report, path.name, has_charts=False).values())


def _make_selftest(folder: Path) -> Path:
    row = SelftestRow(
        metric="stpp",
        better="higher",
        floor=0.9,
        floor_sd=0.01,
        values={"flip": 0.5},
        z={"flip": 12.0},
        monotone={"noise": True},
        seconds=0.5,
    )
    path = folder / "selftest.json"
    write_document(path, selftest_document([row]), overwrite=True)
    return path


def _make_weights(folder: Path) -> Path:
    path = folder / "alex.npz"
    write_lpips_weights(narrow_weights(), path)
    return path


def _make_published(folder: Path) -> Path:
    return write_published(narrow_weights(), folder / "weights_v0.1")


def _read_weights(path: Path) -> str:
    # The published network has 10 MB; a narrow one of the same layers is read by the same code.
    lpips.LAYOUTS = (NARROW,)
    arrays = read_lpips_weights(path).arrays
    return digest(arrays[name] for name in sorted(arrays))
