"""DSEC: times as u4 relative to t_offset, gzip or blosc; read by `texvent.io.hdf5.native`.

    events/x u2 · events/y u2 · events/t u4, µs after t_offset · events/p u1
    ms_to_idx u8 · t_offset i8, µs: the first event's millisecond

A file spans at most 2^32 µs (71.6 min). gzip is read by plain h5py; blosc, as DSEC's files
have it, is written and read several times faster with hdf5plugin. Size, metadata and the
noise label are stored as in universal HDF5, where DSEC's readers do not look.

Source: Gehrig et al., DSEC: A Stereo Event Camera Dataset for Driving Scenarios, RA-L 2021.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, ClassVar

from numpy.typing import NDArray

from texvent._require import require
from texvent.io.hdf5.native import Hdf5Codec, Hdf5Writer
from texvent.sensor import SensorSize


class DsecWriter(Hdf5Writer):
    """Writes times relative to the first millisecond."""

    time_type: ClassVar[str] = "<u4"
    max_start_us: ClassVar[int] = 0
    max_span_us: ClassVar[int] = 2**32 - 1


class DsecBloscWriter(DsecWriter):
    """Compresses with blosc (Zstandard, level 1).

    Raises:
        MissingDependencyError: hdf5plugin is not installed.
    """

    def __init__(
        self, path: Path, *, size: SensorSize, metadata: Mapping[str, Any], overwrite: bool
    ) -> None:
        super().__init__(path, size=size, metadata=metadata, overwrite=overwrite)
        plugin = require("hdf5plugin", extra="blosc")
        self.filters = dict(plugin.Blosc(cname="zstd", clevel=1, shuffle=plugin.Blosc.SHUFFLE))

    def _extend_column(self, name: str, values: NDArray[Any]) -> None:
        self._extend(f"events/{name}", values)


class DsecCodec(Hdf5Codec):
    """DSEC files, compressed with gzip."""

    name: ClassVar[str] = "dsec"
    extensions: ClassVar[tuple[str, ...]] = ()
    writer: ClassVar[type[DsecWriter]] = DsecWriter

    def open_writer(
        self, path: Path, *, size: SensorSize, metadata: Mapping[str, Any], overwrite: bool
    ) -> DsecWriter:
        """Start a file; see `EventCodec.open_writer`."""
        return self.writer(path, size=size, metadata=metadata, overwrite=overwrite)


class DsecBloscCodec(DsecCodec):
    """DSEC files, compressed with blosc as the data set's own."""

    name: ClassVar[str] = "dsec-blosc"
    writer: ClassVar[type[DsecWriter]] = DsecBloscWriter
