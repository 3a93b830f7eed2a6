"""A recording with frames that is known exactly, and a stand-in for a network."""

import cv2
import numpy as np

from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.frames import Video
from texvent.sensor import SensorSize
from texvent_lab.frame_recordings import FrameRecording

SIZE = SensorSize(16, 12)
STEP_US = 40_000
FRAMES = 15


class StandInReconstructor:
    """Adds a fiftieth for every ON event and takes one off for every OFF event, from mid-grey."""

    name = "stand-in"
    sha256 = "0" * 64

    def __init__(self):
        self.reset()

    def reset(self):
        self.image = np.full(SIZE.shape, 0.5, np.float32)

    def twin(self):
        return StandInReconstructor()

    def reconstruct(self, events):
        np.add.at(self.image, (events.y, events.x), events.polarity / np.float32(50))
        return np.clip(self.image, 0, 1)

    def reconstruct_all(self, slices):
        self.reset()
        for t_us, events in slices:
            yield t_us, self.reconstruct(events)


def level(number):
    """The frame of that number: a bright bar that moves a pixel per frame, on grey."""
    image = np.full(SIZE.shape, 127.5, np.float32)
    image[:, number : number + 2] = 178.5
    return image


def moving_bar(name="bar", frames=FRAMES):
    """Frames of the bar, and the events from which the stand-in makes exactly these frames."""
    video = Video(
        np.stack([level(number) for number in range(frames)]),
        [number * STEP_US for number in range(frames)],
    )
    rows = []
    known = np.full(SIZE.shape, 127.5)
    for number in range(1, frames):
        steps = np.rint((level(number) - known) / 5.1).astype(int)
        known = level(number)
        for y, x in np.argwhere(steps):
            count = abs(int(steps[y, x]))
            rows += [(number * STEP_US - 1 - k, y, x, int(steps[y, x] > 0)) for k in range(count)]
    rows.sort()
    t, y, x, p = (np.array(column) for column in zip(*rows, strict=True))
    events = EventStream.from_columns(x, y, t, p, size=SIZE)
    return FrameRecording(name=name, frames=video, events=EventPackets((events,), SIZE))


def write_recording(folder, recording):
    """Write a recording in the layout of the Event-Camera Dataset."""
    (folder / "images").mkdir(parents=True)
    recording.events.collect().save(folder / "events.txt")
    lines = []
    for number, frame in enumerate(recording.frames):
        name = f"images/{number:04d}.png"
        cv2.imwrite(str(folder / name), np.rint(frame.pixels).astype(np.uint8))
        lines.append(f"{frame.t_us / 1e6:.6f} {name}\n")
    (folder / "images.txt").write_text("".join(lines))
    return folder
