"""Events that come in bursts: which part of it is due to camera, lens, threshold and pixel model.

    texvent data pull davis346
    python -m texvent_lab.measure.street street.json

A static camera saw cars in a street. Its recorded events are compared with those that pixel models
make of its own frames, and with those of two cars that pass each other at 10 m/s, from cameras that
stand nearer or farther.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

import texvent
from texvent import EventStream
from texvent.data.pull import find_pulled
from texvent.errors import InputError
from texvent_lab.bench.detection.labels import COUNTED, read_street_labels
from texvent_lab.bench.document import markdown_table, write_document
from texvent_scenes.spec.scene import Camera, Motion, Place, Scene, SceneObject

SOON_US, GAP_US = 5_000, 30_000
"""An event follows soon; from which gap on events are no more of one edge."""
SIZE = texvent.SensorSize(346, 260)
FOCAL, HEIGHT, CAR_M, CAR_M_S = 1.1, 0.12, 4.5, 10.0
"""Focal length in image widths and elevation of the camera, rad; length and speed of a car."""
CAMERAS_M = (19.0, 31.0, 44.0, 66.0)
"""Distances of the camera from the cars: those of a clip of 1 and 2 s that show all their way, and
those from which a street camera sees cars at 10 and 15 m/s."""
MARGIN_PX = 4
STREET = "davis346"
WAYS: tuple[Literal["right"], Literal["left"]] = ("right", "left")


@dataclass(frozen=True)
class Row:
    """Statistics of one stream of events."""

    name: str
    speed_px_s: float | None
    """Speed of the fastest car in the image."""
    length_px: float | None
    """Its length there."""
    events: int
    soon: float
    """Share of the events that come within `SOON_US` of their pixel's last."""
    run: float
    """Events of one polarity with no gap of `GAP_US`, in a pixel: mean over events."""
    gap_ms: float
    """Median time between the events of such a run."""


def soon_share(events: EventStream) -> float:
    """Share of the events that come within `SOON_US` of their pixel's last."""
    pixel = events.y.astype(np.int64) * events.size.width + events.x
    order = np.lexsort((events.t, pixel))
    is_next = np.diff(pixel[order]) == 0
    soon = np.count_nonzero(is_next & (np.diff(events.t[order].astype(np.int64)) < SOON_US))
    return soon / max(len(order), 1)


def measure(
    name: str, events: EventStream, speed_px_s: float | None = None, length_px: float | None = None
) -> Row:
    """The statistics of a stream."""
    pixel = events.y.astype(np.int64) * events.size.width + events.x
    order = np.lexsort((events.t, pixel))
    pixel, t, p = pixel[order], events.t[order].astype(np.int64), events.p[order]
    is_next = np.diff(pixel) == 0
    gaps = np.diff(t)
    is_run = is_next & (gaps < GAP_US) & (p[1:] == p[:-1])
    lengths = np.diff(np.flatnonzero(np.concatenate([[True], ~is_run, [True]])))
    return Row(
        name, speed_px_s, length_px, len(t), soon_share(events),
        float(np.sum(lengths**2) / max(len(t), 1)),
        float(np.median(gaps[is_run])) / 1000 if is_run.any() else float("nan"),
    )  # fmt: skip


def inside(events: EventStream, boxes: NDArray[np.void]) -> EventStream:
    """Events in the box of one track, which moves from label to label."""
    x, y, w, h = (np.interp(events.t, boxes["t"], boxes[side]) for side in "xywh")
    is_in = (events.x > x - MARGIN_PX) & (events.x < x + w + MARGIN_PX)
    is_in &= (events.y > y - MARGIN_PX) & (events.y < y + h + MARGIN_PX)
    is_in &= (events.t >= boxes["t"][0]) & (events.t <= boxes["t"][-1])
    columns = (column[is_in] for column in (events.x, events.y, events.t, events.p))
    return EventStream.from_columns(*columns, size=events.size)


def recorded_rows(path: Path) -> Iterator[Row]:
    """The street: all events, those of each car that drives, and of its frames simulated."""
    events = texvent.load(path)
    labels = read_street_labels()
    driving = np.unique(labels["track_id"][labels["class_confidence"] == COUNTED])
    yield measure("recorded street", events)
    for track in driving:
        boxes = labels[labels["track_id"] == track]
        middles = np.stack([boxes["x"] + boxes["w"] / 2, boxes["y"] + boxes["h"] / 2])
        seconds = (boxes["t"][-1] - boxes["t"][0]) / 1e6
        speed = float(np.linalg.norm(middles[:, -1] - middles[:, 0])) / seconds
        yield measure(
            f"recorded car {track}", inside(events, boxes), speed, float(np.median(boxes["w"]))
        )
    yield measure("its frames, texvent", texvent.simulate(path))
    physical = texvent.simulate(path, simulator="physical", preset="davis346", gamma=1.0)
    yield measure("its frames, physical", physical)


def two_cars(distance_m: float, speed_m_s: float = CAR_M_S) -> Scene:
    """Two cars that pass each other before a camera that stands so far away."""
    right, left = (Motion("drive", way, speed_m_s=speed_m_s) for way in WAYS)
    cars = (
        SceneObject("car", colour="red", motions=(right,)),
        SceneObject("car", id="other", colour="white", motions=(left,)),
    )
    place = (0.0, -distance_m * float(np.cos(HEIGHT)), distance_m * float(np.sin(HEIGHT)))
    view = float(np.degrees(2.0 * np.arctan(0.5 / FOCAL)))
    camera = Camera(position_m=place, look_at_m=(0.0, 0.0, 0.7), field_of_view_deg=view)
    return Scene(objects=cars, camera=camera, place=Place("road"))


def simulated_rows() -> Iterator[Row]:
    """Two cars from each distance; and from the nearest with one thing changed at a time."""
    tries: list[tuple[str, float, float, dict[str, Any]]] = [
        (f"two cars from {one:.0f} m", one, CAR_M_S, {}) for one in CAMERAS_M
    ]
    near_m = CAMERAS_M[0]
    tries += [
        ("the nearest, lens twice as wide", near_m, CAR_M_S, {"point_spread": 1.0}),
        ("the nearest, thresholds twice as high", near_m, CAR_M_S, {"contrast_threshold": 0.4}),
        ("the nearest, physical", near_m, CAR_M_S, {"simulator": "physical", "preset": "davis346"}),
        ("the nearest, 4.3 m/s", near_m, CAR_M_S * near_m / CAMERAS_M[2], {}),
    ]
    for name, distance_m, speed_m_s, options in tries:
        per_m = FOCAL * SIZE.width / distance_m
        events = texvent.generate(
            two_cars(distance_m, speed_m_s), sensor=str(SIZE), duration=1.0, **options
        )
        yield measure(name, events, per_m * speed_m_s, per_m * CAR_M)


def as_markdown(rows: list[dict[str, Any]]) -> str:
    """The table of the documentation."""
    heads = ["", "px/s", "car, px", "events", "within 5 ms, %", "events of an edge", "gap, ms"]
    cells = [
        [
            row["name"],
            *("" if row[key] is None else f"{row[key]:.0f}" for key in ("speed_px_s", "length_px")),
            f"{row['events']:,}", f"{100 * row['soon']:.0f}", f"{row['run']:.1f}",
            f"{row['gap_ms']:.1f}",
        ]
        for row in rows
    ]  # fmt: skip
    return markdown_table(heads, cells)


def main(arguments: list[str]) -> None:
    """Measure all rows, write them and print the table."""
    if len(arguments) != 1:
        sys.exit("error: name the file to write, such as street.json.gz")
    path = find_pulled(STREET)
    if path is None:
        raise InputError(f"{STREET} is not here; texvent data pull {STREET} fetches it")
    rows = [asdict(one) for one in (*recorded_rows(path), *simulated_rows())]
    write_document(Path(arguments[0]), {"kind": "street", "rows": rows}, overwrite=True)
    print(as_markdown(rows))


if __name__ == "__main__":
    main(sys.argv[1:])
