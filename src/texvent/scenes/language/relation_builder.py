"""Relations while a prompt is read: whose target comes later, and which got a second target."""

from __future__ import annotations

from texvent.scenes.description import Relation


class RelationBuilder:
    """Collects relations between objects, by index."""

    def __init__(self) -> None:
        self.relations: list[Relation] = []
        self._last: Relation | None = None
        self._suspended: list[tuple[str, list[int]]] = []
        """Relations whose targets came before their subject: "behind the house stands a dog"."""

    def relate(self, kind: str, subjects: list[int], target: int) -> None:
        """Every subject has this relation to the target."""
        for subject in subjects:
            self._last = Relation(kind, subject, (target,))
            self.relations.append(self._last)

    def suspend(self, kind: str, target: int) -> None:
        """Keep a relation until its subject is named."""
        self._suspended.append((kind, [target]))

    def attach(self, subject: int) -> None:
        """Give the suspended relations their subject."""
        for kind, targets in self._suspended:
            self.relations.append(Relation(kind, subject, tuple(targets)))
        self._suspended = []
        self._last = None

    @property
    def needs_another(self) -> bool:
        """Whether a "between" whose subject is still to come has one target only."""
        return bool(self._suspended) and self._suspended[-1][0] == "between"

    def extend(self, target: int, subjects: list[int]) -> bool:
        """Add a target to the last relation ("between a house and a tree"); False if none."""
        if self.needs_another:
            self._suspended[-1][1].append(target)
            return True
        if self._last is None:
            return False
        kind = self._last.kind
        for position, known in enumerate(self.relations):
            if known.kind == kind and known.subject in subjects:
                self.relations[position] = Relation(kind, known.subject, (*known.targets, target))
        self._last = None
        return True

    def is_last_target(self, objects: list[int]) -> bool:
        """Whether these objects are the target of the relation read last."""
        return self._last is not None and list(self._last.targets) == objects

    def close(self) -> None:
        """The clause ended: no more targets."""
        self._last = None
