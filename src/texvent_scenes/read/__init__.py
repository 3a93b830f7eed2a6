"""Sentences to scenes: a small reader of short English prompts.

Words become tokens by the phrases that are known (`lexicon`), tokens become clauses
(`clauses`) of noun groups, one verb each, and clauses become a scene (`scenes`). What is not
understood changes nothing and is reported.
"""

from texvent_scenes.read.account import Reading
from texvent_scenes.read.scenes import read

__all__ = ["Reading", "read"]
