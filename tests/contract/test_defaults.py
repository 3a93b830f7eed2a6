"""The defaults of the public functions and methods, pinned: they are part of the API.

python -m tests.contract.test_defaults   # writes them anew; CHANGELOG.md must say why
"""

import inspect
from collections.abc import Iterator
from pathlib import Path

import texvent

STORED = Path(__file__).with_name("defaults.txt")


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


if __name__ == "__main__":
    STORED.write_text("\n".join(lines_of_defaults()) + "\n", encoding="utf-8")
