// Edges that are clicked become the lines of a seam for the sewing file.

(() => {
  const one = (selector) => document.querySelector(selector);
  const edges = [...document.querySelectorAll(".edge")];
  const sides = { a: [], b: [] };
  const say = (english, ...values) => ((WORDS && WORDS[english]) || english).replace(/\{(\d)\}/g, (_, k) => values[k]);
  const EQUAL = 0.5, GATHERED = 1.1;
  one("#composer").hidden = false;

  const side = () => one("input[name=side]:checked").value;
  const long = (list) => list.reduce((sum, e) => sum + Number(e.dataset.mm), 0);
  const parts = (name) => edges.filter((e) => e.dataset.edge === name);

  // The stretches of a side as edges and parts of edges, in the order of the first click on each.
  function named(list) {
    const names = [...new Set(list.map((e) => e.dataset.edge))];
    return names.flatMap((name) => {
      const all = parts(name), taken = all.map((e) => list.includes(e)), out = [];
      for (let k = 0; k < all.length; k++) {
        if (!taken[k]) continue;
        const from = k;
        while (taken[k + 1]) k++;
        out.push({ name, from: all[from].dataset.from, to: all[k].dataset.to });
      }
      // Stretches that were clicked from the end of the edge are sewn from there.
      const clicked = list.filter((e) => e.dataset.edge === name).map((e) => Number(e.dataset.part));
      return clicked[0] > clicked[clicked.length - 1] ? out.reverse() : out;
    });
  }

  const isWhole = (e) => e.from === "start" && e.to === "end";
  function written(e) {
    if (isWhole(e)) return JSON.stringify(e.name);
    const dot = e.name.lastIndexOf(".");
    return `{ piece = ${JSON.stringify(e.name.slice(0, dot))}, edge = ${e.name.slice(dot + 1)}, from = "${e.from}", to = "${e.to}" }`;
  }
  const place = (text) => (text.startsWith("notch ") ? say("notch {0}", text.slice(6)) : say(text));
  const words = (e) => (isWhole(e) ? e.name : say("{0} from {1} to {2}", e.name, place(e.from), place(e.to)));

  // The lines, as `toile new` would write them.
  function lines() {
    const [a, b] = [long(sides.a), long(sides.b)], ratio = Math.max(a, b) / Math.min(a, b);
    const [onA, onB] = [named(sides.a).map(written), named(sides.b).map(written)];
    const list = (all) => (all.length === 1 ? all[0] : `[\n  ${all.join(",\n  ")},\n]`);
    const out = ["[[seam]]", `name = ${JSON.stringify(one("#seam-name").value || "my seam")}`, `a = ${list(onA)}`, `b = ${list(onB)}`];
    if (onA.length + onB.length > 2) out.push("reverse = true");
    if (ratio > GATHERED) out.push(`gather = ${ratio.toFixed(3)}`);
    else if (Math.abs(a - b) > EQUAL) out.push(`ease = "${(a - b).toFixed(1)} mm"`);
    return out.join("\n") + "\n";
  }

  function told() {
    const [a, b] = [long(sides.a), long(sides.b)];
    const taken = [...new Set([...sides.a, ...sides.b].flatMap((e) => (e.dataset.seams ? e.dataset.seams.split("|") : [])))];
    const out = [say("{0} mm on {1} mm.", a.toFixed(1), b.toFixed(1))];
    if (Math.max(a, b) / Math.min(a, b) > GATHERED) out.push(say("The longer side is gathered."));
    if (taken.length) out.push(say("These seams of the file are on the same edges; remove those that are wrong: {0}.", taken.join(", ")));
    if (sides.a.length + sides.b.length > 2) out.push(say("If `toile check` says that the order contradicts, list the edges of one side the other way round."));
    return out.join(" ");
  }

  function show() {
    for (const e of edges) {
      e.classList.toggle("side-a", sides.a.includes(e));
      e.classList.toggle("side-b", sides.b.includes(e));
    }
    for (const k of ["a", "b"]) one(`#side-${k}`).textContent = named(sides[k]).map(words).join(", ") || "–";
    const whole = sides.a.length > 0 && sides.b.length > 0;
    one("#lines").textContent = whole ? lines() : "";
    one("#lines").hidden = !whole;
    one("#copy").disabled = !whole;
    one("#told").textContent = whole ? told() : "";
  }

  function choose(edge) {
    const had = ["a", "b"].find((k) => sides[k].includes(edge));
    if (had) {
      sides[had] = sides[had].filter((e) => e !== edge);
    } else {
      sides[side()].push(edge);
    }
    show();
  }

  for (const edge of edges) {
    edge.addEventListener("click", (e) => { e.stopPropagation(); choose(edge); });
    edge.addEventListener("keydown", (e) => {
      if (e.key !== "Enter" && e.key !== " ") return;
      e.preventDefault();
      choose(edge);
    });
  }
  one("#seam-name").addEventListener("input", show);
  one("#composing").addEventListener("change", (e) => {
    document.body.classList.toggle("composing", e.target.checked);
    one("#composed").hidden = !e.target.checked;
    edges.forEach((edge) => edge.setAttribute("tabindex", e.target.checked ? "0" : "-1"));
  });
  one("#clear").addEventListener("click", () => {
    [sides.a, sides.b] = [[], []];
    one("input[name=side][value=a]").checked = true;
    show();
  });
  // A page that is opened from a disk may not write to the clipboard; then the lines are marked.
  one("#copy").addEventListener("click", () => {
    const mark = () => getSelection().selectAllChildren(one("#lines"));
    const done = () => { one("#copy").textContent = say("Copied"); setTimeout(() => { one("#copy").textContent = say("Copy the lines"); }, 1500); };
    if (navigator.clipboard) navigator.clipboard.writeText(lines()).then(done, mark);
    else mark();
  });
  show();
})();
