"""Readers under the GPL find every event where texvent put it: an opt-in job, `make test-gpl`.

They are no dependency of texvent, of its other tests or of its tools: that job alone installs them
and selects these tests, which fail where a reader is missing. They read what few others read.
"""

import importlib
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from texvent.io.files import load, save
from texvent.sensor import SensorSize

from .format_cases import assert_same, recording
from .test_corpus import CORPUS

pytestmark = pytest.mark.gpl

DAVIS = SensorSize(346, 260)
DVS = SensorSize(128, 128)
ATIS = SensorSize(240, 180)
HD = SensorSize(1280, 720)


def joined(packets: Iterable[Any]) -> Any:
    return np.concatenate(list(packets))


def test_tonic_reads_aedat2_of_a_davis346() -> None:
    tonic = importlib.import_module("tonic.io")
    path = CORPUS / "aedat2" / "e.aedat"
    events = load(path)
    _, _, theirs = tonic.read_davis_346(str(path))
    assert_same(events, theirs["x"], theirs["y"], theirs["t"], theirs["p"])


def test_tonic_reads_atis(tmp_path: Path) -> None:
    tonic = importlib.import_module("tonic.io")
    events = recording(ATIS)
    path = save(tmp_path / "e.bin", events, format="atis")
    theirs = tonic.read_mnist_file(str(path), tonic.events_struct)
    assert_same(events, theirs["x"], theirs["y"], theirs["t"], theirs["p"])


def test_event_stream_reads_es_with_rows_from_below() -> None:
    module = importlib.import_module("event_stream")
    path = CORPUS / "es" / "e.es"
    events = load(path)
    with module.Decoder(str(path)) as decoder:
        assert (decoder.type, decoder.width, decoder.height) == ("dvs", *events.size)
        theirs = joined(decoder)
    assert_same(
        events,
        theirs["x"],
        events.size.height - 1 - theirs["y"].astype(int),
        theirs["t"],
        theirs["on"],
    )


@pytest.mark.parametrize(
    ("file", "format"),
    [("e.dat", "dat"), ("e.raw", "evt3")],
)
def test_faery_reads_every_event(tmp_path: Path, file: str, format: str) -> None:
    faery = importlib.import_module("faery")
    events = recording(HD)
    path = save(tmp_path / file, events, format=format)
    theirs = joined(faery.events_stream_from_file(str(path)))
    assert_same(events, theirs["x"], theirs["y"], theirs["t"], theirs["on"])


@pytest.mark.parametrize(("file", "format"), [("e.raw", "evt3"), ("e.dat", "dat")])
def test_evutils_reads_every_event(tmp_path: Path, file: str, format: str) -> None:
    evutils = importlib.import_module("evutils.io")
    events = recording(HD)
    path = save(tmp_path / file, events, format=format)
    with path.open("rb") as opened:  # a file that evutils opens itself stays open
        theirs = evutils.EventReader(opened).read_all()
    assert_same(events, theirs["x"], theirs["y"], theirs["t"], theirs["p"])
