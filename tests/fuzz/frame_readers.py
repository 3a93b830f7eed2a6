"""Videos, image folders, arrays and the frames of recordings."""

from fractions import Fraction
from functools import partial
from pathlib import Path

import av
import cv2
import numpy as np

from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.generation.videos.stored_video import open_stored, reopen, write_video
from texvent.io.ros.bag_writer import open_sensor_bag

from ..capture.dsec_sequence import write_sequence
from ..capture.test_aedat4_frames import grey, write_file
from ..capture.test_recorded_frames import write_folder
from .reader import Reader, digest

WIDTH, HEIGHT, COUNT = 48, 32, 8
VIDEOS = {
    ".mp4": ("mpeg4", "yuv420p"),
    ".avi": ("ffv1", "yuv420p"),
    ".mkv": ("mpeg4", "yuv420p"),
    ".webm": ("libvpx", "yuv420p"),
    ".mov": ("mjpeg", "yuvj420p"),
    ".gif": ("gif", "rgb8"),
}
IMAGES = (".png", ".tiff", ".jpg", ".bmp", ".pgm", ".webp")


def frame_readers() -> list[Reader]:
    """One per kind of source."""
    with_rate = CaptureConfig(fps=Fraction(25))
    videos = [
        Reader(f"video {ending}", partial(_make_video, ending), partial(_read, CaptureConfig()))
        for ending in VIDEOS
    ]
    images = [
        Reader(f"images {ending}", partial(_make_images, ending), partial(_read, CaptureConfig()))
        for ending in IMAGES
    ]
    return [
        *videos,
        *images,
        Reader("frames .npy", _make_npy, partial(_read, with_rate)),
        Reader("frames aedat4", _make_aedat4, partial(_read, CaptureConfig())),
        Reader("frames bag", _make_bag, partial(_read, CaptureConfig())),
        Reader("frames dsec", _make_dsec, partial(_read, CaptureConfig())),
        Reader("frames evreal", write_folder, partial(_read, CaptureConfig())),
        Reader("stored video", _make_stored, _read_stored),
    ]


def _images() -> np.ndarray:
    """[N, H, W, 3], a square that moves over a ramp."""
    frames = np.zeros((COUNT, HEIGHT, WIDTH, 3), np.uint8)
    frames[:] = np.linspace(20, 200, WIDTH, dtype=np.uint8)[None, None, :, None]
    for index in range(COUNT):
        frames[index, 8:20, 3 * index : 3 * index + 9] = (250, 30, 90)
    return frames


def _make_video(ending: str, folder: Path) -> Path:
    path = folder / f"clip{ending}"
    codec, pixels = VIDEOS[ending]
    with av.open(str(path), "w") as container:
        stream = container.add_stream(codec, rate=25)
        stream.width, stream.height, stream.pix_fmt = WIDTH, HEIGHT, pixels
        for image in _images():
            container.mux(stream.encode(av.VideoFrame.from_ndarray(image, format="rgb24")))
        container.mux(stream.encode())
    return path


def _make_images(ending: str, folder: Path) -> Path:
    for index, image in enumerate(_images()[:3]):
        pixels = image[..., 0] if ending == ".pgm" else image
        if ending == ".tiff":  # what PNG and TIFF may hold beside 8 bits
            pixels = pixels.astype(np.uint16) * 257
        cv2.imwrite(str(folder / f"{index:03d}{ending}"), pixels)
    (folder / "timestamps.txt").write_text("0.0\n0.04\n0.08\n")
    return folder


def _make_npy(folder: Path) -> Path:
    path = folder / "frames.npy"
    np.save(path, _images())
    return path


def _make_aedat4(folder: Path) -> Path:
    frames = [grey(40 * one, start=1000 * one + 1, end=1000 * one + 500) for one in range(4)]
    return write_file(folder / "e.aedat4", frames)


def _make_bag(folder: Path) -> Path:
    with open_sensor_bag(folder / "images.bag", "rosbag1") as bag:
        bag.add_images("/camera", "camera", [(40_000 * n, one) for n, one in enumerate(_images())])
    return folder / "images.bag"


def _make_dsec(folder: Path) -> Path:
    return write_sequence(folder / "sequence")


def _make_stored(folder: Path) -> Path:
    path = folder / "made.avi"
    write_video(_images() / np.float32(255), path, Fraction(25), {"prompt": "x"}, overwrite=True)
    return path


def _read(config: CaptureConfig, path: Path) -> str:
    frames = open_frames(path, config)
    return digest(part for frame in frames for part in (np.asarray(frame.pixels), frame.t_us))


def _read_stored(path: Path) -> str:
    video = reopen(path) or open_stored(path, Fraction(25), {})
    return digest(np.asarray(frame.pixels) for frame in video)
