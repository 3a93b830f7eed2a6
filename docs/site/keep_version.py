"""Keep the site just built beside its earlier versions: keep_version.py HTML PUBLIC."""

import json
import re
import shutil
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
REDIRECT = """<!doctype html>
<meta charset="utf-8">
<meta http-equiv="refresh" content="0; url={version}/index.html">
<title>texvent</title>
<a href="{version}/index.html">texvent {version}</a>
"""


def keep_version(html: Path, public: Path, version: str) -> list[str]:
    """Copy a site to PUBLIC/VERSION and put the version first in PUBLIC/versions.json.

    Args:
        html: folder that `make docs` wrote.
        public: folder that a server shows; made if it is missing.
        version: name of the version, such as "0.1.0".

    Returns:
        All versions, the newest first.

    Raises:
        FileNotFoundError: there is no site in `html`.
    """
    if not (html / "index.html").is_file():
        raise FileNotFoundError(f"{html} holds no index.html; run make docs first")
    public.mkdir(parents=True, exist_ok=True)
    listing = public / "versions.json"
    known = json.loads(listing.read_text(encoding="utf-8")) if listing.exists() else []
    versions = [version, *(name for name in known if name != version)]
    shutil.rmtree(public / version, ignore_errors=True)
    shutil.copytree(html, public / version)
    listing.write_text(json.dumps(versions) + "\n", encoding="utf-8")
    (public / "index.html").write_text(REDIRECT.format(version=version), encoding="utf-8")
    return versions


def main(arguments: list[str]) -> None:
    """Run from a shell, with the version of the source tree."""
    if len(arguments) != 2:
        sys.exit("usage: keep_version.py HTML PUBLIC")
    text = (ROOT / "src/texvent/_version.py").read_text(encoding="utf-8")
    version = re.findall(r'^__version__ = "(.+)"', text, re.MULTILINE)[0]
    versions = keep_version(Path(arguments[0]), Path(arguments[1]), version)
    sys.stdout.write(f"{arguments[1]}: {', '.join(versions)}\n")


if __name__ == "__main__":
    try:
        main(sys.argv[1:])
    except OSError as error:
        sys.exit(f"error: {error}")
