"""What the tests of texvent set up and lend: profiles of hypothesis, stand-ins, fixtures."""

from tests.conftest import moving_texture, spawn

__all__ = ["moving_texture", "spawn"]
