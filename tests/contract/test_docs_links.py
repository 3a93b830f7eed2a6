"""Every relative link in the pages leads to a file, and to a heading where it names one.

Pages and code name other pages by path too, SECURITY.md its tests; those paths exist.
"""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
MADE = ("licences", "results", "_build", "gallery")
"""Pages and folders of docs/ that `make docs` writes."""
PAGES = [
    *sorted(ROOT.glob("*.md")),
    *(
        path
        for path in sorted((ROOT / "docs").rglob("*.md"))
        if path.relative_to(ROOT / "docs").with_suffix("").parts[0] not in MADE
    ),
]
LINK = re.compile(r"\]\(([^)\s]+)\)")
CODE = re.compile(r"^```.*?^```$|`[^`\n]*`", re.MULTILINE | re.DOTALL)
MENTION = re.compile(r"\bdocs/[\w/-]+\.md\b")
IMPORT = re.compile(r"^ *from (texvent[\w.]*) import ([\w, ]+)", re.MULTILINE)
HEADING = re.compile(r"^#+ (.+)$", re.MULTILINE)


def links(page: Path) -> list[str]:
    return LINK.findall(CODE.sub("", page.read_text(encoding="utf-8")))


def anchors(page: Path) -> set[str]:
    """The anchors that GitHub makes of a page's headings."""
    text = re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.M | re.S)
    return {
        re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
        for heading in HEADING.findall(text)
    }


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_to_files_and_headings(page):
    for link in links(page):
        if re.match(r"[a-z]+:", link):
            continue
        path, _, anchor = link.partition("#")
        target = (page.parent / path).resolve() if path else page
        assert target.exists(), f"{page.name} links {link}, which is not there"
        if anchor:
            assert anchor in anchors(target), f"{page.name} links {link}: no such heading"


@pytest.mark.parametrize("folder", ["src", "lab", "tests", "docs"])
def test_pages_that_files_name_exist(folder):
    files = [path for path in (ROOT / folder).rglob("*") if path.suffix in (".py", ".md", ".toml")]
    named = {
        (page, str(path.relative_to(ROOT)))
        for path in files
        for page in MENTION.findall(path.read_text(encoding="utf-8"))
    }
    assert not [(page, file) for page, file in sorted(named) if not (ROOT / page).exists()]


def imports(page: Path) -> list[tuple[str, str]]:
    """The module and name of every `from texvent... import ...` in a page, run or not."""
    statements = IMPORT.findall(page.read_text(encoding="utf-8"))
    return [(module, name) for module, names in statements for name in re.findall(r"\w+", names)]


@pytest.mark.parametrize(
    ("module", "name"), sorted({one for page in PAGES for one in imports(page)})
)
def test_names_that_pages_import_exist(module, name):
    """Read from the source: some of these modules need torch or Triton."""
    source = "lab/src" if module.startswith("texvent_lab") else "src"
    path = ROOT / source / Path(*module.split("."))
    file = path / "__init__.py" if path.is_dir() else path.with_suffix(".py")
    text = next(path.glob("__init__.pyi"), file).read_text(encoding="utf-8")
    assert re.search(rf"\b{name}\b", text) or (path / f"{name}.py").exists()


PROMISES = [
    line.split("|")[1:3]
    for line in (ROOT / "SECURITY.md").read_text("utf-8").splitlines()
    if "`tests/" in line
]


@pytest.mark.parametrize(("promise", "tests"), PROMISES, ids=[str(n) for n in range(len(PROMISES))])
def test_every_promise_names_tests_that_exist(promise, tests):
    named = re.findall(r"`([^`]+)`", tests)
    assert named
    assert [one for one in named if not (ROOT / one).exists()] == []
    assert promise.strip().endswith((".", ")"))
