"""Name → class, for every kind of part that can be added: one line here, one new file there.

Values are `"module:attribute"` strings, so naming a part does not import it: torch, numba,
OpenCV and PyAV load only when a part that needs them is used. Packages outside texvent add
their own parts through entry points in the group `texvent.<kind>s`.
"""

from __future__ import annotations

import difflib
import functools
import importlib
from collections.abc import Mapping
from dataclasses import dataclass
from importlib import metadata
from typing import Any, Protocol

from texvent.errors import ConfigError


def load_object(target: str) -> Any:
    """Import and return the object named by a `"module:attribute"` string."""
    module, _, attribute = target.partition(":")
    return getattr(importlib.import_module(module), attribute)


def suggest(name: str, allowed: tuple[str, ...]) -> str:
    """Say what is allowed, and the closest match if there is one: ` did you mean 'blend'?`."""
    close = difflib.get_close_matches(name, allowed, n=1)
    hint = f"; did you mean {close[0]!r}?" if close else ""
    return f"allowed: {', '.join(allowed)}{hint}"


class PartTable(Protocol):
    """Parts that share one class and differ in data, such as models of one adapter."""

    def names(self) -> tuple[str, ...]:
        """Names to list and to suggest."""
        ...

    def find(self, name: str) -> Any | None:
        """The part of that name, or None; also for names that are not listed (paths)."""
        ...


@dataclass(frozen=True)
class Registry:
    """A table of interchangeable parts of one kind."""

    kind: str
    """What the parts are, in the singular, as error messages say it."""
    builtin: Mapping[str, str]
    """Name → `"module:attribute"` of the parts that ship with texvent."""
    table: str | None = None
    """`"module:attribute"` of a `PartTable`: parts that are rows of data, not classes."""

    def entries(self) -> dict[str, str]:
        """Name → target of built-in and plugged-in parts; built-in names cannot be replaced."""
        return {**_plugged_in(f"texvent.{self.kind.replace(' ', '_')}s"), **self.builtin}

    def names(self) -> tuple[str, ...]:
        """All names, in table order."""
        more: tuple[str, ...] = load_object(self.table).names() if self.table else ()
        return (*self.entries(), *more)

    def load(self, name: str) -> Any:
        """Return the part called `name`.

        Raises:
            ConfigError: no part has that name.
        """
        entries = self.entries()
        if name in entries:
            return load_object(entries[name])
        part = load_object(self.table).find(name) if self.table else None
        if part is None:
            raise ConfigError(f"unknown {self.kind} {name!r}; {suggest(name, self.names())}")
        return part


@functools.cache
def _plugged_in(group: str) -> Mapping[str, str]:
    """Name → target of the parts that other packages add; what is installed does not change."""
    return {point.name: point.value for point in metadata.entry_points(group=group)}


GENERATORS = Registry(
    "generator",
    {
        "procedural": "texvent.generate.procedural.generator:ProceduralGenerator",
        "opensora": "texvent.generate.opensora:OpenSoraGenerator",
    },
    table="texvent.generate.model_names:MODEL_TABLE",
)
INTERPOLATORS = Registry(
    "interpolator",
    {
        "none": "texvent.interpolate.none:NoInterpolator",
        "blend": "texvent.interpolate.blend:BlendInterpolator",
        "flow": "texvent.interpolate.flow:FlowInterpolator",
        "exact": "texvent.interpolate.exact:ExactInterpolator",
        "rife": "texvent.interpolate.rife:RifeInterpolator",
        "super-slomo": "texvent.interpolate.super_slomo:SuperSlomoInterpolator",
    },
)
SIMULATORS = Registry(
    "simulator",
    {
        "texvent": "texvent.simulate.texvent:TexventSimulator",
        "physical": "texvent.simulate.physical:PhysicalSimulator",
        "esim": "texvent.simulate.esim:EsimSimulator",
        "v2e": "texvent.simulate.v2e:V2eSimulator",
        "senpi": "texvent.simulate.senpi:SenpiSimulator",
        "v2ce": "texvent.simulate.v2ce:V2ceSimulator",
        "voltmeter": "texvent.simulate.voltmeter:VoltmeterSimulator",
    },
)
CODECS = Registry(
    "event format",
    {
        "hdf5": "texvent.io.hdf5:Hdf5Codec",
        "npz": "texvent.io.npz:NpzCodec",
        "ecd": "texvent.io.ecd:EcdCodec",
        "evt3": "texvent.io.evt3:Evt3Codec",
        "evt2": "texvent.io.evt2:Evt2Codec",
        "evt21": "texvent.io.evt21:Evt21Codec",
        "dat": "texvent.io.dat:DatCodec",
        "prophesee-hdf5": "texvent.io.prophesee_hdf5:PropheseeHdf5Codec",
        "csv": "texvent.io.csv:CsvCodec",
        "e2vid": "texvent.io.e2vid:E2vidCodec",
        "n-imagenet": "texvent.io.n_imagenet:NImageNetCodec",
        "v2e": "texvent.io.v2e:V2eCodec",
        "dsec": "texvent.io.dsec:DsecCodec",
        "dsec-blosc": "texvent.io.dsec:DsecBloscCodec",
        "parquet": "texvent.io.parquet:ParquetCodec",
        "rosbag1": "texvent.io.bags:Rosbag1Codec",
        "mcap": "texvent.io.bags:McapCodec",
        "esim": "texvent.io.esim:EsimCodec",
        "evreal": "texvent.io.evreal:EvrealCodec",
        "aedat2": "texvent.io.aedat2:Aedat2Codec",
        "aedat2-davis346": "texvent.io.aedat2:Davis346Codec",
        "aedat2-dvs128": "texvent.io.aedat2:Dvs128Codec",
        "cifar10-dvs": "texvent.io.aedat2:Cifar10DvsCodec",
        "aedat3": "texvent.io.aedat3:Aedat3Codec",
        "es": "texvent.io.event_stream:EventStreamCodec",
        "atis": "texvent.io.atis:AtisCodec",
        "aedat4": "texvent.io.aedat4:Aedat4Codec",
        "aedat4-none": "texvent.io.aedat4:Aedat4NoneCodec",
        "aedat4-zstd": "texvent.io.aedat4:Aedat4ZstdCodec",
    },
)
METRICS = Registry(
    "metric",
    {
        "stpp": "texvent.metrics.stpp:Stpp",
        "van_rossum": "texvent.metrics.van_rossum:VanRossum",
        "nearest": "texvent.metrics.nearest:NearestTime",
        "isi": "texvent.metrics.intervals:IntervalDistance",
        "voxel": "texvent.metrics.voxel:VoxelDifference",
        "ef_mse": "texvent.metrics.event_frames:EventFrameMse",
        "ef_psnr": "texvent.metrics.event_frames:EventFramePsnr",
        "ef_ssim": "texvent.metrics.event_frames:EventFrameSsim",
        "ef_lpips": "texvent.metrics.event_frames:EventFrameLpips",
        "kernel": "texvent.metrics.kernel_distance:KernelDistance",
        "victor_purpura": "texvent.metrics.victor_purpura:VictorPurpura",
        "time_surface": "texvent.metrics.time_surface:TimeSurfaceDifference",
        "lfs": "texvent.metrics.latent_similarity:LatentSimilarity",
        "eqs": "texvent.metrics.eqs:EventQualityScore",
        "frechet": "texvent.metrics.frechet:FrechetStatistics",
        "batching": "texvent.metrics.batching:BatchingDifference",
        "cadence": "texvent.metrics.cadence:CadenceDifference",
        "fwl": "texvent.metrics.flow_warp:FlowWarpRatio",
        "esr": "texvent.metrics.structural_ratio:StructuralRatioQuotient",
        "count_ratio": "texvent.metrics.marginals:CountRatio",
        "on_difference": "texvent.metrics.marginals:OnDifference",
        "active_iou": "texvent.metrics.marginals:ActiveIou",
    },
)
REPRESENTATIONS = Registry(
    "representation",
    {
        "event-frame": "texvent.represent.event_frame:event_frame",
        "voxel-zhu": "texvent.represent.voxel_grid:voxel_zhu",
        "voxel-e2vid": "texvent.represent.voxel_grid:voxel_e2vid",
        "voxel-dsec": "texvent.represent.voxel_grid:voxel_dsec",
        "voxel-tonic": "texvent.represent.voxel_grid:voxel_tonic",
        "time-surface": "texvent.represent.time_surface:time_surface",
        "stacked-histogram": "texvent.represent.stacked_histogram:stacked_histogram",
        "binary-event-image": "texvent.represent.binary_event_image:binary_event_image",
        "histogram-2d": "texvent.represent.histogram:histogram_2d",
        "histogram-3d": "texvent.represent.histogram:histogram_3d",
    },
)
RECONSTRUCTORS = Registry(
    "reconstructor",
    {
        "e2vid": "texvent.reconstruct.networks:E2VID",
        "e2vid+": "texvent.reconstruct.networks:E2VID_PLUS",
        "firenet": "texvent.reconstruct.networks:FIRENET",
        "firenet+": "texvent.reconstruct.networks:FIRENET_PLUS",
        "hypere2vid": "texvent.reconstruct.networks:HYPER_E2VID",
        "et-net": "texvent.reconstruct.networks:ET_NET",
    },
)
REGISTRIES = {
    registry.kind: registry
    for registry in (
        GENERATORS,
        INTERPOLATORS,
        SIMULATORS,
        CODECS,
        METRICS,
        REPRESENTATIONS,
        RECONSTRUCTORS,
    )
}
