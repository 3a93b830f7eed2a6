"""Small files of every format, committed: what texvent wrote before it reads for ever.

They are also the seeds of `tests/fuzz`. A new format's file is made by
`python -m tests.io.test_corpus` in the repository's root, which never touches existing ones.
"""

from pathlib import Path

import pytest

from texvent.cli.app import main
from texvent.errors import MissingDependencyError
from texvent.events import EventStream
from texvent.io.files import load, save
from texvent.sensor import SensorSize

from .format_cases import ALL_CASES, CASES, FormatCase, random_events

CORPUS = Path(__file__).with_name("corpus")
SMALL = SensorSize(64, 48)


def expected(case: FormatCase) -> EventStream:
    """Twelve events, two of them after a silence of three seconds."""
    burst = random_events(10, case.sensor, span_us=30_000, seed=11)
    late = random_events(2, case.sensor, span_us=50, start_us=3_000_000, seed=12)
    return EventStream.concat([burst, late])


OTHER_LAYOUTS = (
    FormatCase("aedat4-none", "e.aedat4", SMALL),
    FormatCase("aedat4-zstd", "e.aedat4", SMALL),
    FormatCase("dsec-blosc", "e.h5", SMALL, extra="hdf5plugin"),
    FormatCase("v2e", "e.h5", SMALL),
    FormatCase("timelens", "e.npz", SMALL),
)
"""Files that former versions wrote, which are read by their content."""


@pytest.mark.parametrize("case", [*ALL_CASES, *OTHER_LAYOUTS], ids=lambda case: case.name)
def test_a_committed_file_still_reads(case):
    if case.extra:
        pytest.importorskip(case.extra, reason=f"{case.name} needs {case.extra}")
    format = None if case in OTHER_LAYOUTS else case.name
    size = None if case.keeps_metadata else case.sensor
    events = load(CORPUS / case.name / case.file, format=format, size=size)
    assert events.equals(expected(case))
    assert events.metadata == (expected(case).metadata if case.keeps_metadata else {})


@pytest.mark.parametrize("case", ALL_CASES, ids=lambda case: case.name)
def test_every_command_of_event_files_takes_a_committed_file(case, tmp_path):
    if case.extra:
        pytest.importorskip(case.extra, reason=f"{case.name} needs {case.extra}")
    path = str(CORPUS / case.name / case.file)
    size = [] if case.keeps_metadata else ["--sensor", str(case.sensor)]
    commands = [
        ["info", path, "--format", case.name, *size],
        ["validate", path, "--format", case.name, *size],
        ["render", path, "-o", str(tmp_path / "e.png"), "--format", case.name, *size],
        ["convert", path, str(tmp_path / "e.h5"), "--from-format", case.name, *size],
    ]
    assert [main(words) for words in commands] == [0] * 4
    assert load(tmp_path / "e.h5").equals(expected(case))


def make_missing() -> None:
    """Write the files of formats that have none yet."""
    for case in CASES:
        folder = CORPUS / case.name
        if folder.exists():
            continue
        folder.mkdir(parents=True)
        try:
            save(folder / case.file, expected(case), format=case.name)
        except MissingDependencyError:
            folder.rmdir()


if __name__ == "__main__":
    make_missing()
