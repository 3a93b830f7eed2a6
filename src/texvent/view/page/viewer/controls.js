// Buttons, sliders and playback; starts the page.

const OPENING_US = 40e3;

// The 40 ms with the most events; half of a recording that is shorter than 80 ms.
const busiestWindow = ({ data, events: { t } }) => {
  const length = Math.min(0.5, OPENING_US / data.duration_us);
  let [start, most] = [0, 0];
  for (let first = 0, last = 0; first < data.count; first++) {
    while (last < data.count && t[last] < t[first] + length) last++;
    if (last - first > most) [start, most] = [t[first], last - first];
  }
  return { start: Math.min(start, 1 - length), length };
};

const makeControls = (state) => {
  const { data } = state;
  const [startSlider, lengthSlider, play, speed] = ["start", "length", "play", "speed"].map(element);
  const duration = (us) => (us >= 999e3 ? (us / 1e6).toFixed(3) + " s" : (us / 1e3).toFixed(2) + " ms");

  state.onChange(() => {
    startSlider.value = Math.round(state.start * 1000);
    lengthSlider.value = Math.max(1, Math.round(state.length * 1000));
    element("start-text").textContent = state.seconds(state.start).toFixed(3) + " s";
    element("length-text").textContent = duration(state.length * data.duration_us);
  });

  let before = 0;
  const step = (now) => {
    if (!state.playing) return;
    const whole_ms = speed.value === "real" ? data.duration_us / 1000 : 1000 * Number(speed.value);
    const start = state.start + Math.min(now - before, 100) / whole_ms;
    before = now;
    state.set({ start: start + state.length > 1 ? 0 : start });
    requestAnimationFrame(step);
  };
  const setPlaying = (playing) => {
    state.playing = playing;
    play.setAttribute("aria-pressed", String(playing));
    play.textContent = playing ? "❚❚ Pause" : "▶ Play";
    if (!playing) return;
    if (state.length > 0.5) state.set(busiestWindow(state));
    before = performance.now();
    requestAnimationFrame(step);
  };
  play.addEventListener("click", () => setPlaying(!state.playing));
  startSlider.addEventListener("input", () => {
    setPlaying(false);
    state.set({ start: startSlider.value / 1000 });
  });
  lengthSlider.addEventListener("input", () => state.set({ length: lengthSlider.value / 1000 }));
  for (const name of ["on", "off"]) {
    const button = element("toggle-" + name);
    button.addEventListener("click", () => {
      state.set({ [name]: !state[name] });
      button.setAttribute("aria-pressed", String(state[name]));
    });
  }
  return {
    // A long recording plays in real time: faster, a window of 40 ms would jump.
    open: () => {
      state.set(busiestWindow(state));
      if (data.duration_us > 4e6) speed.value = "real";
      if (!matchMedia("(prefers-reduced-motion: reduce)").matches) setPlaying(true);
    },
    pause: () => setPlaying(false),
    toggle: () => setPlaying(!state.playing),
    // One window earlier or later.
    jump: (direction) => {
      setPlaying(false);
      state.set({ start: Math.min(state.start + direction * state.length, 1 - Math.min(state.length, 1)) });
    },
  };
};

const startPage = () => {
  const data = JSON.parse(element("data").textContent);
  const explain = (text) => {
    for (const part of document.querySelectorAll(".needs-events")) part.hidden = true;
    element("cloud").style.height = "auto";
    element("cloud-fallback").hidden = false;
    if (text) element("cloud-fallback").textContent = text;
  };
  if (data.count === 0) return explain("This recording holds no events.");
  const state = makeState(data);
  const controls = makeControls(state);
  makePlane(state);
  makeRate(state, controls.pause);
  // Without WebGL all the rest still works.
  if (!makeCloud(state, controls)) {
    element("cloud-canvas").hidden = element("view-buttons").hidden = true;
    element("cloud").style.height = "auto";
    element("cloud-fallback").hidden = false;
  }
  controls.open();
};
startPage();
// A page that frames this one may make room for all of it.
if (parent !== window) {
  const tell = () => {
    const height = document.body.offsetHeight;
    if (height) parent.postMessage({ height }, "*");
    else setTimeout(tell, 200); // not laid out yet; and out of sight nothing is observed
  };
  tell();
  new ResizeObserver(tell).observe(document.body);
}
