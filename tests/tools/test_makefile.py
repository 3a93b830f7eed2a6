"""Recipes of the Makefile: commands that a shell reads, and those of the hooks of pre-commit."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[2]


@pytest.mark.skipif(shutil.which("make") is None, reason="make is not installed")
@pytest.mark.parametrize("given", [[], ["BRIEF="]], ids=["brief", "whole"])
def test_a_shell_can_read_every_recipe(given):
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    targets = re.findall(r"^\.PHONY: (.+)$", makefile, re.MULTILINE)[0].split()
    # Each use of a name would look for interpreters again.
    found = [f"{name}={sys.executable}" for name in ("PYTHON", "NEWEST_PYTHON", "OLDEST_PYTHON")]
    asked = ["make", "-n", "--no-print-directory", *targets, *given, *found]
    recipes = subprocess.run(asked, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    assert "--durations" in recipes
    read = subprocess.run(["sh", "-n"], input=recipes, capture_output=True, text=True, check=False)
    assert read.stderr == ""


def test_hooks_are_the_commands_of_make_lint():
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    recipe = re.search(r"^lint:.*\n((?:\t.*\n)+)", makefile, re.MULTILINE)
    assert recipe is not None
    commands = [line.strip().replace("$(VENV)", ".venv") for line in recipe[1].splitlines()]
    hooks = yaml.safe_load((ROOT / ".pre-commit-config.yaml").read_text(encoding="utf-8"))
    assert [repository["repo"] for repository in hooks["repos"]] == ["local"]
    entries = hooks["repos"][0]["hooks"]
    assert [hook["entry"] for hook in entries] == commands
    assert all(hook["language"] == "system" for hook in entries)
    assert not any(hook["pass_filenames"] for hook in entries)
