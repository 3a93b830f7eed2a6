"""The typed keywords of the Python API are the options of the dataclasses."""

import ast
import inspect

from tests.contract import option_keywords

from texvent.api import generate, simulate, video
from texvent.options.fields import option_names
from texvent.options.keywords import GenerateOptions, SimulateOptions
from texvent.settings.resolution import base_settings


def test_the_typed_keywords_are_up_to_date():
    committed = option_keywords.FILE.read_text(encoding="utf-8")
    assert ast.dump(ast.parse(committed)) == ast.dump(ast.parse(option_keywords.text())), (
        "an option changed; run: python -m tests.contract.option_keywords"
    )


def test_every_option_of_a_run_is_a_typed_keyword():
    for command, keywords in (("generate", GenerateOptions), ("simulate", SimulateOptions)):
        groups = base_settings(command).groups().values()
        names = {name for group in groups for name in option_names(type(group))}
        assert names <= set(keywords.__annotations__)


def test_signatures_name_every_option():
    pairs = ((generate, GenerateOptions), (simulate, SimulateOptions), (video, GenerateOptions))
    for function, keywords in pairs:
        assert set(keywords.__annotations__) < set(inspect.signature(function).parameters)
