"""Settings of pip as those of uv."""

from tools.install import settings_of


def test_uv_is_told_the_indexes_and_links_of_pip():
    listed = """\
:env:.index-url='https://mirror.example/simple'
global.cert='/certificates.pem'
global.extra-index-url='file:///a/simple file:///b/simple'
global.find-links='/wheels'
global.index-url='https://other.example/simple'
user.find-links='\\n/one\\n/two'
user.timeout='3'
"""
    assert settings_of(listed) == {
        "SSL_CERT_FILE": "/certificates.pem",
        "UV_DEFAULT_INDEX": "https://mirror.example/simple",
        "UV_FIND_LINKS": "/one,/two",
        "UV_INDEX": "file:///a/simple file:///b/simple",
    }
