"""Some of several that do or are something by themselves stay in what is said of all."""

import itertools
from collections import Counter

from tests.scenes.every_row import for_every

from texvent_scenes.description import to_description
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.read import read

SAID = (
    "a dog chases {} cats", "{} cats chase a dog", "a man walks past {} dogs",
    "{} dogs run towards a man", "a ball lies behind {} horses", "a bird flies over {} cows",
    "{} cats sit on a sofa", "a girl stands between {} robots", "a van overtakes {} buses",
    "{} robots stand next to {} men", "a woman follows {} goats", "{} balls roll past {} boxes",
)  # fmt: skip
AFTERWARDS = (
    ", one of which jumps", ", one of them jumps", ". One of them jumps.", ", one jumps",
    ". One jumps and the other sits.", ", one of which is red", "; one of them is white",
    " and one of them falls", ", two of them spin", ", the others wait",
)  # fmt: skip


def count(text):
    """Bodies by their nouns; and by relations and nouns those that have them, and to how many."""
    said = to_description(read(text, NOUNS).scene)
    bodies, related = Counter(), Counter()
    for one in said.objects:
        bodies[one.noun] += one.count
    for one in said.relations:
        who, to = said.objects[one.subject], [said.objects[n] for n in one.targets]
        related[one.kind, who.noun, to[0].noun, sum(each.count for each in to)] += who.count
    return bodies, related


@for_every(itertools.product(SAID, ("two", "three", "5"), AFTERWARDS), is_quick=True)
def test_what_some_do_takes_none_from_what_all_do(row):
    said, number, afterwards = row
    usual = said.format(number, number)
    assert count(usual + afterwards) == count(usual)
