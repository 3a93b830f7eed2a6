"""`python -m texvent` is the command `texvent`."""

from __future__ import annotations

import sys

from texvent.cli.app import main

sys.exit(main())
