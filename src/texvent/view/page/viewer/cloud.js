// The x-y-t point cloud. Events go to the graphics card once; a frame is one draw call over the
// events of the time window, and turning, hiding and selecting only change a few numbers.

const makeCloud = (state, controls) => {
  const { data, events } = state;
  const canvas = element("cloud-canvas");
  const gl = canvas.getContext("webgl", { antialias: true, alpha: false });
  if (!gl) return false;
  const camera = { zoom: 1 };
  const views = {
    space: { yaw: -0.62, pitch: 0.32, perspective: 1 },
    front: { yaw: 0, pitch: 0, perspective: 0 },
    side: { yaw: -Math.PI / 2, pitch: 0, perspective: 0 },
    top: { yaw: 0, pitch: Math.PI / 2, perspective: 0 },
  };
  Object.assign(camera, views.space);

  // The box around the events of the time window: x and y keep their proportions, time runs into
  // the depth.
  const longest = Math.max(data.width, data.height);
  const half = [data.width / longest, data.height / longest, 1.35];
  const focal = 3.2;

  // Rotation by yaw about the vertical axis, then pitch about the horizontal one.
  const rotate = ([x, y, z]) => {
    const [cy, sy] = [Math.cos(camera.yaw), Math.sin(camera.yaw)];
    const [cp, sp] = [Math.cos(camera.pitch), Math.sin(camera.pitch)];
    const [x1, z1] = [cy * x - sy * z, sy * x + cy * z];
    return [x1, cp * y + sp * z1, cp * z1 - sp * y];
  };
  const corners = [-1, 1].flatMap((x) => [-1, 1].flatMap((y) => [-1, 1].map((z) => [x * half[0], y * half[1], z * half[2]])));

  // Distance and scale that let the whole box fill the canvas from the current side.
  let fit = { scale: 1, x: 0, y: 0 };
  const project = (point) => {
    const [x, y, z] = rotate(point);
    const w = 1 + camera.perspective * (z + 1.2) / focal;
    return [x / w, y / w, w];
  };
  const fitBox = (aspect) => {
    const shown = corners.map(project);
    const [xs, ys] = [shown.map((p) => p[0]), shown.map((p) => p[1])];
    const [left, right] = [Math.min(...xs), Math.max(...xs)];
    const [low, high] = [Math.min(...ys), Math.max(...ys)];
    const scale = 0.84 * Math.min((2 * aspect) / (right - left), 2 / (high - low));
    fit = { scale: scale * camera.zoom, x: (left + right) / 2, y: (low + high) / 2 };
  };

  const compile = (kind, source) => {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    return shader;
  };
  const link = (vertex, fragment) => {
    const program = gl.createProgram();
    gl.attachShader(program, compile(gl.VERTEX_SHADER, vertex));
    gl.attachShader(program, compile(gl.FRAGMENT_SHADER, fragment));
    gl.linkProgram(program);
    return program;
  };
  const projection = `
    uniform vec4 rotation; uniform vec4 fit; uniform float perspective;
    vec4 project(vec3 p) {
      vec2 a = vec2(rotation.x * p.x - rotation.y * p.z, rotation.y * p.x + rotation.x * p.z);
      vec3 r = vec3(a.x, rotation.z * p.y + rotation.w * a.y, rotation.z * a.y - rotation.w * p.y);
      float w = 1.0 + perspective * (r.z + 1.2);
      vec2 s = (r.xy / w - fit.xy) * vec2(fit.z / fit.w, fit.z);
      return vec4(s * w, (r.z / 8.0) * w, w);
    }`;
  const points = link(`
    attribute vec2 xy; attribute float t; attribute float p;
    uniform vec2 size; uniform vec3 halfBox; uniform vec2 shown;
    uniform vec4 region; uniform vec2 timeWindow; uniform float pointSize; varying float polarity; varying float depth;
    ${projection}
    void main() {
      vec2 unit = (xy + 0.5) / size * 2.0 - 1.0;
      gl_Position = project(vec3(unit.x, -unit.y, (t - timeWindow.x) / timeWindow.y * 2.0 - 1.0) * halfBox);
      gl_PointSize = max(1.0, pointSize / gl_Position.w);
      polarity = p; depth = gl_Position.w;
      bool outside = xy.x < region.x || xy.y < region.y || xy.x >= region.z || xy.y >= region.w;
      bool hidden = outside || (p > 0.5 ? shown.x : shown.y) < 0.5;
      if (hidden) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    }`, `
    precision mediump float;
    uniform vec3 onColour; uniform vec3 offColour; uniform vec3 background;
    varying float polarity; varying float depth;
    void main() {
      vec3 colour = polarity > 0.5 ? onColour : offColour;
      gl_FragColor = vec4(mix(colour, background, clamp((depth - 0.9) * 0.5, 0.0, 0.5)), 1.0);
    }`);
  const lines = link(`
    attribute vec3 corner; ${projection}
    void main() { gl_Position = project(corner); }`, `
    precision mediump float; uniform vec3 ink;
    void main() { gl_FragColor = vec4(ink, 1.0); }`);

  const upload = (values) => {
    const buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
    return buffer;
  };
  const buffers = {
    xy: upload(events.xy),
    t: upload(events.t),
    p: upload(events.p),
  };
  const edges = [];
  for (let axis = 0; axis < 3; axis++) {
    for (const a of [-1, 1]) for (const b of [-1, 1]) for (const end of [-1, 1]) {
      const corner = [0, 0, 0];
      corner[axis] = end * half[axis];
      corner[(axis + 1) % 3] = a * half[(axis + 1) % 3];
      corner[(axis + 2) % 3] = b * half[(axis + 2) % 3];
      edges.push(...corner);
    }
  }
  buffers.edges = upload(new Float32Array(edges));
  // Outlines of the region at the begin and the end of the time window.
  buffers.frame = gl.createBuffer();

  // Names are looked up once: asking the driver again in every frame is slow.
  const locations = new Map();
  const locationOf = (program, name, method) => {
    if (!locations.has(program)) locations.set(program, {});
    const known = locations.get(program);
    if (!(name in known)) known[name] = gl[method](program, name);
    return known[name];
  };
  const attribute = (program, name, buffer, count, type) => {
    const location = locationOf(program, name, "getAttribLocation");
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(location);
    gl.vertexAttribPointer(location, count, type, false, 0, 0);
  };
  const uniform = (program, name, ...values) =>
    gl["uniform" + values.length + "f"](locationOf(program, name, "getUniformLocation"), ...values);
  const unit = (colour) => colour.map((value) => value / 255);
  const faded = () => state.palette.ink.map((value, i) => value + 0.62 * (state.palette.background[i] - value));

  const labels = [
    { axis: 0, at: [0, -half[1], -half[2]], text: "x 0…" + (data.width - 1), shift: [-0.5, 0.35] },
    { axis: 1, at: [-half[0], 0, -half[2]], text: "y 0…" + (data.height - 1), shift: [-1.12, -0.5] },
    { axis: 2, at: [half[0], -half[1], 0], text: "time →", shift: [0.1, 0.35] },
    { axis: 2, at: [half[0], -half[1], -half[2]], text: "000.000 s", shift: [0.15, 0.1] },
    { axis: 2, at: [half[0], -half[1], half[2]], text: "000.000 s", shift: [0.1, 0.1] },
  ].map((label) => {
    const span = document.createElement("span");
    span.textContent = label.text;
    element("cloud-labels").append(span);
    return { ...label, span, w: 0, h: 0 };
  });
  // Only for a new canvas size: reading sizes in every frame makes the browser lay out the page
  // again and again.
  let measuredFor = 0;
  const measureLabels = (width) => {
    if (measuredFor === width) return;
    measuredFor = width;
    for (const label of labels) label.span.hidden = false;
    for (const label of labels) [label.w, label.h] = [label.span.offsetWidth, label.span.offsetHeight];
  };

  const [firstTime, lastTime] = labels.slice(-2).map(({ span }) => span);
  const placeLabels = (width, height) => {
    measureLabels(width);
    firstTime.textContent = state.seconds(state.start).toFixed(3) + " s";
    lastTime.textContent = state.seconds(state.start + state.length).toFixed(3) + " s";
    labels.forEach(({ axis, at, span, shift, w, h }) => {
      const [x, y] = project(at);
      const left = (((x - fit.x) * fit.scale) / (width / height) + 1) / 2 * width;
      const top = (1 - (y - fit.y) * fit.scale) / 2 * height;
      const px = Math.min(Math.max(left + shift[0] * w, 4), width - w - 4);
      const py = Math.min(Math.max(top + shift[1] * h, 2), height - h - 2);
      span.style.transform = `translate(${px.toFixed(1)}px, ${py.toFixed(1)}px)`;
      // An axis seen end-on has no length: its labels would lie over each other.
      const [dx, dy] = rotate([0, 1, 2].map((one) => (one === axis ? 1 : 0)));
      span.hidden = Math.hypot(dx, dy) < 0.2;
    });
  };

  const drawLines = (buffer, first, count, colour) => {
    attribute(lines, "corner", buffer, 3, gl.FLOAT);
    uniform(lines, "ink", ...unit(colour));
    gl.drawArrays(gl.LINES, first, count);
  };
  const common = (program, aspect) => {
    gl.useProgram(program);
    uniform(program, "rotation", Math.cos(camera.yaw), Math.sin(camera.yaw), Math.cos(camera.pitch), Math.sin(camera.pitch));
    uniform(program, "fit", fit.x, fit.y, fit.scale, aspect);
    uniform(program, "perspective", camera.perspective / focal);
  };

  const draw = () => {
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (!width || !height) return;
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    const aspect = width / height;
    fitBox(aspect);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(...unit(state.palette.background), 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);

    common(lines, aspect);
    drawLines(buffers.edges, 0, 24, faded());
    const { x0, y0, x1, y1 } = state.region;
    if (!state.regionIsWhole()) {
      const rectangle = [];
      for (const z of [-half[2], half[2]]) {
        const loop = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]].map(([x, y]) => [
          ((2 * x) / data.width - 1) * half[0], (1 - (2 * y) / data.height) * half[1], z]);
        loop.forEach((corner, i) => rectangle.push(...corner, ...loop[(i + 1) % 4]));
      }
      gl.bindBuffer(gl.ARRAY_BUFFER, buffers.frame);
      gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(rectangle), gl.DYNAMIC_DRAW);
      drawLines(buffers.frame, 0, 16, state.palette.ink);
    }

    common(points, aspect);
    attribute(points, "xy", buffers.xy, 2, gl.UNSIGNED_SHORT);
    attribute(points, "t", buffers.t, 1, gl.FLOAT);
    attribute(points, "p", buffers.p, 1, gl.UNSIGNED_BYTE);
    uniform(points, "size", data.width, data.height);
    uniform(points, "halfBox", ...half);
    uniform(points, "region", x0, y0, x1, y1);
    uniform(points, "shown", state.on ? 1 : 0, state.off ? 1 : 0);
    // Few points are larger: up to a pixel of the sensor, or what the eye still sees well.
    const pixel = (canvas.height * fit.scale) / longest;
    const [first, last] = state.range();
    const sparsity = Math.sqrt(60000 / Math.max(last - first, 0.05 * data.count, 1));
    uniform(points, "pointSize", Math.min(Math.max(pixel * 1.1, 2.4 * ratio), ratio * Math.min(3, 1.35 * Math.max(1, sparsity)) * camera.zoom));
    uniform(points, "onColour", ...unit(state.palette.on));
    uniform(points, "offColour", ...unit(state.palette.off));
    uniform(points, "background", ...unit(state.palette.background));
    uniform(points, "timeWindow", state.start, state.length);
    if (last > first) gl.drawArrays(gl.POINTS, first, last - first);
    placeLabels(width, height);
  };
  state.onChange(draw);

  for (const button of document.querySelectorAll("[data-view]")) {
    button.addEventListener("click", () => {
      const view = button.dataset.view;
      Object.assign(camera, views[view], { zoom: 1 });
      // The whole recording in one image smears.
      if (view === "front" && state.length === 1) state.set(busiestWindow(state));
      state.changed();
    });
  }

  const turn = (dx, dy) => {
    camera.perspective = 1;
    camera.yaw -= dx;
    camera.pitch = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, camera.pitch + dy));
    state.changed();
  };
  const zoom = (factor) => {
    camera.zoom = Math.max(0.5, Math.min(12, camera.zoom * factor));
    state.changed();
  };
  const pointers = new Map();
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  canvas.addEventListener("pointermove", (event) => {
    const old = pointers.get(event.pointerId);
    if (!old) return;
    const apart = pointers.size === 2 ? spread() : 0;
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (pointers.size === 2) {
      if (apart > 0) zoom(spread() / apart);
    } else {
      turn((event.clientX - old.x) / 200, (event.clientY - old.y) / 200);
    }
  });
  for (const name of ["pointerup", "pointercancel"]) {
    canvas.addEventListener(name, (event) => pointers.delete(event.pointerId));
  }
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoom(Math.exp(-event.deltaY / 500));
  }, { passive: false });
  canvas.addEventListener("keydown", (event) => {
    const actions = {
      ArrowLeft: () => turn(-0.08, 0), ArrowRight: () => turn(0.08, 0),
      ArrowUp: () => turn(0, -0.08), ArrowDown: () => turn(0, 0.08),
      "+": () => zoom(1.15), "=": () => zoom(1.15), "-": () => zoom(1 / 1.15),
      "0": () => {
        Object.assign(camera, views.space, { zoom: 1 });
        state.set(busiestWindow(state));
      },
      " ": controls.toggle, ",": () => controls.jump(-1), ".": () => controls.jump(1),
    };
    if (!actions[event.key]) return;
    event.preventDefault();
    actions[event.key]();
  });
  new ResizeObserver(state.changed).observe(canvas);
  canvas.addEventListener("webglcontextlost", (event) => {
    event.preventDefault();
    element("cloud-fallback").textContent = "The graphics card was reset; reload the page to see the cloud.";
    element("cloud-fallback").hidden = false;
  });
  return true;
};
