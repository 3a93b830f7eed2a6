from fractions import Fraction
from itertools import combinations
from pathlib import Path

import av
import cv2
import pytest

from texvent.errors import InputError, OutputError
from texvent.events import EventStream
from texvent.frames import Frame
from texvent.sensor import SensorSize
from texvent.view.drawing.palettes import DEFAULT_PALETTE, PALETTES
from texvent.view.preview import PREVIEW_KINDS, Preview

SIZE = SensorSize(32, 24)
Steps = list[tuple[Frame, EventStream]]


def write_preview(stem: Path, steps: Steps, **options: object) -> Preview:
    with Preview(stem, size=SIZE, fps=Fraction(30), **options) as preview:
        for frame, packet in steps:
            preview.append(frame, packet)
    return preview


@pytest.mark.parametrize(
    "kinds", [one for n in (1, 2, 4) for one in combinations(PREVIEW_KINDS, n)]
)
def test_every_kind_of_preview_is_whole_beside_any_others(tmp_path, steps, kinds):
    facts = {"prompt": "a bar moves right", "seed": 0}
    stem = tmp_path / "out.v1"
    with Preview(stem, size=SIZE, fps=Fraction(30), kinds=kinds, metadata=facts) as preview:
        for step in steps:
            preview.append(*step)
        preview.add_metadata({"found_late": 1234567})
    names = [f"out.v1.{kind}" for kind in kinds]
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(names)
    assert [path.name for path in preview.paths] == names
    for kind in {"mp4", "gif"} & {*kinds}:
        with av.open(f"{stem}.{kind}") as video:
            assert len(list(video.decode(video=0))) == 5
    if "png" in kinds:
        assert cv2.imread(f"{stem}.png") is not None
    if "html" in kinds:
        page = Path(f"{stem}.html").read_text("utf-8")
        events = f"{sum(len(packet) for _, packet in steps):,} events"
        facts_shown = ("a bar moves right", "Found late", "1234567", events)
        wanted = ("data:image/png;base64,", *facts_shown)
        assert [one for one in wanted if one not in page] == []


@pytest.mark.parametrize("kind", PREVIEW_KINDS)
def test_every_option_changes_every_kind_of_preview(tmp_path, steps, kind):
    """The title, the colours; the same options give the same file."""
    options = [
        {"metadata": {"prompt": "a bar"}}, {"metadata": {"prompt": "a ball"}}, {},
        *({"palette": one} for one in sorted(PALETTES) if one != DEFAULT_PALETTE), {},
    ]  # fmt: skip
    written = []
    for number, one in enumerate(options):
        (tmp_path / str(number)).mkdir()
        (path,) = write_preview(tmp_path / f"{number}/a", steps, kinds=(kind,), **one).paths
        written.append(path.read_bytes())
    assert written[2] == written[-1]
    assert len({*written}) == len(options) - 1


def test_of_one_frame_that_frame_is_shown(tmp_path, steps):
    preview = write_preview(tmp_path / "one", steps[:1])
    for path in preview.paths:
        assert path.stat().st_size > 0
    with av.open(str(tmp_path / "one.mp4")) as video:
        assert len(list(video.decode(video=0))) == 1


def test_no_frame_is_an_input_error_and_leaves_nothing(tmp_path, folder_is_clean):
    with pytest.raises(InputError, match="no frame was given"):
        write_preview(tmp_path / "out", [])
    assert folder_is_clean()


@pytest.mark.parametrize("error", [KeyboardInterrupt, RuntimeError])
def test_an_exception_midway_leaves_nothing(tmp_path, steps, folder_is_clean, error):
    def interrupt() -> None:
        with Preview(tmp_path / "out", size=SIZE, fps=None) as preview:
            preview.append(*steps[0])
            preview.append(*steps[1])
            raise error

    with pytest.raises(error):
        interrupt()
    assert folder_is_clean()


def test_every_output_is_checked_before_any_work(tmp_path, steps):
    (tmp_path / "out.png").write_bytes(b"old")
    with pytest.raises(OutputError, match=r"out\.png exists already"):
        Preview(tmp_path / "out", size=SIZE, fps=None)
    assert [path.name for path in tmp_path.iterdir()] == ["out.png"]
    write_preview(tmp_path / "out", steps, overwrite=True)
    assert (tmp_path / "out.png").read_bytes() != b"old"
