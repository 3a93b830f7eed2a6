"""What readers make of their first damaged inputs: the same content, other content or a refusal.

    python -m tests.fuzz.outcomes    # writes them anew; CHANGELOG.md says why

`outcomes.txt` holds them, of other content with its digest. Readers whose formats are read by a
library are left out: another version of it may read what this one refuses.
"""

from collections.abc import Mapping
from pathlib import Path

from .worker import Outcome, Worker, readers

KEPT = 40
OUTCOMES = Path(__file__).with_name("outcomes.txt")
OF_LIBRARIES = ("video", "images", "stored video", "motion .exr", "pixel mask .png",
                "option prompt", "events hdf5", "events dsec", "events event-utils",
                "events prophesee-hdf5",
                "events v2e", "events timelens", "events esim", "events parquet", "frames dsec",
                "weights pickle", "events rosbag2")  # fmt: skip


def mark(outcome: Outcome) -> str:
    """The kind of an outcome, with a digest of other content."""
    return f"{outcome.kind} {outcome.detail}" if outcome.kind == "changed" else outcome.kind


def stored_outcomes() -> Mapping[str, list[str]]:
    """Reader → marks of its first inputs."""
    lines = OUTCOMES.read_text(encoding="utf-8").splitlines()
    return {name: marks.split(", ") for name, _, marks in (one.partition(": ") for one in lines)}


def write() -> None:
    """Write the outcomes anew."""
    worker, lines = Worker(), []
    for name in readers():
        if not name.startswith(OF_LIBRARIES):
            marks = [mark(worker.one(name, number)) for number in range(KEPT)]
            lines.append(f"{name}: {', '.join(marks)}\n")
    worker.end()
    OUTCOMES.write_text("".join(lines), encoding="utf-8")


if __name__ == "__main__":
    write()
