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
from texvent.web.answer_html import (
    download_html,
    failure_html,
    progress_html,
    summary_html,
    video_html,
    viewer_html,
)
from texvent.web.examples import examples
from texvent.web.guard import SESSION, Guard
from texvent.web.job import Answer, ConvertJob, Job, SimulateJob
from texvent.web.limits import Limits
from texvent.web.results import add_results, address_of
from texvent.web.server import Server
from texvent.web.supervisor import Supervisor
from texvent.web.workspace import Workspace

OWN_SIZE = "as the video"
DEFAULT_PRESET = "(default)"
"""Ends the name of the preset that is used unless one is chosen or the sensor has its own."""
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
#examples .grid-wrap { max-height: none; }
#preview { display: block; width: 100%; max-height: 46vh; background: #fff; border-radius: 8px; }
.texvent-error { border-left: 4px solid #c62828; }
"""
WELCOME = '<div class="texvent-status">No events yet.</div>'
MINUTES_KEPT = 60
FETCH = """(address) => {
  if (!address) return;
  const link = document.createElement("a");
  Object.assign(link, {href: address, download: ""}).click();
}"""
"""Downloads what the click asked for."""
REST_IF_UNWANTED = """() => {
  if (matchMedia("(prefers-reduced-motion: reduce)").matches)
    document.getElementById("preview")?.pause();
}"""


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
        allowed_hosts: tuple[str, ...] = (),
    ) -> None:
        """Import Gradio.

        Args:
            workspace: where jobs put their files.
            limits: how much a visitor may ask for.
            generators: those that visitors may choose.
            allowed_hosts: host names that the page answers to, besides those of this machine.
        """
        prepare_environment(workspace)
        self._gradio: Any = require("gradio", extra="app")
        self._workspace = workspace
        self._limits = limits
        self._supervisor = Supervisor(time_limit_s=limits.time_limit)
        self._server: Server | None = None
        self._allowed_hosts = allowed_hosts
        self._generators = generators

    def launch(self, *, host: str, port: int) -> str:
        """Start the server in threads of its own.

        Args:
            host: address to listen on; 127.0.0.1 is reached from this machine only.
            port: TCP port; 0 takes the first free one from 7860 on.

        Returns:
            The page's address.

        Raises:
            InputError: the port is taken.
        """
        upload_bytes = int(self._limits.max_upload_mb * 2**20)
        guard = Guard(
            self._application(upload_bytes),
            host=host,
            allowed_hosts=self._allowed_hosts,
            upload_bytes=upload_bytes,
            public_files=examples()[0][0].parent,
            before_upload=lambda: self._workspace.make_room(upload_bytes),
        )
        self._server = Server(guard, host=host, port=port)
        return self._server.start()

    def close(self) -> None:
        """Stop the jobs that run, then the server."""
        self._supervisor.close()
        if self._server is not None:
            self._server.close()

    def _application(self, upload_bytes: int) -> Any:
        """The page and its results, as one ASGI application."""
        gr = self._gradio
        gr.set_static_paths([str(examples()[0][0].parent)])
        application = require("fastapi", extra="app").FastAPI(openapi_url=None)
        add_results(application, self._workspace)
        blocks = self.build()
        blocks.queue(max_size=self._limits.max_waiting, default_concurrency_limit=1)
        return gr.mount_gradio_app(
            application,
            blocks,
            path="/",
            max_file_size=upload_bytes,
            ssr_mode=False,
            mcp_server=False,
            enable_monitoring=False,
            run_history=False,
            footer_links=[],
            css=CSS,
            theme=gr.themes.Default(primary_hue="blue", font=list(FONTS), font_mono=["monospace"]),
        )

    def build(self) -> Any:
        """The page, not started."""
        gr = self._gradio
        # Gradio deletes uploaded copies after an hour.
        with gr.Blocks(title="texvent", delete_cache=(600, 60 * MINUTES_KEPT)) as blocks:
            gr.Markdown(
                "### texvent: the events that an event camera would see, from a sentence or a video"
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
        with gr.Tabs() as parts["tabs"]:
            with gr.Tab("Prompt", id="prompt"):
                parts["prompt"] = gr.Textbox(
                    examples()[0][1], label="Prompt", lines=2, elem_id="prompt"
                )
                with gr.Row():
                    parts["generator"] = _choice(gr, "Generator", self._generators)
                    parts["duration"] = gr.Number(
                        min(1.0, limits.max_seconds),
                        label="Seconds",
                        minimum=0.01,
                        maximum=limits.max_seconds,
                        min_width=120,
                    )
                parts["from_prompt"] = gr.Button(
                    "Make events", variant="primary", elem_id="from-prompt"
                )
            with gr.Tab("Video", id="video"):
                parts["video"] = gr.File(
                    label=f"A video of at most {limits.max_upload_mb:g} MB and "
                    f"{limits.max_seconds:g} s",
                    height=140,
                    elem_id="video",
                )
                parts["from_video"] = gr.Button(
                    "Make events", variant="primary", elem_id="from-video"
                )
        with gr.Row():
            parts["simulator"] = _choice(gr, "Simulator", SIMULATORS.names())
            parts["preset"] = _choice(gr, "Preset", _presets(SIMULATORS.names()[0]))
        with gr.Row():
            parts["sensor"] = _choice(gr, "Sensor", [OWN_SIZE, *SENSORS], DEFAULT_SENSOR)
            parts["seed"] = gr.Number(
                0, label="Seed", precision=0, minimum=0, min_width=120, elem_id="seed"
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
        return parts

    def _outputs(self) -> dict[str, Any]:
        gr = self._gradio
        parts: dict[str, Any] = {}
        with gr.Row():
            with gr.Column(scale=5, min_width=200):
                parts["status"] = gr.HTML(WELCOME, elem_id="status")
            parts["stop"] = gr.Button(
                "Stop", elem_id="stop", scale=1, min_width=80, interactive=False
            )
        parts["preview"] = gr.HTML()
        with gr.Row(equal_height=True):
            parts["format"] = _choice(gr, "Format", CODECS.names())
            parts["download"] = gr.Button("Download", elem_id="download", interactive=False)
        parts["viewer"] = gr.HTML()
        parts["events"] = gr.State(None)
        parts["address"] = gr.Textbox(visible=False)
        return parts

    def _connect(self, inputs: dict[str, Any], outputs: dict[str, Any]) -> None:
        """Connect the buttons to their handlers."""
        gr = self._gradio
        stop, download = outputs["stop"], outputs["download"]
        shown = [outputs[name] for name in ("status", "preview", "viewer", "events")]
        shown += [stop, download]
        asked = [
            inputs[name]
            for name in ("generator", "duration", "simulator", "preset", "sensor", "seed")
        ]
        private = {"api_visibility": "private"}
        running = []
        for button, source, run in (
            (inputs["from_prompt"], inputs["prompt"], self.from_prompt),
            (inputs["from_video"], inputs["video"], self.from_video),
        ):
            begun = button.click(
                lambda: gr.Button(interactive=True), None, stop, queue=False, **private
            )
            job = begun.then(
                _with_request(gr, run),
                [source, *asked],
                shown,
                show_progress="minimal",
                show_progress_on=outputs["status"],
                concurrency_id="jobs",
                **private,
            )
            job.then(None, js=REST_IF_UNWANTED, **private)
            running.append(job)
        stop.click(
            lambda: ('<div class="texvent-status">Stopped.</div>', gr.Button(interactive=False)),
            None,
            [outputs["status"], stop],
            cancels=running,
            queue=False,
            **private,
        )
        inputs["simulator"].change(
            lambda name: gr.Dropdown(_presets(name), value=_presets(name)[0]),
            inputs["simulator"],
            inputs["preset"],
            **private,
        )

        def chosen(event: Any) -> tuple[Any, str]:
            return gr.Tabs(selected="prompt"), examples()[int(event.index)][1]

        # Gradio passes the event because of this annotation.
        chosen.__annotations__["event"] = gr.SelectData
        inputs["gallery"].select(chosen, None, [inputs["tabs"], inputs["prompt"]], **private)
        download.click(
            _with_request(gr, self.prepare_download),
            [outputs["events"], outputs["format"]],
            [outputs["status"], outputs["address"]],
            show_progress="minimal",
            show_progress_on=outputs["status"],
            **private,
        ).then(None, outputs["address"], js=FETCH, **private)

    def from_prompt(self, session: str, prompt: str, *asked: Any) -> Iterator[list[Any]]:
        """Run a prompt; yields the values of status, preview, viewer, events, stop, download."""
        options = _options(asked)
        yield from self._simulate(session, options, prompt=prompt)

    def from_video(self, session: str, video: str | None, *asked: Any) -> Iterator[list[Any]]:
        """Run an uploaded video; yields the same."""
        options = _options(asked)
        for name in ("generator", "duration"):
            options.pop(name)
        yield from self._simulate(session, options, video=video or "")

    def prepare_download(
        self, session: str, events: str | None, format: str
    ) -> Iterator[list[Any]]:
        """Convert the events; yields the values of status and of the address to fetch."""
        try:
            if events is None or not os.path.exists(events):
                raise ConfigError("there are no events to download yet; make some first")
            yield [progress_html(Answer(kind="progress", text="converting")), ""]
            folder = str(self._workspace.new_folder(session))
            done = self._last(ConvertJob(source=events, folder=folder, format=format))
        except TexventError as error:
            yield [failure_html(str(error)), ""]
            return
        address = address_of(done.files["download"])
        yield [download_html(done, address), address]

    def _simulate(
        self, session: str, options: Mapping[str, Any], **source: str
    ) -> Iterator[list[Any]]:
        gr = self._gradio
        skip, active, idle = gr.skip(), gr.Button(interactive=True), gr.Button(interactive=False)
        try:
            if source.get("video") == "":
                raise ConfigError("there is no video yet; drop one, or choose a file")
            folder = str(self._workspace.new_folder(session))
            job = SimulateJob(folder=folder, options=options, limits=self._limits, **source)
            for answer in self._supervisor.run(job):
                if answer.kind == "progress":
                    yield [progress_html(answer), skip, skip, skip, skip, idle]
                    continue
                files = answer.files
                video, viewer = video_html(address_of(files["video"])), viewer_html(files["page"])
                yield [summary_html(answer), video, viewer, files["events"], idle, active]
        except TexventError as error:
            # Results of an earlier job are removed: they could be mistaken for this one's.
            yield [failure_html(str(error)), "", "", None, idle, idle]

    def _last(self, job: Job) -> Answer:
        *_, done = self._supervisor.run(job)
        return done


def _choice(gr: Any, label: str, names: Any, value: str | None = None) -> Any:
    return gr.Dropdown(
        list(names), value=value or names[0], label=label, min_width=120, elem_id=label.lower()
    )


def _with_request(gr: Any, handler: Any) -> Any:
    """The handler, given the visitor's session first."""

    def handle(request: Any, *values: Any) -> Iterator[list[Any]]:
        yield from handler(str(request.cookies.get(SESSION, "")), *values)

    # Gradio passes the request because of this annotation.
    handle.__annotations__["request"] = gr.Request
    return handle


def _presets(simulator: str) -> list[str]:
    first, *others = SIMULATORS.load(simulator).presets
    return [f"{first} {DEFAULT_PRESET}".replace("default (", "("), *others]


def _options(asked: tuple[Any, ...]) -> dict[str, Any]:
    generator, duration, simulator, preset, sensor, seed = asked
    return {
        "generator": generator,
        "duration": duration,
        "simulator": simulator,
        "preset": None if preset.endswith(DEFAULT_PRESET) else preset,
        "sensor": None if sensor == OWN_SIZE else sensor,
        "seed": int(seed or 0),
    }
