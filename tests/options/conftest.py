"""Runs of commands, each made once."""

import functools

import pytest
from tests.options.inputs_of_commands import make_inputs
from tests.options.runs_of_commands import run_once


@pytest.fixture(scope="session")
def outcome(tmp_path_factory):
    """Function of a command line, and of one that ran before: its outcome, kept."""
    folder = tmp_path_factory.mktemp("inputs")
    make_inputs(folder)
    return functools.cache(functools.partial(run_once, folder))
