"""The paper's tables, and tables that compare measured values with them.

Source: "Texvent: Asynchronous Event Data Simulation via Text Prompt", Tables 1 to 3 of the paper,
Tables 4 to 9 of its supplement.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from texvent_lab.bench.document import markdown_table

SCHEMA = "texvent-paper-2"
"""Schema of a document with measured tables."""
SIMULATORS = ("VID2E", "V2E", "V2CE", "DVS-Voltmeter", "SENPI", "Texvent")

IMAGE_ROWS: Mapping[str, str] = {"MSE ↓": "mse", "SSIM ↑": "ssim", "LPIPS ↓": "lpips"}
"""Row of reconstructed images → measure."""


@dataclass(frozen=True)
class PaperTable:
    """One table of the paper."""

    number: int
    title: str
    columns: tuple[str, ...]
    rows: Mapping[str, tuple[float, ...]]
    """Row → the paper's value per column."""
    digits: int = 4


@dataclass(frozen=True)
class Measured:
    """Values that were measured here for one table."""

    rows: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    """Row → column → value as text."""
    notes: Sequence[str] = ()
    """Differences to the paper's measurement."""
    needs: Sequence[str] = ()
    """Inputs that are missing for the rest."""


TABLES: Mapping[int, PaperTable] = {
    table.number: table
    for table in (
        PaperTable(
            1,
            "event frames, and images reconstructed from events by E2VID (ECD and DSEC)",
            SIMULATORS,
            {
                "event frames: MSE ↓": (0.116, 0.142, 0.082, 0.276, 0.186, 0.045),
                "event frames: SSIM ↑": (0.430, 0.299, 0.552, 0.085, 0.095, 0.488),
                "event frames: LPIPS ↓": (0.406, 0.603, 0.383, 0.972, 0.820, 0.339),
                "images: MSE ↓": (0.188, 0.099, 0.151, 0.096, 0.104, 0.116),
                "images: SSIM ↑": (0.387, 0.420, 0.392, 0.149, 0.251, 0.472),
                "images: LPIPS ↓": (0.381, 0.422, 0.451, 0.354, 0.561, 0.296),
            },
            3,
        ),
        PaperTable(
            2,
            "event quality score on NT-ImageNet, and run time per pair of frames",
            SIMULATORS,
            {
                "EQS ↑": (0.8597, 0.8138, 0.8642, 0.8573, 0.8824, 0.8851),
                "time, s": (2.1228, 2.1652, 0.0950, 0.6919, 0.0573, 0.0653),
            },
        ),
        PaperTable(
            3,
            "reconstruction trained without and with 5 % simulated clips (ECD)",
            ("PSNR ↑", "SSIM ↑", "LPIPS ↓", "MSE ↓"),
            {
                "E2VID": (22.1127, 0.5897, 0.3104, 0.0070),
                "E2VID + 5 %": (22.8475, 0.6320, 0.2791, 0.0063),
                "HyperE2VID": (21.9488, 0.5973, 0.2421, 0.0077),
                "HyperE2VID + 5 %": (23.3000, 0.6624, 0.1656, 0.0061),
                "ET-Net": (21.1987, 0.5629, 0.2013, 0.0087),
                "ET-Net + 5 %": (21.3771, 0.5630, 0.2112, 0.0084),
            },
        ),
        PaperTable(
            4,
            "ablations: balance (E1-E3), brightness cache (E4, E5), interpolation (E6-E8)",
            (*(f"E{number}" for number in range(1, 9)), "Texvent"),
            {"EQS ↑": (0.8639, 0.8637, 0.8531, 0.8597, 0.8508, 0.8435, 0.8638, 0.8314, 0.9086)},
        ),
        PaperTable(
            5,
            "ablations: noise (E9-E11), time stamps (E12)",
            ("E9", "E10", "E11", "E12", "Texvent"),
            {"EQS ↑": (0.8400, 0.8142, 0.8402, 0.9065, 0.9086)},
        ),
        PaperTable(
            6,
            "accuracy of classifiers trained without and with 20 % simulated streams",
            ("ResNet34", "ResNet152", "ViTB", "SqueezeNet"),
            {
                "Original": (0.4980, 0.4680, 0.3840, 0.3860),
                "with VID2E": (0.5140, 0.4820, 0.3820, 0.3920),
                "with Texvent": (0.6320, 0.5060, 0.3940, 0.4000),
            },
        ),
        PaperTable(
            7,
            "noise sensitivity of E2VID: share of events that is perturbed",
            ("1 %", "5 %", "10 %", "20 %", "30 %"),
            {
                "MSE ↓": (0.0035, 0.0057, 0.0080, 0.0083, 0.0168),
                "SSIM ↑": (0.8958, 0.7657, 0.6811, 0.5397, 0.3652),
                "LPIPS ↓": (0.0598, 0.1512, 0.2156, 0.3426, 0.5353),
            },
        ),
        PaperTable(
            8,
            "images reconstructed from events by ET-Net",
            SIMULATORS,
            {
                "MSE ↓": (0.2745, 0.1354, 0.2614, 0.0836, 0.0675, 0.0799),
                "SSIM ↑": (0.5521, 0.6187, 0.4545, 0.6602, 0.1976, 0.6893),
                "LPIPS ↓": (0.3555, 0.3154, 0.4731, 0.2172, 0.4989, 0.2074),
            },
        ),
        PaperTable(
            9,
            "accuracy of N-ImageNet's classifier on recorded and simulated streams",
            ("Original", *SIMULATORS),
            {
                "Acc@1 ↑": (0.6920, 0.3585, 0.3251, 0.1611, 0.1817, 0.1686, 0.3067),
                "Acc@5 ↑": (0.9156, 0.4760, 0.4873, 0.3500, 0.4589, 0.4175, 0.5458),
            },
        ),
    )
}
"""Number → table."""

FIGURES: Mapping[int, str] = {
    5: "events, and images reconstructed from them",
    6: "events warped along their motion, and depth",
    7: "balance and brightness cache: the paper's setting and E1 to E5",
    12: "optical flow",
}
"""Number → pictures of a recorded and of simulated streams."""


def join_measured(parts: Sequence[Measured]) -> Measured:
    """Values of several parts of one table; equal notes and needs once."""
    return Measured(
        {row: cells for part in parts for row, cells in part.rows.items()},
        tuple(dict.fromkeys(note for part in parts for note in part.notes)),
        tuple(dict.fromkeys(need for part in parts for need in part.needs)),
    )


def compare_with_paper(table: PaperTable, ours: Measured) -> str:
    """A Markdown table with the paper's values and ours, row by row."""
    rows: list[list[str]] = []
    found = (column for cells in ours.rows.values() for column in cells)
    columns = tuple(dict.fromkeys((*table.columns, *found)))
    unpublished = ["–"] * (len(columns) - len(table.columns))
    for name in dict.fromkeys((*table.rows, *ours.rows)):
        is_published = name in table.rows
        if is_published:
            published = [f"{one:.{table.digits}f}" for one in table.rows[name]]
            rows.append([name, "paper", *published, *unpublished])
        here = ours.rows.get(name, {})
        if here or not is_published:
            label = "" if is_published else name
            rows.append([label, "here", *(here.get(one, "–") for one in columns)])
    shown = markdown_table(["", "", *columns], rows)
    remarks = [f"- {note}" for note in ours.notes]
    remarks += [f"- Not measured: {need}" for need in ours.needs]
    lines = "\n".join(["", *remarks])
    return f"## Table {table.number}: {table.title}\n\n{shown}{lines}\n"
