import contextlib
import struct
from fractions import Fraction

import cv2
import numpy as np
import pytest
from PIL import Image

from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import FileFormatError, InputError, TexventWarning
from texvent.frames import Frame
from texvent.run.check import check_source
from texvent.sensor import SensorSize


def save_images(folder, count=3, dtype=np.uint8, channels=(), name="frame{}.png", step=1):
    folder.mkdir(parents=True, exist_ok=True)
    for index in range(count):
        pixels = np.full((4, 6, *channels), 100 + step * index, dtype)
        assert cv2.imwrite(str(folder / name.format(index)), pixels)
    return folder


@pytest.mark.parametrize("listed", ["", "0.5\n0.6\n0.7\n", "0.5 frame1.png\n", "damaged"])
def test_a_frame_rate_gives_the_times_whatever_a_list_beside_the_images_says(tmp_path, listed):
    save_images(tmp_path)
    if listed:
        (tmp_path / "timestamps.txt").write_text(listed)
    stream = open_frames(tmp_path, CaptureConfig(fps=Fraction(30_000, 1001)))
    assert [frame.t_us for frame in stream] == [0, 33_367, 66_733]
    assert (stream.frame_count, stream.metadata["timestamps"]) == (3, None)


def test_ecd_layout_is_found_without_options_and_keeps_its_clock(tmp_path):
    save_images(tmp_path / "images")
    (tmp_path / "images" / "frame1.png").unlink()
    (tmp_path / "images.txt").write_text(
        "# time name\n0.5 images/frame0.png\n0.538766001 images/frame2.png\n"
    )
    frames = list(open_frames(tmp_path, CaptureConfig()))
    assert [frame.t_us for frame in frames] == [500_000, 538_766]
    assert [int(frame.pixels[0, 0]) for frame in frames] == [100, 102]


def test_sixteen_bits_stay(tmp_path):
    save_images(tmp_path, dtype=np.uint16, step=30_000)
    frames = list(open_frames(tmp_path, CaptureConfig(fps=Fraction(10))))
    assert frames[1].pixels.dtype == np.uint16
    assert int(frames[1].pixels[0, 0]) == 30_100


def test_a_wrong_number_of_times_is_refused(tmp_path):
    save_images(tmp_path)
    (tmp_path / "timestamps.txt").write_text("0\n0.1\n")
    with pytest.raises(InputError, match=r"timestamps\.txt has 2 times for 3 frames"):
        open_frames(tmp_path, CaptureConfig())


def test_a_damaged_image_is_named(tmp_path):
    save_images(tmp_path)
    (tmp_path / "frame1.png").write_bytes(b"not an image")
    with pytest.raises(FileFormatError, match=r"frame1\.png cannot be decoded"):
        list(open_frames(tmp_path, CaptureConfig(fps=Fraction(10))))


def levels(source, **config):
    """First pixel of every frame."""
    frames = open_frames(source, CaptureConfig(**{"fps": Fraction(10), **config}))
    return [frame.pixels.reshape(-1)[0].item() for frame in frames]


def test_a_link_to_a_missing_file_is_an_error_and_a_missing_number_is_found(tmp_path):
    save_images(tmp_path, 9)
    (tmp_path / "frame3.png").unlink()
    with pytest.warns(TexventWarning, match=r"missing between frame2\.png and frame4\.png"):
        assert len(levels(tmp_path)) == 8
    with pytest.warns(TexventWarning, match="missing"):
        found = check_source(tmp_path, fps=10, progress=False)
    assert "missing frames" in found.report.remarks
    (tmp_path / "frame3.png").symlink_to("nowhere.png")
    with pytest.raises(InputError, match=r"1 of 9 images .* not there \(frame3\.png\)"):
        levels(tmp_path)


def test_every_image_of_a_tiff_stack_is_a_frame(tmp_path):
    pages = [np.full((4, 6), 10 * i, np.uint8) for i in range(12)]
    for part in range(2):
        cv2.imwritemulti(str(tmp_path / f"run_{part}.tif"), pages[6 * part : 6 * part + 6])
    assert levels(tmp_path) == [10 * i for i in range(12)]
    assert levels(tmp_path / "run_1.tif") == [10 * i for i in range(6, 12)]
    cv2.imwritemulti(str(tmp_path / "run_1.tif"), [pages[0], pages[1][:2]])
    with pytest.raises(FileFormatError, match="several sizes"):
        levels(tmp_path)
    with pytest.raises(InputError, match="several images; leave camera out"):
        open_frames(tmp_path / "run_0.tif", CaptureConfig(camera="pan"))


@pytest.mark.parametrize(
    ("text", "is_video"),
    [
        ("ImageJ=1.53\nimages=6\nchannels=1\nslices=6\nframes=1\n", True),
        ("ImageJ=1.53\nimages=6\nchannels=2\nframes=3\n", False),
        ("ImageJ=1.53\nimages=6\nslices=2\nframes=3\n", False),
        ('<OME><Pixels SizeC="1" SizeT="6" SizeZ="1"/></OME>', True),
        ('<OME><Pixels SizeC="2" SizeT="3" SizeZ="1"/></OME>', False),
    ],
)
def test_a_stack_of_channels_or_of_depths_and_times_is_no_video(tmp_path, text, is_video):
    first, *others = [Image.fromarray(np.full((4, 6), 10 * i, np.uint8)) for i in range(6)]
    path = tmp_path / "stack.tif"
    first.save(path, save_all=True, append_images=others, tiffinfo={270: text})
    if is_video:
        assert levels(path) == [0, 10, 20, 30, 40, 50]
    else:
        with pytest.raises(FileFormatError, match="are not one video"):
            levels(path)


def test_a_stack_of_more_images_than_pages_is_refused(tmp_path):
    for name in "ab":
        text = {270: "ImageJ=1.53t\nimages=6\nframes=6\n"}
        Image.new("L", (6, 4)).save(tmp_path / f"{name}.tif", tiffinfo=text)
    for source in (tmp_path, tmp_path / "a.tif"):
        with pytest.raises(FileFormatError, match="states 6 images and has 1 page"):
            levels(source)


DURATIONS_MS = [40, 80, 120, 40]


@pytest.mark.parametrize("name", ["a.png", "a.apng", "a.gif"])
def test_animated_images_have_their_own_times(tmp_path, name):
    images = [Image.new("RGB", (20, 10), (60 * i, 200 - 60 * i, 80)) for i in range(4)]
    path = tmp_path / "clip" / name
    path.parent.mkdir()
    options = {"format": "PNG"} if name == "a.apng" else {}
    images[0].save(path, save_all=True, append_images=images[1:], duration=DURATIONS_MS, **options)
    frames = list(open_frames(path, CaptureConfig()))
    assert [frame.t_us for frame in frames] == [0, 40_000, 120_000, 240_000]
    assert [frame.pixels[0, 0].tolist() for frame in frames] == [
        [60 * i, 200 - 60 * i, 80] for i in range(4)
    ]
    if name == "a.png":
        with pytest.raises(FileFormatError, match="an animation"):
            levels(path.parent)


def test_an_animated_webp_is_refused_by_name(tmp_path):
    path = tmp_path / "a.webp"
    GREY.save(path, save_all=True, append_images=[GREY.rotate(180)], duration=40)
    with pytest.raises(InputError, match="make an animated PNG of it"):
        open_frames(path, CaptureConfig())
    with pytest.raises(FileFormatError, match="an animation"):
        levels(tmp_path)


RAMP = np.tile(np.linspace(0, 255, 16).astype(np.uint8), (4, 1))
GREY = Image.fromarray(RAMP)
COLOUR = Image.merge("RGB", (GREY, Image.new("L", (16, 4), 90), Image.fromarray(255 - RAMP)))


@pytest.mark.parametrize(
    ("image", "name", "expected"),
    [
        (COLOUR.quantize(16), "a.png", COLOUR.quantize(16).convert("RGB")),
        (COLOUR.quantize(16), "a.tif", COLOUR.quantize(16).convert("RGB")),
        (COLOUR.quantize(16), "a.bmp", COLOUR.quantize(16).convert("RGB")),
        (GREY.convert("1"), "a.png", GREY.convert("1").convert("L")),
        (GREY.convert("1"), "a.tif", GREY.convert("1").convert("L")),
        (COLOUR.convert("CMYK"), "a.tif", COLOUR),
        (Image.merge("LA", (GREY, GREY)), "a.png", GREY),
        (Image.merge("RGBA", (*COLOUR.split(), GREY)), "a.png", COLOUR),
        (Image.fromarray(RAMP.astype(np.uint16) * 257), "a.png", GREY),
        (Image.fromarray(RAMP.astype(np.uint16) * 257), "a.tif", GREY),
        (Image.fromarray(RAMP.astype(np.float32)), "a.tif", GREY),
    ],
)
def test_images_of_every_mode_are_read_by_its_meaning(tmp_path, image, name, expected):
    image.save(tmp_path / name)
    image.save((tmp_path / name).with_stem("b"))
    frame = next(iter(open_frames(tmp_path, CaptureConfig(fps=Fraction(10)))))
    right = np.asarray(Frame(np.asarray(expected), 0).luma, np.float32)
    assert np.allclose(frame.luma, right, atol=0.01)


def tiff(pixels, photometric):
    """A TIFF of one strip."""
    data = pixels.tobytes()
    height, width = pixels.shape
    entries = [
        *((256, width), (257, height), (258, 8 * pixels.itemsize), (259, 1), (262, photometric)),
        *((273, 8), (277, 1), (278, height), (279, len(data))),
        (339, 3 if pixels.dtype.kind == "f" else 1),
    ]
    table = b"".join(struct.pack("<HHII", tag, 4, 1, value) for tag, value in entries)
    table = table.replace(struct.pack("<HHI", 262, 4, 1), struct.pack("<HHI", 262, 3, 1))
    head = struct.pack("<2sHI", b"II", 42, 8 + len(data))
    return head + data + struct.pack("<H", len(entries)) + table + bytes(4)


@pytest.mark.parametrize("dtype", [np.uint8, np.uint16])
def test_a_tiff_whose_zero_is_white_is_turned_round(tmp_path, dtype):
    full = np.iinfo(dtype).max
    for number in range(2):
        (tmp_path / f"{number}.tif").write_bytes(tiff(np.full((4, 6), full // 5 * 3, dtype), 0))
    assert levels(tmp_path) == [full // 5 * 2] * 2


def test_a_tiff_of_floats_whose_zero_is_white_is_refused(tmp_path):
    (tmp_path / "0.tif").write_bytes(tiff(np.full((4, 6), 1, np.float32), 0))
    with pytest.raises(FileFormatError, match="floats whose zero is white"):
        levels(tmp_path)


@pytest.mark.parametrize("kind", ["P2", "P5"])
@pytest.mark.parametrize("white", [100, 255, 1023, 4095, 65_535])
def test_white_of_a_pgm_is_what_its_header_says(tmp_path, kind, white):
    values = np.full(24, white, ">u2" if white > 255 else np.uint8)
    stored = values.tobytes() if kind == "P5" else (" ".join(map(str, values)) + "\n").encode()
    for number in range(2):
        head = f"{kind}\n# made by hand\n6 4\n{white}\n".encode()
        (tmp_path / f"{number}.pgm").write_bytes(head + stored)
    assert levels(tmp_path) == [65_535 if white > 255 else 255] * 2
    if white > 255:
        assert levels(tmp_path, white_level=white) == [255, 255]


def test_what_follows_white_in_a_damaged_pgm_is_no_part_of_it(tmp_path):
    for number in range(2):
        (tmp_path / f"{number}.pgm").write_bytes(b"P5\n6 4\n255\xff\xff" + bytes([100]) * 24)
    assert levels(tmp_path)


def test_transparent_pixels_that_a_tiff_reader_darkens_are_refused(tmp_path):
    for number in range(2):
        Image.new("RGBA", (6, 4), (200, 20, 10, 128)).save(tmp_path / f"{number}.tif")
    with pytest.raises(FileFormatError, match="without alpha"):
        levels(tmp_path)


def test_images_of_another_size_or_bit_depth_do_not_pass_silently(tmp_path):
    save_images(tmp_path, 2)
    cv2.imwrite(str(tmp_path / "frame2.png"), np.full((4, 6), 25_700, np.uint16))
    with pytest.warns(TexventWarning, match="type uint16, those before it uint8"):
        levels(tmp_path)
    cv2.imwrite(str(tmp_path / "frame2.png"), np.zeros((8, 12), np.uint8))
    for size in (None, SensorSize(3, 2)):
        stream = open_frames(tmp_path, CaptureConfig(fps=Fraction(10)), size=size)
        with pytest.raises(InputError, match="is 12x8, those before it are 6x4"):
            list(stream)


@pytest.mark.parametrize("is_asked", [False, True])
def test_images_that_a_found_list_leaves_out_are_said(tmp_path, is_asked):
    save_images(tmp_path)
    path = tmp_path / "timestamps.txt"
    path.write_text("0 frame0.png\n0.1 frame2.png\n")
    given = {"timestamps": path} if is_asked else {}
    said = pytest.warns(TexventWarning, match=r"names 2 of 3 images; frame1\.png are left out")
    with contextlib.nullcontext() if is_asked else said:
        assert levels(tmp_path, fps=None, **given) == [100, 102]


def test_a_list_of_the_images_of_another_folder_is_refused(tmp_path):
    for place in ("left", "right"):
        save_images(tmp_path / place)
    (tmp_path / "timestamps.txt").write_text("0 left/frame0.png\n0.1 left/frame1.png\n")
    with pytest.raises(InputError, match=r"left/frame0\.png, which is not in .*right"):
        levels(tmp_path / "right", fps=None)


@pytest.mark.parametrize("name", ["../private/frame0.png", "{}/private/frame0.png"])
def test_a_list_names_no_image_of_another_folder(tmp_path, name):
    save_images(tmp_path / "private")
    save_images(tmp_path / "shown", 2)
    lines = f"0.0 frame1.png\n0.1 {name.format(tmp_path)}\n"
    (tmp_path / "shown" / "images.txt").write_text(lines)
    # An image of that name in the folder is meant, as after a move.
    assert levels(tmp_path / "shown", fps=None) == [101, 100]
    (tmp_path / "shown" / "frame0.png").unlink()
    with pytest.raises(InputError, match="neither beside it nor in"):
        levels(tmp_path / "shown", fps=None)
