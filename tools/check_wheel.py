"""Install a wheel into an environment of its own, without a compiler, and run it there.

With the versions of constraints.txt a newcomer's commands are run; with the newest or the lowest
stated release of every dependency, the main commands and every small extra (`tools/smoke.py`).

Example:
    python -m tools.check_wheel dist/texvent-0.1.0-py3-none-any.whl --python python3.13
    python -m tools.check_wheel dist/texvent-0.1.0-py3-none-any.whl --releases lowest
"""

from __future__ import annotations

import argparse
import functools
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

ROOT = Path(__file__).parent.parent
CONSTRAINTS = ROOT / "constraints.txt"
SMOKE = ROOT / "tools" / "smoke.py"
EXTRAS = ("plot", "pandas", "zstd", "exr", "assets", "bags", "parquet", "blosc")
"""Those that fit: without torch, Ray and what only developers need."""
NO_COMPILER = "texvent-needs-no-compiler"
"""A program that does not exist, in place of every compiler."""
PROMPT = "a red ball bounces"
COMMANDS = (
    ("--version",),
    ("doctor",),
    ("generate", PROMPT, "--sensor", "64x48", "--duration", "0.2", "-o", "ball.h5"),
    ("info", "ball.h5"),
    ("convert", "ball.h5", "ball.aedat4"),
)
"""What a newcomer runs: the second shows that nothing is missing, the third that it works."""
IMPORT = "import texvent, sys; sys.exit('site-packages' not in texvent.__file__)"


@contextmanager
def timed(what: str) -> Iterator[None]:
    """Print how long the block took, s."""
    started = time.monotonic()
    yield
    sys.stdout.write(f"{time.monotonic() - started:7.1f} s  {what}\n")
    sys.stdout.flush()


def bare_environment(variables: Mapping[str, str]) -> dict[str, str]:
    """These variables without those that lend Python modules, and without a compiler."""
    lent = ("PYTHON", "VIRTUAL_ENV", "TEXVENT_")
    kept = {name: value for name, value in variables.items() if not name.startswith(lent)}
    compilers = dict.fromkeys(("CC", "CXX", "FC", "LD", "RUSTC", "CARGO"), NO_COMPILER)
    return {**kept, **compilers}


def lowest() -> list[str]:
    """The lowest release that pyproject.toml states of every dependency, as constraints."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    extras = (project["optional-dependencies"][name] for name in EXTRAS)
    required = [*project["dependencies"], *(one for extra in extras for one in extra)]
    return [re.sub(r">=([\w.]+)[^;]*", r"==\1", one) for one in required]


def install(
    wheel: str, folder: Path, python: str, constraints: Path, environment: Mapping[str, str]
) -> Path:
    """Make an environment in `folder` and install the wheel; returns the folder of its programs.

    Raises:
        subprocess.CalledProcessError: it cannot be installed from wheels alone.
    """
    with timed(f"an environment of {python}"):
        subprocess.run([python, "-m", "venv", str(folder)], check=True, env=environment)
    programs = folder / ("Scripts" if os.name == "nt" else "bin")
    # A newcomer has pip alone.
    pip = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    installing = pip if constraints == CONSTRAINTS else [str(ROOT / "tools" / "install.py")]
    with timed(f"pip install {wheel}"):
        command = [str(programs / "python"), *installing, "--only-binary=:all:"]
        subprocess.run([*command, "-c", str(constraints), wheel], check=True, env=environment)
    return programs


def check(wheel: Path, python: str, releases: str) -> None:
    """Install the wheel and run `COMMANDS`, or the smoke tests, in folders that are thrown away.

    Raises:
        subprocess.CalledProcessError: a step failed; its output has been shown.
    """
    with tempfile.TemporaryDirectory(prefix="texvent-wheel-") as name:
        folder = Path(name)
        # A cache of its own: kernels are compiled as on a newcomer's machine.
        environment = bare_environment(os.environ) | {"NUMBA_CACHE_DIR": str(folder / "kernels")}
        constraints, what = CONSTRAINTS, str(wheel)
        if releases != "constraints":
            constraints, what = folder / "constraints.txt", f"{wheel}[{','.join(EXTRAS)}]"
            constraints.write_text("\n".join(lowest() if releases == "lowest" else []))
        programs = install(what, folder / "environment", python, constraints, environment)
        (folder / "work").mkdir()
        run = functools.partial(subprocess.run, cwd=folder / "work", env=environment, check=True)
        run([str(programs / "python"), "-c", IMPORT])
        if releases != "constraints":
            run([str(programs / "python"), str(SMOKE)])
            return
        for words in COMMANDS:
            with timed(f"texvent {' '.join(words)}"):
                run([str(programs / "texvent"), *words])
        size = sum(file.stat().st_size for file in (folder / "environment").rglob("*"))
        sys.stdout.write(f"{size / 1e6:7.0f} MB in the environment, without links\n")


def main(words: Sequence[str]) -> int:
    """Check one wheel; the exit code is that of the step that failed."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("wheel", type=Path)
    parser.add_argument("--python", default=sys.executable, help="interpreter to install it for")
    parser.add_argument(
        "--releases",
        choices=("constraints", "newest", "lowest"),
        default="constraints",
        help="of the dependencies: those of constraints.txt, or all that pyproject.toml allows",
    )
    options = parser.parse_args(words)
    python = shutil.which(options.python)
    if python is None or not options.wheel.is_file():
        parser.error(f"there is no {options.python if python is None else options.wheel}")
    try:
        check(options.wheel.resolve(), python, options.releases)
    except subprocess.CalledProcessError as error:
        sys.stderr.write(f"error: {' '.join(map(str, error.cmd))} ended with {error.returncode}\n")
        return error.returncode or 1
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
