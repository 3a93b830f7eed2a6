import pytest

from texvent.io.files import load

from .prophesee_files import events_of, write_words

WORDS = [
    0x1 << 60 | 0b1,  # before any TIME_HIGH: no time, left out
    0x8 << 60 | 3 << 32,  # TIME_HIGH: 3 · 64 µs
    0x1 << 60 | 5 << 54 | 1248 << 43 | 719 << 32 | 0x8000_0001,  # ON at x 1248 and 1279
    0xA << 60,  # a trigger
    0x0 << 60 | 63 << 54 | 32 << 43 | 4 << 32 | 0b1010,  # OFF at x 33 and 35
]
MEANING = [(1248, 719, 197, 1), (1279, 719, 197, 1), (33, 4, 255, 0), (35, 4, 255, 0)]


def exchange_halves(word: int) -> int:
    return (word & 0xFFFF_FFFF) << 32 | word >> 32


@pytest.mark.parametrize(
    ("header", "legacy"),
    [
        ("% format EVT21;endianness=legacy;height=720;width=1280\n% end\n", True),
        ("% endianness legacy\n% evt 2.1\n% geometry 1280x720\n% end\n", True),
        ("% endianness little\n% evt 2.1\n% geometry 1280x720\n% end\n", False),
        ("% evt 2.1\n% geometry 1280x720\n% integrator_name Prophesee\n% system_ID 49\n", True),
        ("% evt 2.1\n% geometry 1280x720\n% integrator_name Prophesee\n% system_ID 55\n", False),
        ("% evt 2.1\n% geometry 1280x720\n% integrator_name Other\n% system_ID 49\n", False),
        ("% evt 2.1\n% geometry 1280x720\n% end\n", False),
    ],
)
def test_the_header_decides_which_half_of_a_word_comes_first(tmp_path, header, legacy):
    words = [exchange_halves(word) if legacy else word for word in WORDS]
    assert events_of(load(write_words(tmp_path, "evt21", words, header=header))) == MEANING
