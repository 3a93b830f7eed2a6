// The rate curve: a drag on it chooses the time window, a click moves the window there.

const makeRate = (state, pausePlayback) => {
  const curve = element("rate-curve");
  if (!curve) return;
  const { data, events } = state;
  const [mark, outline] = [element("rate-window"), element("rate-region")];
  const [width, height] = [1000, 200];
  // The last bin ends after the last event, so the curve is a little longer than the recording.
  const span = (width * data.duration_us) / (data.rate.bins * data.rate.bin_us);

  // Of the events in the cloud, those in the region, on the scale of the whole curve.
  const outlineOf = ({ x0, y0, x1, y1 }) => {
    const counts = [new Float64Array(data.rate.bins), new Float64Array(data.rate.bins)];
    for (let i = 0; i < data.count; i++) {
      const [x, y] = [events.xy[2 * i], events.xy[2 * i + 1]];
      if (x < x0 || x >= x1 || y < y0 || y >= y1) continue;
      const bin = Math.floor((events.t[i] * data.duration_us) / data.rate.bin_us);
      counts[events.p[i]][Math.min(bin, data.rate.bins - 1)]++;
    }
    const scale = (0.96 * height * data.seen) / data.count / 2 / data.rate.peak;
    const step = width / data.rate.bins;
    return [-1, 1].map((sign) => {
      const row = counts[sign < 0 ? 1 : 0];
      return "M0 " + height / 2 + Array.from(row, (value, i) =>
        `V${(height / 2 + sign * value * scale).toFixed(1)}H${((i + 1) * step).toFixed(2)}`).join("");
    }).join("");
  };
  let drawn = null;
  state.onChange(() => {
    mark.setAttribute("x", state.start * span);
    mark.setAttribute("width", state.length < 1 ? Math.max(2, (state.stop() - state.start) * span) : 0);
    if (drawn === state.region) return;
    drawn = state.region;
    outline.setAttribute("d", state.regionIsWhole() ? "" : outlineOf(state.region));
    element("rate-region-note").hidden = state.regionIsWhole();
  });

  let from = null;
  const share = (event) => {
    const box = curve.getBoundingClientRect();
    return Math.min(Math.max(((event.clientX - box.left) / box.width) * (width / span), 0), 1);
  };
  curve.addEventListener("pointerdown", (event) => {
    curve.setPointerCapture(event.pointerId);
    from = { share: share(event), x: event.clientX, moved: false };
  });
  curve.addEventListener("pointermove", (event) => {
    if (!from) return;
    from.moved ||= Math.abs(event.clientX - from.x) > 4;
    if (!from.moved) return;
    const ends = [from.share, share(event)];
    pausePlayback();
    state.set({ start: Math.min(...ends), length: Math.max(0.001, Math.abs(ends[1] - ends[0])) });
  });
  curve.addEventListener("pointerup", (event) => {
    if (from && !from.moved) {
      const length = state.length < 1 ? state.length : 0.06;
      pausePlayback();
      state.set({ start: Math.min(Math.max(share(event) - length / 2, 0), 1 - length), length });
    }
    from = null;
  });
  curve.addEventListener("pointercancel", () => { from = null; });
};
