"""Commands that `texvent` has where this package is installed."""

COMMANDS = {
    "bench": ("texvent_lab.commands.bench.bench", "Benchmarks of metrics and simulators."),
    "reconstruct": (
        "texvent_lab.commands.reconstruct",
        "Images from events alone, by a published network.",
    ),
    "train": (
        "texvent_lab.commands.train",
        "Train a network on simulated events or a data set.",
    ),
    "evaluate": ("texvent_lab.commands.evaluate", "Scores of trained weights on other samples."),
    "nt-imagenet": (
        "texvent_lab.commands.nt_imagenet",
        "N-ImageNet with captions, as prompts for simulated streams.",
    ),
    "align": (
        "texvent_lab.commands.align",
        "How well events fit their texts, by a CLIP model of yours.",
    ),
}
"""Command → its module, which has a function `run(arguments)`, and what it does."""
