"""Commands of scenes: entry points in the group `texvent.commands`."""

COMMANDS = {
    "rig": (
        "texvent_scenes.commands.rig",
        "Several cameras with lenses, frames and an IMU, from a prompt.",
    ),
    "scenes": (
        "texvent_scenes.commands.scenes",
        "Nouns of embedded scenes: list them, see one.",
    ),
}
"""Command → module, and what it does, as `texvent.cli.app.COMMANDS`."""
