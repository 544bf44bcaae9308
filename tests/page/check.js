// Runs in a report that tests/page.rs has opened, and gives what it saw as JSON.
(async () => {
  const out = { errors: [] };
  window.addEventListener("error", (e) => out.errors.push(e.message));
  const frame = () => new Promise((done) => setTimeout(() => requestAnimationFrame(() => setTimeout(done, 20)), 20));
  const canvas = document.querySelector("canvas[data-view]");
  const state = () => window.toile.state();
  const click = (x, y) => {
    const at = { clientX: x, clientY: y, pointerId: 1, bubbles: true, button: 0 };
    canvas.setPointerCapture = () => {};
    canvas.dispatchEvent(new PointerEvent("pointerdown", at));
    canvas.dispatchEvent(new PointerEvent("pointerup", at));
  };
  // How many pixels are not empty, and the mean of their colours.
  const seen = () => {
    const gl = canvas.getContext("webgl2"), { width, height } = canvas;
    const pixels = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    let count = 0, sum = [0, 0, 0];
    for (let i = 0; i < pixels.length; i += 4) {
      if (pixels[i + 3] < 128) continue;
      count++;
      for (let c = 0; c < 3; c++) sum[c] += pixels[i + c];
    }
    return { share: count / (width * height), mean: sum.map((x) => Math.round(x / Math.max(count, 1))) };
  };
  const set = (id, value, kind) => {
    const e = document.getElementById(id);
    if (!e) return;
    if (e.type === "checkbox") e.checked = value;
    else e.value = value;
    e.dispatchEvent(new Event(kind, { bubbles: true }));
  };
  try {
    await frame();
    await frame();
    out.opened = performance.now();
    out.state = state();
    out.requests = performance.getEntriesByType("resource").map((e) => e.name).filter((n) => !n.startsWith("data:") && !n.startsWith("blob:"));
    const listed = (selector) => document.querySelectorAll(selector).length;
    out.pins = listed(".stage .pin");
    out.marks = {
      picked: out.state.picked, shown: !document.getElementById("spot").hidden,
      list: listed(".findings .picked .pin"), drawing: listed("svg .found.picked"),
    };
    if (out.state.ready && document.getElementById("colourway")) {
      out.sewn = seen();
      set("colourway", "1", "change");
      await frame();
      out.navy = seen();
      for (const [name, value] of [["begin", 0], ["end", 11]]) {
        set("moment", value, "input");
        await frame();
        out[name] = { ...seen(), words: document.getElementById("seconds").textContent };
      }
      // The motion is played by a clock of this check, since that of a machine under load jumps.
      const own = window.requestAnimationFrame, waiting = [];
      window.requestAnimationFrame = (use) => waiting.push(use);
      let time = 1000;
      const tick = (ms) => { time += ms; waiting.splice(0).forEach((use) => use(time)); };
      document.getElementById("play").click();
      const moment = () => Number(document.getElementById("moment").value);
      out.played = [];
      for (const ms of [0, 100, 50, 1000]) {
        tick(ms);
        out.played.push(moment());
      }
      out.waits = document.getElementById("play").textContent === document.getElementById("play").dataset.play;
      window.requestAnimationFrame = own;
      waiting.forEach((use) => own(use));
    }
    if (out.state.ready) {
      document.querySelector("[data-look=front]").click();
      await frame();
      out.worn = seen();
      set("body", false, "change");
      await frame();
      out.bare = seen();
      set("map", "strain-warp", "change");
      await frame();
      out.map = { ...seen(), state: state().map, legend: document.getElementById("legend").innerText };
      // A click on a map tells the value there, and leaves the colours as they are.
      const view = canvas.getBoundingClientRect();
      for (let y = 0.1; y < 0.95 && !(state().picked || "").startsWith("piece"); y += 0.05) click(view.left + 0.47 * view.width, view.top + y * view.height);
      await frame();
      out.onMap = { ...seen(), words: document.getElementById("picked").textContent };
      window.toile.pick(null);
      set("map", "cloth", "change");
      set("worn", "0", "input");
      await frame();
      out.flat = seen();
      set("worn", "100", "input");
      set("cut", "60", "input");
      await frame();
      out.cut = { ...seen(), words: document.querySelector("#section figcaption").textContent };
      set("cut", "100", "input");
      await frame();
      const box = canvas.getBoundingClientRect();
      for (let y = 0.1; y < 0.95 && !state().picked; y += 0.05) click(box.left + 0.47 * box.width, box.top + y * box.height);
      await frame();
      out.picked = { name: state().picked, words: document.getElementById("picked").textContent };
      out.pickedTinted = seen();
      out.marked = [...document.querySelectorAll(".picked")].map((e) => e.tagName.toLowerCase());
      document.querySelector("tr[data-pick^='seam:'] button, tr[data-pick^='seam:']")?.click();
      await frame();
      out.fromTable = { name: state().picked, marked: document.querySelectorAll("svg .picked").length };
      const notch = document.querySelector("tr[data-pick^='notch:'] button");
      if (notch) {
        notch.click();
        await frame();
        const [x, y] = window.toile.screen(state().picked);
        const tags = [...document.querySelectorAll(".stage .tag.notch")].map((e) => e.textContent);
        out.notch = {
          row: notch.textContent, name: state().picked, words: document.getElementById("picked").textContent, tags,
          drawing: document.querySelector("svg .picked > .notchname")?.textContent,
          spot: !document.getElementById("spot").hidden,
        };
        window.toile.pick(null);
        const at = canvas.getBoundingClientRect(), ratio = canvas.width / canvas.clientWidth;
        click(at.left + x / ratio, at.top + y / ratio);
        await frame();
        out.notch.clicked = state().picked;
        const sewn = [...document.querySelectorAll("tr[data-pick^='notch:']")].find((row) => row.cells[4].textContent);
        window.toile.pick(sewn && sewn.dataset.pick);
        out.notch.sewn = document.getElementById("picked").textContent;
      }
      document.dispatchEvent(new KeyboardEvent("keydown", { key: "Escape" }));
      document.querySelector("svg [data-pick='piece:0'] path")?.dispatchEvent(new MouseEvent("click", { bubbles: true }));
      out.fromDrawing = state().picked;
      canvas.dispatchEvent(new KeyboardEvent("keydown", { key: "3" }));
      out.key = state().view;
    }
    const show = [...document.querySelectorAll(".findings button")][0];
    if (show) {
      show.click();
      await frame();
      out.spot = { hidden: document.getElementById("spot").hidden, left: document.getElementById("spot").style.left };
    }
    const named = (e) => e.getAttribute("aria-label") || e.labels?.length || e.textContent.trim() || e.title;
    out.nameless = [...document.querySelectorAll("button, input, select, canvas, summary")].filter((e) => !named(e)).length;
    out.pictures = [...document.images].map((i) => [i.alt, i.naturalWidth]);
    out.wide = document.documentElement.scrollWidth - window.innerWidth;
  } catch (problem) {
    out.errors.push(String(problem.stack || problem));
  }
  return JSON.stringify(out);
})()
