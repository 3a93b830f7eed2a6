"""Every error texvent raises on purpose, in one tree.

    TexventError
    ├── InputError               what the caller gave is wrong: a file, an array, a value
    │   ├── ConfigError          an option, preset or config file is wrong
    │   └── FileFormatError      a file is damaged or not what its name says
    ├── OutputError              a result cannot be written: exists, no folder, disk full
    └── MissingDependencyError   an optional package is not installed

A message says what was wrong, the value, what is allowed and what to do. The command line
prints it as one line and exits with `exit_code`; it never shows a traceback for these. An option
has one name in messages, config files and Python: `white_level`; its flag is `--white-level`.
Echoes of a file or a caller go through `shown`, those of a library's message through `one_line`:
both are bounded, so that a hostile file cannot fill the terminal.

A `TexventWarning` is issued when a result is probably not what the user wanted.
"""

from __future__ import annotations

import contextlib
import re
import reprlib
import sys
import warnings
from collections.abc import Callable, Iterator, Sequence
from typing import Any

MAX_SHOWN = 80
"""Characters of a value that an error echoes."""
MOST_WORDS = 5
"""Words of a list that a message names."""
MAX_WORD = 40
"""Characters of each."""
MAX_REASON = 120
"""Characters of what a library says."""
HIDDEN = re.compile(r"[\x00-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]")
"""Control characters, which begin a terminal's commands; line ends; marks that turn text around."""


def shown(value: object) -> str:
    """A value as errors echo it: as `repr` writes it, on one line, its middle left out if long.

    Example:
        >>> shown("v3e"), len(shown("x" * 5000))
        ("'v3e'", 80)
    """
    try:
        # NumPy's numbers as they print.
        is_number = getattr(value, "ndim", None) == 0 and hasattr(value, "item")
        value = value.item() if is_number else value  # type: ignore[attr-defined]
        value = _without_passwords(value) if isinstance(value, str) else value
        # Never the whole: a few aliases in a YAML file print as gigabytes.
        text = " ".join(_SHORT.repr(value).split())
    except Exception:  # noqa: BLE001  # such as numbers of too many digits; repr is anyone's code
        return f"a value of type {type(value).__name__}"
    return text if len(text) <= MAX_SHOWN else f"{text[: MAX_SHOWN - 4]}...{text[-1]}"


def visible(text: str) -> str:
    r"""The text with what a terminal would obey written out; ordinary Unicode stays.

    Example:
        >>> visible("zwölf 🦩"), visible("a\x1b[31m\nb")
        ('zwölf 🦩', 'a\\u001b[31m\\u000ab')
    """
    return HIDDEN.sub(lambda match: f"\\u{ord(match[0]):04x}", text)


def visible_lines(text: str) -> str:
    """`visible` of every line; the line ends stay."""
    return "\n".join(map(visible, text.split("\n")))


def is_address(text: str) -> bool:
    """True for an address such as rtsp://..., and not for a path."""
    return _SCHEME.match(text) is not None and not text.startswith("file:")


def without_password(address: str) -> str:
    """An address as it is shown and stored: without user, password, and all that may be a token.

    Example:
        >>> without_password("rtsp://me:p@ss@camera/stream?channel=1")
        'rtsp://camera/stream...'
    """
    scheme = _SCHEME.match(address)
    if scheme is None:
        return address
    begin, rest = scheme[0], address[scheme.end() :]
    user, at, after = rest.rpartition("@")
    # After a host without a port, an @ may be part of a name.
    if at and not re.fullmatch(r"[\w-]+(\.[\w-]+)+/[^@:]*", user):
        rest = after
    host = re.match(r"(\[[\da-fA-F:.%]+\]|[\w.-]*)(:\d*)?(?=[/?#;]|$)", rest)
    if host is None:
        return f"{begin}..."
    kept = re.split(r"[?#;=&]|%3[bdfBDF]|%2[36]", rest, maxsplit=1)
    return begin + kept[0] + ("..." if len(kept) > 1 else "")


def _without_passwords(text: str) -> str:
    """A message, the addresses in it without what is secret."""
    return _SECRETS.sub(lambda match: without_password(match[0]), text)


_SCHEME = re.compile(r"([A-Za-z][A-Za-z0-9+.-]{1,20}:){1,3}/+")
"""Begin of an address; a `Path` has one / of it, and a letter alone is a drive of Windows."""
_SECRETS = re.compile(rf"{_SCHEME.pattern}\S{{0,2000}}([@=]|%3[dD]|%40)[^\s'\"]{{0,2000}}")


def few(words: Sequence[str], most: int = MOST_WORDS, longest: int = MAX_WORD) -> str:
    """The first words of a list, each bounded, and how many more there are.

    Example:
        >>> few(["a", "b"]), few(list("abcdefgh"))
        ('a, b', 'a, b, c, d, e and 3 more')
    """
    first, more = words[:most], len(words) - most
    bounded = (one if len(one) <= longest else f"{one[: longest - 3]}..." for one in first)
    return ", ".join(bounded) + (f" and {more} more" if more > 0 else "")


def one_line(error: BaseException) -> str:
    """Message of a library's error as one short line; its type where it has none."""
    text = " ".join(str(error)[: 2 * MAX_REASON].split())
    return (text if len(text) <= MAX_REASON else f"{text[: MAX_REASON - 3]}...") or type(
        error
    ).__name__


def _short_repr() -> reprlib.Repr:
    short = reprlib.Repr()
    short.maxlevel = 3
    short.maxstring = short.maxother = MAX_SHOWN
    return short


_SHORT = _short_repr()


class TexventError(Exception):
    """Base of all errors that texvent raises on purpose.

    Example:
        >>> import texvent
        >>> try:
        ...     events = texvent.load("lost.h5")
        ... except texvent.TexventError as error:
        ...     print(error, error.exit_code)
        no such file: lost.h5; check the name and the folder 2
    """

    exit_code: int = 1

    def __init__(self, message: object = "", *more: Any, **facts: Any) -> None:
        """Keep the message, its line breaks as spaces."""
        text = _without_passwords(" ".join(f"{message}".splitlines()))
        super().__init__(text, *more, **facts)


class InputError(TexventError, ValueError):
    """Input that cannot be used: a missing file, a NaN, a wrong shape.

    Example:
        >>> import texvent
        >>> texvent.load("lost.h5")
        Traceback (most recent call last):
            ...
        texvent.errors.InputError: no such file: lost.h5; check the name and the folder
    """

    exit_code = 2


class ConfigError(InputError):
    """An option, a preset name or a config file is wrong.

    Example:
        >>> import texvent
        >>> texvent.EventStream.empty("8x0")
        Traceback (most recent call last):
            ...
        texvent.errors.ConfigError: sensor size 8x0; each side must be 1..65535
    """


class FileFormatError(InputError):
    """A file is damaged, truncated, or not of the format its name claims.

    Example:
        >>> import pathlib, texvent
        >>> size = pathlib.Path("cut.npz").write_bytes(b"PK")
        >>> try:
        ...     texvent.load("cut.npz")
        ... except texvent.FileFormatError as error:
        ...     print(error)
        cut.npz is damaged or not a NumPy archive (File is not a zip file)
    """


class OutputError(TexventError):
    """A result cannot be written: it exists already, or its folder or disk refuses it.

    Example:
        >>> import texvent
        >>> path = texvent.EventStream.empty("8x6").save("none.npz")
        >>> try:
        ...     texvent.EventStream.empty("8x6").save("none.npz")
        ... except texvent.OutputError as error:
        ...     print(error)
        none.npz exists already; choose another name, or --overwrite (overwrite=True in Python)
    """

    exit_code = 3


class MissingDependencyError(TexventError, ImportError):
    """An optional package is needed and not installed.

    Example:
        >>> import texvent
        >>> issubclass(texvent.MissingDependencyError, ImportError)
        True
    """

    exit_code = 4


class TexventWarning(UserWarning):
    """Issued when a result was produced but is probably not what the user wanted.

    The command line shows it as one line; `warnings.simplefilter("error", texvent.TexventWarning)`
    makes it an error.

    Example:
        >>> import texvent, warnings
        >>> warnings.simplefilter("error", texvent.TexventWarning)
        >>> texvent.EventStream.from_columns([3], [0], [10], [1], size="8x6").between(9, 9)
        Traceback (most recent call last):
            ...
        texvent.errors.TexventWarning: the range from 9 to 9 µs is empty
    """


_listeners: list[Callable[[str], None]] = []


@contextlib.contextmanager
def warnings_to(listener: Callable[[str], None]) -> Iterator[None]:
    """Give the texts of texvent's warnings to a function inside the block.

    Unlike `warnings.catch_warnings` this holds while other threads compile kernels.
    """
    _listeners.append(listener)
    try:
        yield
    finally:
        _listeners.remove(listener)


def warn(message: str) -> None:
    """Issue a `TexventWarning` that points at the first line outside texvent."""
    message = _without_passwords(message)
    if _listeners:
        _listeners[-1](message)
        return
    level = 2
    frame = sys._getframe(1)
    while frame.f_back is not None and _is_own(frame.f_globals.get("__name__", "")):
        frame = frame.f_back
        level += 1
    warnings.warn(message, TexventWarning, stacklevel=level)


def _is_own(module: str) -> bool:
    return module == "texvent" or module.startswith("texvent.")
