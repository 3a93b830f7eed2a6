"""`texvent doctor`: what is installed, what is missing, how to get it."""

from __future__ import annotations

import importlib
import os
import platform
import re
import shutil
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path

from rich.console import Console
from rich.markup import escape

from texvent._registry import REGISTRIES
from texvent._require import install_command
from texvent._version import full_version
from texvent.cli.options import parse_configs
from texvent.runtime.jit import kernel_folder
from texvent.runtime.memory import machine_bytes

DESCRIPTION = """Say what is installed, what is missing, and how to get it. Exit code 1 if something
needed is missing."""

DEVELOPERS = frozenset(("dev", "docs", "readers", "loaders"))
"""Extras that only the makers of texvent need."""
MODULES = {"opencv-python-headless": "cv2", "pyyaml": "yaml", "tomli-w": "tomli_w"}
"""Packages whose module has another name."""


@dataclass(frozen=True)
class ReportLine:
    """One line of the report."""

    name: str
    is_fine: bool
    state: str
    remedy: str = ""


def run(arguments: Sequence[str]) -> int:
    """Print the report; returns 0 if everything texvent needs is there, else 1."""
    parse_configs(arguments, {}, prog="texvent doctor", description=DESCRIPTION)
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


def examine() -> list[ReportLine]:
    """Everything worth knowing about this installation."""
    findings = [_python(), ReportLine("texvent", True, full_version())]
    findings += [_package(name) for name in _required("")]
    findings += [_encoder(), _processors(), _folder("current folder", Path.cwd())]
    findings += [_kernels()]
    extras = metadata.metadata("texvent").get_all("Provides-Extra") or []
    findings += [_extra(name) for name in extras if name not in DEVELOPERS]
    return findings


def _required(extra: str) -> list[str]:
    """Packages that texvent needs, or those of an extra; parts of texvent are left out."""
    names = []
    for line in metadata.requires("texvent") or []:
        of = re.search(r"extra == [\"'](.+?)[\"']", line)
        name = re.match(r"[\w.-]+", line)
        if name and (of[1] if of else "") == extra and name[0] != "texvent":
            names.append(name[0])
    return names


def _python() -> ReportLine:
    is_fine = sys.version_info >= (3, 11)
    state = f"{platform.python_version()} on {platform.system()} {platform.machine()}"
    return ReportLine("Python", is_fine, state, "" if is_fine else "install Python 3.11 or newer")


def _package(name: str) -> ReportLine:
    try:
        version = metadata.version(name)
        importlib.import_module(MODULES.get(name, name.replace("-", "_")))
    except ImportError as error:
        return ReportLine(name, False, f"cannot be imported: {error}", install_command(name))
    return ReportLine(name, True, version)


def _extra(name: str) -> ReportLine:
    """Row of an optional part, with how to install it."""
    missing = [package for package in _required(name) if not _is_installed(package)]
    if not missing:
        return ReportLine(f"[{name}]", True, "here")
    state = f"not here: {', '.join(missing)}"
    return ReportLine(f"[{name}]", True, state, install_command(f"texvent[{name}]"))


def _is_installed(package: str) -> bool:
    try:
        metadata.version(package)
    except metadata.PackageNotFoundError:
        return package == "backports.zstd" and sys.version_info >= (3, 14)
    return True


def _encoder() -> ReportLine:
    """Whether videos can be written: some builds of FFmpeg have no H.264 encoder."""
    try:
        av = importlib.import_module("av")
        av.codec.Codec("libx264", "w")
    except ImportError:
        return ReportLine("H.264 encoder", False, "PyAV is missing", install_command("av"))
    except ValueError:
        remedy = install_command("--force-reinstall", "--only-binary", ":all:", "av")
        return ReportLine("H.264 encoder", False, "PyAV was built without libx264", remedy)
    return ReportLine("H.264 encoder", True, "libx264")


def _processors() -> ReportLine:
    size = machine_bytes()
    memory = "memory unknown" if size is None else f"{size / 2**30:.0f} GB memory"
    return ReportLine("processors", True, f"{os.cpu_count()} cores, {memory}")


def _kernels() -> ReportLine:
    """Folder of compiled functions."""
    folder = kernel_folder()
    if folder is None or folder.is_relative_to(tempfile.gettempdir()):
        remedy = "name a folder that can be written with NUMBA_CACHE_DIR"
        state = "kept nowhere" if folder is None else f"kept in {folder.parent} for now"
        return ReportLine("compiled functions", True, state, remedy)
    state = "beside the package" if folder.name == "__pycache__" else f"in {folder.parent}"
    return ReportLine("compiled functions", True, f"kept {state}")


def _folder(name: str, path: Path) -> ReportLine:
    free = shutil.disk_usage(path).free / 2**30
    if not os.access(path, os.W_OK):
        return ReportLine(name, False, f"{path} is not writable", "go to another folder, or use -o")
    is_fine = free > 0.1
    return ReportLine(name, is_fine, f"{free:.1f} GB free", "" if is_fine else "free some space")
