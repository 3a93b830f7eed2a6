"""Coverage-guided fuzzing of the codecs that are written in Python, by hand, with atheris.

    pip install atheris
    python -m tests.io.fuzz_formats aedat4 -max_total_time=60 -rss_limit_mb=2048

The first word is a format; the rest are libFuzzer's options. The committed file of the format is
the seed. An input that gives anything but events or one line of error stops the run and is kept
as `crash-…`; add it to `tests/io/findings/FORMAT/`, where `test_findings.py` keeps it fixed.
"""

from __future__ import annotations

import contextlib
import importlib
import shutil
import sys
import tempfile
from pathlib import Path

from texvent.errors import InputError
from texvent.io.files import codec_for

from .format_cases import CASE_OF
from .test_corpus import CORPUS


def main() -> None:
    """Fuzz one format until a time is up or something is found."""
    atheris = importlib.import_module("atheris")
    if len(sys.argv) < 2 or sys.argv[1] not in CASE_OF:
        sys.exit(f"usage: python -m tests.io.fuzz_formats FORMAT; one of {', '.join(CASE_OF)}")
    case = CASE_OF[sys.argv.pop(1)]
    folder = Path(tempfile.mkdtemp())
    shutil.copytree(CORPUS / case.name, folder, dirs_exist_ok=True)
    path = folder / case.file
    seeds = folder / "seeds"
    seeds.mkdir()
    shutil.copy(path, seeds)
    # Codecs are imported when they are asked for: here, so that atheris sees their branches.
    with atheris.instrument_imports(include=["texvent.io"]):
        codec = codec_for(path, case.name)

    def read(data: bytes) -> None:
        path.write_bytes(data)
        with contextlib.suppress(InputError):
            codec.read(path).collect()

    atheris.Setup([*sys.argv, str(seeds)], read)
    atheris.Fuzz()


if __name__ == "__main__":
    main()
