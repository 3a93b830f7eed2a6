"""`texvent check` prints what it found, and advises options that exist."""

import re

from texvent.options.values import option_names
from texvent.settings.resolution import resolve
from texvent.video_check.checks import CHECKS

OF_GENERATE = {"seed", "on_failure"}


def test_advice_names_options_that_exist():
    settings = resolve("simulate", {})
    known = {name for group in settings.groups().values() for name in option_names(type(group))}
    named = r"(?:`|\b)([a-z_]+)(?:`|=')"
    advised = {name for check in CHECKS for name in re.findall(named, check.help)}
    assert advised <= known | OF_GENERATE
    assert "deflicker" in advised
