"""Which bits of an AEDAT2 address are x, y and polarity: it depends on the camera and the tool.

    davis346     (259 - y)<<22 | (345 - x)<<12 | p<<11      jAER and v2e; bit 31 or 10: no event
    jaer-dvs128  (127 - y)<<8 | (127 - x)<<1 | (1 - p)      jAER; bit 31 or 15: no event
    dvs128       x<<8 | y<<1 | p                            what tonic reads
    cifar10-dvs  (127 - x)<<8 | (127 - y)<<1 | (1 - p)      what SpikingJelly reads

x and y count from the top left here, y from the bottom in jAER. docs/files.md says which recording
is read with which.

Sources: iniVation, AEDAT 2.0 file format; jAER, DVS128.Extractor (flips x and the polarity); the
readers named above (formats are facts).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.io.protocol import Columns
from texvent.sensor import SensorSize

SPECIAL = 1 << 10
"""Bit of a DAVIS address that is no pixel's: an external signal."""
APS = 1 << 31
"""Bit of a DAVIS address that is an image's or an IMU's; of a DVS128's, jAER's special events."""
SYNC = 1 << 15
"""Bit of a DVS128 address that is an external signal's."""


@dataclass(frozen=True)
class AddressLayout:
    """Pixels and polarity ↔ 32-bit addresses."""

    name: str
    size: SensorSize
    encode: Callable[[Columns], NDArray[np.uint32]]
    decode: Callable[[NDArray[np.uint32]], dict[str, NDArray[np.integer]]]
    """Columns x, y, p; a place outside the sensor where the address is none of a pixel."""
    not_events: int = 0
    """Addresses with one of these bits are no events."""


def _unsigned(columns: Columns) -> tuple[NDArray[Any], ...]:
    return tuple(columns[name].astype(np.uint32) for name in "xyp")


def _encode_davis(columns: Columns) -> NDArray[np.uint32]:
    x, y, p = _unsigned(columns)
    address: NDArray[Any] = (259 - y) << 22 | (345 - x) << 12 | p << 11
    return address


def _decode_davis(address: NDArray[np.uint32]) -> dict[str, NDArray[np.integer]]:
    # Addresses beyond the sensor come out negative, which no column allows.
    return {
        "x": 345 - (address >> 12 & 1023).astype(np.int32),
        "y": 259 - (address >> 22 & 511).astype(np.int32),
        "p": (address >> 11 & 1).astype(np.uint8),
    }


def _encode_dvs(columns: Columns) -> NDArray[np.uint32]:
    x, y, p = _unsigned(columns)
    address: NDArray[Any] = x << 8 | y << 1 | p
    return address


def _decode_dvs(address: NDArray[np.uint32]) -> dict[str, NDArray[np.integer]]:
    return {
        "x": (address >> 8).astype(np.int64),
        "y": (address >> 1 & 127).astype(np.int16),
        "p": (address & 1).astype(np.uint8),
    }


def _encode_jaer_dvs(columns: Columns) -> NDArray[np.uint32]:
    x, y, p = _unsigned(columns)
    address: NDArray[Any] = (127 - y) << 8 | (127 - x) << 1 | (1 - p)
    return address


def _decode_jaer_dvs(address: NDArray[np.uint32]) -> dict[str, NDArray[np.integer]]:
    # Addresses beyond the sensor come out negative, which no column allows.
    return {
        "x": 127 - (address >> 1 & 127).astype(np.int16),
        "y": 127 - (address >> 8).astype(np.int64),
        "p": (1 - (address & 1)).astype(np.uint8),
    }


# Mirroring x and y and swapping ON and OFF flips all 15 bits.
_DVS_BITS = np.uint32(0x7FFF)


def _encode_cifar(columns: Columns) -> NDArray[np.uint32]:
    return _encode_dvs(columns) ^ _DVS_BITS


def _decode_cifar(address: NDArray[np.uint32]) -> dict[str, NDArray[np.integer]]:
    return _decode_dvs(address ^ _DVS_BITS)


DAVIS346 = AddressLayout(
    "davis346", SensorSize(346, 260), _encode_davis, _decode_davis, SPECIAL | APS
)
JAER_DVS128 = AddressLayout(
    "jaer-dvs128", SensorSize(128, 128), _encode_jaer_dvs, _decode_jaer_dvs, APS | SYNC
)
DVS128 = AddressLayout("dvs128", SensorSize(128, 128), _encode_dvs, _decode_dvs)
CIFAR10_DVS = AddressLayout("cifar10-dvs", SensorSize(128, 128), _encode_cifar, _decode_cifar)
LAYOUTS = {layout.name: layout for layout in (DAVIS346, JAER_DVS128, DVS128, CIFAR10_DVS)}
