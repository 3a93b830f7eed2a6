"""Classes whose prompts do not show what tells them apart are found before any work."""

import pytest

from texvent.dataset.specification.items import Item
from texvent.dataset.specification.prompts import find_untrue
from texvent.settings.resolution import resolve

LABELS = {"claps": "a man claps", "cw": "a man rotates the right arm clockwise"}
"""Classes whose prompts are understood."""


def found(prompts: dict[str, list[str]]) -> dict[str, list[str]]:
    items = [
        Item(f"{label} {number}", prompt=prompt, label=label)
        for label, of_class in prompts.items()
        for number, prompt in enumerate(of_class)
    ]
    return find_untrue(items, resolve("generate", {}))


@pytest.mark.parametrize("label", ["ccw", "Wugs!"])
def test_a_class_is_untrue_if_a_lost_word_tells_it_apart(label: str) -> None:
    known = {name: [prompt] for name, prompt in LABELS.items()}
    assert not found(known)
    assert found(known | {label: ["a man wugs", "a woman Wugs"]}) == {label: ["wugs"]}
    # Not if some of its prompts go without it, or if those of all classes have it.
    assert not found(known | {label: ["a man wugs", "a man claps"]})
    everywhere = {name: [f"{prompt} wugs"] for name, prompt in LABELS.items()}
    assert bool(found(everywhere | {label: ["a man jumps wugs"]})) == (label == "Wugs!")


def test_prompts_of_a_class_that_are_refused_or_scenes_say_nothing() -> None:
    assert not found({"qwerty": ["qwerty zxcv"], "claps": ["a man claps"]})
    scene = Item("scene", prompt="a wug", label="wug", scene={"objects": []})
    assert not find_untrue([scene], resolve("generate", {}))
