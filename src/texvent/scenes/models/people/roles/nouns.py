"""People whom a stranger tells by their look: sports, trades, ages, figures of tales; robots."""

from __future__ import annotations

from texvent.scenes.models.people.roles.robots import ROBOTS
from texvent.scenes.models.people.roles.sportspeople import SPORTS
from texvent.scenes.models.people.roles.tales import AGES, TALES
from texvent.scenes.models.people.roles.trades import TRADES

NOUNS = (*SPORTS, *TRADES, *TALES, *AGES, *ROBOTS)
