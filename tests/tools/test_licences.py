"""Licences of packages: read from metadata, allowed or refused, listed on their page."""

import pytest
from tools.licences import Package, faults, is_allowed, licence_of, needed_by


@pytest.mark.parametrize(
    ("expression", "allowed"),
    [
        ("MIT", True),
        ("MIT OR GPL-3.0-only", True),
        ("Apache-2.0 WITH LLVM-exception", True),
        ("MPL-2.0 AND (GPL-2.0-only OR MIT)", True),
        ("(MIT)", True),
        ("GPL-3.0-or-later", False),
        ("MIT AND GPL-2.0-only", False),
        ("(MIT OR ISC) AND LGPL-3.0-only", False),
        ("GPL-2.0-only WITH Classpath-exception-2.0", False),
        ("MIT AND (", False),
        ("LicenseRef-Proprietary", False),
        ("", False),
    ],
)
def test_an_expression_is_allowed_if_one_choice_of_each_part_is(expression, allowed):
    assert is_allowed(expression) is allowed


@pytest.mark.parametrize(
    ("expression", "field", "classifiers", "licence"),
    [
        ("MIT", "something else", [], "MIT"),
        (None, "BSD-3-Clause", [], "BSD-3-Clause"),
        (None, "Apache 2.0", [], "Apache-2.0"),
        (None, None, ["License :: OSI Approved :: MIT License"], "MIT"),
        (
            None,
            "Dual",
            [
                "License :: OSI Approved :: MIT License",
                "License :: OSI Approved :: Apache Software License",
            ],
            "MIT OR Apache-2.0",
        ),
        # Two or three clauses? The licence file must be read.
        (None, "BSD", ["License :: OSI Approved :: BSD License"], None),
        (
            None,
            "",
            [
                "License :: OSI Approved :: MIT License",
                "License :: OSI Approved :: GNU General Public License (GPL)",
            ],
            None,
        ),
        (None, None, [], None),
    ],
)
def test_the_licence_is_what_the_metadata_tell(expression, field, classifiers, licence):
    assert licence_of("some-package", expression, field, classifiers) == licence


def test_unknown_and_forbidden_licences_are_faults():
    packages = {
        "good": Package("good", "1", "MIT", ()),
        "viral": Package("viral", "2", "GPL-3.0-only", ()),
        "silent": Package("silent", "3", None, ()),
    }
    lines = faults(packages)
    assert [line.partition(":")[0] for line in lines] == ["viral 2", "silent 3"]


def test_parts_are_followed_through_extras_and_markers():
    packages = {
        "a": Package("a", "1", "MIT", ("b[fast]>=1", "w; sys_platform == 'win32'")),
        "b": Package("b", "1", "MIT", ("c; extra == 'fast'", "d; extra == 'slow'")),
        "c": Package("c", "1", "MIT", ("a",)),
    }
    users = needed_by(packages, {"base": ["a"], "more": ["texvent[other]", "C"]})
    assert users == {"a": {"base", "more"}, "b": {"base", "more"}, "c": {"base", "more"}}
