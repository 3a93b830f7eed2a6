"""The samples of a specification, simulated when they are asked for instead of stored."""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path

from texvent.dataset.generation.make_sample import prepare_clip
from texvent.dataset.generation.recipe import Recipe
from texvent.dataset.specification.clips import NumberedClip, simulation_seed, with_seed
from texvent.dataset.specification.reading import read_specification
from texvent.dataset.specification.specification import Specification
from texvent.errors import ConfigError, shown
from texvent.extending import full_version, suggest
from texvent.pipeline import Simulation
from texvent.runtime.identity import digest
from texvent.settings.resolution import Settings


class SimulatedClips:
    """A split of a variant: sample `n` is what `texvent dataset make` would store, and its video.

    Filters are not applied: what they leave out is known only after it is simulated.
    """

    def __init__(
        self, specification: Specification | str | Path, *, split: str, variant: str | None = None
    ) -> None:
        """Read the sources; nothing is simulated yet.

        Args:
            specification: an object, or a TOML or YAML file.
            split: which.
            variant: which; None: the only one.

        Raises:
            InputError, ConfigError: as `texvent.dataset.make`; no such split or variant; or videos
                of a learned generator, which are to be made once.
        """
        if not isinstance(specification, Specification):
            specification = read_specification(specification)
        self.recipe = Recipe.of(specification)
        if self.recipe.stores_videos:
            raise ConfigError(
                f"{specification.name} stores its videos; make it with texvent dataset make, and "
                "name its folder instead"
            )
        self.split = _chosen("split", split, tuple(self.recipe.clips.counts))
        names = tuple(self.recipe.variants)
        if variant is None and len(names) > 1:
            raise ConfigError(
                f"{specification.name} has variants {', '.join(names)}; choose one of them"
            )
        self.variant = self.recipe.variants[_chosen("variant", variant or names[0], names)]

    def __len__(self) -> int:
        """Number of samples."""
        return self.recipe.clips.counts[self.split] * self.variant.seeds

    def simulation(self, number: int) -> Simulation:
        """The simulation of sample `number`, made ready.

        Raises:
            IndexError: there is no such sample.
            TexventError: its video cannot be read or made.
        """
        clip, seed_number = self._clip(number)
        settings = with_seed(self._settings(clip), simulation_seed(clip, seed_number))
        return prepare_clip(self.recipe, clip, settings)

    def identity(self, number: int, *facts: object) -> str:
        """Digest of everything that decides a sample; a changed video has another.

        Args:
            number: of the sample.
            *facts: plain values that count as well.

        Raises:
            IndexError: there is no such sample.
        """
        clip, seed_number = self._clip(number)
        options = self._settings(clip).as_tables()
        item = dataclasses.asdict(clip.item)
        files = (clip.item.video, *self.recipe.files_named[self.variant.name])
        state = [_state_of(Path(one)) for one in files if one is not None]
        parts = [full_version(), options, item, state, clip.seed, seed_number, *facts]
        return digest([json.dumps(parts, sort_keys=True)])

    def _settings(self, clip: NumberedClip) -> Settings:
        return self.recipe.settings[self.variant.name].of(clip)

    def _clip(self, number: int) -> tuple[NumberedClip, int]:
        if not 0 <= number < len(self):
            raise IndexError(f"sample {number} does not exist; there are {len(self)}")
        place, seed_number = divmod(number, self.variant.seeds)
        return self.recipe.clips.clip(self.split, place), seed_number


def _state_of(path: Path) -> list[tuple[str, int, int]]:
    """Names, sizes and times of change; nothing of a file that is not there or not needed."""
    files = sorted(path.iterdir()) if path.is_dir() else [path]
    states = [(one.name, one.stat()) for one in files if one.exists()]
    return [(name, one.st_size, one.st_mtime_ns) for name, one in states]


def _chosen(what: str, name: str, known: tuple[str, ...]) -> str:
    if name not in known:
        raise ConfigError(f"unknown {what} {shown(name)}; {suggest(name, known)}")
    return name
