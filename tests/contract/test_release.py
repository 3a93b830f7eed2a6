"""What a release consists of agrees: versions, the package page, workflows, containers."""

import re
import tomllib
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
import yaml

import texvent

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
WORKFLOWS = sorted((ROOT / ".github/workflows").glob("*.yml"))
DOCKERFILES = sorted((ROOT / "containers").rglob("*Dockerfile"))


def read(path: str) -> str:
    return (ROOT / path).read_text(encoding="utf-8")


def test_the_version_is_the_same_everywhere() -> None:
    assert PROJECT["tool"]["hatch"]["version"]["path"] == "src/texvent/_version.py"
    assert yaml.safe_load(read("CITATION.cff"))["version"] == texvent.__version__
    assert tomllib.loads(read("lab/pyproject.toml"))["project"]["version"] == texvent.__version__
    comfyui = tomllib.loads(read("comfyui/texvent_nodes/pyproject.toml"))
    assert comfyui["project"]["version"] == texvent.__version__
    package = ElementTree.parse(ROOT / "ros/texvent_ros/package.xml")
    assert package.findtext("version") == texvent.__version__
    assert re.findall(r'version="(.*?)"', read("ros/texvent_ros/setup.py")) == [texvent.__version__]


def page() -> str:
    """README.md as the build rewrites it for a package page."""
    hook = PROJECT["tool"]["hatch"]["metadata"]["hooks"]["fancy-pypi-readme"]
    parts = []
    for fragment in hook["fragments"]:
        text = fragment.get("text") or read(fragment["path"])
        for edge, keeps in (("start-at", slice(1, None)), ("end-before", slice(0, 1))):
            if edge in fragment:
                assert text.count(fragment[edge]) == 1
                halves = text.split(fragment[edge])
                text = (fragment[edge] if edge == "start-at" else "") + halves[keeps][0]
        parts.append(text)
    whole = "".join(parts)
    for change in hook["substitutions"]:
        whole = re.sub(change["pattern"], change["replacement"], whole)
    return whole


def test_the_package_page_has_no_link_into_the_repository() -> None:
    whole = page()
    targets = re.findall(r"\]\(([^)]*)\)", whole)
    assert [one for one in targets if not re.match("[a-z]+:", one)] == []
    assert "pip install texvent" in whole
    assert "make demo" not in whole


def test_the_first_sentence_is_shown_as_it_says_and_is_the_same_everywhere() -> None:
    found = re.search(r"^PROMPT \?= (.+)$", read("Makefile"), re.MULTILINE)
    assert found is not None
    reading = texvent.read(found[1])
    assert not reading.not_understood
    assert not reading.substituted
    assert f"![{found[1].capitalize()}: " in read("README.md")
    assert found[1] in page()
    assert f'PROMPT = \\"{found[1]}\\"' in read("docs/notebooks/first-events.ipynb")


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.name)
def test_workflows_run_pinned_actions_with_few_rights(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    workflow: dict[str, Any] = yaml.safe_load(text)
    assert workflow["permissions"] == {}
    uses = re.findall(r"uses: (.*)", text)
    assert uses
    assert [
        one
        for one in uses
        if not one.startswith("./")
        and not re.fullmatch(r"[\w/-]+@[0-9a-f]{40} # v\d+\.\d+\.\d+", one)
    ] == []
    rights = {name: job["permissions"] for name, job in workflow["jobs"].items()}
    allowed = {"publish": {"id-token": "write"}, "announce": {"contents": "write"}}
    assert rights == {name: allowed.get(name, {"contents": "read"}) for name in rights}


@pytest.mark.parametrize("path", DOCKERFILES, ids=lambda path: f"{path.parent.name}-{path.name}")
def test_images_are_pinned_constrained_and_not_roots(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    bases = re.findall(r"^FROM (\S+)", text, flags=re.MULTILINE)
    assert len(set(bases)) == 1
    assert re.fullmatch(r"python:3\.\d+-slim-\w+@sha256:[0-9a-f]{64}", bases[0])
    assert re.findall(r"^USER (.*)", text, flags=re.MULTILINE) == ["1000"]
    assert "constraints.txt" in text
