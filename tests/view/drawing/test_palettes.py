from __future__ import annotations

import pytest

from texvent.view.drawing.palettes import PALETTES, get_palette


def test_the_default_is_the_papers_on_blue_off_red_on_white() -> None:
    paper = next(iter(PALETTES.values()))
    assert paper.name == "paper"
    assert (paper.on, paper.off, paper.background) == ((0, 0, 255), (255, 0, 0), (255, 255, 255))


@pytest.mark.parametrize("name", PALETTES)
def test_polarities_background_and_ink_can_be_told_apart(name: str) -> None:
    palette = get_palette(name)
    colours = [palette.on, palette.off, palette.background]
    for index, one in enumerate(colours):
        for other in colours[index + 1 :]:
            assert sum(abs(a - b) for a, b in zip(one, other, strict=True)) > 100
    contrast = abs(sum(palette.ink) - sum(palette.background))
    assert contrast > 200
    assert palette.name == name


@pytest.mark.parametrize("name", list(PALETTES))
def test_in_dark_mode_no_background_is_light_and_events_stand_out(name: str) -> None:
    palette = PALETTES[name].dark
    background = sum(palette.background)
    assert background <= 3 * 128
    for colour in (palette.on, palette.off):
        assert abs(sum(colour) - background) > 150
    assert palette.on != palette.off
