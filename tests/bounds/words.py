"""What commands say of words that an option may not have, and of those that it may.

    python -m tests.bounds.words    # writes them anew; CHANGELOG.md says why

`words.txt` holds, of every option with a value, the errors that each odd word meets: that of the
option, or the next one, as there is no input and no folder for the output.
"""

import re
import tempfile
from collections.abc import Iterator
from pathlib import Path
from zlib import crc32

from tests.options.outcomes import own_options
from tests.options.runs_of_commands import run_once
from tests.options.tries import COMMANDS_TRIED

TABLE = Path(__file__).with_name("words.txt")
ODD = ("''", "x", "0", "-1", "1.5", "1e3", "nan", "1,2", "2,1", "1,2,3,4", "1,b,3,4", "a,b,c,d",
       "3,1,2,1", "1/2", "1/0", "16x12", "0x12", "a=b", "a:b=1", "1..2", "none", "no/a.h5", "a.png",
       "a.npz")  # fmt: skip
SETTLED = [
    one for one in COMMANDS_TRIED if one.split()[0] not in ("doctor", "weights", "data", "scenes")
]
"""Commands that need an input, and do not tell of this machine."""


def base_of(command: str) -> str:
    """The words of a command, with its output in a folder that is not there."""
    words = COMMANDS_TRIED[command].words.replace(" -o ", " -o no/")
    return words + (" -o no/rig" if command == "rig" else "")


def errors(folder: Path, words: str) -> str:
    """What a run says, without places on the disk and times."""
    seen = run_once(folder, words)
    said = re.sub(r"install it with: .*", "", seen.said).replace(str(folder), "")
    return f"{seen.code} {said.strip()}"


def lines_of(command: str, folder: Path) -> Iterator[str]:
    """A line for each option: digests of what each odd word meets."""
    base = base_of(command)
    for listed in own_options(command):
        if listed.placeholder and "{" not in listed.placeholder:
            said = [errors(folder, f"{base} {listed.flag}={word}") for word in ODD]
            marks = " ".join(f"{crc32(one.encode()) & 0xFFFF:04x}" for one in said)
            yield f"{command} {listed.flag}: {marks}"


def stored_lines() -> list[str]:
    """Lines of all commands, as they were."""
    return TABLE.read_text(encoding="utf-8").splitlines()


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as place:
        found = [line for one in SETTLED for line in lines_of(one, Path(place))]
    TABLE.write_text("\n".join((*found, "")), encoding="utf-8")
