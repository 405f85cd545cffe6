// Draws one load case (the data of mbla/results/view3d/scene.py) with plotly.js and moves its mechanism.
// It begins when its place comes into view: a browser has only some sixteen drawings of this kind at a time, and one that
// is folded away has no size yet.
window.mblaView3d = function (host, data) {
  host.style.minHeight = "420px";
  const watch = new IntersectionObserver((entries) => {
    if (!entries.some((entry) => entry.isIntersecting)) return;
    watch.disconnect();
    host.style.minHeight = "";
    window.mblaDrawView3d(host, data);
  }, { rootMargin: "300px" });
  watch.observe(host);
};

window.mblaDrawView3d = function (host, data) {
  "use strict";
  const MOST_MOVING = 3000;  // blocks that move smoothly; of more there are two states
  const kinds = { f4: Float32Array, i4: Int32Array, u1: Uint8Array };
  function unpacked(array) {
    const text = atob(array.bdata);
    const bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
    return new kinds[array.dtype](bytes.buffer);
  }
  const vertices = unpacked(data.vertices), vertexStart = unpacked(data.vertexStart);
  const triangles = unpacked(data.triangles), blockOfTriangle = unpacked(data.blockOfTriangle);
  const edges = unpacked(data.edges), partOfBlock = unpacked(data.partOfBlock);
  const motion = data.motion && unpacked(data.motion);
  const blockCount = vertexStart.length - 1;
  const blockOfVertex = new Int32Array(vertices.length / 3);
  for (let b = 0; b < blockCount; b++) blockOfVertex.fill(b, vertexStart[b], vertexStart[b + 1]);
  const marks = data.marks.map((mark) => ({
    ...mark, points: unpacked(mark.points), bodies: unpacked(mark.bodies), pairs: unpacked(mark.pairs),
    textRows: unpacked(mark.textRows),
  }));

  // --- finite motion: p' = R p + d of each part, between the frames that motion.py gives -----------------------------

  function poseAt(time) {  // 12 numbers a part: R by rows, each followed by its d
    const steps = data.steps, size = motion.length / (steps + 1), before = Math.min(Math.floor(time * steps), steps - 1);
    const share = time * steps - before, first = size * before, pose = new Float64Array(size);
    for (let k = 0; k < size; k++) pose[k] = (1 - share) * motion[first + k] + share * motion[first + size + k];
    return pose;
  }

  function carry(points, row, block, state, into, place, weight) {
    const p = 3 * row;
    if (!state || block < 0 || block >= blockCount) {
      for (let i = 0; i < 3; i++) into[place + i] += weight * points[p + i];
      return;
    }
    for (let i = 0; i < 3; i++) {
      const r = 12 * partOfBlock[block] + 4 * i;
      const turned = state[r] * points[p] + state[r + 1] * points[p + 1] + state[r + 2] * points[p + 2];
      into[place + i] += weight * (turned + state[r + 3]);
    }
  }

  function movedVertices(state) {
    if (!state) return vertices;
    const moved = new Float64Array(vertices.length);
    for (let row = 0; row < blockOfVertex.length; row++) carry(vertices, row, blockOfVertex[row], state, moved, 3 * row, 1);
    return moved;
  }

  function movedMark(mark, state) {
    const moved = new Float64Array(mark.points.length);
    for (let row = 0; row < moved.length / 3; row++) {
      for (let side = 0; side < 2; side++) carry(mark.points, row, mark.bodies[2 * row + side], state, moved, 3 * row, 0.5);
    }
    return moved;
  }

  // --- coordinates as plotly wants them ----------------------------------------------------------------------------

  function columns(points) {
    const count = points.length / 3, found = [0, 1, 2].map(() => new Float32Array(count));
    for (let row = 0; row < count; row++) for (let i = 0; i < 3; i++) found[i][row] = points[3 * row + i];
    return found;
  }

  function segments(points, pairs) {
    const count = pairs.length / 2, found = [0, 1, 2].map(() => new Float32Array(3 * count).fill(NaN));
    for (let k = 0; k < count; k++) {
      for (let end = 0; end < 2; end++) {
        for (let i = 0; i < 3; i++) found[i][3 * k + end] = points[3 * pairs[2 * k + end] + i];
      }
    }
    return found;
  }

  function segmentTexts(mark) {
    const found = [], { texts, textRows, pairs } = mark;
    for (let k = 0; k < pairs.length; k += 2) found.push(texts[textRows[pairs[k]]], texts[textRows[pairs[k + 1]]], "");
    return found;
  }

  function faceColours(colouring) {
    const rows = unpacked(colouring.rows);
    return Array.from(blockOfTriangle, (block) => colouring.colours[rows[block]]);
  }

  // --- traces ------------------------------------------------------------------------------------------------------

  const lamp = { x: 1e5 * data.eye[0], y: 1e5 * data.eye[1], z: 1e5 };  // above and behind the viewer
  const light = { ambient: 0.6, diffuse: 0.6, specular: 0, fresnel: 0, vertexnormalsepsilon: 0, facenormalsepsilon: 0 };
  const traces = [], updates = [];
  function add(trace, update) {
    traces.push({ showlegend: false, hoverinfo: "skip", ...trace });
    updates.push(update || null);
    return traces.length - 1;
  }
  function line(points, pairs, colour, width, more) {
    const [x, y, z] = segments(points, pairs);
    return { type: "scatter3d", mode: "lines", x, y, z, line: { color: colour, width }, connectgaps: false, ...more };
  }
  function mesh(points, indices, more) {
    const [x, y, z] = columns(points), corner = (n) => indices.filter((_, row) => row % 3 === n);
    return { type: "mesh3d", x, y, z, i: corner(0), j: corner(1), k: corner(2), flatshading: true, lighting: light, lightposition: lamp, ...more };
  }

  const hovertext = Array.from(blockOfVertex, (block) => data.texts[block]);
  const blocks = add(
    mesh(vertices, triangles, { facecolor: faceColours(data.colourings[0]), hoverinfo: "text", hovertext }),
    (state, moved) => columns(moved),
  );
  const edgeTrace = add(
    line(vertices, edges, "#222222", blockCount < 500 ? 3 : 1.5),
    (state, moved) => segments(moved, edges),
  );
  let ghost = null;
  if (motion) {
    ghost = add(line(vertices, unpacked(data.ghost), "#8A8A8A", 1, { visible: false }));
  }
  const layers = [{ name: "edges", colour: "#222222", traces: [edgeTrace], shown: true }];
  if (ghost !== null) layers.push({ name: "as built", colour: "#8A8A8A", traces: [ghost], shown: true });
  for (const mark of marks) {
    const dots = mark.dots ? { mode: "lines+markers", marker: { size: 4, color: mark.colour } } : {};
    const at = movedMark(mark, null);
    const more = { hoverinfo: "text", hovertext: segmentTexts(mark), visible: !mark.inside, ...dots };
    const trace = add(line(at, mark.pairs, mark.colour, mark.width, more), (state) => segments(movedMark(mark, state), mark.pairs));
    layers.push({ name: mark.name, colour: mark.colour, traces: [trace], shown: !mark.inside, inside: mark.inside });
  }
  if (data.ground) {
    const slab = mesh(unpacked(data.ground.points), unpacked(data.ground.triangles), { color: "#7A7A7A" });
    layers.push({ name: "ground", colour: "#7A7A7A", traces: [add(slab)], shown: true });
  }

  // --- page --------------------------------------------------------------------------------------------------------

  function element(tag, parent, properties, style) {
    const made = Object.assign(document.createElement(tag), properties || {});
    Object.assign(made.style, style || {});
    parent.appendChild(made);
    return made;
  }
  function labelled(parent, text, make) {
    const label = element("label", parent, {}, { display: "inline-flex", alignItems: "center", gap: "0.3em" });
    const control = make(label);
    label.appendChild(document.createTextNode(text));
    return control;
  }
  function swatch(parent, colour) {
    element("span", parent, {}, { width: "0.9em", height: "0.9em", background: colour, border: "1px solid #666", display: "inline-block" });
  }
  const row = { display: "flex", flexWrap: "wrap", gap: "0.3em 1em", alignItems: "center", margin: "0.3em 0" };
  const top = element("div", host, { className: "mbla-view3d-controls" }, row);
  const plot = element("div", host, { className: "mbla-view3d-plot" }, { width: "100%", height: "min(70vh, 640px, 95vw)", minHeight: "300px" });
  const legend = element("div", host, { className: "mbla-view3d-legend" }, row);
  const shownLayers = element("div", host, { className: "mbla-view3d-layers" }, row);

  function titleOf(axis) {
    const shift = data.offset["xyz".indexOf(axis)];
    const from = shift === 0 ? "" : shift < 0 ? ` + ${-shift}` : ` − ${shift}`;
    return `${axis}${from} [${data.unit}]`;
  }
  // plotly's orthographic view is two units high; the box of the scene is made to fill a share of it
  const size = [0, 1, 2].map((i) => data.high[i] - data.low[i]), widest = Math.max(...size);
  const length = (vector) => Math.hypot(...vector);
  const towards = data.eye.map((value) => value / length(data.eye));
  const right = [-towards[1], towards[0], 0].map((value) => value / Math.hypot(towards[0], towards[1]));
  const up = [0, 1, 2].map((i) => towards[(i + 1) % 3] * right[(i + 2) % 3] - towards[(i + 2) % 3] * right[(i + 1) % 3]);
  const across = (axis) => size.reduce((sum, value, i) => sum + (Math.abs(axis[i]) * value) / widest, 0);
  const shape = (plot.clientWidth || 800) / (plot.clientHeight || 600);
  const zoom = Math.min((1.8 * shape * 0.9) / across(right), (1.8 * 0.95) / across(up));
  const extent = (i) => (zoom * size[i]) / widest;
  const far = 2 * zoom * length(size) / widest;  // the eye stays outside of the box, however it is turned
  const scene = {
    aspectmode: "manual",
    aspectratio: { x: extent(0), y: extent(1), z: extent(2) },
    dragmode: "turntable",
    camera: { projection: { type: "orthographic" }, up: { x: 0, y: 0, z: 1 }, center: { x: 0, y: 0, z: 0 },
              eye: { x: far * towards[0], y: far * towards[1], z: far * towards[2] } },
  };
  ["x", "y", "z"].forEach((axis, i) => {
    const share = size[i] / widest;
    scene[`${axis}axis`] = {
      title: { text: share < 0.15 ? "" : titleOf(axis) }, range: [data.low[i], data.high[i]], showspikes: false,
      nticks: Math.max(2, Math.round(8 * share)), showticklabels: share >= 0.15, backgroundcolor: "#FFFFFF",
      gridcolor: "#DDDDDD", zeroline: false, exponentformat: "power",
    };
  });
  const layout = { scene, margin: { l: 0, r: 0, t: 0, b: 0 }, paper_bgcolor: "#FFFFFF", showlegend: false, uirevision: 1 };
  const config = { displaylogo: false, responsive: true, showLink: false, plotlyServerURL: "", showSendToCloud: false,
                   modeBarButtonsToRemove: ["orbitRotation", "tableRotation", "resetCameraLastSave3d"] };

  let time = 0, seeThrough = null;
  function show() {
    const state = time > 0 ? poseAt(time) : null, moved = movedVertices(state);
    const rows = [], x = [], y = [], z = [];
    updates.forEach((update, index) => {
      if (!update) return;
      const [a, b, c] = update(state, moved);
      rows.push(index); x.push(a); y.push(b); z.push(c);
    });
    return Plotly.restyle(plot, { x, y, z }, rows).then(() => (ghost === null ? null : showLayers()));
  }
  function showLayers() {
    const index = [], visible = [];
    for (const layer of layers) {
      for (const trace of layer.traces) {
        index.push(trace);
        visible.push(layer.shown && (trace !== ghost || time > 0));
      }
    }
    if (index.every((trace, k) => traces[trace].visible === visible[k])) return null;
    index.forEach((trace, k) => { traces[trace].visible = visible[k]; });
    return Plotly.restyle(plot, { visible }, index);
  }
  function throughBlocks() {
    return Plotly.restyle(plot, { opacity: seeThrough.checked ? 0.2 : 1 }, [blocks]);
  }
  function colourBy(name) {
    const colouring = data.colourings.find((each) => each.name === name);
    legend.replaceChildren();
    for (const [text, colour] of colouring.legend) {
      const entry = element("span", legend, {}, { display: "inline-flex", alignItems: "center", gap: "0.3em" });
      if (colour) swatch(entry, colour);
      entry.appendChild(document.createTextNode(text));
    }
    return faceColours(colouring);
  }

  if (motion) {
    const slider = labelled(top, data.motionWords, (label) => {
      Object.assign(label.style, { flexWrap: "wrap" });
      const large = blockCount > MOST_MOVING, play = element("button", label, { type: "button", textContent: "play" });
      if (large) play.remove();
      element("span", label, { textContent: "as built" }, { whiteSpace: "nowrap" });
      const size = { width: large ? "3em" : "12em" };
      const range = element("input", label, { type: "range", min: 0, max: 1, step: large ? 1 : 0.01, value: 0 }, size);
      range.setAttribute("aria-label", "how far the mechanism has moved");
      let begun = null;
      function frame(now) {
        if (begun === null) return;
        range.value = 0.5 - 0.5 * Math.cos(((now - begun) / 4000) * 2 * Math.PI);
        time = Number(range.value);
        show().then(() => requestAnimationFrame(frame));
      }
      play.addEventListener("click", () => {
        const running = begun !== null;
        begun = running ? null : performance.now();
        play.textContent = running ? "play" : "stop";
        if (!running) requestAnimationFrame(frame);
      });
      return range;
    });
    let waiting = false;
    slider.addEventListener("input", () => {
      if (waiting) return;
      waiting = true;
      requestAnimationFrame(() => {
        waiting = false;
        time = Number(slider.value);
        show();
      });
    });
    time = 1;
    slider.value = 1;
  }
  const chooser = labelled(top, "", (label) => {
    label.appendChild(document.createTextNode("colour by "));
    return element("select", label);
  });
  for (const each of data.colourings) element("option", chooser, { value: each.name, textContent: each.name });
  chooser.addEventListener("change", () => Plotly.restyle(plot, { facecolor: [colourBy(chooser.value)] }, [blocks]));
  seeThrough = labelled(top, "see through blocks", (label) => element("input", label, { type: "checkbox" }));
  seeThrough.addEventListener("change", throughBlocks);
  for (const layer of layers) {
    labelled(shownLayers, layer.name, (label) => {
      const box = element("input", label, { type: "checkbox", checked: layer.shown });
      swatch(label, layer.colour);
      box.addEventListener("change", () => {
        layer.shown = box.checked;
        showLayers();
        if (layer.inside && box.checked && !seeThrough.checked) {
          seeThrough.checked = true;
          throughBlocks();
        }
      });
      return box;
    });
  }
  if (data.forceWords) element("span", shownLayers, { textContent: `(${data.forceWords})` }, { color: "#555" });
  colourBy(data.colourings[0].name);
  return Plotly.newPlot(plot, traces, layout, config).then(() => (motion ? show() : null)).then(() => {
    host.dataset.mblaReady = "yes";
  });
};
