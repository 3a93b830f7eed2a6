"""Network weights that are read without torch."""

from __future__ import annotations

from pathlib import Path

from texvent.metrics.lpips import read_lpips_weights, write_lpips_weights

from ..metrics.lpips.lpips_files import NARROW, narrow_weights, write_published
from .reader import Reader, digest


def document_readers() -> list[Reader]:
    """Both forms of weights."""
    return [
        Reader("weights .npz", _make_weights, _read_weights),
        Reader("weights pickle", _make_published, _read_weights),
    ]


def _make_weights(folder: Path) -> Path:
    path = folder / "alex.npz"
    write_lpips_weights(narrow_weights(), path)
    return path


def _make_published(folder: Path) -> Path:
    return write_published(narrow_weights(), folder / "weights_v0.1")


def _read_weights(path: Path) -> str:
    # The published network has 10 MB; a narrow one of the same layers is read by the same code.
    arrays = read_lpips_weights(path, NARROW).arrays
    return digest(arrays[name] for name in sorted(arrays))
