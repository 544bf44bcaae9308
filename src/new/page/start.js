// Edges that are clicked become the lines of a seam for the sewing file.

(() => {
  const one = (selector) => document.querySelector(selector);
  const edges = [...document.querySelectorAll(".edge")];
  const sides = { a: [], b: [] };
  const EQUAL = 0.5, GATHERED = 1.1;
  one("#composer").hidden = false;

  const side = () => one("input[name=side]:checked").value;
  const long = (list) => list.reduce((sum, e) => sum + Number(e.dataset.mm), 0);
  const names = (list) => list.map((e) => JSON.stringify(e.dataset.edge));
  const written = (list) => (list.length === 1 ? names(list)[0] : `[${names(list).join(", ")}]`);

  // The lines, as `toile new` would write them.
  function lines() {
    const [a, b] = [long(sides.a), long(sides.b)], ratio = Math.max(a, b) / Math.min(a, b);
    const out = ["[[seam]]", 'name = "my seam"', `a = ${written(sides.a)}`, `b = ${written(sides.b)}`];
    if (sides.a.length + sides.b.length > 2) out.push("reverse = true");
    if (ratio > GATHERED) out.push(`gather = ${ratio.toFixed(3)}`);
    else if (Math.abs(a - b) > EQUAL) out.push(`ease = "${(a - b).toFixed(1)} mm"`);
    return out.join("\n") + "\n";
  }

  function told() {
    const [a, b] = [long(sides.a), long(sides.b)];
    const taken = [...new Set([...sides.a, ...sides.b].flatMap((e) => (e.dataset.seams ? e.dataset.seams.split("|") : [])))];
    const out = [`${a.toFixed(1)} mm on ${b.toFixed(1)} mm.`];
    if (Math.max(a, b) / Math.min(a, b) > GATHERED) out.push("The longer side is gathered.");
    if (taken.length) out.push(`Remove from the file: ${taken.join(", ")}, which has these edges.`);
    return out.join(" ");
  }

  function show() {
    for (const e of edges) {
      e.classList.toggle("side-a", sides.a.includes(e));
      e.classList.toggle("side-b", sides.b.includes(e));
    }
    for (const k of ["a", "b"]) one(`#side-${k}`).textContent = sides[k].map((e) => e.dataset.edge).join(", ") || "–";
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
      const to = side();
      sides[to].push(edge);
      if (to === "a" && !sides.b.length) one("input[name=side][value=b]").checked = true;
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
    const done = () => { one("#copy").textContent = "Copied"; setTimeout(() => { one("#copy").textContent = "Copy the lines"; }, 1500); };
    if (navigator.clipboard) navigator.clipboard.writeText(lines()).then(done, mark);
    else mark();
  });
  show();
})();
