"""The web page: inputs, outputs and what connects them. The file that knows Gradio."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from typing import Any

from texvent._registry import CODECS, SIMULATORS
from texvent._require import require
from texvent.errors import ConfigError, TexventError
from texvent.run.settings import DEFAULT_SENSOR
from texvent.sensor import SENSORS
from texvent.web.answer_html import failure_html, progress_html, summary_html, viewer_html
from texvent.web.examples import examples
from texvent.web.job import Answer, ConvertJob, Job, SimulateJob
from texvent.web.limits import Limits
from texvent.web.supervisor import Supervisor
from texvent.web.workspace import Workspace

OWN_SIZE = "as the video"
DEFAULT_PRESET = "default"
FONTS = ("system-ui", "Segoe UI", "Roboto", "DejaVu Sans", "sans-serif")
"""Fonts of the visitor's own machine: none is fetched."""
CSS = """
.texvent-status { padding: 8px 12px; min-height: 24px; }
.texvent-status progress { width: 12em; }
.texvent-status ul { margin: 4px 0 0 1.2em; font-size: .92em; }
#examples .caption-label { position: static; display: block; max-width: 100%; padding: 2px 6px;
  white-space: normal; font-size: .75rem; line-height: 1.25; text-align: left; }
#examples .thumbnail-lg { height: auto; aspect-ratio: auto; }
#examples .thumbnail-lg img { height: auto; aspect-ratio: 4 / 3; }
.texvent-error { border-left: 4px solid #c62828; }
"""
WELCOME = '<div class="texvent-status">No events yet.</div>'
MINUTES_KEPT = 60


def prepare_environment(workspace: Workspace) -> None:
    """Switch off Gradio's reports and set its upload folder, before it is imported."""
    os.environ["GRADIO_ANALYTICS_ENABLED"] = "False"
    os.environ["GRADIO_TEMP_DIR"] = str(workspace.uploads)
    os.environ["HF_HUB_DISABLE_TELEMETRY"] = "1"
    os.environ["DO_NOT_TRACK"] = "1"


class WebPage:
    """The web page around a workspace.

    Raises:
        MissingDependencyError: gradio, the extra "app", is not installed.
    """

    def __init__(
        self,
        workspace: Workspace,
        *,
        limits: Limits,
        generators: tuple[str, ...] = ("procedural",),
    ) -> None:
        """Import Gradio.

        Args:
            workspace: where jobs put their files.
            limits: how much a visitor may ask for.
            generators: those that visitors may choose.
        """
        prepare_environment(workspace)
        self._gradio: Any = require("gradio", extra="app")
        self._workspace = workspace
        self._limits = limits
        self._supervisor = Supervisor(time_limit_s=limits.time_limit)
        self._server: Any = None
        self._generators = generators

    def launch(self, *, host: str, port: int) -> str:
        """Start the server in threads of its own.

        Args:
            host: address to listen on; 127.0.0.1 is reached from this machine only.
            port: TCP port; 0 lets Gradio choose a free one from 7860 on.

        Returns:
            The page's address.

        Raises:
            OSError: the port is taken.
        """
        blocks = self.build()
        blocks.queue(max_size=self._limits.max_waiting, default_concurrency_limit=1)
        _, address, _ = blocks.launch(
            server_name=host,
            server_port=port or None,
            share=False,
            quiet=True,
            prevent_thread_lock=True,
            max_file_size=int(self._limits.max_upload_mb * 2**20),
            allowed_paths=[str(self._workspace.root)],
            ssr_mode=False,
            mcp_server=False,
            enable_monitoring=False,
            footer_links=[],
            css=CSS,
            theme=self._gradio.themes.Default(
                primary_hue="blue", font=list(FONTS), font_mono=["monospace"]
            ),
        )
        self._server = blocks
        return str(address)

    def close(self) -> None:
        """Stop the jobs that run, then the server."""
        self._supervisor.close()
        if self._server is not None:
            self._server.close(verbose=False)

    def build(self) -> Any:
        """The page, not started."""
        gr = self._gradio
        # Gradio deletes uploaded and served copies after an hour.
        with gr.Blocks(title="texvent", delete_cache=(600, 60 * MINUTES_KEPT)) as blocks:
            gr.Markdown(
                "# texvent\nThe events that an event camera would see, from a sentence or a video."
            )
            with gr.Row():
                with gr.Column(scale=2, min_width=320):
                    inputs = self._inputs()
                with gr.Column(scale=5, min_width=320):
                    outputs = self._outputs()
            self._connect(inputs, outputs)
        return blocks

    def _inputs(self) -> dict[str, Any]:
        gr, limits = self._gradio, self._limits
        parts: dict[str, Any] = {}
        with gr.Tab("Prompt"):
            parts["prompt"] = gr.Textbox(
                examples()[0][1], label="Prompt", lines=3, elem_id="prompt"
            )
            parts["generator"] = gr.Dropdown(
                list(self._generators), value=self._generators[0], label="Generator"
            )
            parts["duration"] = gr.Slider(
                0.1, limits.max_seconds, value=min(1.0, limits.max_seconds), label="Seconds"
            )
            parts["from_prompt"] = gr.Button(
                "Make events", variant="primary", elem_id="from-prompt"
            )
            gr.Markdown("Or click an example:")
            parts["gallery"] = gr.Gallery(
                [(str(path), prompt) for path, prompt in examples()],
                show_label=False,
                columns=2,
                height="auto",
                buttons=[],
                allow_preview=False,
                interactive=False,
                elem_id="examples",
            )
        with gr.Tab("Video"):
            parts["video"] = gr.File(
                label=f"A video of at most {limits.max_upload_mb:g} MB and "
                f"{limits.max_seconds:g} s",
                elem_id="video",
            )
            parts["from_video"] = gr.Button("Make events", variant="primary", elem_id="from-video")
        parts["simulator"] = gr.Dropdown(
            list(SIMULATORS.names()), value=SIMULATORS.names()[0], label="Simulator"
        )
        parts["preset"] = gr.Dropdown(
            _presets(SIMULATORS.names()[0]), value=DEFAULT_PRESET, label="Preset"
        )
        parts["sensor"] = gr.Dropdown([OWN_SIZE, *SENSORS], value=DEFAULT_SENSOR, label="Sensor")
        parts["seed"] = gr.Number(0, label="Seed", precision=0, minimum=0)
        return parts

    def _outputs(self) -> dict[str, Any]:
        gr = self._gradio
        parts: dict[str, Any] = {}
        with gr.Row():
            with gr.Column(scale=5, min_width=200):
                parts["status"] = gr.HTML(WELCOME, elem_id="status")
            parts["stop"] = gr.Button("Stop", elem_id="stop", scale=1, min_width=80)
        parts["preview"] = gr.Video(
            label="Video and events",
            show_label=False,
            autoplay=True,
            loop=True,
            interactive=False,
            elem_id="preview",
        )
        with gr.Row():
            parts["format"] = gr.Dropdown(
                list(CODECS.names()), value=CODECS.names()[0], label="Format", elem_id="format"
            )
            parts["prepare"] = gr.Button("Prepare download", elem_id="prepare")
            parts["download"] = gr.File(
                label="Events", interactive=False, height=110, elem_id="download"
            )
        parts["viewer"] = gr.HTML()
        parts["events"] = gr.State(None)
        return parts

    def _connect(self, inputs: dict[str, Any], outputs: dict[str, Any]) -> None:
        """Connect the buttons to their handlers."""
        gr = self._gradio
        shown = [outputs[name] for name in ("status", "preview", "viewer", "download", "events")]
        asked = [
            inputs[name]
            for name in ("generator", "duration", "simulator", "preset", "sensor", "seed")
        ]
        private = {"api_visibility": "private"}
        running = [
            inputs["from_prompt"].click(
                self.from_prompt, [inputs["prompt"], *asked], shown, **private
            ),
            inputs["from_video"].click(
                self.from_video, [inputs["video"], *asked], shown, **private
            ),
        ]
        outputs["stop"].click(None, cancels=running, **private)
        inputs["simulator"].change(
            lambda name: gr.Dropdown(_presets(name), value=DEFAULT_PRESET),
            inputs["simulator"],
            inputs["preset"],
            **private,
        )

        def chosen(event: Any) -> str:
            return examples()[int(event.index)][1]

        # Gradio passes the event because of this annotation.
        chosen.__annotations__["event"] = gr.SelectData
        inputs["gallery"].select(chosen, None, inputs["prompt"], **private)
        outputs["prepare"].click(
            self.prepare_download,
            [outputs["events"], outputs["format"]],
            [outputs["status"], outputs["download"]],
            **private,
        )

    def from_prompt(self, prompt: str, *asked: Any) -> Iterator[list[Any]]:
        """Run a prompt; yields the values of status, preview, viewer, download and state."""
        options = _options(asked)
        yield from self._simulate(lambda folder: self._job(folder, options, prompt=prompt))

    def from_video(self, video: str | None, *asked: Any) -> Iterator[list[Any]]:
        """Run an uploaded video; yields the same."""
        options = _options(asked)
        for name in ("generator", "duration"):
            options.pop(name)
        yield from self._simulate(lambda folder: self._job(folder, options, video=video or ""))

    def prepare_download(self, events: str | None, format: str) -> Iterator[list[Any]]:
        """Convert the events; yields the values of status and download."""
        gr = self._gradio
        try:
            if events is None or not os.path.exists(events):
                raise ConfigError("there are no events to download yet; make some first")
            yield [progress_html(Answer(kind="progress", text="converting")), gr.skip()]
            folder = str(self._workspace.new_folder())
            done = self._last(ConvertJob(source=events, folder=folder, format=format))
        except TexventError as error:
            yield [failure_html(str(error)), None]
            return
        yield [summary_html(done), done.files["download"]]

    def _job(self, folder: str, options: Mapping[str, Any], **source: str) -> SimulateJob:
        if source.get("video") == "":
            raise ConfigError("there is no video yet; drop one, or choose a file")
        return SimulateJob(folder=folder, options=options, limits=self._limits, **source)

    def _simulate(self, make_job: Any) -> Iterator[list[Any]]:
        skip = self._gradio.skip()
        try:
            job = make_job(str(self._workspace.new_folder()))
            for answer in self._supervisor.run(job):
                if answer.kind == "progress":
                    yield [progress_html(answer), skip, skip, None, skip]
                else:
                    files = answer.files
                    viewer = viewer_html(files["page"])
                    yield [summary_html(answer), files["video"], viewer, None, files["events"]]
        except TexventError as error:
            # Results of an earlier job are removed: they could be mistaken for this one's.
            yield [failure_html(str(error)), None, "", None, None]

    def _last(self, job: Job) -> Answer:
        *_, done = self._supervisor.run(job)
        return done


def _presets(simulator: str) -> list[str]:
    return [DEFAULT_PRESET, *SIMULATORS.load(simulator).presets]


def _options(asked: tuple[Any, ...]) -> dict[str, Any]:
    generator, duration, simulator, preset, sensor, seed = asked
    return {
        "generator": generator,
        "duration": duration,
        "simulator": simulator,
        "preset": None if preset == DEFAULT_PRESET else preset,
        "sensor": None if sensor == OWN_SIZE else sensor,
        "seed": int(seed or 0),
    }
