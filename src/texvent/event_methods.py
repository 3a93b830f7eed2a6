"""Methods of events that are functions of rooms above: edits, arrays, files, views.

`METHODS` names the functions, which load when they are called: a convenience for users. An edit
takes both kinds of recordings; a stream gives a stream, packets give packets that are made as they
are read. Each is noted under `edits` in the metadata, as `texvent convert` does.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn, Self

from numpy.typing import NDArray

from texvent._registry import load_object
from texvent.runtime.notebooks import NotebookValue

if TYPE_CHECKING:
    from texvent.sensor import SizeLike
    from texvent.transform.edits import Axes
    from texvent.transform.filters.apply import EventFilter

METHODS = {
    "region": "texvent.transform.edits:Region",
    "crop": "texvent.transform.edits:crop",
    "resize": "texvent.transform.edits:resize",
    "flip": "texvent.transform.edits:flip",
    "rotate": "texvent.transform.edits:rotate",
    "filter": "texvent.transform.filters.apply:filter_events",
    "represent": "texvent.represent.named:represent",
    "represent_slices": "texvent.represent.slices:represent_slices",
    "to_structured": "texvent.represent.named:to_structured",
    "to_tonic": "texvent.represent.named:to_tonic",
    "to_dataframe": "texvent.represent.named:to_dataframe",
    "to_torch": "texvent.represent.tensors:to_torch",
    "save": "texvent.io.files:save",
    "show": "texvent.view.page.writer:show",
    "plot": "texvent.view.plots:plot",
}
"""Name → function."""


def call_method(method: str, /, *values: Any, **options: Any) -> Any:
    """The value of a function of `METHODS`."""
    return load_object(METHODS[method])(*values, **options)


def with_edit(metadata: Mapping[str, Any], edit: Mapping[str, Any]) -> dict[str, Any]:
    """Metadata with one more entry under `edits`: what was done to the events after their run.

    An entry has the names and values of the options of `texvent convert`.
    """
    before = metadata.get("edits")
    return {**metadata, "edits": [*(before if isinstance(before, list) else ()), dict(edit)]}


def time_edit(start_us: int, stop_us: int) -> dict[str, str]:
    """The entry of a part in time, `START,STOP` in seconds."""
    return {"time": f"{start_us / 1_000_000},{stop_us / 1_000_000}"}


class EventMethods(NotebookValue):
    """Base of `EventStream` and `EventPackets`."""

    def __add__(self, other: object) -> NoReturn:
        """Refused, as it could mean two things; the message names both."""
        raise TypeError(
            "events are not added: EventStream.concat([first, second]) joins streams that follow "
            "each other, texvent.transform.edits.merge EventPackets of the same time"
        )

    __radd__ = __add__  # sum([first, second])

    def _edited(self, edit: str, *values: Any, **options: Any) -> Self:
        edited: Self = call_method(edit, self, *values, **options)
        return edited

    def crop(self, x: int, y: int, width: int, height: int) -> Self:
        """The events of a region, whose top left pixel (x, y) becomes (0, 0).

        Raises:
            ConfigError: a number is not whole.
            InputError: the region is empty or reaches over the sensor's edge.

        Example:
            >>> from texvent import EventStream
            >>> events = EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
            >>> events.crop(4, 0, 2, 2), events.crop(4, 0, 2, 2).x
            (EventStream(1 events, 2x2, t 20..20 µs), array([0], dtype=uint16))
        """
        return self._edited("crop", call_method("region", x, y, width, height))

    def resize(self, size: SizeLike) -> Self:
        """All events on a sensor of another size; see `transform.edits.resize`.

        Raises:
            ConfigError: the size is impossible.

        Example:
            >>> from texvent import EventStream
            >>> events = EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
            >>> events.resize("4x3").x
            array([1, 2], dtype=uint16)
        """
        return self._edited("resize", size)

    def flip(self, axes: Axes) -> Self:
        """Mirrored: "x" exchanges left and right, "y" top and bottom, "xy" both.

        Raises:
            ConfigError: other axes.

        Example:
            >>> from texvent import EventStream
            >>> events = EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
            >>> events.flip("x").x, events.flip("xy").y
            (array([4, 3], dtype=uint16), array([5, 5], dtype=uint16))
        """
        return self._edited("flip", axes)

    def rotate(self, degrees: int) -> Self:
        """Turned clockwise by 0, 90, 180 or 270 degrees; quarter turns exchange width and height.

        Raises:
            ConfigError: another angle.

        Example:
            >>> from texvent import EventStream
            >>> events = EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
            >>> events.rotate(90), events.rotate(90).y
            (EventStream(2 events, 6x8, t 10..20 µs), array([3, 4], dtype=uint16))
        """
        return self._edited("rotate", degrees)

    def filter(self, which: str | EventFilter, **options: Any) -> Self:
        """The events that a filter keeps.

        Args:
            which: its name, such as "background-activity", "refractory", "hot-pixels" or "mask".
            **options: of that filter, such as `window_us=5000`.

        Raises:
            ConfigError: unknown name or option, or a value out of range.
            InputError: the filter does not fit the sensor.

        Example:
            >>> from texvent import EventStream
            >>> events = EventStream.from_columns([3, 3], [0, 0], [10, 20], [1, 1], size="8x6")
            >>> events.filter("refractory", period_us=50).t
            array([10])
        """
        return self._edited("filter", which, **options)

    def show(self, path: str | Path | None = None, *, overwrite: bool = False) -> Path:
        """Make a self-contained page (x-y-t cloud, rate curve) and open it in the browser.

        Args:
            path: where to save the page; then nothing is opened. Default: a temporary file.
            overwrite: whether an existing file may be replaced.

        Example:
            >>> from texvent import EventStream
            >>> events = EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
            >>> events.show("two.html").suffix
            '.html'
        """
        page: Path = call_method("show", self, path, overwrite=overwrite)
        return page


class StreamMethods(EventMethods):
    """Base of `EventStream`: what takes events in memory."""

    def represent(self, name: str, *, device: str | None = None, **options: Any) -> Any:
        """A dense array of the events: `name` such as "voxel-e2vid", options such as `bins=5`.

        See `texvent.represent.named.represent`; with `device`, a torch tensor.

        Example:
            >>> from texvent import EventStream
            >>> events = EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
            >>> events.represent("event-frame")[0].tolist()
            [0, 0, 0, 1, -1, 0, 0, 0]
            >>> events.represent("voxel-e2vid", bins=2).shape
            (2, 6, 8)
        """
        return call_method("represent", name, self, device=device, **options)

    def to_structured(self) -> NDArray[Any]:
        """One record per event, [n]: x and y uint16, t int64 µs, p uint8, label uint8 if known.

        Example:
            >>> from texvent import EventStream
            >>> events = EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
            >>> events.to_structured()
            array([(3, 0, 10, 1), (4, 0, 20, 0)],
                  dtype=[('x', '<u2'), ('y', '<u2'), ('t', '<i8'), ('p', 'u1')])
        """
        records: NDArray[Any] = call_method("to_structured", self)
        return records

    def to_tonic(self) -> NDArray[Any]:
        """One record per event, [n], as tonic's transforms take it: x, y int16, t int64, p int8.

        Raises:
            InputError: a side of the sensor is above 32768 pixels, so coordinates do not fit.

        Example:
            >>> from texvent import EventStream
            >>> events = EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
            >>> events.to_tonic()["p"]
            array([1, 0], dtype=int8)
        """
        records: NDArray[Any] = call_method("to_tonic", self)
        return records

    def to_dataframe(self) -> Any:
        """A pandas DataFrame with one row per event and the columns and types of `columns()`.

        Raises:
            MissingDependencyError: pandas is not installed.

        Example:
            >>> from texvent import EventStream
            >>> events = EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
            >>> events.to_dataframe()
               x  y   t  p
            0  3  0  10  1
            1  4  0  20  0
        """
        return call_method("to_dataframe", self)

    def to_torch(self, device: str = "cpu") -> dict[str, Any]:
        """Tensors x, y (int32), t (int64, µs), p and, if known, label (int8), each [n].

        Raises:
            ConfigError: torch knows or finds no such device.
            MissingDependencyError: torch is not installed.

        Example:
            >>> from texvent import EventStream
            >>> events = EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
            >>> events.to_torch()["t"]
            tensor([10, 20])
        """
        tensors: dict[str, Any] = call_method("to_torch", self, device)
        return tensors

    def save(self, path: str | Path, *, format: str | None = None, overwrite: bool = False) -> Path:
        """Write to a file, its format taken from the extension unless given; see `texvent.io`.

        Example:
            >>> from texvent import EventStream
            >>> events = EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
            >>> events.save("two.raw", format="evt3").stat().st_size > 8
            True
        """
        saved: Path = call_method("save", path, self, format=format, overwrite=overwrite)
        return saved

    def plot(self, kind: str = "frame", *, ax: Any = None, **options: Any) -> Any:
        """Draw the events by matplotlib and give the axes.

        Args:
            kind: "frame" (counted per pixel), "cloud" (x, y and time), "rate" (over time) or
                "isi" (times between events of a pixel).
            ax: axes to draw into; default: those of a new figure. A cloud needs 3-D ones.
            **options: of the kind, such as `palette="v2e"`; see `texvent.view.plots`.

        Returns:
            The axes (`matplotlib.axes.Axes`).

        Raises:
            ConfigError: unknown kind or option, or axes that do not fit it.
            MissingDependencyError: matplotlib is not installed.

        Example:
            >>> from texvent import EventStream
            >>> events = EventStream.from_columns([3, 4], [0, 0], [10, 20], [1, 0], size="8x6")
            >>> axes = events.plot("frame")
            >>> axes.get_xlabel(), axes.get_ylabel()
            ('x, pixels', 'y, pixels')
        """
        return call_method("plot", self, kind, ax=ax, **options)
