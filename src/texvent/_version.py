"""The version, in one place; of a build between releases, with its commit."""

from __future__ import annotations

import functools
import json
import subprocess
from importlib import metadata
from pathlib import Path

__version__ = "0.1.0"
PATIENCE_S = 10
COMMIT_DIGITS = 12


@functools.cache
def full_version() -> str:
    """The version with the commit of a source tree, or of an installation from one.

    Returns:
        Such as "0.1.0" of a release, "0.1.0+g1a2b3c4d5e6f" of a commit, and
        "0.1.0+g1a2b3c4d5e6f.changes" of a source tree whose files differ from it.
    """
    commit, _, changes = (source_commit() or _installed_commit() or "").partition("+")
    if not commit:
        return __version__
    return f"{__version__}+g{commit[:COMMIT_DIGITS]}{f'.{changes}' if changes else ''}"


def source_commit() -> str | None:
    """Commit of the source tree, with "+changes" where files differ from it; None without one."""
    package = Path(__file__).parent
    # Asked for a file of ours: a package installed inside another project's tree is not its commit.
    if _git(package, "ls-files", "--error-unmatch", "_version.py") is None:
        return None
    commit = _git(package, "rev-parse", "HEAD") or ""
    changes = _git(package, "status", "--porcelain", "--untracked-files=no", ".")
    return f"{commit}+changes" if changes else commit


def _installed_commit() -> str | None:
    """Commit that pip noted of an installation from a repository (PEP 610)."""
    try:
        note = metadata.distribution("texvent").read_text("direct_url.json")
        facts = json.loads(note or "{}").get("vcs_info", {})
    except (metadata.PackageNotFoundError, ValueError, OSError):
        return None
    commit = facts.get("commit_id")
    return str(commit) if commit else None


def _git(folder: Path, *words: str) -> str | None:
    """Output of a git command, or None where git or the tree is missing."""
    command = ["git", "-C", str(folder), *words]
    try:
        done = subprocess.run(
            command, capture_output=True, encoding="utf-8", timeout=PATIENCE_S, check=False
        )
    except (OSError, subprocess.TimeoutExpired):
        return None
    return None if done.returncode else done.stdout.strip()
