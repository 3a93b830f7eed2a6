"""The same prompt means the same in every process, whatever the order of Python's sets."""

import os
import subprocess
import sys

PROMPTS = (
    "Two cups stand on a green cloth. The shot is taken from directly above.",
    "A tennis player hits the ball hard. The shot is filmed from behind the baseline at dusk.",
    "two red cars and a bus drive past many trees, then one stops",
    "the basketball is shot into the hoop while the crowd waves and cheers",
    "a slow pan left over a kitchen table with cups, plates, forks and a striped cat",
)
READ = """
import sys
from texvent.scenes.language.parser import parse_prompt
for prompt in sys.argv[1:]:
    print(parse_prompt(prompt))
"""


def test_reading_does_not_depend_on_the_seed_of_hashes():
    read = {
        subprocess.run(
            [sys.executable, "-c", READ, *PROMPTS],
            env={**os.environ, "PYTHONHASHSEED": seed},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for seed in ("1", "2", "3")
    }
    assert len(read) == 1
