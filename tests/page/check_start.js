// Runs in the page of a proposal that tests/page.rs has opened, and gives what it saw as JSON.
(async () => {
  const out = { errors: [] };
  window.addEventListener("error", (e) => out.errors.push(e.message));
  const frame = () => new Promise((done) => setTimeout(() => requestAnimationFrame(() => setTimeout(done, 20)), 20));
  const canvas = document.querySelector("canvas[data-view]");
  // The pixels that are not empty, and the sum of their colours.
  const seen = () => {
    const gl = canvas.getContext("webgl2"), { width, height } = canvas;
    const pixels = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    let count = 0, sum = 0;
    for (let i = 0; i < pixels.length; i += 4) {
      if (pixels[i + 3] < 128) continue;
      count++;
      sum += pixels[i] + 2 * pixels[i + 1] + 4 * pixels[i + 2];
    }
    return { share: count / (width * height), sum };
  };
  const set = (id, key, value, kind) => {
    const e = document.getElementById(id);
    e[key] = value;
    e.dispatchEvent(new Event(kind, { bubbles: true }));
  };
  const press = (e) => e.dispatchEvent(new MouseEvent("click", { bubbles: true }));
  try {
    await frame();
    await frame();
    Object.assign(out, window.toile.state());
    out.requests = performance.getEntriesByType("resource").map((e) => e.name).filter((n) => !n.startsWith("data:") && !n.startsWith("blob:"));
    if (out.ready) {
      document.querySelector("[data-look=front]").click();
      await frame();
      out.worn = seen().share;
      set("body", "checked", false, "change");
      await frame();
      out.bare = seen().share;
      const before = seen().sum;
      document.querySelector("tr[data-pick='seam:0'] button").click();
      await frame();
      out.row = {
        name: window.toile.state().picked, before, after: seen().sum,
        words: document.getElementById("picked").textContent,
        marked: document.querySelectorAll("polyline.picked").length,
      };
      set("worn", "value", "0", "input");
      await frame();
      out.flat = seen().share;
    } else {
      out.stills = [...document.querySelectorAll(".stills svg")].filter((e) => e.getBoundingClientRect().width > 50).length;
    }
    document.getElementById("composing").click();
    const edges = (name) => [...document.querySelectorAll(".edge")].filter((e) => e.dataset.edge === name);
    edges("FRONT.0").forEach(press);
    document.querySelector("input[name=side][value=b]").click();
    edges("BACK.0").forEach(press);
    out.lines = document.getElementById("lines").textContent;
    const named = (e) => e.getAttribute("aria-label") || e.labels?.length || e.textContent.trim() || e.title;
    out.nameless = [...document.querySelectorAll("button, input, select, canvas, summary, [role=button]")].filter((e) => !named(e)).length;
    out.wide = document.documentElement.scrollWidth - window.innerWidth;
  } catch (problem) {
    out.errors.push(String(problem.stack || problem));
  }
  return JSON.stringify(out);
})()
