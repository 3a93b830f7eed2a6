"""Every way in which a program hands frames to texvent."""

from collections.abc import Callable, Iterable
from fractions import Fraction

import numpy as np

import texvent
from texvent.events import EventStream
from texvent.frames import Frame, Video
from texvent.sensor import SensorSize

STEP_US = 10_000


def through_camera(images: Iterable, **options) -> EventStream:
    with texvent.EventCamera((24, 16), **options) as camera:
        packets = [camera.step(image, STEP_US * i) for i, image in enumerate(images)]
        return EventStream.concat([*packets, camera.finish()])


def through_generator(images: Iterable, **options) -> EventStream:
    return texvent.simulate((image for image in images), fps=100, progress=False, **options)


def through_list(images: Iterable, **options) -> EventStream:
    return texvent.simulate(list(images), fps=100, progress=False, **options)


def through_array(images: Iterable, **options) -> EventStream:
    whole = images if isinstance(images, np.ndarray) else np.stack(list(images))
    return texvent.simulate(whole, fps=100, progress=False, **options)


class Stream:
    """A FrameStream of another program."""

    size, fps, frame_count, metadata = SensorSize(24, 16), Fraction(100), None, {"kind": "own"}

    def __init__(self, images: Iterable, *, is_live: bool) -> None:
        self._images, self.is_live = images, is_live

    def __iter__(self):
        return (Frame(image, STEP_US * i) for i, image in enumerate(self._images))


def through_stream(images: Iterable, **options) -> EventStream:
    return texvent.simulate(Stream(images, is_live=False), progress=False, **options)


def through_live_stream(images: Iterable, **options) -> EventStream:
    return texvent.simulate(Stream(images, is_live=True), progress=False, **options)


def through_video(images: Iterable, **options) -> EventStream:
    whole = images if isinstance(images, np.ndarray) else np.stack(list(images))
    video = Video(whole, [STEP_US * i for i in range(len(whole))])
    return texvent.simulate(video, progress=False, **options)


Door = Callable[..., EventStream]
ONE_BY_ONE: tuple[Door, ...] = (
    through_camera, through_generator, through_stream, through_live_stream
)  # fmt: skip
"""Doors of which the program makes each frame when it is asked for."""
OF_IMAGES: tuple[Door, ...] = (through_camera, through_generator, through_list)
DOORS: tuple[Door, ...] = (*ONE_BY_ONE, through_list, through_array, through_video)
