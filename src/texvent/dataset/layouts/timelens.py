"""Layout timelens: frames, and the events between each two, as TimeLens reads them.

    SPLIT/KEY/images/000000.png    frames
    SPLIT/KEY/images/timestamp.txt one time per frame, µs
    SPLIT/KEY/events/000001.npz    events between frame 0 and frame 1: x, y, t (µs), p (0 or 1)

Source: S. Tulyakov et al., "TimeLens: event-based video frame interpolation", CVPR 2021, and its
code: `python -m timelens.run_timelens checkpoint.bin KEY/events KEY/images OUT 0 7`.
"""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np

from texvent.dataset.layouts.frames import write_frames
from texvent.dataset.layouts.layout import Layout, LayoutSample
from texvent.errors import InputError
from texvent.io.atomic import atomic_folder


def _write(sample: LayoutSample, path: Path) -> bool:
    if sample.read_frames is None:
        raise InputError(f"sample {sample.key} has no frames")
    events = sample.read_events()
    with atomic_folder(path, overwrite=False, is_own=lambda _: False) as part:
        with sample.read_frames() as frames:
            times = write_frames(frames, part / "images")
        np.savetxt(part / "images" / "timestamp.txt", times, fmt="%d")
        (part / "events").mkdir()
        for index, (start, stop) in enumerate(pairwise(times), start=1):
            between = events.cut(int(start), int(stop))
            columns = {name: getattr(between, name) for name in "xytp"}
            np.savez_compressed(part / "events" / f"{index:06d}.npz", **columns)
    return True


TIMELENS = Layout(
    place="{split}/{key}",
    write=_write,
    lost="captions",
    takes_frames=True,
    has_frames=True,
)
