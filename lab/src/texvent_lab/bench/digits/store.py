"""Results of steps in a folder, each under the digest of all that it depends on.

A step that is there is not made again, so a run that was killed goes on, and a run with more
networks computes those alone.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from texvent import __version__
from texvent.extending import full_version
from texvent.runtime.cache_folder import make_folder
from texvent_lab.bench.document import read_document, write_document

PROTOCOL = 1
"""Part of every digest: raise it when a step computes something else from the same config."""
DIGITS = 20
"""Of a digest, hexadecimal."""


def digest_of(*values: Any) -> str:
    """A name for plain values and bytes."""
    found = hashlib.sha256()
    for value in values:
        content = value if isinstance(value, bytes) else json.dumps(value, sort_keys=True).encode()
        found.update(hashlib.sha256(content).digest())
    return found.hexdigest()[:DIGITS]


@dataclass(frozen=True)
class Step:
    """A result, made or to be made."""

    folder: Path
    kind: str
    """What it is, such as "sets"; a folder of that name holds it."""
    config: Mapping[str, Any]
    """All that it depends on, beside the release of texvent and `PROTOCOL`."""

    @property
    def digest(self) -> str:
        """Its name."""
        return digest_of(__version__, PROTOCOL, self.kind, self.config)

    def path(self, extension: str) -> Path:
        """Its file."""
        return self.folder / self.kind / f"{self.digest}{extension}"

    @property
    def is_done(self) -> bool:
        """Whether its values were written, which comes last."""
        return self.path(".json").is_file()

    def write(self, values: Mapping[str, Any]) -> None:
        """Write its values."""
        make_folder(self.path("").parent)
        document = {"version": full_version(), "config": self.config, **values}
        write_document(self.path(".json"), document, overwrite=True)

    def read(self) -> dict[str, Any]:
        """Its values."""
        return read_document(self.path(".json"))
