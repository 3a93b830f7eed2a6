"""Files in the formats of MNIST and N-MNIST with ten made-up figures, recorded by a simulator."""

import gzip

import numpy as np

from texvent.events import EventStream
from texvent.run.prepare import prepare_video
from texvent.sensor import SensorSize
from texvent_lab.bench.digits.plan import find_arm
from texvent_lab.bench.digits.sheet import Digits, DigitSheet

TRAIN, PAIRS = 40, 6
SIZE = SensorSize(34, 34)


def figures(count, seed):
    """[n, 28, 28]: class k is a bar, across or upright, of one of five lengths."""
    chance = np.random.default_rng(seed)
    images = np.zeros((count, 28, 28), np.uint8)
    for number in range(count):
        kind, (row, column) = number % 10, chance.integers(4, 7, 2)
        size = (3, 3 + 4 * (kind % 5))
        height, width = size if kind < 5 else size[::-1]
        images[number, row : row + height, column : column + width] = chance.integers(180, 256)
    return images


def write_idx(path, array):
    head = bytes((0, 0, 8, array.ndim)) + np.array(array.shape, ">u4").tobytes()
    content = head + array.astype(np.uint8).tobytes()
    path.write_bytes(gzip.compress(content, 1) if path.suffix == ".gz" else content)


def write_mnist(folder, count=10_000):
    folder.mkdir()
    images = np.concatenate([figures(100, seed) for seed in range(3)])
    images = np.resize(images, (count, 28, 28))
    write_idx(folder / "t10k-images-idx3-ubyte.gz", images)
    write_idx(folder / "t10k-labels-idx1-ubyte", np.arange(count) % 10)
    return images


def record(images):
    """Events of each image by the measured motion, with the right polarity."""
    sheet = DigitSheet(Digits.as_measured(images))
    settings = find_arm("esim").settings("exact", threshold=0.5)
    events = prepare_video(sheet, settings).packets.collect()
    return [tile_events(sheet, events, number) for number in range(len(images))]


def tile_events(sheet, events, number):
    """The events of one digit, on its own sensor."""
    mask = np.zeros(sheet.size.shape, bool)
    columns = sheet.size.width // 40
    top, left = 40 * (number // columns) + 3, 40 * (number % columns) + 3
    mask[top : top + 34, left : left + 34] = True
    own = events[mask[events.y, events.x]]
    return EventStream(own.x - np.uint16(left), own.y - np.uint16(top), own.t, own.p, SIZE)


def write_recordings(folder, mnist_images, train=TRAIN, pairs=PAIRS):
    """N-MNIST's folders: the stored bit is 1 where brightness falls."""
    names = [(f"Train/{number % 10}", number + 1) for number in range(train)]
    names += [(f"Test/{number % 10}", number + 1) for number in range(pairs)]
    images = np.concatenate([figures(train, 9), mnist_images[:pairs]])
    for (name, number), events in zip(names, record(images), strict=True):
        (folder / name).mkdir(parents=True, exist_ok=True)
        content = encode(events.x, events.y, events.t, 1 - events.p)
        (folder / name / f"{number:05d}.bin").write_bytes(content)


def encode(x, y, t, stored):
    t = np.asarray(t, np.int64)
    columns = (x, y, np.asarray(stored, np.int64) << 7 | t >> 16, t >> 8 & 255, t & 255)
    return np.stack([np.asarray(one, np.int64) for one in columns], axis=1).astype("u1").tobytes()
