// Compares the view of an open report with a picture of the command line: the same garment from the front, without its
// body. `PICTURE` is its address, `HEIGHT` the rows of it above the legend, `MAP` the colours. Gives JSON.
(async () => {
  const [WIDE, HIGH] = [24, 32];
  const wait = () => new Promise((done) => setTimeout(() => requestAnimationFrame(() => setTimeout(done, 20)), 20));
  const set = (id, key, value) => {
    const e = document.getElementById(id);
    if (!e) return;
    e[key] = value;
    e.dispatchEvent(new Event("change", { bubbles: true }));
  };
  // Fields around all that is drawn, whatever its size and place: the share that is covered, and the mean colour.
  const fields = (width, height, pixel) => {
    const box = [Infinity, Infinity, -Infinity, -Infinity], seen = [];
    for (let y = 0; y < height; y++) {
      for (let x = 0; x < width; x++) {
        const colour = pixel(x, y);
        if (!colour) continue;
        seen.push([x, y, colour]);
        box[0] = Math.min(box[0], x);
        box[1] = Math.min(box[1], y);
        box[2] = Math.max(box[2], x + 1);
        box[3] = Math.max(box[3], y + 1);
      }
    }
    const size = [(box[2] - box[0]) / WIDE, (box[3] - box[1]) / HIGH];
    const out = Array.from({ length: WIDE * HIGH }, () => ({ count: 0, sum: [0, 0, 0] }));
    for (const [x, y, colour] of seen) {
      const field = out[Math.floor((y - box[1]) / size[1]) * WIDE + Math.floor((x - box[0]) / size[0])];
      field.count++;
      colour.forEach((c, k) => { field.sum[k] += c; });
    }
    return out.map(({ count, sum }) => ({ share: count / (size[0] * size[1]), mean: sum.map((s) => s / Math.max(count, 1)) }));
  };
  const canvas = document.querySelector("canvas[data-view]"), gl = canvas.getContext("webgl2");
  set("body", "checked", false);
  set("map", "value", MAP);
  document.querySelector("[data-look=front]").click();
  await wait();
  const { width, height } = canvas, drawn = new Uint8Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, drawn);
  const view = fields(width, height, (x, y) => {
    const i = 4 * ((height - 1 - y) * width + x);
    return drawn[i + 3] < 128 ? null : drawn.slice(i, i + 3);
  });

  const image = new Image();
  image.src = PICTURE;
  await image.decode();
  const sheet = Object.assign(document.createElement("canvas"), { width: image.width, height: HEIGHT }).getContext("2d");
  sheet.drawImage(image, 0, 0);
  const paper = sheet.getImageData(0, 0, image.width, HEIGHT).data, empty = paper.slice(0, 3);
  const picture = fields(image.width, HEIGHT, (x, y) => {
    const i = 4 * (y * image.width + x), colour = paper.slice(i, i + 3);
    return empty.every((c, k) => c === colour[k]) ? null : colour;
  });

  const sum = (of) => view.reduce((total, v, k) => total + of(v, picture[k]), 0);
  const both = view.flatMap((v, k) => (Math.min(v.share, picture[k].share) > 0.9 ? [[v.mean, picture[k].mean]] : []));
  const apart = both.map(([a, b]) => Math.max(...a.map((c, k) => Math.abs(c - b[k])))).sort((a, b) => a - b);
  return JSON.stringify({
    overlap: sum((a, b) => Math.min(a.share, b.share)) / sum((a, b) => Math.max(a.share, b.share)),
    fields: both.length,
    median: apart[Math.floor(apart.length / 2)],
    high: apart[Math.floor(0.95 * apart.length)],
  });
})()
