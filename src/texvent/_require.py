"""Optional packages: import them when used, and name the exact command when one is missing."""

from __future__ import annotations

import importlib
import sys
from types import ModuleType

from texvent.errors import MissingDependencyError, one_line


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
        raise MissingDependencyError(
            f"{module} is needed here and could not be imported ({one_line(error)}); "
            f"install it with: pip install '{target}'"
        ) from error
