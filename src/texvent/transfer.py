"""Transfer functions between signals and linear light.

A signal is a share of full scale, 0..1; light is proportional to photons. Every function takes and
returns arrays of one shape.

Source: IEC 61966-2-1 (sRGB); ITU-R BT.2100, tables 4 (PQ) and 5 (HLG); reference white: ITU-R
    BT.2408, section 2.2.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from enum import StrEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray

Float32Array = NDArray[np.float32]

WHITE = 255.0
"""Level of diffuse white in frames, whatever their transfer."""
LINEAR_BELOW = 0.0031308
"""sRGB's curve is a line below this much light."""
HALF_MAX = 65_504.0
UINT16_MAX = 65_535
CODED_LINEAR_BELOW = 12.92 * LINEAR_BELOW
PQ_M1, PQ_M2 = 2610 / 16384, 2523 / 4096 * 128
PQ_C1, PQ_C2, PQ_C3 = 3424 / 4096, 2413 / 4096 * 32, 2392 / 4096 * 32
PQ_PEAK = 10_000.0
"""Light of PQ's signal 1, cd/m²."""
HLG_A = 0.17883277
HLG_B, HLG_C = 1 - 4 * HLG_A, 0.5 - HLG_A * np.log(4 * HLG_A)


class Transfer(StrEnum):
    """Coding of light: what the levels of a frame are proportional to."""

    GAMMA = "gamma"
    """Gamma-coded, as in ordinary video: about light to the power 1/2.2."""
    LINEAR = "linear"
    """Light itself; 255 is diffuse white, and more is brighter than that."""


def encode_srgb(light: NDArray[Any]) -> Float32Array:
    """Light (1 is white) as gamma-coded levels (255 is white) by sRGB's curve, unrounded.

    The curve goes on above white; light below 0 counts as 0. It is computed in float64: powers of
    float32 differ between processors.

    Example:
        >>> encode_srgb(np.array([0.0, 0.5, 1.0, 4.0])).round().tolist()
        [0.0, 188.0, 255.0, 465.0]
    """
    light = np.maximum(np.asarray(light, dtype=np.float32), 0.0).astype(np.float64)  # keeps NaN
    curve = np.asarray(light ** (1 / 2.4))
    curve *= 1.055
    curve -= 0.055
    np.multiply(light, 12.92, out=curve, where=light <= LINEAR_BELOW)
    curve *= WHITE
    return curve.astype(np.float32)


def linear_levels(light: NDArray[Any]) -> Float32Array:
    """Light (1 is white) as levels of linear frames (255 is white)."""
    return np.asarray(light, np.float32) * np.float32(WHITE)


def decode_srgb(signal: NDArray[Any]) -> Float32Array:
    """Light, 1 is white, of a signal that sRGB's curve coded: the inverse of `encode_srgb`.

    Example:
        >>> [f"{one:.4f}" for one in decode_srgb(np.array([0.0, 0.02, 0.5, 1.0]))]
        ['0.0000', '0.0015', '0.2140', '1.0000']
    """
    coded = np.maximum(np.asarray(signal, dtype=np.float64), 0.0)
    curve = ((coded + 0.055) / 1.055) ** 2.4
    return np.where(coded <= CODED_LINEAR_BELOW, coded / 12.92, curve).astype(np.float32)


def decode_pq(signal: NDArray[Any]) -> Float32Array:
    """Light of a display, cd/m², for a signal of the perceptual quantizer (HDR10).

    Source: BT.2100 table 4, reference EOTF.

    Example:
        >>> decode_pq(np.array([0.0, 0.508078, 1.0])).round(1).tolist()
        [0.0, 100.0, 10000.0]
    """
    power = np.clip(np.asarray(signal, dtype=np.float64), 0.0, 1.0) ** (1 / PQ_M2)
    light = (np.maximum(power - PQ_C1, 0.0) / (PQ_C2 - PQ_C3 * power)) ** (1 / PQ_M1)
    return (PQ_PEAK * light).astype(np.float32)


def decode_hlg(signal: NDArray[Any]) -> Float32Array:
    """Light of the scene, 1 at the signal's peak, for a signal of hybrid log-gamma.

    What a display adds (BT.2100's OOTF) is left out: an event camera would see the scene.

    Source: BT.2100 table 5, inverse of the reference OETF.

    Example:
        >>> [f"{one:.4f}" for one in decode_hlg(np.array([0.0, 0.5, 0.75, 1.0]))]
        ['0.0000', '0.0833', '0.2650', '1.0000']
    """
    coded = np.clip(np.asarray(signal, dtype=np.float64), 0.0, 1.0)
    curve = (np.exp((coded - HLG_C) / HLG_A) + HLG_B) / 12.0
    return np.where(coded <= 0.5, coded**2 / 3.0, curve).astype(np.float32)


def encode_half(light: NDArray[Any]) -> NDArray[np.uint16]:
    """Light, 1 is white, as 16-bit levels: the bits of half floats, whose order is that of numbers.

    A level is at most 1/2048 of its light away. Light below 0 counts as 0, above 65504 as that.

    Example:
        >>> encode_half(np.array([0.0, 1.0, 2.0])).tolist()  # IEEE 754: 2^0 and 2^1
        [0, 15360, 16384]
    """
    halves = np.clip(np.asarray(light), 0.0, HALF_MAX).astype(np.float16)
    return np.asarray(halves.view(np.uint16))


def decode_half(signal: NDArray[Any]) -> Float32Array:
    """Light of a signal, 0..1 of 16 bits, that holds `encode_half`'s levels."""
    levels = np.rint(np.asarray(signal, np.float64) * UINT16_MAX)
    highest = encode_half(np.array(HALF_MAX))  # what is above it is no number
    bits = np.minimum(levels, highest).astype(np.uint16)
    return bits.view(np.float16).astype(np.float32)


DECODERS: Mapping[str, tuple[Callable[[NDArray[Any]], Float32Array], float]] = {
    "half": (decode_half, 1.0),
    "srgb": (decode_srgb, 1.0),
    "pq": (decode_pq, 203.0),
    "hlg": (decode_hlg, float(decode_hlg(np.array(0.75)))),
}
"""Coding → its inverse, and the light of diffuse white: for PQ 203 cd/m² and for HLG the signal
0.75, both by BT.2408."""
