"""Every error texvent raises on purpose, in one tree.

    TexventError
    ├── InputError               what the caller gave is wrong: a file, an array, a value
    │   ├── ConfigError          an option, preset or config file is wrong
    │   └── FileFormatError      a file is damaged or not what its name says
    ├── OutputError              a result cannot be written: exists, no folder, disk full
    └── MissingDependencyError   an optional package is not installed

A message says what was wrong, the value, what is allowed and what to do. The command line
prints it as one line and exits with `exit_code`; it never shows a traceback for these.
"""


class TexventError(Exception):
    """Base of all errors that texvent raises on purpose."""

    exit_code: int = 1


class InputError(TexventError, ValueError):
    """What the caller gave cannot be used: a missing file, a NaN, a wrong shape."""

    exit_code = 2


class ConfigError(InputError):
    """An option, a preset name or a config file is wrong."""


class FileFormatError(InputError):
    """A file is damaged, truncated, or not of the format its name claims."""


class OutputError(TexventError):
    """A result cannot be written: it exists already, or its folder or disk refuses it."""

    exit_code = 3


class MissingDependencyError(TexventError, ImportError):
    """An optional package is needed and not installed."""

    exit_code = 4
