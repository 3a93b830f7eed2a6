"""What a generator tells while it works."""


class Watcher:
    """Keeps lines and steps; interrupts the work at a step, if that is asked for."""

    def __init__(self, stop_at=None):
        self.lines, self.steps, self.stop_at = [], [], stop_at

    def announce(self, line):
        self.lines.append(line)

    def advance(self, stage, done, total):
        self.steps.append((stage, done, total))
        if done == self.stop_at:
            raise KeyboardInterrupt
