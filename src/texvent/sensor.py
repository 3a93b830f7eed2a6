"""Sensor sizes, and sensors by name."""

from __future__ import annotations

import operator
import re
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

from texvent._registry import suggest
from texvent.errors import ConfigError, shown, warn

MAX_SIDE = 65_535
"""Largest width or height: coordinates are uint16."""


class SensorSize(NamedTuple):
    """Width and height of a sensor, in pixels. Arrays are indexed [y, x], shape (height, width).

    Example:
        >>> from texvent import SensorSize
        >>> str(SensorSize(346, 260)), SensorSize(346, 260).shape
        ('346x260', (260, 346))
    """

    width: int
    height: int

    @property
    def shape(self) -> tuple[int, int]:
        """Array shape (height, width)."""
        return (self.height, self.width)

    def __str__(self) -> str:
        return f"{self.width}x{self.height}"


@dataclass(frozen=True)
class Sensor:
    """A sensor that events can be simulated for.

    Example:
        >>> import texvent
        >>> sensor = texvent.SENSORS["davis346"]
        >>> sensor.size, sensor.source
        (SensorSize(width=346, height=260), 'Gallego 2022')
    """

    name: str
    size: SensorSize
    description: str
    source: str
    """Source of the numbers; Gallego 2022 is Table 1 of "Event-based vision: a survey"."""
    fill_factor: float | None = None
    """Share of a pixel's area that light falls on, 0..1; None: no source is known.

    The DVS128's stands in the abstract of Lichtsteiner 2008. The others are cited after Gallego
    2022, and not checked against its text; the Gen4 HD's is the least value there (> 77 %).
    """


SENSORS: dict[str, Sensor] = {
    sensor.name: sensor
    for sensor in (
        Sensor("dvs128", SensorSize(128, 128), "iniLabs DVS128", "Lichtsteiner 2008", 0.094),
        Sensor("davis240c", SensorSize(240, 180), "iniLabs DAVIS240C", "Brandli 2014", 0.22),
        Sensor("davis346", SensorSize(346, 260), "iniVation DAVIS346", "Gallego 2022", 0.22),
        Sensor(
            "gen3-vga",
            SensorSize(640, 480),
            "Samsung Gen3 VGA (N-ImageNet)",
            "Gallego 2022 (DVS-Gen3)",
            0.12,
        ),
        Sensor("gen4-hd", SensorSize(1280, 720), "Prophesee Gen4 HD", "Finateu 2020", 0.77),
        Sensor(
            "evk4", SensorSize(1280, 720), "Prophesee EVK4 (Sony IMX636)", "Prophesee data sheet"
        ),
        Sensor("genx320", SensorSize(320, 320), "Prophesee GenX320", "Prophesee product page"),
        Sensor(
            "gen3.1",
            SensorSize(640, 480),
            "Prophesee Gen3.1 VGA (PPS3MVCD)",
            "Prophesee manual, Gallego 2022",
            0.25,
        ),
        Sensor(
            "dvxplorer",
            SensorSize(640, 480),
            "iniVation DVXplorer (Samsung S5K231Y)",
            "iniVation specifications",
        ),
    )
}
ALIASES: dict[str, str] = {
    **dict.fromkeys(("imx636", "evk4-hd", "gen4", "gen4.1", "silkyevcam-hd"), "evk4"),
    **dict.fromkeys(("gen3", "gen31", "pps3mvcd", "silkyevcam-vga"), "gen3.1"),
    "davis240": "davis240c",
    "davis346b": "davis346",
}
"""Other names of sensors, of the chip or of cameras with it → the name in `SENSORS`."""


def find_sensor(name: str) -> Sensor | None:
    """The sensor with a name or another name, upper or lower case; None if there is none.

    Example:
        >>> find_sensor("IMX636").name
        'evk4'
    """
    name = name.strip().lower()
    return SENSORS.get(ALIASES.get(name, name))


def parse_sensor(text: str) -> SensorSize:
    """Size of a sensor given by name or as `WIDTHxHEIGHT`.

    Raises:
        ConfigError: the name is unknown or a side is not in 1..65535.

    Example:
        >>> parse_sensor("davis346")
        SensorSize(width=346, height=260)
        >>> parse_sensor("64x48")
        SensorSize(width=64, height=48)
    """
    match = re.fullmatch(r"(\d{1,9})[xX×](\d{1,9})", text.strip())
    if match:
        return checked_size(int(match[1]), int(match[2]))
    sensor = find_sensor(text)
    if sensor is None:
        names = (*SENSORS, "WIDTHxHEIGHT")
        raise ConfigError(f"unknown sensor {shown(text)}; {suggest(text.lower(), names)}")
    return sensor.size


SizeLike: TypeAlias = str | Sensor | tuple[int, int]
"""Size of a sensor, as Python takes it: "davis346", "346x260", a `Sensor` or (width, height)."""


def as_size(size: SizeLike) -> SensorSize:
    """The size that a name, a `Sensor` or two numbers state.

    Raises:
        ConfigError: the name is unknown, it is none of these, or a side is not in 1..65535.

    Example:
        >>> as_size("davis346") == as_size("346x260") == as_size((346, 260))
        True
    """
    if isinstance(size, str):
        return parse_sensor(size)
    if isinstance(size, Sensor):
        return size.size
    try:
        width, height = (operator.index(side) for side in size)
    except (TypeError, ValueError):
        raise ConfigError(
            f"size is {size!r:.60}; give (width, height), a text such as '346x260', or a sensor's "
            "name, such as 'davis346'"
        ) from None
    return checked_size(width, height)


def warn_of_far_centre(centre: tuple[float, float], size: SensorSize, where: str) -> None:
    """Warn of an optical axis that meets the image far from its middle.

    Warns:
        TexventWarning: it is outside the middle half of a side, as where sizes do not fit.
    """
    if any(abs(one - 0.5 * side) > 0.25 * side for one, side in zip(centre, size, strict=True)):
        warn(
            f"{where}: the centre ({centre[0]:g}, {centre[1]:g}) is far from the middle of {size}; "
            "the intrinsics may be of another sensor, or of another resolution"
        )


def checked_size(width: int, height: int) -> SensorSize:
    """A SensorSize whose sides are in 1..65535.

    Raises:
        ConfigError: a side is out of range.
    """
    if not (1 <= width <= MAX_SIDE and 1 <= height <= MAX_SIDE):
        raise ConfigError(
            f"sensor size {shown(width)}x{shown(height)}; each side must be 1..{MAX_SIDE}"
        )
    return SensorSize(int(width), int(height))
