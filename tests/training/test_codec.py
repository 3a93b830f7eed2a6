"""Videos that torchcodec decodes are those of PyAV; what it cannot vouch for is left to PyAV."""

import subprocess
from pathlib import Path

import numpy as np
import pytest

from texvent.errors import FileFormatError

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")
MISSING = "torchcodec is not installed here: decoding by it is not tested"
pytest.importorskip("torchcodec", reason=MISSING)

from texvent.capture.open import open_frames  # noqa: E402
from texvent.config import CaptureConfig  # noqa: E402
from texvent.training import VideoClips  # noqa: E402
from texvent.training.codec import decode_video  # noqa: E402
from texvent.training.sources import read_clip  # noqa: E402

FILM = Path(__file__).parents[1] / "clips" / "bigbuckbunny_excerpt.mp4"
DEVICE = "cuda" if torch.cuda.is_available() else "cpu"
ROOM = 2**30


def decoded(path: Path, most_bytes: int = ROOM):
    return decode_video(path, open_frames(path, CaptureConfig()), DEVICE, most_bytes)


def by_pyav(path: Path, most_bytes: int = ROOM):
    return read_clip(open_frames(path, CaptureConfig()), (), most_bytes, None)


@pytest.mark.parametrize("most_bytes", [ROOM, 7 * 320 * 180])
def test_frames_and_times_are_those_of_pyav(most_bytes):
    found, expected = decoded(FILM, most_bytes), by_pyav(FILM, most_bytes)
    assert len(found.pixels) == (25 if most_bytes == ROOM else 7)
    difference = np.abs(found.pixels.astype(int) - expected.frames)
    assert difference.max() == 0 if DEVICE == "cpu" else difference.mean() <= 1
    assert list(found.times_us) == expected.times_us.tolist()


def test_clips_of_a_gpu_are_decoded_there_and_without_one_by_pyav():
    clip = VideoClips([FILM], device="cuda").read(0, (), ROOM)
    expected = decoded(FILM).pixels if DEVICE == "cuda" else by_pyav(FILM).frames
    assert np.array_equal(clip.frames, expected)


def test_a_video_that_is_cut_off_is_refused_by_pyav(tmp_path):
    film = tmp_path / "film.mkv"
    subprocess.run(["ffmpeg", "-loglevel", "error", "-i", FILM, "-c", "copy", film], check=True)
    assert decoded(film) is not None
    for name, whole in (("cut.mkv", film), ("cut.mp4", FILM)):
        cut = tmp_path / name
        cut.write_bytes(whole.read_bytes()[: whole.stat().st_size // 2])
        assert decoded(cut) is None
        with pytest.raises(FileFormatError, match=r"is cut off|is damaged"):
            VideoClips([cut], device="cuda").read(0, (), ROOM)


@pytest.mark.parametrize(
    "options", [["-c", "copy", "-metadata:s:v:0", "rotate=90"], ["-pix_fmt", "yuv420p10le"]]
)
def test_turned_and_deep_videos_are_those_of_pyav(options, tmp_path):
    film = tmp_path / "film.mp4"
    subprocess.run(["ffmpeg", "-loglevel", "error", "-i", FILM, *options, film], check=True)
    found, expected = decoded(film), by_pyav(film)
    assert expected.frames.shape[1:] == ((320, 180) if options[0] == "-c" else (180, 320))
    assert found is None or np.abs(found.pixels - expected.frames.astype(int)).mean() <= 1


BLACK_FIRST = "fade=in:0:4"
HDR = "log-level=none:transfer=smpte2084:colorprim=bt2020:colormatrix=bt2020nc"


def test_a_black_first_frame_vouches_for_nothing(tmp_path):
    videos = {
        "film.mp4": ["-vf", BLACK_FIRST],
        "mirrored.mp4": ["-vf", f"hflip,{BLACK_FIRST}"],
        "hdr.mp4": [
            *("-vf", f"{BLACK_FIRST},format=yuv420p10le"),
            *("-c:v", "libx265", "-x265-params", HDR),
        ],
        "black.mp4": ["-vf", "lutyuv=y=16:u=128:v=128"],
    }
    for name, options in videos.items():
        words = ["ffmpeg", "-loglevel", "error", "-i", FILM, *options, tmp_path / name]
        subprocess.run(words, check=True)
    assert decoded(tmp_path / "film.mp4") is not None
    for name in ("hdr.mp4", "black.mp4"):
        assert decoded(tmp_path / name) is None, name
    other = open_frames(tmp_path / "mirrored.mp4", CaptureConfig())
    assert decode_video(tmp_path / "film.mp4", other, DEVICE, ROOM) is None


def test_image_folders_are_no_videos(tmp_path):
    np.save(tmp_path / "film.npy", np.zeros((4, 8, 8), np.uint8))
    path = tmp_path / "film.npy"
    assert decode_video(path, open_frames(path, CaptureConfig(fps=25)), DEVICE, ROOM) is None
