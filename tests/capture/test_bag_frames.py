"""Images of ROS bags: every encoding, both ROS, raw and compressed, one topic of several."""

from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from tests.io.ros.test_bags import types_of, write_bag

from texvent.capture.bag_frames import BAYER, COMPRESSED, ENCODINGS, IMAGE
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import ConfigError, FileFormatError, InputError, TexventError

PICTURES = np.random.default_rng(0).integers(0, 2**16, (3, 4, 6, 3), np.uint16)
"""[N, H, W, 3] RGB."""
TIMES_US = [1_700_000_000_000_000 + 40_000 * number for number in range(3)]
PADDING = 3


def header(types: Any, version: int, t_us: int) -> Any:
    time = types.types["builtin_interfaces/msg/Time"](t_us // 10**6, t_us % 10**6 * 1000)
    number = {} if version == 2 else {"seq": 0}
    return types.types["std_msgs/msg/Header"](stamp=time, frame_id="camera", **number)


def image(version: int, t_us: int, pixels: np.ndarray, encoding: str, *, big: bool = False) -> Any:
    """A sensor_msgs/Image of [H, W, channels], whose rows end with bytes that are no pixels."""
    types, (height, width) = types_of(version), pixels.shape[:2]
    values = pixels.astype(pixels.dtype.newbyteorder(">" if big else "<"))
    rows = values.reshape(height, -1).view(np.uint8)
    data = np.pad(rows, ((0, 0), (0, PADDING)), constant_values=7)
    head = header(types, version, t_us)
    make = types.types[IMAGE]
    return make(head, height, width, encoding, big, data.shape[1], data.reshape(-1))


def compressed(version: int, t_us: int, picture: np.ndarray, form: str) -> Any:
    types = types_of(version)
    data = cv2.imencode(".png", picture[..., ::-1])[1].reshape(-1)
    return types.types[COMPRESSED](header(types, version, t_us), form, data)


def bag(folder: Path, version: int, messages: dict[str, tuple[str, list[Any]]]) -> Path:
    return write_bag(folder / ("a.bag" if version == 1 else "folder"), version, messages)


def frames(path: Path, **options: Any) -> list[Any]:
    return list(open_frames(path, CaptureConfig(**options)))


@pytest.mark.parametrize("version", [1, 2])
@pytest.mark.parametrize("big", [False, True])
@pytest.mark.parametrize("encoding", ENCODINGS)
def test_images_of_every_encoding_are_read_at_their_stamps(tmp_path, version, big, encoding):
    kind, count, _ = ENCODINGS[encoding]
    pictures = PICTURES.astype(kind)
    wanted = pictures[..., 0] if count == 1 else pictures
    order = [2, 1, 0] if encoding.startswith("b") or encoding[-3:] in ("UC3", "UC4") else [0, 1, 2]
    stored = pictures[..., [*order, 0][:count]]
    sent = [
        image(version, t_us, picture, encoding, big=big)
        for t_us, picture in zip(TIMES_US, stored, strict=True)
    ]
    stream = open_frames(bag(tmp_path, version, {"/camera": (IMAGE, sent)}), CaptureConfig())
    assert (stream.size, stream.frame_count) == ((6, 4), 3)
    assert list(stream.times_us) == [frame.t_us for frame in stream] == TIMES_US
    for frame, picture in zip(stream, wanted, strict=True):
        np.testing.assert_array_equal(frame.pixels, picture)


@pytest.mark.parametrize("pattern", BAYER)
@pytest.mark.parametrize("colour", [(200, 0, 0), (0, 200, 0), (0, 0, 200)])
def test_a_mosaic_of_one_colour_is_that_colour(tmp_path, pattern, colour):
    tile = np.array([["rgb".index(one) for one in pattern]]).reshape(2, 2)
    mosaic = np.tile(np.array(colour, np.uint8)[tile], (2, 3))[..., None]
    sent = [image(2, t_us, mosaic, f"bayer_{pattern}8") for t_us in TIMES_US]
    for frame in frames(bag(tmp_path, 2, {"/camera": (IMAGE, sent)})):
        np.testing.assert_array_equal(frame.pixels, np.broadcast_to(colour, (4, 6, 3)))


@pytest.mark.parametrize("version", [1, 2])
def test_one_topic_of_several_is_chosen_raw_or_compressed(tmp_path, version):
    pictures = PICTURES.astype(np.uint8)
    rows = list(zip(TIMES_US, pictures, strict=True))
    raw = [image(version, t_us, one, "rgb8") for t_us, one in rows]
    packed = [compressed(version, t_us, one[:2], "rgb8; png") for t_us, one in rows]
    sent = {"/left/raw": (IMAGE, raw), "/right/compressed": (COMPRESSED, packed)}
    path = bag(tmp_path, version, sent)
    for topic, wanted in (("left/raw", pictures), ("/right/compressed", pictures[:, :2])):
        for frame, picture in zip(frames(path, topic=topic), wanted, strict=True):
            np.testing.assert_array_equal(frame.pixels, picture)
    with pytest.raises(InputError, match=r"images on 2 topics: /left/raw, /right/compressed; cho"):
        frames(path)
    with pytest.raises(InputError, match="no stream '/middle'"):
        frames(path, topic="/middle")
    steady = open_frames(path, CaptureConfig(topic="left/raw", fps=50))
    assert list(steady.times_us) == [one.t_us for one in steady] == [0, 20_000, 40_000]
    np.save(tmp_path / "clip.npy", pictures)
    with pytest.raises(ConfigError, match=r"topic chooses images of a ROS bag, and .* is none"):
        frames(tmp_path / "clip.npy", topic="left", fps=50)


def test_a_topic_without_messages_is_no_choice(tmp_path):
    sent = [image(2, t_us, PICTURE, "rgb8") for t_us in TIMES_US]
    path = bag(tmp_path, 2, {"/dead": (IMAGE, []), "/camera": (IMAGE, sent)})
    assert len(frames(path)) == len(TIMES_US)
    with pytest.raises(FileFormatError, match="/dead has no message"):
        frames(path, topic="dead")


PICTURE = PICTURES[0].astype(np.uint8)
DAMAGED = image(2, TIMES_US[1], PICTURE, "rgb8")
DAMAGED.height = 40


def shortened(by: int) -> Any:
    made = image(2, TIMES_US[1], PICTURE, "rgb8")
    made.data = made.data[:-by]
    return made


def packed(by: int) -> bytes:
    whole = bytes(types_of(2).serialize_cdr(image(2, TIMES_US[1], PICTURE, "rgb8"), IMAGE))
    return whole[:-by]


def test_the_last_row_may_end_with_its_pixels(tmp_path):
    sent = [image(2, TIMES_US[0], PICTURE, "rgb8"), shortened(PADDING)]
    path = bag(tmp_path, 2, {"/camera": (IMAGE, sent)})
    np.testing.assert_array_equal(frames(path)[1].pixels, PICTURE)


@pytest.mark.parametrize(
    ("second", "said"),
    [
        (image(2, TIMES_US[1], PICTURE, "yuv422"), "encoded as 'yuv422'; texvent reads mono8"),
        (image(2, TIMES_US[1], PICTURE[:2], "rgb8"), "is 6x2, the first 6x4"),
        (image(2, TIMES_US[0], PICTURE, "rgb8"), r"has the stamp .* give the frame rate, --fps"),
        (image(2, TIMES_US[0] - 9, PICTURE, "rgb8"), "order of the recording is not that of the s"),
        (DAMAGED, "an image of 6x40 rgb8 has"),
        (shortened(PADDING + 1), "an image of 6x4 rgb8 has 80 bytes in rows of 21"),
        (packed(1), "a message states 84 bytes of data; it is damaged"),
        (packed(86), "a message of an image is cut off"),
    ],
)
def test_images_that_cannot_be_used_are_refused(tmp_path, second, said):
    sent = [image(2, TIMES_US[0], PICTURE, "rgb8"), second]
    with pytest.raises(TexventError, match=said):
        frames(bag(tmp_path, 2, {"/camera": (IMAGE, sent)}))


@pytest.mark.parametrize(
    "form", ["16UC1; compressedDepth png", "16UC1; png compressed ", "32FC1; tiff compressed "]
)
def test_compressed_depth_is_refused(tmp_path, form):
    depth = [compressed(1, TIMES_US[0], PICTURE, form)]
    with pytest.raises(FileFormatError, match="an image is of depth"):
        frames(bag(tmp_path, 1, {"/depth": (COMPRESSED, depth)}))


def test_bags_without_images_are_refused(tmp_path):
    types = types_of(2)
    text = types.types["std_msgs/msg/String"]("{}")
    path = bag(tmp_path, 2, {"/texvent": ("std_msgs/msg/String", [text])})
    with pytest.raises(FileFormatError, match=r"holds no images .*, but std_msgs/msg/String"):
        frames(path)
