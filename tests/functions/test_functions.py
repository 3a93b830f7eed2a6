"""Functions give what they gave, at values of all their types."""

import importlib
import signal
from itertools import zip_longest

import pytest
from tests.functions.calls import TABLE, found_by_a_process, read


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="calls are stopped by a timer")
def test_every_public_function_gives_what_it_gave():
    """`python -m tests.functions.calls` writes the table anew, or prints calls of the one named."""
    stored, found = read(TABLE), found_by_a_process()
    changed = {}
    for name in stored.keys() | found.keys():
        pairs = zip_longest(*(table.get(name, "none").split() for table in (stored, found)))
        if differing := [number for number, (old, new) in enumerate(pairs) if old != new]:
            changed[name] = differing
    for name in stored.keys() - found.keys():
        changed.pop(name, None) if is_absent(name) else None
    assert changed == {}, "numbers of the calls with another outcome"


def is_absent(name: str) -> bool:
    """Whether the module of a function needs a package that is not installed."""
    try:
        importlib.import_module(name.rpartition(".")[0])
    except ImportError as error:
        return not str(error.name).startswith("texvent")
    return False
