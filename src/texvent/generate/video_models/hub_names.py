"""How repositories of the model hub are named on the command line."""

from __future__ import annotations

REPOSITORY = r"[A-Za-z0-9]\w*(?:[.-]\w+)*/[A-Za-z0-9]\w*(?:[.-]\w+)*"
"""`organisation/name` as the model hub allows it: no two dots or hyphens in a row."""
HUB = "hub:"
"""Prefix of a name that is a repository of the model hub: `hub:org/name`."""
