// Joins the view in 3D, the drawing and the tables: what is picked in one is shown in all.

(() => {
  const one = (selector) => document.querySelector(selector);
  const all = (selector) => [...document.querySelectorAll(selector)];
  const data = JSON.parse(one("#toile-data").textContent);
  const said = one("#picked"), canvas = one("canvas[data-view]");
  let viewer = null;
  try {
    if (one("#toile-model")) viewer = new Viewer(canvas, readGlb(bytesOf(one("#toile-model").textContent)), data);
  } catch (problem) {
    document.body.dataset.still = String(problem.message);
  }
  document.body.classList.toggle("live", !!viewer);

  const state = { picked: null };
  const LISTS = { TR: "table", LI: "list" };
  // Places that findings name. A mark stands for the piece or seam that it is about, too.
  const marks = data.marks || [], markOf = (name) => marks.find((m) => m.pick === name);
  function pick(name, from) {
    const found = name && data.names[name] ? name : null;
    const mark = markOf(found), target = mark ? mark.target : found;
    state.picked = found;
    if (viewer) {
      viewer.picked = target;
      viewer.draw();
    }
    all(".picked").forEach((e) => e.classList.remove("picked"));
    const marked = found ? all("[data-pick]").filter((e) => [found, target].includes(e.dataset.pick)) : [];
    marked.forEach((e) => e.classList.add("picked"));
    said.textContent = found ? data.names[found] : said.dataset.empty;
    const row = marked.find((e) => LISTS[e.tagName] && e.dataset.pick === found);
    if (row && !["table", "list"].includes(from)) {
      const folded = row.closest("details");
      if (folded) folded.open = true;
    }
    if (row && from === "drawing") row.scrollIntoView({ block: "nearest" });
    if (viewer) viewer.show(mark, from);
    else if (mark && from === "list") marked.find((e) => e.closest("svg"))?.scrollIntoView({ block: "nearest" });
  }

  function listen(e) {
    const from = LISTS[e.tagName] || "drawing";
    const go = (event) => {
      event.stopPropagation();
      pick(state.picked === e.dataset.pick ? null : e.dataset.pick, from);
    };
    e.addEventListener("click", go);
    const key = from === "table" ? e.querySelector("button") : null;
    if (key) key.addEventListener("click", go);
  }
  all("[data-pick]").forEach(listen);
  document.addEventListener("keydown", (e) => {
    if (e.key === "Escape") pick(null);
  });

  window.toile = {
    state: () => ({
      ready: !!viewer,
      pieces: data.pieces,
      picked: state.picked,
      map: viewer && viewer.map ? viewer.map.key : "cloth",
      view: viewer ? viewer.view : "still",
    }),
    pick,
    at: (x, y) => (viewer ? viewer.at(x, y) : null),
    screen: (name) => (viewer && markOf(name)?.at ? viewer.place(markOf(name)) : null),
    value: (x, y) => (viewer ? viewer.valueAt(x, y) : null),
    section: (height) => (viewer ? viewer.section(height).length : null),
  };
  if (!viewer) {
    pick(data.shown || null);
    return;
  }

  // A tool that a page may have.
  const tool = (selector, event, use) => {
    const found = one(selector);
    if (found) found.addEventListener(event, use);
  };
  const legend = one("#legend"), cutter = one("#cut"), inset = one("#section");
  function show() {
    const map = viewer.map;
    legend.hidden = !map;
    if (!map) return;
    const colours = map.stops.map((c) => `rgb(${c.join(",")})`).join(",");
    const [low, high] = map.ends;
    const mark = (k) => Number((low + ((high - low) * k) / 4).toFixed(2));
    const sign = (x) => (low < 0 && x > 0 ? "+" : "") + x;
    const last = low < 0 ? sign(mark(4)) : "≥ " + mark(4);
    legend.replaceChildren(document.createElement("b"), document.createElement("i"), document.createElement("span"));
    const [title, bar, marks] = legend.children;
    title.textContent = `${map.name}, ${map.unit}`;
    bar.style.background = `linear-gradient(to right,${colours})`;
    for (const text of [0, 1, 2, 3].map((k) => sign(mark(k))).concat(last)) {
      marks.append(Object.assign(document.createElement("span"), { textContent: text }));
    }
  }

  function cut() {
    const { low, high } = viewer.worn, share = Number(cutter.value) / 100;
    const isCut = share < 1;
    const height = low[1] + (high[1] - low[1]) * share;
    viewer.cut = isCut ? height : Infinity;
    viewer.draw();
    inset.hidden = !isCut;
    if (!isCut) return;
    const found = viewer.section(height), points = found.cloth.concat(found.body).flat();
    const xs = points.map((p) => p[0]), zs = points.map((p) => p[1]);
    const edge = [Math.min(...xs), Math.min(...zs), Math.max(...xs), Math.max(...zs)];
    const path = (lines) => lines.map(([a, b]) => `M${a[0].toFixed(4)} ${a[1].toFixed(4)}L${b[0].toFixed(4)} ${b[1].toFixed(4)}`).join("");
    const svg = inset.querySelector("svg");
    if (points.length) svg.setAttribute("viewBox", `${edge[0] - 0.01} ${edge[1] - 0.01} ${edge[2] - edge[0] + 0.02} ${edge[3] - edge[1] + 0.02}`);
    svg.querySelector(".body").setAttribute("d", path(found.body));
    svg.querySelector(".cloth").setAttribute("d", path(found.cloth));
    const words = inset.dataset.words.replace("{height}", Math.round(1000 * height)).replace("{length}", Math.round(1000 * found.length));
    inset.querySelector("figcaption").textContent = words;
  }

  all("[data-look]").forEach((b) => b.addEventListener("click", () => viewer.look(b.dataset.look)));
  tool("#body", "change", (e) => { viewer.withBody = e.target.checked; viewer.draw(); });
  tool("#map", "change", (e) => {
    viewer.setMap(data.fields.find((f) => f.key === e.target.value) || null);
    show();
  });
  tool("#colourway", "change", (e) => {
    viewer.colours = (data.colourways || [])[Number(e.target.value) - 1] || null;
    viewer.draw();
  });

  // The motion plays in its own time. The way from the flat pieces begins at rest.
  const player = one("#play"), slider = one("#moment");
  let playing = null;
  const moment = (value) => {
    viewer.motion.show(value);
    if (value !== null) slider.value = value;
    one("#seconds").textContent = value === null ? "" : `${(value / data.motion.fps).toFixed(2)} s`;
  };
  const stop = () => {
    playing = null;
    if (player) player.textContent = player.dataset.play;
  };
  const play = (last) => (now) => {
    if (!playing) return;
    const next = Number(slider.value) + ((now - last) / 1000) * data.motion.fps, end = data.motion.count - 1;
    moment(Math.min(next, end));
    if (next >= end) stop();
    else requestAnimationFrame(play(now));
  };
  if (viewer.motion) {
    slider.addEventListener("input", () => { stop(); moment(Number(slider.value)); });
    player.addEventListener("click", () => {
      if (playing) return stop();
      playing = true;
      player.textContent = player.dataset.pause;
      viewer.share = 1;
      one("#worn").value = 100;
      if (Number(slider.value) >= data.motion.count - 1.001) moment(0);
      requestAnimationFrame((now) => play(now)(now));
    });
  }
  tool("#worn", "input", (e) => {
    if (viewer.motion && !viewer.atRest()) { stop(); moment(null); }
    viewer.share = Number(e.target.value) / 100;
    if (viewer.share < 0.5 && viewer.view !== "front") viewer.look("front");
    viewer.draw();
  });
  tool("#cut", "input", cut);

  // Numbered pins stand on the places, and a ring around the one that is picked.
  const spot = one("#spot"), stage = canvas.parentElement;
  const pins = marks.filter((m) => m.at && m.number).map((mark) => {
    const pin = Object.assign(document.createElement("button"), { type: "button", className: "pin", textContent: mark.number });
    pin.dataset.pick = mark.pick;
    pin.title = data.names[mark.pick];
    listen(pin);
    stage.append(pin);
    return [pin, mark];
  });
  // The labels of the edges and notches of a piece that is picked, as the drawing has them.
  let tags = [];
  function tag(name) {
    tags.forEach(([label]) => label.remove());
    const piece = /^(?:piece|notch):(\d+)/.exec(name || "");
    const own = piece ? (data.tags || []).filter(([, , at]) => at[0] === Number(piece[1])) : [];
    tags = own.map(([text, isNotch, at]) => {
      const label = Object.assign(document.createElement("span"), { textContent: text, className: isNotch ? "tag notch" : "tag" });
      label.ariaHidden = "true";
      stage.append(label);
      return [label, { at }];
    });
  }

  // A notch is picked by a click near it: on its own piece, on the other side of its seam, or just beside the cloth.
  function notchAt(x, y, under) {
    const camera = viewer.camera(), near = 9 * ratio();
    const far = (m) => {
      const [left, top] = viewer.onScreen(placed(m), camera);
      return Math.hypot(left - x, top - y) + (m.target === under ? 0 : 0.5 * near) + (isBehind(m, camera) ? 4 * near : 0);
    };
    const notches = viewer.atRest() ? marks.filter((m) => m.at && m.pick.startsWith("notch:")) : [];
    const [best] = notches.map((m) => [far(m), m.pick]).sort((a, b) => a[0] - b[0]);
    return best && best[0] < near ? best[1] : under;
  }

  let shown = null;
  const placed = (mark) => {
    const [piece, [x, y, z, u, v]] = mark.at;
    return posed(pose(viewer.model.surfaces[piece].frame, viewer.share, viewer.lay()), [x, y, z], [u, v]);
  };
  const isBehind = (mark, camera) => {
    const [x, , z] = mark.at[1], { middle } = viewer.worn;
    return viewer.share > 0.5 && dot([x - middle[0], 0, z - middle[2]], camera.toward) < 0;
  };
  const put = (element, mark, camera) => {
    const [left, top] = viewer.onScreen(placed(mark), camera);
    element.style.left = `${left / ratio()}px`;
    element.style.top = `${top / ratio()}px`;
    element.classList.toggle("behind", isBehind(mark, camera));
  };
  viewer.painted = (camera) => {
    [...pins, ...tags].forEach(([pin, mark]) => put(pin, mark, camera));
    spot.hidden = !shown;
    if (shown) put(spot, shown, camera);
  };
  viewer.place = (mark) => viewer.onScreen(placed(mark), viewer.camera());
  viewer.show = (mark, from) => {
    shown = mark && mark.at ? mark : null;
    tag(state.picked);
    if (shown && from !== "view" && viewer.share > 0.5) {
      // From the side on which the place lies, a little from above.
      const [x, , z] = shown.at[1], { middle } = viewer.worn;
      viewer.look("front");
      Object.assign(viewer, { turn: (Math.atan2(x - middle[0], z - middle[2]) * 180) / Math.PI, rise: 15, view: "free" });
      if (from === "list") canvas.scrollIntoView({ block: "nearest" });
    }
    viewer.draw();
  };

  // Fingers and the mouse: one turns, two or the wheel change the size, with the shift key the garment is moved.
  const held = new Map();
  let moved = 0, apart = 0;
  const ratio = () => canvas.width / canvas.clientWidth;
  canvas.addEventListener("pointerdown", (e) => {
    canvas.setPointerCapture(e.pointerId);
    held.set(e.pointerId, [e.clientX, e.clientY]);
    moved = 0;
    apart = 0;
  });
  canvas.addEventListener("pointermove", (e) => {
    const before = held.get(e.pointerId);
    if (!before) return;
    const [dx, dy] = [e.clientX - before[0], e.clientY - before[1]];
    held.set(e.pointerId, [e.clientX, e.clientY]);
    moved += Math.hypot(dx, dy);
    if (held.size === 2) {
      const [a, b] = [...held.values()], now = Math.hypot(a[0] - b[0], a[1] - b[1]);
      if (apart) viewer.scale(now / apart);
      apart = now;
    } else if (e.shiftKey || e.buttons === 2) {
      viewer.shift = [viewer.shift[0] + (2 * dx) / canvas.clientWidth, viewer.shift[1] - (2 * dy) / canvas.clientHeight];
      viewer.draw();
    } else if (moved > 3) {
      viewer.orbit(-0.5 * dx, 0.4 * dy);
    }
  });
  const release = (e) => {
    const had = held.delete(e.pointerId);
    if (e.type !== "pointerup" || !had || moved > 4) return;
    const box = canvas.getBoundingClientRect();
    const [x, y] = [(e.clientX - box.left) * ratio(), (e.clientY - box.top) * ratio()];
    pick(notchAt(x, y, viewer.at(x, y)), "view");
    const value = viewer.valueAt(x, y);
    if (value === null) return;
    const words = [`${viewer.map.name}: ${value.toFixed(2)} ${viewer.map.unit}`];
    const way = /^(strain|tension)/.test(viewer.map.key) ? viewer.strainAt(x, y) : null;
    if (way) words.push(said.dataset.way.replace("{value}", way.strain.toFixed(2)).replace("{angle}", way.angle.toFixed(0)));
    said.textContent = [...words, said.textContent].join(", ");
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("contextmenu", (e) => e.preventDefault());
  canvas.addEventListener("wheel", (e) => {
    if (!e.ctrlKey && document.activeElement !== canvas) return;
    e.preventDefault();
    viewer.scale(Math.exp(-0.0015 * e.deltaY));
  }, { passive: false });
  canvas.addEventListener("keydown", (e) => {
    const turns = { ArrowLeft: [-10, 0], ArrowRight: [10, 0], ArrowUp: [0, 8], ArrowDown: [0, -8] };
    const views = { 1: "front", 2: "back", 3: "left", 4: "right", 5: "three-quarter" };
    if (turns[e.key]) viewer.orbit(...turns[e.key]);
    else if (views[e.key]) viewer.look(views[e.key]);
    else if (e.key === "+" || e.key === "=") viewer.scale(1.2);
    else if (e.key === "-") viewer.scale(1 / 1.2);
    else return;
    e.preventDefault();
  });
  new ResizeObserver(() => viewer.draw()).observe(canvas);
  viewer.look("three-quarter");
  pick(data.shown || null);
})();
