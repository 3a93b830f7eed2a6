"""A page as a browser opens it: by the printed address, then with the cookie that it left."""

import urllib.request
from collections.abc import Callable
from http.client import HTTPResponse
from http.cookiejar import CookieJar
from urllib.parse import urljoin


def open_entry(entry: str) -> Callable[..., HTTPResponse]:
    """Function of a path, and of the body of a POST, that asks for it."""
    opener = urllib.request.build_opener(urllib.request.HTTPCookieProcessor(CookieJar()))
    opener.open(entry, timeout=120).close()

    def ask(path: str, body: bytes | None = None) -> HTTPResponse:
        answer: HTTPResponse = opener.open(urljoin(entry, path or "/"), body, timeout=120)
        return answer

    return ask
