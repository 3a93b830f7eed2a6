"""Names of devices: auto, cpu, cuda, or a numbered GPU. Light, because configurations need them."""

from __future__ import annotations

import re
from typing import Any

from texvent.errors import ConfigError, shown

AUTO, CPU = "auto", "cpu"
_NAME = re.compile("auto|cpu|cuda(:(0|[1-9][0-9]?))?")


def check_device_name(value: Any, option: str = "device") -> str:
    """The name of a device.

    Args:
        value: a name, or a torch.device.
        option: of what, for the message.

    Raises:
        ConfigError: it is none.
    """
    if _NAME.fullmatch(str(value)):
        return str(value)
    raise ConfigError(
        f"{option} is {shown(value)}; it must be auto, cpu, cuda or a numbered GPU such as cuda:1"
    )
