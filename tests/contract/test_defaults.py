"""The defaults of the public functions and methods, pinned: they are part of the API.

python -m tests.contract.test_defaults   # writes them anew; CHANGELOG.md must say why
"""

import ast
import inspect
from collections.abc import Iterator
from pathlib import Path

import texvent
import texvent_scenes

STORED = Path(__file__).with_name("defaults.txt")
FOLDERS = [Path(one.__path__[0]) for one in (texvent, texvent_scenes)]


def public_callables() -> Iterator[tuple[str, object]]:
    """Functions, classes and their methods, with the names that callers use."""
    for name in sorted({*texvent.__all__} - {"training"}):  # which needs torch
        one = getattr(texvent, name)
        for part, value in inspect.getmembers(one) if inspect.ismodule(one) else [("", one)]:
            is_own = getattr(value, "__module__", "").startswith("texvent") and part[:1] != "_"
            if not is_own or (inspect.isclass(value) and issubclass(value, Exception)):
                continue
            path = f"{name}.{part}".rstrip(".")
            own = inspect.getmembers(value) if inspect.isclass(value) else []
            methods = ((f"{path}.{key}", each) for key, each in own if key[0] != "_")
            yield from (one for one in ((path, value), *methods) if callable(one[1]))


def lines_of_defaults() -> list[str]:
    lines = []
    for name, value in public_callables():
        parameters = inspect.signature(value).parameters.values()
        said = [
            f"{one.name}={getattr(one.default, '__name__', repr(one.default))}"
            for one in parameters
            if one.default is not one.empty
        ]
        lines += [f"{name}: {', '.join(said)}"] if said else []
    return lines


def test_defaults_of_the_api_are_as_stored():
    assert lines_of_defaults() == STORED.read_text(encoding="utf-8").splitlines()


def test_nothing_replaces_files_unasked():
    found = []
    for path in (each for folder in FOLDERS for each in folder.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            pairs = list[tuple[str, ast.expr | None]]()
            if isinstance(node, ast.arguments):
                names = [one.arg for one in (*node.posonlyargs, *node.args)]
                pairs += zip((one.arg for one in node.kwonlyargs), node.kw_defaults, strict=True)
                pairs += zip(names[::-1], node.defaults[::-1], strict=False)
            if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
                pairs.append((node.target.id, node.value))
            values = [value for name, value in pairs if name == "overwrite"]
            found += [(path.name, each) for each in values if isinstance(each, ast.Constant)]
    assert len(found) > 15
    assert [name for name, each in found if each.value is not False] == []


if __name__ == "__main__":
    STORED.write_text("\n".join(lines_of_defaults()) + "\n", encoding="utf-8")
