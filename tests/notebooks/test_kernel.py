"""Displays and progress bars in a real kernel, as nbclient runs notebooks."""

import os
from typing import Any

import pytest

pytestmark = pytest.mark.docs

PROLOGUE = """
import time
import texvent
from texvent.runtime.progress_option import open_progress

began = time.monotonic()

def work(steps, option=None, seconds=0.02):
    with open_progress(option) as progress:
        progress.announce("a line to show")
        for step in range(steps):
            time.sleep(seconds)
            progress.advance("simulate <b>", step + 1, steps)
"""


def run_cells(*sources: str) -> tuple[list[Any], list[dict[str, Any]]]:
    """Run cells in a new kernel.

    Returns:
        The cells, and all messages about displays in the order in which they came.
    """
    import nbformat
    from nbclient import NotebookClient

    messages: list[dict[str, Any]] = []

    class Recorder(NotebookClient):
        def process_message(self, msg: Any, cell: Any, cell_index: int) -> Any:
            if msg["msg_type"] in ("display_data", "update_display_data"):
                messages.append({"type": msg["msg_type"], **msg["content"]["data"]})
            return super().process_message(msg, cell, cell_index)

    notebook = nbformat.v4.new_notebook()
    notebook.cells = [nbformat.v4.new_code_cell(source) for source in (PROLOGUE, *sources)]
    # What this test process sets for itself is not for kernels.
    environment = {name: value for name, value in os.environ.items() if "PYTEST" not in name}
    Recorder(notebook, timeout=300).execute(env=environment)
    return notebook.cells[1:], messages


def test_steps_are_shown_and_disappear():
    cells, messages = run_cells("work(60)", "print(time.monotonic() - began)")
    bars = [one for one in messages if one["text/plain"] != "a line to show"]
    assert bars[0]["type"] == "display_data"
    assert {one["type"] for one in bars[1:]} == {"update_display_data"}
    seconds = float(cells[1].outputs[0]["text"])
    assert len(bars) < 8 + 10 * seconds  # ten per second, though there are fifty steps per second
    assert "simulate <b>  60/60" in bars[-2]["text/plain"]
    assert bars[-1]["text/plain"] == ""
    # What is stored with the notebook is the last state: nothing but the line.
    stored = [output["data"]["text/plain"] for output in cells[0].outputs]
    assert stored == ["a line to show", ""]


def test_short_work_shows_no_steps_unless_it_is_asked_for():
    cells, _ = run_cells("work(3, seconds=0)", "work(3, option=True)", "work(60, option=False)")
    assert [len(cell.outputs) for cell in cells] == [1, 2, 0]


def test_generate_shows_its_steps_and_the_events_show_themselves():
    source = """
from fractions import Fraction
import numpy as np
frames = np.random.default_rng(0).integers(0, 255, (8, 48, 64)).astype(np.uint8)
events = texvent.simulate(frames, fps=100, noise="none", progress=True)
events
"""
    cells, messages = run_cells(source)
    assert any("simulate  8/8" in one["text/plain"] for one in messages)
    result = cells[0].outputs[-1]
    assert result.output_type == "execute_result"
    assert "EventStream(" in result.data["text/plain"]
    assert "<img" in result.data["text/html"]


def test_plots_show_inline():
    cells, _ = run_cells(
        "%matplotlib inline\n"
        "import numpy as np\n"
        "events = texvent.EventStream.from_columns([1], [1], [5], [1], size=(4, 3))\n"
        "ax = events.plot()"
    )
    assert any("image/png" in output.data for output in cells[0].outputs)


def test_tab_completes_options_and_shift_tab_lists_them():
    source = """
kernel, code = get_ipython().kernel, "texvent.simulate(frames, contrast_thre"
print(*kernel.do_complete(code, len(code))["matches"])
print(kernel.do_inspect(code, 16)["data"]["text/plain"])
"""
    cells, _ = run_cells(source)
    printed = "".join(one["text"] for one in cells[0].outputs if one.get("name") == "stdout")
    assert "contrast_threshold= " in printed.splitlines()[0]
    assert "interpolator_weights" in printed
