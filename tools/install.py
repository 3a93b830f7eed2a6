"""`pip install` into an environment: by uv, in a fifth of the time, else by pip.

    .venv/bin/python -m tools.install [arguments that pip and uv share]

`make` puts uv into `.venv-uv`. It is told the index, links and certificates that pip has; what it
still cannot install, pip does, which then says why it cannot either. Files that several
environments have are one file on disk.
"""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

UV = Path(__file__).parents[1] / ".venv-uv" / "bin" / "uv"
SETTINGS = {
    "index-url": "UV_DEFAULT_INDEX",
    "extra-index-url": "UV_INDEX",
    "find-links": "UV_FIND_LINKS",
    "constraint": "UV_CONSTRAINT",
    "cert": "SSL_CERT_FILE",
}
"""Setting of pip, the same for uv."""
PATIENCE = {
    "UV_HTTP_TIMEOUT": "15",
    "UV_HTTP_RETRIES": "0",
    "UV_INDEX_STRATEGY": "unsafe-best-match",
}
"""pip is not far; and like pip, uv takes the best of all indexes."""


def settings_of(listed: str) -> Mapping[str, str]:
    """Variables of uv for what `pip config list` says."""
    found: dict[str, str] = {}
    lines = listed.splitlines()
    for place in (":env:", "site", "user", "global"):
        for line in (one for one in lines if one.startswith(f"{place}.")):
            name, _, value = line.removeprefix(f"{place}.").partition("=")
            if name in SETTINGS:
                words = value.strip("'").replace("\\n", " ").split()
                separator = "," if name == "find-links" else " "
                found.setdefault(SETTINGS[name], separator.join(words))
    return found


def install(words: Sequence[str]) -> int:
    """Install beside this interpreter; the exit code is that of pip where uv could not."""
    pip = [sys.executable, "-m", "pip"]
    if UV.exists():
        listed = subprocess.run(
            [*pip, "config", "list"], capture_output=True, text=True, check=False
        )
        environment = {**PATIENCE, **settings_of(listed.stdout), **os.environ}
        if "--require-hashes" in words:  # its files hold exact versions
            environment.pop("UV_CONSTRAINT", "")
        uv = [str(UV), "pip", "install", "--quiet", "--python", sys.executable, *words]
        done = subprocess.run(uv, env=environment, stderr=subprocess.DEVNULL, check=False)
        if done.returncode == 0:
            return 0
        sys.stderr.write("note: uv could not install it, so pip does, which takes longer\n")
    options = ("--quiet", "--disable-pip-version-check", "--no-compile")
    return subprocess.run([*pip, "install", *options, *words], check=False).returncode


if __name__ == "__main__":
    raise SystemExit(install(sys.argv[1:]))
