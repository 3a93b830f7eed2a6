"""Images into videos and folders: complete or not at all, and read back as they were."""

import json
from fractions import Fraction

import numpy as np
import pytest

from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import InputError, OutputError
from texvent.sensor import SensorSize
from texvent.view.video_writer import check_image_output, open_image_sink

SIZE = SensorSize(15, 11)


def images():
    return [(1_000_003 + 40_000 * n, np.full(SIZE.shape, n / 10, np.float32)) for n in range(4)]


def write(path, *, overwrite=False, some=None, size=SIZE):
    opened = open_image_sink(
        path, size=size, fps=Fraction(25), facts={"network": "firenet"}, overwrite=overwrite
    )
    with opened as sink:
        for t_us, image in images() if some is None else some:
            sink.add(t_us, image)


def test_a_folder_is_read_again_with_its_times(tmp_path):
    write(tmp_path / "frames")
    frames = list(open_frames(str(tmp_path / "frames"), CaptureConfig()))
    assert [frame.t_us for frame in frames] == [t_us for t_us, _ in images()]
    for frame, (_, image) in zip(frames, images(), strict=True):
        assert frame.pixels.dtype == np.uint8
        assert frame.pixels.shape == SIZE.shape
        np.testing.assert_array_equal(frame.pixels, np.rint(image * 255))
    facts = json.loads((tmp_path / "frames" / "texvent.json").read_text())
    assert facts == {"network": "firenet"}


@pytest.mark.parametrize("size", [SIZE, SensorSize(16, 11), SensorSize(15, 12)])
@pytest.mark.parametrize(("name", "error"), [("video.mp4", 4), ("video.gif", 0.5)])
def test_a_video_has_even_sides_and_the_times_of_the_images(tmp_path, size, name, error):
    ramp = np.add.outer(*(np.arange(side) for side in size.shape)).astype(np.float32)
    some = [(t_us, ramp * n / 100) for n, (t_us, _) in enumerate(images())]
    write(tmp_path / name, some=some, size=size)
    frames = list(open_frames(str(tmp_path / name), CaptureConfig()))
    assert frames[0].size == SensorSize(16, 12)
    assert [frame.t_us for frame in frames] == [0, 40_000, 80_000, 120_000]
    shown = frames[3].luma[: size.height, : size.width]
    assert np.abs(shown - 255 * some[3][1]).mean() < error


def test_only_a_folder_of_such_images_is_replaced(tmp_path):
    folder = tmp_path / "frames"
    write(folder)
    with pytest.raises(OutputError, match="exists already"):
        check_image_output(folder, overwrite=False)
    write(folder, overwrite=True, some=images()[:2])
    assert len(list(folder.glob("*.png"))) == 2
    (folder / "notes.txt").write_text("mine")
    with pytest.raises(OutputError, match=r"notes\.txt"):
        check_image_output(folder, overwrite=True)


@pytest.mark.parametrize("name", ["frames", "video.mp4"])
def test_without_an_image_nothing_is_left(name, tmp_path):
    with pytest.raises(InputError, match="image"):
        write(tmp_path / name, some=[])
    assert list(tmp_path.iterdir()) == []
