"""Parts that other packages add, as text with options makes them."""

import pytest

from texvent._registry import Registry
from texvent.errors import TexventError
from texvent.options.values import make_part


class NoDataclass:
    """A filter as another package might add it."""


def no_class() -> None:
    """Neither is this one."""


@pytest.mark.parametrize("name", ["NoDataclass", "no_class"])
def test_a_part_that_is_no_dataclass_is_refused(name: str) -> None:
    parts = Registry("event filter", {"odd": f"{__name__}:{name}"})
    with pytest.raises(TexventError, match=rf"event filter 'odd' is <.*{name}.*>, no dataclass;"):
        make_part(parts, "odd")
