"""Coded sources become linear light, 255 at white; what cannot be is one line."""

from fractions import Fraction

import av
import cv2
import numpy as np
import pytest

from texvent.capture.linear_light import to_light
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import InputError
from texvent.frames import Video, transfer_of
from texvent.transfer import Transfer

FPS = Fraction(30)


def frames_of(source, **options):
    return list(open_frames(source, CaptureConfig(fps=FPS, **options)))


def write_exr(folder, lights, names="RGB"):
    library = pytest.importorskip("OpenEXR")
    folder.mkdir()
    for index, light in enumerate(lights):
        header = {"compression": library.ZIP_COMPRESSION, "type": library.scanlineimage}
        channels = {name: np.ascontiguousarray(light) for name in names}
        library.File(header, channels).write(str(folder / f"{index:03}.exr"))
    return folder


def spot(place, brightest=20.0):
    """Texture in shade and a light source above white, [24, 32]."""
    y, x = np.mgrid[:24, :32]
    shade = 0.03 + 0.5 * ((x // 4 + y // 4) % 2)
    glare = brightest * np.exp(-((x - place) ** 2 + (y - 12) ** 2) / 8.0)
    return (shade + glare).astype(np.float32)


@pytest.mark.parametrize("kind", [np.float16, np.float32])
@pytest.mark.parametrize("names", ["RGB", "Y"])
def test_exr_is_linear_and_1_is_white(tmp_path, kind, names):
    lights = [spot(8).astype(kind), spot(12).astype(kind)]
    stream = open_frames(write_exr(tmp_path / "f", lights, names), CaptureConfig(fps=FPS))
    assert transfer_of(stream) is Transfer.LINEAR
    assert stream.metadata["coding"] == "linear"
    for frame, light in zip(stream, lights, strict=True):
        assert frame.transfer is Transfer.LINEAR
        assert frame.luma == pytest.approx(255 * light.astype(np.float32), rel=1e-6)
    assert frame.luma.max() > 4000


def test_the_white_level_of_exr_counts_in_its_own_unit(tmp_path):
    folder = write_exr(tmp_path / "f", [spot(8), spot(9)])
    assert frames_of(folder, white_level=0.5)[0].luma == pytest.approx(510 * spot(8), rel=1e-6)


def test_radiance_images_are_linear(tmp_path):
    for index in range(2):
        rgb = np.repeat(spot(8 + index)[..., None], 3, axis=2)
        cv2.imwrite(str(tmp_path / f"{index}.hdr"), rgb)
    frame = frames_of(tmp_path)[0]
    assert frame.transfer is Transfer.LINEAR
    # Radiance keeps 8 bits of the brightest colour of a pixel.
    assert frame.luma == pytest.approx(255 * spot(8), rel=1 / 128)


def test_light_below_0_counts_as_none(tmp_path):
    assert frames_of(write_exr(tmp_path / "f", [spot(8) - 0.1, spot(9)]))[0].luma.min() == 0


def test_integers_can_be_linear_or_srgb():
    levels = np.array([[[0, 51, 255]], [[1, 128, 254]]], np.uint8)
    linear = frames_of(levels, transfer="linear")
    assert linear[0].pixels.tolist() == [[0, 51, 255]]
    deep = frames_of(levels.astype(np.uint16) * 257, transfer="linear")
    assert deep[0].pixels == pytest.approx(np.array([[0, 51, 255]]), rel=1e-6)
    # 51 / 255 = 0.2 is the light ((0.2 + 0.055) / 1.055)^2.4 = 0.033105.
    assert frames_of(levels, transfer="srgb")[0].pixels == pytest.approx(
        np.array([[0, 8.4417, 255]]), abs=1e-3
    )
    assert linear[0].transfer is Transfer.LINEAR


def test_pq_and_hlg_are_white_by_bt_2408():
    # 203 cd/m² and 10 000 cd/m² of PQ; 0.75 and 1 of HLG.
    pq = to_light(np.array([0.580689 * 255, 255.0], np.float32), "pq")
    assert pq == pytest.approx([255, 255 * 10_000 / 203], rel=1e-4)
    hlg = to_light(np.array([0.75 * 255, 255.0], np.float32), "hlg")
    assert hlg == pytest.approx([255, 255 / 0.26496], rel=1e-4)
    assert to_light(np.array([255.0]), "pq", white_level=100.0) == pytest.approx([25_500])


def write_video(path, trc, signal):
    """Ten bits, BT.2020, limited range, lossless."""
    with av.open(str(path), "w") as container:
        stream = container.add_stream("ffv1", rate=30)
        stream.width, stream.height, stream.pix_fmt = 32, 24, "yuv420p10le"
        context = stream.codec_context
        context.color_trc, context.colorspace, context.color_primaries = trc, 9, 9
        context.color_range = 1
        for index in range(3):
            frame = av.VideoFrame(32, 24, "yuv420p10le")
            for plane, value in zip(
                frame.planes, (64 + round(876 * signal), 512, 512), strict=True
            ):
                plane.update(np.full(plane.buffer_size // 2, value, np.uint16).tobytes())
            frame.pts = index
            container.mux(stream.encode(frame))
        container.mux(stream.encode())
    return path


@pytest.mark.parametrize(
    ("coding", "trc", "signal", "level"),
    [
        ("pq", 16, 508 / 876, 254.0),  # 0.5799: 201.7 cd/m²
        ("pq", 16, 658 / 876, 255 * 989.4 / 203),
        ("hlg", 18, 657 / 876, 255.0),
        ("linear", 8, 438 / 876, 127.5),
    ],
)
def test_video_says_itself_how_it_is_coded(tmp_path, coding, trc, signal, level):
    stream = open_frames(write_video(tmp_path / "v.mkv", trc, signal), CaptureConfig())
    frame = next(iter(stream))
    assert (stream.metadata["coding"], frame.transfer) == (coding, Transfer.LINEAR)
    # libav's 16-bit RGB of deep YUV has its white at 65283, 0.4 % below full scale.
    assert frame.luma.mean() == pytest.approx(level, rel=0.04)
    assert frame.luma.std() < 0.01 * level


def test_a_stream_says_itself_what_it_is():
    video = Video(np.ones((2, 3, 4), np.float32), (0, 1000), metadata={"transfer": "linear"})
    assert video[0].transfer is Transfer.LINEAR
    with pytest.raises(InputError, match="leave out transfer"):
        open_frames(video, CaptureConfig(transfer="srgb"))


@pytest.mark.parametrize(
    ("transfer", "advice"),
    [
        ("linear", "Give white_level=1"),
        ("srgb", "multiply it by 255"),
        ("pq", "multiply it by 255"),
    ],
)
def test_floats_up_to_1_are_refused_where_their_scale_is_not_known(transfer, advice):
    def images():
        yield np.zeros((4, 6), np.float32)  # black tells nothing
        yield np.full((4, 6), 0.5, np.float32)

    stream = open_frames(images(), CaptureConfig(transfer=transfer, fps=Fraction(25)))
    with pytest.raises(InputError, match=r"never exceed 0\.5") as refused:
        list(stream)
    assert advice in str(refused.value)
