// The image plane: source frame and events of the time window, and the selected region.

const makePlane = (state) => {
  const { data, events } = state;
  const canvas = element("plane-canvas");
  canvas.width = data.width;
  canvas.height = data.height;
  document.documentElement.style.setProperty("--ratio", data.width / data.height);
  const context = canvas.getContext("2d");
  const imageData = context.createImageData(data.width, data.height);
  const pixels = new Uint32Array(imageData.data.buffer);
  const [on, off] = [new Uint32Array(pixels.length), new Uint32Array(pixels.length)];
  const regionMarks = [...document.querySelectorAll(".region-mark")];
  const fields = ["x0", "x1", "y0", "y1"].map((name) => element("region-" + name));

  const count = () => {
    on.fill(0);
    off.fill(0);
    const [first, last] = state.range();
    const { x0, y0, x1, y1 } = state.region;
    let inside = 0;
    for (let i = first; i < last; i++) {
      const [x, y] = [events.xy[2 * i], events.xy[2 * i + 1]];
      if (events.p[i] ? state.on : state.off) {
        (events.p[i] ? on : off)[y * data.width + x]++;
        if (x >= x0 && x < x1 && y >= y0 && y < y1) inside++;
      }
    }
    return inside;
  };

  // As in texvent's images: hue is the polarity, strength the number of events.
  const paint = () => {
    let [sum, active] = [0, 0];
    for (let i = 0; i < pixels.length; i++) {
      const total = on[i] + off[i];
      if (total) { sum += total; active++; }
    }
    const ceiling = Math.max(1, (2 * sum) / Math.max(active, 1));
    const { on: onColour, off: offColour, background } = state.palette;
    const colour = [0, 0, 0];
    const bytes = imageData.data;
    for (let i = 0; i < pixels.length; i++) {
      const total = on[i] + off[i];
      const strength = total ? Math.min(1, Math.max(0.3, Math.sqrt(total / ceiling))) : 0;
      const share = total ? on[i] / total : 0;
      for (let c = 0; c < 3; c++) {
        colour[c] = share * onColour[c] + (1 - share) * offColour[c];
        bytes[4 * i + c] = background[c] + strength * (colour[c] - background[c]);
      }
      bytes[4 * i + 3] = 255;
    }
    context.putImageData(imageData, 0, 0);
  };

  const showRegion = (inside) => {
    const { x0, y0, x1, y1 } = state.region;
    const part = state.regionIsWhole();
    for (const regionMark of regionMarks) {
      regionMark.hidden = part;
      regionMark.style.left = (100 * x0) / data.width + "%";
      regionMark.style.top = (100 * y0) / data.height + "%";
      regionMark.style.width = (100 * (x1 - x0)) / data.width + "%";
      regionMark.style.height = (100 * (y1 - y0)) / data.height + "%";
    }
    // Last column and row, included.
    [x0, x1 - 1, y0, y1 - 1].forEach((value, i) => {
      if (fields[i] !== document.activeElement) fields[i].value = value;
    });
    element("region-clear").disabled = part;
    element("shown-text").textContent =
      inside.toLocaleString("en") + " of the cloud's " + data.count.toLocaleString("en") +
      " events in this time" + (part ? "" : " and region");
  };

  // The source frame at the start of the window.
  const video = element("video-canvas");
  const images = video ? data.frames.map(({ src }) => Object.assign(new Image(), { src })) : [];
  images.forEach((image) => image.addEventListener("load", () => state.changed()));
  const showFrame = () => {
    if (!video) return;
    let index = 0;
    while (index + 1 < data.frames.length && data.frames[index + 1].t <= state.start + 1e-6) index++;
    const image = images[index];
    if (!image.complete || !image.naturalWidth || video.dataset.frame === String(index)) return;
    if (video.width !== image.naturalWidth) video.width = image.naturalWidth;
    if (video.height !== image.naturalHeight) video.height = image.naturalHeight;
    video.getContext("2d").drawImage(image, 0, 0);
    video.dataset.frame = index;
  };

  // Turning the cloud changes nothing here, and counting a million events takes longer than a
  // screen refresh, so it is only done again when something else is shown.
  let shown = "";
  state.onChange(() => {
    showFrame();
    const wanted = JSON.stringify([state.start, state.length, state.on, state.off, state.region, state.palette === data]);
    if (wanted === shown) return;
    shown = wanted;
    const inside = count();
    paint();
    showRegion(inside);
  });

  // Drag selects; a click without a drag selects everything again.
  let corner = null;
  const pixelAt = (event) => {
    const box = canvas.getBoundingClientRect();
    return [((event.clientX - box.left) / box.width) * data.width, ((event.clientY - box.top) / box.height) * data.height];
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    corner = { at: pixelAt(event), x: event.clientX, y: event.clientY, moved: false };
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!corner) return;
    corner.moved ||= Math.hypot(event.clientX - corner.x, event.clientY - corner.y) > 4;
    if (corner.moved) state.setRegion(...corner.at, ...pixelAt(event));
  });
  canvas.addEventListener("pointerup", () => {
    if (corner && !corner.moved) state.clearRegion();
    corner = null;
  });
  canvas.addEventListener("pointercancel", () => { corner = null; });
  for (const field of fields) {
    field.addEventListener("change", () => {
      const [x0, x1, y0, y1] = fields.map((one) => Number(one.value));
      state.setRegion(x0, y0, x1 + 1, y1 + 1);
    });
  }
  element("region-clear").addEventListener("click", () => state.clearRegion());
};
