"""`texvent doctor`: what is installed, what is missing, how to get it."""

from __future__ import annotations

import importlib
import importlib.util
import os
import platform
import shutil
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path

from rich.console import Console
from rich.markup import escape

from texvent._registry import REGISTRIES
from texvent._version import full_version
from texvent.cli.options import refuse_arguments
from texvent.runtime.memory import machine_bytes

DESCRIPTION = """Say what is installed, what is missing, and how to get it. Exit code 1 if something
needed is missing."""

BASE = {
    "numpy": "arrays",
    "numba": "fast kernels and the scene renderer",
    "h5py": "HDF5 event files",
    "av": "reading and writing video",
    "opencv-python-headless": "images, resizing",
    "rich": "progress and tables",
    "pyyaml": "YAML config files",
    "tomli-w": "--print-config",
    "pypi-simple": "texvent data pull",
    "requests": "texvent data pull",
    "lz4": "AEDAT4 event files",
}
"""Package → what it is for; `pip install texvent` brings all of them."""

EXTRAS = {
    "generate": ("diffusers", "learned text-to-video models: Cosmos, Wan, CogVideoX, ..."),
    "cosmos": ("cosmos_guardrail", "the guardrail that Cosmos models must not run without"),
    "quantize": ("bitsandbytes", "learned models with 8 or 4 bits: --quantize"),
    "rife": ("torch", "RIFE interpolation"),
    "v2ce": ("torch", "the V2CE simulator"),
    "plot": ("matplotlib", "events.plot()"),
    "gpu": ("triton", "texvent and esim on a GPU: --backend gpu"),
    "assets": ("trimesh", "OBJ and PLY models in --assets folders"),
    "exr": ("OpenEXR", "OpenEXR frames and passes of a renderer"),
    "bags": ("rosbags", "ROS bags and mcap"),
    "parquet": ("pyarrow", "Parquet event files"),
    "ray": ("ray", "data sets made on a cluster: texvent dataset make --ray"),
    "blosc": ("hdf5plugin", "HDF5 files packed with blosc, as DSEC's own"),
    "zstd": ("backports.zstd", "AEDAT4 packed with zstd (Python 3.14 has it)"),
    "pandas": ("pandas", "events.to_dataframe()"),
}
"""Extra → the module that shows it is there, and what it is for; none is needed to start."""

MODULES = {"opencv-python-headless": "cv2", "pyyaml": "yaml", "tomli-w": "tomli_w"}
"""Packages whose module has another name."""


@dataclass(frozen=True)
class Finding:
    """One line of the report."""

    name: str
    is_fine: bool
    state: str
    remedy: str = ""


def run(arguments: Sequence[str]) -> int:
    """Print the report; returns 0 if everything texvent needs is there, else 1."""
    refuse_arguments(arguments, prog="texvent doctor", description=DESCRIPTION)
    findings = examine()
    console = Console(highlight=False, soft_wrap=True)
    width = max(len(finding.name) for finding in findings)
    for finding in findings:
        is_absent = finding.is_fine and bool(finding.remedy)
        mark = "--" if is_absent else "[green]ok[/]" if finding.is_fine else "[red]no[/]"
        remedy = f"  [bold]{escape(finding.remedy)}[/]" if finding.remedy else ""
        console.print(
            f"{mark}  {escape(finding.name.ljust(width))}  {escape(finding.state)}{remedy}"
        )
    for kind, registry in REGISTRIES.items():
        console.print(f"{kind + 's'}: {', '.join(registry.names())}", markup=False)
    return 0 if all(finding.is_fine for finding in findings) else 1


def examine() -> list[Finding]:
    """Everything worth knowing about this installation."""
    findings = [_python(), Finding("texvent", True, full_version())]
    findings += [_package(name, purpose) for name, purpose in BASE.items()]
    findings += [_encoder(), _processors(), _folder("current folder", Path.cwd())]
    findings += [_extra(name, *entry) for name, entry in EXTRAS.items()]
    return findings


def _python() -> Finding:
    is_fine = sys.version_info >= (3, 11)
    state = f"{platform.python_version()} on {platform.system()} {platform.machine()}"
    return Finding("Python", is_fine, state, "" if is_fine else "install Python 3.11 or newer")


def _package(name: str, purpose: str) -> Finding:
    try:
        version = metadata.version(name)
        importlib.import_module(MODULES.get(name, name.replace("-", "_")))
    except ImportError as error:
        return Finding(name, False, f"cannot be imported: {error}", f"pip install {name}")
    return Finding(name, True, f"{version:<10} {purpose}")


def _extra(name: str, module: str, purpose: str) -> Finding:
    """Row of an optional part, with how to install it."""
    try:
        is_here = importlib.util.find_spec(module) is not None
    except ModuleNotFoundError:
        is_here = False
    if name == "zstd" and sys.version_info >= (3, 14):
        is_here = True
    state = f"{'here' if is_here else 'missing':<10} {purpose}"
    return Finding(f"[{name}]", True, state, "" if is_here else f"pip install 'texvent[{name}]'")


def _encoder() -> Finding:
    """Whether videos can be written: some builds of FFmpeg have no H.264 encoder."""
    try:
        av = importlib.import_module("av")
        av.codec.Codec("libx264", "w")
    except ImportError:
        return Finding("H.264 encoder", False, "PyAV is missing", "pip install av")
    except ValueError:
        remedy = "pip install --force-reinstall --only-binary :all: av"
        return Finding("H.264 encoder", False, "PyAV was built without libx264", remedy)
    return Finding("H.264 encoder", True, "libx264")


def _processors() -> Finding:
    size = machine_bytes()
    memory = "memory unknown" if size is None else f"{size / 2**30:.0f} GB memory"
    return Finding("processors", True, f"{os.cpu_count()} cores, {memory}")


def _folder(name: str, path: Path) -> Finding:
    free = shutil.disk_usage(path).free / 2**30
    if not os.access(path, os.W_OK):
        return Finding(name, False, f"{path} is not writable", "go to another folder, or use -o")
    is_fine = free > 0.1
    return Finding(name, is_fine, f"{free:.1f} GB free", "" if is_fine else "free some space")
