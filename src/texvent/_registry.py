"""Name → class, for every kind of part that can be added: one line here, one new file there.

Values are `"module:attribute"` strings, so naming a part does not import it: torch, numba,
OpenCV and PyAV load only when a part that needs them is used. Packages outside texvent add
their own parts through entry points in the group `texvent.<kind>s`.
"""

from __future__ import annotations

import difflib
import functools
import importlib
import importlib.util
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib import metadata
from typing import Any

from texvent._require import reinstall_command
from texvent.errors import ConfigError, MissingDependencyError, TexventError, one_line, shown

LONGEST_NAME = 60
"""Longer names are no misspelling of an allowed one."""
SHORTEST_START = 3
"""Letters from which the start of a name suggests it: "gen" is "generate"."""
LONGEST_LISTING, FIRST_NAMES = 160, 8
"""Characters of a list that an error holds in full; names that it holds of a longer one."""


def load_object(target: str) -> Any:
    """Import and return the object that a `"module:attribute"` string names, or a module."""
    module, _, attribute = target.partition(":")
    home = importlib.import_module(module)
    return getattr(home, attribute) if attribute else home


def absent_package(target: str) -> str | None:
    """The package of a `"module:attribute"` string, where it is not installed; else None."""
    package = target.partition(":")[0].partition(".")[0]
    return package if importlib.util.find_spec(package) is None else None


def say_absent(package: str) -> str:
    """Say that a package of texvent's own distribution is gone, and what brings it back."""
    return (
        f"the package {package}, a part of texvent, is missing; install it anew: "
        f"{reinstall_command()}"
    )


def nearest(word: str, names: Sequence[str]) -> str | None:
    """The name that is spelt most like a word, whole or in its first parts; None if none is close.

    Example:
        >>> nearest("contrst", ("count", "contrast_threshold")), nearest("gen", ("generate",))
        ('contrast_threshold', 'generate')
    """
    word = word.lower()
    if len(word) > LONGEST_NAME:
        return None
    forms = {name: name for name in names}
    for name in names:
        for end in re.finditer("[-_ ]", name):
            forms.setdefault(name[: end.start()], name)
    close = difflib.get_close_matches(word, forms, n=1)
    begun = [one for one in names if len(word) >= SHORTEST_START and one.startswith(word)]
    return forms[close[0]] if close else next(iter(begun), None)


def suggest(name: object, allowed: tuple[str, ...], *, longest: int = LONGEST_LISTING) -> str:
    """Say what is allowed, and the nearest name if there is one: ` did you mean 'blend'?`.

    Of a list of more than `longest` characters, only the nearest or the first names are said.
    """
    near = nearest(name, allowed) if isinstance(name, str) else None
    listed, hint = ", ".join(allowed), f"did you mean {near!r}?" if near else ""
    if len(listed) > longest:
        listed = f"{', '.join(allowed[:FIRST_NAMES])}, ... ({len(allowed)} in all)"
        return hint or f"allowed: {listed}"
    return f"allowed: {listed}{hint and f'; {hint}'}"


@dataclass(frozen=True)
class Registry:
    """A table of interchangeable parts of one kind."""

    kind: str
    """Kind of the parts, in the singular, as error messages say it."""
    builtin: Mapping[str, str]
    """Name → `"module:attribute"` of the parts that ship with texvent."""
    table: str | None = None
    """Module of parts that are rows of data, not classes: `names()` to list and to suggest, and
    `find(name)`, which gives a part or None, also for names that are not listed (paths)."""

    @property
    def group(self) -> str:
        """Group of the entry points that add parts."""
        return f"texvent.{self.kind.replace(' ', '_')}s"

    def shipped(self) -> dict[str, str]:
        """Name → target of the parts of texvent's own distribution that are here."""
        own = _plugged_in(self.group, is_own=True)
        here = {name: target for name, target in own.items() if not absent_package(target)}
        return {**here, **self.builtin}

    def absent(self) -> dict[str, str]:
        """Name → package of the parts of texvent's own distribution whose package is missing."""
        own = _plugged_in(self.group, is_own=True)
        return {name: one for name, target in own.items() if (one := absent_package(target))}

    def entries(self) -> dict[str, str]:
        """Name → target of shipped and plugged-in parts; shipped names cannot be replaced."""
        shipped = self.shipped()
        return {**shipped, **_plugged_in(self.group, is_own=False), **shipped}

    def names(self) -> tuple[str, ...]:
        """All names, in table order."""
        more: tuple[str, ...] = importlib.import_module(self.table).names() if self.table else ()
        return (*self.entries(), *more)

    def load_all(self) -> list[Any]:
        """All parts of `entries`, in their order."""
        return [load_object(target) for target in self.entries().values()]

    def load(self, name: Any) -> Any:
        """Return the part called `name`.

        Raises:
            ConfigError: no part has that name.
            MissingDependencyError: its package, one of texvent's own, is missing.
            TexventError: a part of another package is broken.
        """
        is_name = isinstance(name, str)  # a config file may hold anything
        if is_name and name in self.builtin:
            return load_object(self.builtin[name])
        entries = self.entries()
        if is_name and name in entries:
            return self._load_plugged_in(name, entries[name])
        part = importlib.import_module(self.table).find(name) if self.table and is_name else None
        if part is None and is_name and name in (absent := self.absent()):
            raise MissingDependencyError(f"{self.kind} {name!r}: {say_absent(absent[name])}")
        if part is None:
            raise ConfigError(f"unknown {self.kind} {shown(name)}; {suggest(name, self.names())}")
        return part

    def _load_plugged_in(self, name: str, target: str) -> Any:
        """A part of another package.

        Raises:
            TexventError: it cannot be imported.
        """
        try:
            part = load_object(target)
        except Exception as error:
            text = one_line(error)
            raise TexventError(
                f"{self.kind} {name!r} of another package cannot be loaded from {target} "
                f"({type(error).__name__}: {text})"
            ) from error
        return part


@functools.cache
def _plugged_in(group: str, *, is_own: bool) -> Mapping[str, str]:
    """Name → target of the entry points of a group; what is installed does not change.

    Args:
        group: its name.
        is_own: those of the distribution that texvent is in; False: of all others.
    """
    points = metadata.entry_points(group=group)
    return {point.name: point.value for point in points if _is_own(point) is is_own}


def _is_own(point: metadata.EntryPoint) -> bool:
    """Whether an entry point is of the distribution that texvent is in."""
    return point.dist is not None and point.dist.name == "texvent"


DEFAULT_GENERATOR = "procedural"
"""Generator of prompts where none is named."""


GENERATORS = Registry(
    "generator",
    {
        "opensora": "texvent.generation.opensora:OpenSoraGenerator",
    },
    table="texvent.generation.video_models.named_models",
)
SCENES = Registry("scene package", {})
INTERPOLATORS = Registry(
    "interpolator",
    {
        "none": "texvent.interpolate.simple:NoInterpolator",
        "blend": "texvent.interpolate.simple:BlendInterpolator",
        "flow": "texvent.interpolate.flow:FlowInterpolator",
        "exact": "texvent.interpolate.simple:ExactInterpolator",
        "motion": "texvent.interpolate.motion.interpolator:MotionInterpolator",
        "rife": "texvent.interpolate.rife.interpolator:RifeInterpolator",
    },
)
SIMULATORS = Registry(
    "simulator",
    {
        "texvent": "texvent.simulation.texvent.simulator:TexventSimulator",
        "physical": "texvent.simulation.physical.simulator:PhysicalSimulator",
        "esim": "texvent.simulation.esim.simulator:EsimSimulator",
        "v2e": "texvent.simulation.v2e.simulator:V2eSimulator",
        "voltmeter": "texvent.simulation.voltmeter.simulator:VoltmeterSimulator",
        "senpi": "texvent.simulation.senpi.simulator:SenpiSimulator",
    },
)
CODECS = Registry(
    "event format",
    {
        "hdf5": "texvent.io.hdf5.dsec:Hdf5Codec",
        "npz": "texvent.io.arrays.npz:NpzCodec",
        "npy": "texvent.io.arrays.npz:NpyCodec",
        "ecd": "texvent.io.text.codecs:EcdCodec",
        "evt3": "texvent.io.prophesee.evt:Evt3Codec",
        "evt2": "texvent.io.prophesee.evt:Evt2Codec",
        "evt21": "texvent.io.prophesee.evt:Evt21Codec",
        "dat": "texvent.io.prophesee.dat:DatCodec",
        "prophesee-hdf5": "texvent.io.prophesee.prophesee_ecf:EcfHdf5Codec",
        "csv": "texvent.io.text.codecs:CsvCodec",
        "e2vid": "texvent.io.text.codecs:E2vidZipCodec",
        "n-imagenet": "texvent.io.arrays.npz:NImageNetCodec",
        "dsec": "texvent.io.hdf5.dsec:DsecCodec",
        "event-utils": "texvent.io.hdf5.event_utils:EventUtilsCodec",
        "parquet": "texvent.io.arrays.parquet:ParquetCodec",
        "rosbag1": "texvent.io.ros.bags:Rosbag1Codec",
        "mcap": "texvent.io.ros.bags:McapCodec",
        "rosbag2": "texvent.io.ros.bags:Rosbag2FolderCodec",
        "esim": "texvent.io.arrays.folders:EsimFolderCodec",
        "evreal": "texvent.io.arrays.folders:EvrealFolderCodec",
        "aedat2": "texvent.io.aedat.aedat2:Aedat2Codec",
        "aedat2-dvs128": "texvent.io.aedat.aedat2:Dvs128Codec",
        "cifar10-dvs": "texvent.io.aedat.aedat2:Cifar10DvsCodec",
        "aedat3": "texvent.io.aedat.aedat3:Aedat3Codec",
        "es": "texvent.io.event_stream2:EventStream2Codec",
        "atis": "texvent.io.atis:NMnistCodec",
        "aedat4": "texvent.io.aedat.aedat4:Aedat4Codec",
    },
)
METRICS = Registry(
    "metric",
    {
        "stpp": "texvent.metrics.stpp:Stpp",
        "van_rossum": "texvent.metrics.spike_trains:VanRossum",
        "nearest": "texvent.metrics.spike_trains:NearestTime",
        "ef_mse": "texvent.metrics.event_frames:EventFrameMse",
        "ef_psnr": "texvent.metrics.event_frames:EventFramePsnr",
        "ef_ssim": "texvent.metrics.event_frames:EventFrameSsim",
        "ef_lpips": "texvent.metrics.event_frames:EventFrameLpips",
        "lfs": "texvent.metrics.latent_similarity:LatentSimilarity",
        "eqs": "texvent.metrics.latent_similarity:EventQualityScore",
        "count_ratio": "texvent.metrics.count_statistics:CountRatio",
        "on_difference": "texvent.metrics.count_statistics:OnDifference",
        "active_iou": "texvent.metrics.count_statistics:ActiveIou",
    },
)
REPRESENTATIONS = Registry(
    "representation",
    {
        "event-frame": "texvent.represent.event_frame:event_frame",
        "voxel-zhu": "texvent.represent.voxel_grid:voxel_zhu",
        "voxel-e2vid": "texvent.represent.voxel_grid:voxel_e2vid",
        "voxel-dsec": "texvent.represent.voxel_grid:voxel_dsec",
        "time-surface": "texvent.represent.time_surface:time_surface",
        "stacked-histogram": "texvent.represent.histogram:stacked_histogram",
        "binary-event-image": "texvent.represent.event_frame:binary_event_image",
        "histogram-2d": "texvent.represent.histogram:histogram_2d",
        "histogram-3d": "texvent.represent.histogram:histogram_3d",
        "timestamp-image": "texvent.represent.time_surface:timestamp_image",
    },
)
FILTERS = Registry(
    "event filter",
    {
        "background-activity": ("texvent.transform.filters.noise_filters:BackgroundActivityFilter"),
        "refractory": "texvent.transform.filters.noise_filters:RefractoryFilter",
        "hot-pixels": "texvent.transform.filters.noise_filters:HotPixelFilter",
        "mask": "texvent.transform.filters.noise_filters:MaskFilter",
        "rate-limit": "texvent.transform.filters.noise_filters:RateLimitFilter",
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
        FILTERS,
    )
}
