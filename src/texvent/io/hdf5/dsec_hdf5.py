"""DSEC: times as u4 relative to t_offset, gzip or blosc; read by `texvent.io.hdf5.native`.

    events/x u2 · events/y u2 · events/t u4, µs after t_offset · events/p u1
    ms_to_idx u8 · t_offset i8, µs: the first event's millisecond

A file spans at most 2^32 µs (71.6 min). gzip is read by plain h5py; blosc, as DSEC's files
have it, is written and read several times faster with hdf5plugin. Size, metadata and the
further columns are stored as in universal HDF5, where DSEC's readers do not look.

Source: Gehrig et al., DSEC: A Stereo Event Camera Dataset for Driving Scenarios, RA-L 2021.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from numpy.typing import NDArray

from texvent._require import require
from texvent.io.block_writer import FileTarget
from texvent.io.hdf5.native import Hdf5Codec, NativeSink, OffsetLimits
from texvent.io.hdf5.writer import Hdf5Sink


class DsecSink(NativeSink):
    """Writes times in 32 bits."""

    time_type: ClassVar[str] = "<u4"


class DsecBloscSink(DsecSink):
    """Compresses with blosc (Zstandard, level 1)."""

    def _filters(self) -> Mapping[str, Any]:
        plugin = require("hdf5plugin", extra="blosc")
        return dict(plugin.Blosc(cname="zstd", clevel=1, shuffle=plugin.Blosc.SHUFFLE))

    def _extend_column(self, name: str, values: NDArray[Any]) -> None:
        self._extend(f"events/{name}", values)


class DsecCodec(Hdf5Codec):
    """DSEC files, compressed with gzip."""

    name: ClassVar[str] = "dsec"
    has_checksums: ClassVar[bool] = True
    extensions: ClassVar[tuple[str, ...]] = ()
    limits: ClassVar[OffsetLimits] = OffsetLimits(
        "DSEC HDF5", 1 << 16, 1 << 63, 2**32 - 1, keeps_labels=True, max_absolute_us=0
    )
    sink: ClassVar[type[Hdf5Sink]] = DsecSink


class DsecBloscCodec(DsecCodec):
    """DSEC files, compressed with blosc as the data set's own."""

    name: ClassVar[str] = "dsec-blosc"
    has_checksums: ClassVar[bool] = False
    sink: ClassVar[type[Hdf5Sink]] = DsecBloscSink

    def check_target(self, target: FileTarget) -> None:
        """Refuse to start without hdf5plugin."""
        require("hdf5plugin", extra="blosc")
