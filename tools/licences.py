"""Licences of the packages that texvent installs: checked, and listed on a page of the site.

    python -m tools.licences VENV ...   every package there has an allowed licence

`docs/site/making.py` writes the page from the environments of a checkout.
`licences.toml` has the allowed licences, and those that metadata do not tell. What nothing tells is
an error. Only metadata are read: a wheel may hold libraries that they do not name.
"""

from __future__ import annotations

import argparse
import re
import sys
import tomllib
from collections import defaultdict
from importlib.metadata import Distribution, distributions
from pathlib import Path
from typing import NamedTuple

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).parents[1]
RULES = tomllib.loads((ROOT / "tools" / "licences.toml").read_text(encoding="utf-8"))
OWN = ("texvent", "texvent-lab")

OPENING = """\
# Licences

Packages that texvent and its extras install, with the licences that they state, in the versions of
`constraints.txt` on Linux x86_64.

* `make licences` fails on a package whose licence is not in `tools/licences.toml`, such as GPL,
  AGPL, non-commercial or unknown ones. CI runs it over every environment that it makes.
* `make docs` writes this page from the environments of the checkout.
* A wheel may hold libraries of others under licences that its metadata do not tell. The table says
  what we know of them. PyAV's wheels hold x264 and x265, under the GPL, and texvent writes .mp4
  files by x264. Who passes on PyAV's wheel passes them on too; texvent's wheel holds neither.
* Readers of event files under the GPL are installed by `make test-gpl` alone. Programs that
  maintainers run, such as `reuse` and `hadolint`, may be under the GPL too; they have environments
  of their own (`make licences`, `make lint-workflows`). texvent imports none of these.

"""


class Package(NamedTuple):
    """A distribution in an environment."""

    name: str
    version: str
    licence: str | None
    """SPDX expression; None if nothing tells it."""
    requires: tuple[str, ...]


def environment(folder: Path) -> dict[str, Package]:
    """The packages of a virtual environment, by canonical name."""
    sites = [str(path) for path in folder.glob("lib/python3*/site-packages")]
    if not sites:
        raise SystemExit(f"error: {folder} is no virtual environment; name one that make has made")
    found = [describe(one) for one in distributions(path=sites)]
    return {package.name: package for package in found}


def describe(distribution: Distribution) -> Package:
    """What the metadata of a distribution say of it."""
    fields = distribution.metadata
    name = canonicalize_name(fields["Name"])
    classifiers = [
        text for text in fields.get_all("Classifier", []) if text.startswith("License ::")
    ]
    expression, field = (fields.get_all(key) for key in ("License-Expression", "License"))
    licence = licence_of(
        name, expression[0] if expression else None, field[0] if field else None, classifiers
    )
    return Package(name, distribution.version, licence, tuple(distribution.requires or ()))


def licence_of(
    name: str, expression: str | None, field: str | None, classifiers: list[str]
) -> str | None:
    """The SPDX expression of a package: as it states it, as translated, or as read by us."""
    if expression:
        return expression
    if name in RULES["read"]:
        return str(RULES["read"][name])
    field = (field or "").strip()
    if is_expression(field):
        return field
    names = RULES["names"]
    if field in names:
        return str(names[field])
    translated = [names.get(text) for text in classifiers if text.count("::") > 1]
    if not translated or None in translated:
        return None
    return " OR ".join(translated)


def is_expression(text: str) -> bool:
    """Whether all words of a text are licences of `allowed`, or what joins them."""
    known = {word for licence in RULES["allowed"] for word in licence.split()}
    words = re.findall(r"[^\s()]+", text)
    return bool(words) and all(word in known or word in ("AND", "OR") for word in words)


def is_allowed(expression: str) -> bool:
    """Whether an SPDX expression is: all parts of AND, one part of OR, WITH as one licence."""
    tokens = re.findall(r"[()]|[^\s()]+(?:\s+WITH\s+[^\s()]+)?", expression)
    value = _either(tokens)
    return value and not tokens


def _either(tokens: list[str]) -> bool:
    value = _both(tokens)
    while tokens[:1] == ["OR"]:
        tokens.pop(0)
        value |= _both(tokens)
    return value


def _both(tokens: list[str]) -> bool:
    value = _one(tokens)
    while tokens[:1] == ["AND"]:
        tokens.pop(0)
        value &= _one(tokens)
    return value


def _one(tokens: list[str]) -> bool:
    if tokens[:1] == ["("]:
        tokens.pop(0)
        value = _either(tokens)
        return tokens[:1] == [")"] and bool(tokens.pop(0)) and value
    return bool(tokens) and " ".join(tokens.pop(0).split()) in RULES["allowed"]


def faults(packages: dict[str, Package]) -> list[str]:
    """A line for each package whose licence is unknown or not allowed."""
    lines = []
    for package in packages.values():
        if package.licence is None:
            lines.append(
                f"{package.name} {package.version}: its metadata tell no licence; read its "
                "licence file and add it to [read] in tools/licences.toml"
            )
        elif not is_allowed(package.licence):
            lines.append(
                f"{package.name} {package.version}: {package.licence} is not allowed; use "
                "another package, or see CONTRIBUTING.md"
            )
    return lines


def needed_by(packages: dict[str, Package], extras: dict[str, list[str]]) -> dict[str, set[str]]:
    """For each package of the environments, the parts of texvent that install it."""
    users: dict[str, set[str]] = defaultdict(set)
    for part, requirements in extras.items():
        pending = [(text, "") for text in requirements]
        seen: set[tuple[str, str]] = set()
        while pending:
            text, extra = pending.pop()
            requirement = Requirement(text)
            name = canonicalize_name(requirement.name)
            if requirement.marker and not requirement.marker.evaluate({"extra": extra}):
                continue
            users[name].add(part)
            for wanted in ("", *requirement.extras):
                if (name, wanted) not in seen:
                    seen.add((name, wanted))
                    pending += [(needed, wanted) for needed in requires(name, packages)]
    for own in OWN:
        users.pop(own, None)
    return users


def requires(name: str, packages: dict[str, Package]) -> tuple[str, ...]:
    """What a package requires; nothing if no environment has it."""
    return packages[name].requires if name in packages else ()


def parts_of_texvent() -> dict[str, list[str]]:
    """Requirements of the base and of each extra, and those of the laboratory."""
    parts: dict[str, list[str]] = {}
    for folder, base, prefix in ((".", "base", ""), ("lab", "lab", "lab ")):
        text = (ROOT / folder / "pyproject.toml").read_text(encoding="utf-8")
        project = tomllib.loads(text)["project"]
        own = [one for one in project["dependencies"] if one not in OWN]
        extras = project["optional-dependencies"].items()
        parts |= {base: own, **{prefix + name: needed for name, needed in extras}}
    return parts


def page(packages: dict[str, Package]) -> str:
    """The page of licences."""
    users = needed_by(packages, parts_of_texvent())
    rows, unseen = [], []
    for name in sorted(users):
        parts = "base" if "base" in users[name] else ", ".join(sorted(users[name]))
        if name not in packages:
            unseen.append(f"{name} ({parts})")
            continue
        package = packages[name]
        licence, note = str(package.licence), RULES["notes"].get(name)
        rows.append(
            f"| {name} | {package.version.partition('+')[0]} | {licence}"
            f"{'; ' + note if note else ''} | {parts} |"
        )
    text = OPENING + "| package | version | licence | part |\n|---|---|---|---|\n"
    text += "\n".join(rows) + "\n"
    if unseen:
        text += f"\nNot looked at, as no environment of CI installs them: {', '.join(unseen)}.\n"
    return text


def main(words: list[str] | None = None) -> int:
    """Check; 1 if a licence is not allowed."""
    parser = argparse.ArgumentParser(prog="python -m tools.licences", description=__doc__)
    parser.add_argument("environments", nargs="+", type=Path, metavar="VENV")
    arguments = parser.parse_args(words)
    packages: dict[str, Package] = {}
    for folder in arguments.environments:
        packages |= environment(folder)
    lines = faults(packages)
    if lines:
        sys.stderr.write("".join(f"error: {line}\n" for line in lines))
        return 1
    sys.stdout.write(f"{len(packages)} packages, every licence allowed\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
