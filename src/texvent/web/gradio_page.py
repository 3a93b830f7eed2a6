"""The web page: inputs, outputs and what connects them. The file that knows Gradio."""

from __future__ import annotations

import os
from typing import Any

from texvent._registry import SIMULATORS
from texvent._require import require
from texvent.config import RunConfig
from texvent.errors import ConfigError, TexventError
from texvent.io.files import writable_formats
from texvent.run.settings import DEFAULT_SENSOR, sensor_preset
from texvent.sensor import SENSORS, parse_sensor
from texvent.web.answer_html import (
    download_html,
    failure_html,
    progress_html,
    status_html,
    summary_html,
    video_html,
    viewer_html,
)
from texvent.web.examples import examples
from texvent.web.guard import SESSION, Guard
from texvent.web.job import Answer, ConvertJob, SimulateJob
from texvent.web.limits import Limits
from texvent.web.page_jobs import Page, PageJobs
from texvent.web.page_style import CSS, FONTS
from texvent.web.results import add_results, address_of
from texvent.web.server import Server
from texvent.web.supervisor import Supervisor
from texvent.web.workspace import Workspace

NO_SENSOR = "none"
WELCOME = status_html("No events yet. Type a prompt or drop a video, and press Make events.")
MINUTES_KEPT = 60
LOOK_S = 1.0
"""How often a page asks how its job gets on."""
WITH_TAB = """(_, ...values) =>
  [sessionStorage.texvent ??= Math.random().toString(36).slice(2), ...values]"""
"""Puts the browser's name of this tab, which outlives a reload, before the values of a call."""
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
        self._jobs = PageJobs(self._supervisor, max_waiting=limits.max_waiting)
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
        """Stop the jobs, then the server."""
        self._jobs.close()
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
            self._connect(blocks, inputs, outputs)
        return blocks

    def _inputs(self) -> dict[str, Any]:
        gr, limits = self._gradio, self._limits
        parts: dict[str, Any] = {}
        with gr.Tabs() as parts["tabs"]:
            with gr.Tab("Prompt", id="prompt"):
                parts["prompt"] = gr.Textbox(
                    examples()[0][1],
                    label="Prompt, or the text of a scene file",
                    lines=2,
                    elem_id="prompt",
                )
                parts["scene_file"] = gr.UploadButton(
                    "Open a scene file",
                    file_types=[".toml", ".json"],
                    type="binary",
                    size="sm",
                    elem_id="scene-file",
                )
                with gr.Row():
                    parts["generator"] = _choice(gr, "Generator", self._generators)
                    parts["duration"] = gr.Number(
                        min(1.0, limits.max_seconds),
                        label="Duration, s",
                        min_width=120,
                        elem_id="duration",
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
            simulator = RunConfig.simulator
            parts["simulator"] = _choice(gr, "Simulator", SIMULATORS.names(), simulator)
            parts["preset"] = _choice(gr, "Preset", _presets(simulator))
        with gr.Row():
            parts["sensor"] = _choice(gr, "Sensor", [NO_SENSOR, *SENSORS])
            parts["seed"] = gr.Number(0, label="Seed", min_width=120, elem_id="seed")
        gr.Markdown(_hint(), elem_classes="texvent-hint")
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
        with gr.Row(visible=False) as parts["results"]:
            parts["format"] = _choice(gr, "Format", writable_formats())
            parts["download"] = gr.Button("Download", elem_id="download", variant="primary")
        parts["viewer"] = gr.HTML()
        gr.Markdown("Prompts to try:")
        parts["gallery"] = gr.Gallery(
            [(str(path), prompt) for path, prompt in examples()],
            show_label=False,
            height="auto",
            buttons=[],
            allow_preview=False,
            interactive=False,
            elem_id="examples",
        )
        parts["events"] = gr.State(None)
        parts["address"] = gr.Textbox(visible=False)
        parts["tab"] = gr.Textbox(visible=False)
        parts["timer"] = gr.Timer(LOOK_S, active=False)
        return parts

    def _connect(self, blocks: Any, inputs: dict[str, Any], outputs: dict[str, Any]) -> None:
        """Connect the buttons to their handlers."""
        gr = self._gradio
        shown = [
            outputs[name]
            for name in ("status", "preview", "viewer", "events", "stop", "results", "timer")
        ]
        common = [inputs[name] for name in ("simulator", "preset", "sensor", "seed")]
        scene = [inputs[name] for name in ("prompt", "generator", "duration")]
        private = {"api_visibility": "private"}
        at_once = {**private, "queue": False, "show_progress": "hidden", "js": WITH_TAB}
        for listen, run, values in (
            (inputs["from_prompt"].click, self.from_prompt, [*scene, *common]),
            (inputs["from_video"].click, self.from_video, [inputs["video"], *common]),
            (outputs["timer"].tick, self.look, []),
            (outputs["stop"].click, self.stop, []),
            (blocks.load, self.reopen, []),
        ):
            listen(_with_session(gr, run), [outputs["tab"], *values], shown, **at_once)
        inputs["scene_file"].upload(
            lambda content: content.decode("utf-8", errors="replace"),
            inputs["scene_file"],
            inputs["prompt"],
            **private,
        )
        outputs["preview"].change(None, js=REST_IF_UNWANTED, **private)
        inputs["simulator"].change(
            lambda name, sensor: gr.Dropdown(
                _presets(name), value=sensor_preset(name, sensor) or _presets(name)[0]
            ),
            [inputs["simulator"], inputs["sensor"]],
            inputs["preset"],
            **private,
        )
        inputs["sensor"].change(
            lambda name, sensor: sensor_preset(name, sensor) or gr.skip(),
            [inputs["simulator"], inputs["sensor"]],
            inputs["preset"],
            **private,
        )

        def chosen(event: Any) -> tuple[Any, str]:
            return gr.Tabs(selected="prompt"), examples()[int(event.index)][1]

        # Gradio passes the event because of this annotation.
        chosen.__annotations__["event"] = gr.SelectData
        outputs["gallery"].select(chosen, None, [inputs["tabs"], inputs["prompt"]], **private)
        outputs["download"].click(
            _with_session(gr, self.prepare_download),
            [outputs["events"], outputs["format"]],
            [outputs["status"], outputs["address"]],
            show_progress="minimal",
            show_progress_on=outputs["status"],
            **private,
        ).then(None, outputs["address"], js=FETCH, **private)

    def from_prompt(
        self, session: str, tab: str, prompt: str, generator: str, duration: Any, *common: Any
    ) -> list[Any]:
        """Start on a prompt; returns the values that the page shows."""
        more = {"generator": generator, "duration": duration}
        return self._start((session, tab), common, more, prompt=prompt)

    def from_video(self, session: str, tab: str, video: str | None, *common: Any) -> list[Any]:
        """Start on an uploaded video; returns the same."""
        return self._start((session, tab), common, {}, video=video or "")

    def look(self, session: str, tab: str) -> list[Any]:
        """How the tab's job gets on; returns the same."""
        return self._values(self._jobs.latest((session, tab)))

    def reopen(self, session: str, tab: str) -> list[Any]:
        """The tab's job or its result after a reload, but no old error; returns the same."""
        answer = self._jobs.latest((session, tab))
        is_over = answer is not None and answer.kind in ("failed", "stopped")
        return self._values(None if is_over else answer)

    def stop(self, session: str, tab: str) -> list[Any]:
        """Give the tab's job up; returns the same."""
        self._jobs.stop((session, tab))
        return self.look(session, tab)

    def prepare_download(self, session: str, events: str | None, format: str) -> list[str]:
        """Convert the events; returns the values of status and of the address to fetch."""
        try:
            if events is None or not os.path.exists(events):
                raise ConfigError("there are no events to download; make some first")
            folder = str(self._workspace.new_folder(session))
            job = ConvertJob(source=events, folder=folder, format=format)
            *_, done = self._supervisor.run(job)
        except TexventError as error:
            return [failure_html(str(error)), ""]
        address = address_of(done.files["download"])
        return [download_html(done, address), address]

    def _start(
        self, page: Page, common: tuple[Any, ...], more: dict[str, Any], **source: str
    ) -> list[Any]:
        def job() -> SimulateJob:
            folder = str(self._workspace.new_folder(page[0]))
            return SimulateJob(folder=folder, options=options, limits=self._limits, **source)

        try:
            if source.get("video") == "":
                raise ConfigError("there is no video yet; drop one, or choose a file")
            options = _options(*common, **more)
            self._jobs.stop(page)
            self._jobs.start(page, job)
        except TexventError as error:
            return self._values(Answer(kind="failed", text=str(error)))
        return self.look(*page)

    def _values(self, answer: Answer | None) -> list[Any]:
        """Values of status, preview, viewer, events, stop, results and timer; None: unchanged."""
        gr = self._gradio
        skip = gr.skip()
        stop, timer = gr.Button(interactive=False), gr.Timer(active=False)
        if answer is None:
            return [skip] * 7
        if answer.kind == "progress":
            stop, timer = gr.Button(interactive=True), gr.Timer(active=True)
            return [progress_html(answer), skip, skip, skip, stop, skip, timer]
        if answer.kind == "stopped":
            return [status_html(answer.text), skip, skip, skip, stop, skip, timer]
        if answer.kind == "failed":
            # Results of an earlier job are removed: they could be mistaken for this one's.
            return [failure_html(answer.text), "", "", None, stop, gr.Row(visible=False), timer]
        files = answer.files
        video, viewer = video_html(address_of(files["video"])), viewer_html(files["page"])
        results = gr.Row(visible=True)
        return [summary_html(answer), video, viewer, files["events"], stop, results, timer]


def _choice(gr: Any, label: str, names: Any, value: str | None = None) -> Any:
    return gr.Dropdown(
        list(names), value=value or names[0], label=label, min_width=120, elem_id=label.lower()
    )


def _with_session(gr: Any, handler: Any) -> Any:
    """The handler, given the visitor's session first."""

    def handle(request: Any, *values: Any) -> Any:
        return handler(str(request.cookies.get(SESSION, "")), *values)

    # Gradio passes the request because of this annotation.
    handle.__annotations__["request"] = gr.Request
    return handle


def _presets(simulator: str) -> list[str]:
    return list(SIMULATORS.load(simulator).presets)


def _hint() -> str:
    simulator = RunConfig.simulator
    return (
        f"Which one? **{simulator}** with **{_presets(simulator)[0]}** is fast and close to the "
        "best by measurement; the others are there to compare. A preset named after a camera has "
        "its constants. Without a sensor a video keeps its size, and a prompt is drawn at "
        f"{parse_sensor(DEFAULT_SENSOR)}."
    )


def _options(
    simulator: str, preset: str, sensor: str, seed: float | None, **more: Any
) -> dict[str, Any]:
    options = {"simulator": simulator, "preset": preset, "sensor": sensor, "seed": seed, **more}
    for name, value in options.items():
        if value is None:
            raise ConfigError(f"{name} is empty; fill it in")
    return {name: value for name, value in options.items() if value != NO_SENSOR}
