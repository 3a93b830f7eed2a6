// The state of the view and the events. Every part reads it and is called back after a change.

// Base64 → typed array.
const decode = (text, type) => {
  const raw = atob(text);
  const bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; i++) bytes[i] = raw.charCodeAt(i);
  return new type(bytes.buffer);
};

const element = (id) => document.getElementById(id);

const makeState = (data) => {
  const events = { xy: decode(data.xy, Uint16Array), t: decode(data.t, Float32Array), p: decode(data.p, Uint8Array) };
  const whole = () => ({ x0: 0, y0: 0, x1: data.width, y1: data.height });
  const state = {
    data,
    events,
    // `start` and `length` are shares of the recording.
    start: 0, length: 1, on: true, off: true, playing: false,
    // Columns x0 ≤ x < x1 and rows y0 ≤ y < y1.
    region: whole(),
  };
  const system = matchMedia("(prefers-color-scheme: dark)");
  const choosePalette = () => {
    state.palette = system.matches ? data.dark : data;
  };
  choosePalette();
  const listeners = [];
  let isScheduled = false;

  // Drawn once per screen refresh, whatever changed before it.
  state.onChange = (draw) => listeners.push(draw);
  state.changed = () => {
    if (isScheduled) return;
    isScheduled = true;
    requestAnimationFrame(() => {
      isScheduled = false;
      listeners.forEach((draw) => draw());
    });
  };
  const changeTheme = () => {
    choosePalette();
    state.changed();
  };
  system.addEventListener("change", changeTheme);
  state.set = (values) => {
    Object.assign(state, values);
    state.start = Math.min(Math.max(state.start, 0), 1);
    state.length = Math.min(Math.max(state.length, 1e-6), 1);
    state.changed();
  };
  state.stop = () => Math.min(1, state.start + state.length);

  // First event whose time is at or after `share`; events are in time order.
  const search = (share) => {
    let [low, high] = [0, data.count];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (events.t[middle] < share) low = middle + 1; else high = middle;
    }
    return low;
  };
  state.range = () => [
    state.start <= 0 ? 0 : search(state.start),
    state.stop() >= 1 ? data.count : search(state.stop()),
  ];

  state.regionIsWhole = () => {
    const { x0, y0, x1, y1 } = state.region;
    return x0 === 0 && y0 === 0 && x1 === data.width && y1 === data.height;
  };
  // Any two corners, in any order, inside the sensor or not.
  state.setRegion = (xa, ya, xb, yb) => {
    const order = (a, b, limit) => {
      const [low, high] = [Math.min(a, b), Math.max(a, b)].map((value) => Math.min(Math.max(Math.round(value), 0), limit));
      return low < high ? [low, high] : low < limit ? [low, low + 1] : [limit - 1, limit];
    };
    const [x0, x1] = order(xa, xb, data.width);
    const [y0, y1] = order(ya, yb, data.height);
    state.set({ region: { x0, y0, x1, y1 } });
  };
  state.clearRegion = () => state.set({ region: whole() });

  state.seconds = (share) => (data.start_us + share * data.duration_us) / 1e6;
  return state;
};
