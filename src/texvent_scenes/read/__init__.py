"""Sentences to scenes: a small reader of short English prompts.

`parsing` makes tokens of words by the phrases that are known, and of tokens clauses of noun groups,
one verb each. `scenes` fills a `draft` of a scene with what these say, clause by clause; `account`
finishes it. What is not understood changes nothing and is reported.
"""

from texvent_scenes.read.account import Reading
from texvent_scenes.read.scenes import read

__all__ = ["Reading", "read"]
