"""What errors echo is bounded and on one line, whatever it is."""

import numpy as np
import pytest

from texvent.errors import MAX_REASON, MAX_SHOWN, InputError, one_line, shown, without_password
from texvent.runtime.files.file_names import usable_path


def bomb():
    value = ["x"] * 10
    for _ in range(12):
        value = [value] * 10
    return value


@pytest.mark.parametrize(
    "value",
    ["x" * 200_000, 10**6000, bomb(), np.zeros((400, 400)), {"a" * 900: "b" * 900}, "a\nb\0"],
    ids=["text", "digits", "aliases", "array", "mapping", "lines"],
)
def test_a_value_is_shown_in_one_short_line(value):
    assert len(shown(value)) <= MAX_SHOWN
    assert shown(value).isprintable()


def test_the_words_of_a_library_are_cut_to_one_line():
    assert one_line(ValueError("one\n  two")) == "one two"
    assert one_line(ValueError()) == "ValueError"
    assert len(one_line(ValueError("x" * 5000))) == MAX_REASON


@pytest.mark.parametrize("name", ["a\0b", "n" * 256, "a/" * 2500])
def test_a_name_that_no_file_can_have_is_refused(name):
    with pytest.raises(InputError, match="is no file name"):
        usable_path(name)


ADDRESSES = {
    "rtsp://me:hidden@cam/s": "rtsp://cam/s",
    "rtsp://me:hid@den@cam/s": "rtsp://cam/s",
    "rtsp://me:hid/den@cam:554/s": "rtsp://cam:554/s",
    "rtsp://me:hid?den#@cam/s": "rtsp://cam/s",
    "rtsp://me:hid'den@cam/s": "rtsp://cam/s",
    "rtsp://me%3Ahidden@cam.org/s": "rtsp://cam.org/s",
    "rtsp://hidden@cam/s": "rtsp://cam/s",
    "rtsp:/me:hidden@cam/s": "rtsp:/cam/s",
    "RTSP://me:hidden@[::1]:5/s": "RTSP://[::1]:5/s",
    "async:http://me:hidden@cam/s": "async:http://cam/s",
    "http://a.org/http://me:hidden@cam/s": "http://cam/s",
    "http://cam/s?user=me&pwd=hidden": "http://cam/s...",
    "http://cam/s?hidden=": "http://cam/s...",
    "http://cam/s%3Ftoken%3Dhidden": "http://cam/s...",
    "rtsp://10.0.0.9:554/user=me_password=hidden_channel=1.sdp": "rtsp://10.0.0.9:554/user...",
    "http://cam.org:80/a@2x/b.mp4": "http://2x/b.mp4",  # the a could be a password
    "http://cam.org/a@2x/b.mp4": "http://cam.org/a@2x/b.mp4",
    "/data/a:b@c.mp4": "/data/a:b@c.mp4",
    "C:/clips/a@2x.mp4": "C:/clips/a@2x.mp4",
    "clip@2x.mp4": "clip@2x.mp4",
    "a dog, seed:7@night": "a dog, seed:7@night",
}


@pytest.mark.parametrize("address", ADDRESSES)
def test_an_address_is_shown_without_what_it_may_hide(address: str) -> None:
    assert without_password(address) == ADDRESSES[address]
    assert without_password("rtsp://me:hidden") == "rtsp://..."
    for text in (address, f"no such file: {address}; give one", shown(address)):
        said = str(InputError(f"{text} (see https://docs.org/page#part)"))
        assert "hidden" not in said
        assert "den@" not in said
        assert "https://docs.org/page#part" in said
