"""Events with images of them as an MCAP file, which Foxglove, PlotJuggler and ROS 2 open.

    /dvs/events     event_camera_msgs/EventPacket        the events, per 10 ms
    /dvs/image      sensor_msgs/CompressedImage, PNG     images of events, at their end
    /camera/image   sensor_msgs/CompressedImage, JPEG    frames of the video, where one is shown
    /texvent        std_msgs/String                      size and metadata

Foxglove draws no EventPacket, so images lie beside them. Messages are in order of time.
`texvent.open` reads the events of such a file.
"""

from __future__ import annotations

import heapq
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from pathlib import Path

import cv2

from texvent._require import require
from texvent.errors import InputError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.io.atomic import atomic_file
from texvent.io.limits import FormatLimits
from texvent.io.metadata import sidecar_text
from texvent.io.ros.bags import EXTRA, TOPIC, McapCodec
from texvent.io.ros.messages import FRAME
from texvent.io.ros.sensor_bag import open_sensor_bag
from texvent.video import Frame
from texvent.view.drawing.canvas import Image, png_bytes
from texvent.view.drawing.event_image import draw_events, draw_fading, frame_image
from texvent.view.drawing.palettes import Palette
from texvent.view.windows.event_window import EventWindow

EVENT_IMAGES, FRAMES = "/dvs/image", "/camera/image"
JPEG_QUALITY = 90
Timed = tuple[int, int, Callable[[], None]]
"""Time of a message, µs; its rank among those of the same time; what writes it."""
MessagesOf = Callable[[EventStream], Iterator[tuple[int, Callable[[], None]]]]
WriteImage = Callable[[int, bytes], None]


def write_foxglove(
    packets: EventPackets,
    path: Path,
    windows: Iterable[EventWindow],
    palette: Palette,
    *,
    frames: Iterable[Frame] | None = None,
    overwrite: bool = False,
) -> None:
    """Write a .mcap file; memory stays flat.

    Args:
        packets: the recording.
        path: .mcap file.
        windows: what the images of events show, in order of their ends; read beside the packets.
        palette: colours of the images.
        frames: the video.
        overwrite: whether an existing file may be replaced.

    Raises:
        InputError: there is no event to show, or EVT3 cannot hold the sensor or a time.
        MissingDependencyError: rosbags, the extra "bags", is not installed.
        OutputError: the file exists already or cannot be written.
    """
    require("rosbags", extra=EXTRA)
    McapCodec.limits.check_size(path, packets.size)
    packets = EventPackets(_checked(packets, path), packets.size, packets.metadata)
    with atomic_file(path, overwrite=overwrite) as part, open_sensor_bag(part, "mcap") as bag:
        streams = [
            _events(packets, bag.events_topic(TOPIC, packets.size)),
            _images(windows, palette, bag.compressed_topic(EVENT_IMAGES, FRAME, "png")),
        ]
        if frames is not None:
            streams.append(_frames(frames, bag.compressed_topic(FRAMES, "camera", "jpeg")))
        is_first = True
        for t_us, _, write in heapq.merge(*streams, key=lambda timed: timed[:2]):
            if is_first:
                bag.add_text(sidecar_text(packets.size, packets.metadata), t_us)
                is_first = False
            write()
        if is_first:
            raise InputError("the recording, or the part asked for, holds no events to show")


def _events(packets: EventPackets, messages_of: MessagesOf) -> Iterator[Timed]:
    for packet in packets:
        for t_us, write in messages_of(packet):
            yield t_us, 0, write


def _images(windows: Iterable[EventWindow], palette: Palette, write: WriteImage) -> Iterator[Timed]:
    for window in windows:
        data = png_bytes(_draw(window, palette))
        yield window.stop_us, 1, partial(write, window.stop_us, data)


def _frames(frames: Iterable[Frame], write: WriteImage) -> Iterator[Timed]:
    for frame in frames:
        yield frame.t_us, 2, partial(write, frame.t_us, _jpeg(frame_image(frame)))


def _draw(window: EventWindow, palette: Palette) -> Image:
    if window.fading is not None:
        return draw_fading(window.fading, palette)
    return draw_events(window.counts, palette)


def _jpeg(image: Image) -> bytes:
    options = [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY]
    return bytes(cv2.imencode(".jpg", image[:, :, ::-1], options)[1])


def _checked(packets: EventPackets, path: Path) -> Iterable[EventStream]:
    """The packets that are not empty, each checked, anew at each pass."""
    limits: FormatLimits = McapCodec.limits

    class Checked:
        def __iter__(self) -> Iterator[EventStream]:
            for packet in packets:
                if len(packet):
                    limits.check_packet(path, packet, int(packet.t[0]))
                    yield packet

    return Checked()
