"""Optional packages: import them when used, and name the exact command when one is missing."""

from __future__ import annotations

import importlib
import importlib.util
import json
import shlex
import shutil
import sys
from collections.abc import Iterable
from importlib import metadata
from pathlib import Path
from types import ModuleType

from texvent.errors import MissingDependencyError, one_line

CHECKOUT = Path(__file__).parents[2]
"""Folder of the repository, where the package runs from one."""


def require(module: str, *, extra: str | None = None) -> ModuleType:
    """Import `module`, or say what to install.

    Args:
        module: dotted module name, such as `"torch"`.
        extra: the texvent extra that brings it, or None for a base dependency; or the extra of
            another package, as `"package[extra]"`.

    Returns:
        The imported module.

    Raises:
        MissingDependencyError: the module is not installed.
    """
    known = sys.modules.get(module)
    if known is not None:  # torch.compile follows this, but no import
        return known
    try:
        return importlib.import_module(module)
    except ImportError as error:
        target = "texvent" if extra is None else extra if "[" in extra else f"texvent[{extra}]"
        is_lab = target.startswith("texvent-lab[")
        way = lab_command(target.removeprefix("texvent-lab")) if is_lab else install_command(target)
        raise MissingDependencyError(
            f"{module} is needed here and could not be imported ({one_line(error)}); "
            f"install it with: {way}"
        ) from error


def find_missing(modules: Iterable[str]) -> str | None:
    """The first of some modules that is not installed; nothing is imported."""
    return next((one for one in modules if importlib.util.find_spec(one) is None), None)


def install_command(*words: str) -> str:
    """The command by which the running Python installs packages.

    It names this Python where `pip` on the PATH is another's: that one finds no texvent.
    """
    found = shutil.which("pip")
    is_ours = found is not None and Path(found).parent == Path(sys.executable).parent
    pip = "pip" if is_ours else shlex.join([sys.executable or "python", "-m", "pip"])
    return f"{pip} install {shlex.join(words)}"


def reinstall_command() -> str:
    """The command that installs texvent anew, from where it came."""
    if (CHECKOUT / "pyproject.toml").is_file():
        return install_command("-e", str(CHECKOUT))
    try:
        note = metadata.distribution("texvent").read_text("direct_url.json")
    except metadata.PackageNotFoundError:
        note = None
    source = json.loads(note or "{}").get("url", "texvent")
    return install_command("--force-reinstall", "--no-deps", source)


def lab_command(extras: str = "") -> str:
    """The command that installs the laboratory, which no registry has, and extras, as "[train]"."""
    if (CHECKOUT / "lab").is_dir():
        return install_command("-e", f"{CHECKOUT / 'lab'}{extras}")
    local = install_command(f"./lab{extras}")
    return f"{local} in a clone of texvent's repository, or from the wheel texvent_lab-*.whl"
