"""The hashed requirements: they agree with constraints.txt and pyproject.toml, and name no host."""

import re
import tomllib
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).parents[2]
FILES = sorted((ROOT / "requirements").glob("*.txt"))
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
REMEDY = "run make requirements"


def pins(text: str) -> dict[str, set[str]]:
    """The versions of each package; more than one if they depend on the interpreter."""
    found: dict[str, set[str]] = {}
    for line in text.splitlines():
        if match := re.match(r"([\w.-]+)==([^\s;]+)", line):
            found.setdefault(canonicalize_name(match[1]), set()).add(match[2])
    return found


CONSTRAINTS = pins((ROOT / "constraints.txt").read_text(encoding="utf-8"))


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_versions_are_those_of_the_constraints(path):
    hashed = pins(path.read_text(encoding="utf-8"))
    # What only other systems install (colorama on Windows) may have no constraint.
    differing = {
        name: versions for name, versions in hashed.items() if name in CONSTRAINTS
        and versions != CONSTRAINTS[name]
    }  # fmt: skip
    assert not differing, REMEDY
    assert set(hashed) - set(CONSTRAINTS) <= {"cffi", "colorama", "pycparser", "pywin32-ctypes"}


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_every_package_has_hashes_and_no_host_is_named(path):
    text = path.read_text(encoding="utf-8")
    assert "://" not in text
    blocks = re.split(r"^(?=[\w.-]+==)", text, flags=re.MULTILINE)
    assert not blocks[0]
    for block in blocks[1:]:
        assert re.search(r"--hash=sha256:[0-9a-f]{64}", block), block


@pytest.mark.parametrize(
    ("stem", "requirements"),
    [
        ("base", PROJECT["project"]["dependencies"]),
        ("test", PROJECT["project"]["dependencies"]),
        ("test", PROJECT["project"]["optional-dependencies"]["dev"]),
        ("readers", PROJECT["project"]["optional-dependencies"]["readers"]),
        ("build", PROJECT["build-system"]["requires"]),
    ],
    ids=["base", "base in test", "dev in test", "readers", "build"],
)
def test_what_the_project_requires_is_pinned(stem, requirements):
    hashed = pins((ROOT / "requirements" / f"{stem}.txt").read_text(encoding="utf-8"))
    for text in requirements:
        requirement = Requirement(text)
        versions = hashed.get(canonicalize_name(requirement.name), set())
        assert versions, f"{text}: {REMEDY}"
        assert all(version in requirement.specifier for version in versions), REMEDY
