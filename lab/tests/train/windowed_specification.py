"""A specification of four short clips at 32×24 px, simulated in well under a second each."""

from pathlib import Path

from texvent_lab.train.reconstruction.sequences import SequenceData

TEXT = """\
name = "tiny"
splits = {train = 0.5, validation = 0.5}
filters = {min_events = 1}
options = {duration = 0.125, sensor = "32x24", samples = 1, shadows = false}
[[sources]]
template = "a {colour} ball flies {way}"
words.colour = ["red", "white"]
words.way = ["left", "right"]
[variants.paper]
contrast_threshold = 0.2
[variants.esim]
simulator = "esim"
"""

SLICE_US = 20_000


def write_specification(folder: Path, text: str = TEXT) -> Path:
    path = folder / "tiny.toml"
    path.write_text(text)
    return path


def write_sequence_data(folder: Path, length: int) -> SequenceData:
    """Examples of so many windows of its variant "paper"."""
    return SequenceData(
        specification=write_specification(folder),
        variant="paper",
        slice_us=SLICE_US,
        length=length,
        cache=folder / "cache",
    )
