// The motion of the cloth: places of all vertices at any moment, and their normals.
class Motion {
  constructor(viewer, told) {
    this.viewer = viewer;
    this.told = told;
    this.frames = told.pieces.map((text) => new Uint16Array(bytesOf(text).buffer));
    this.rest = viewer.model.surfaces.slice(0, told.pieces.length).map((s) => [s.at.POSITION.slice(), s.at.NORMAL.slice()]);
    this.moment = null;
  }

  // Shows a moment, as a number of frames from the first; null shows the garment at rest.
  show(moment) {
    this.moment = moment;
    this.rest.forEach(([position, normal], k) => {
      const s = this.viewer.model.surfaces[k];
      if (moment === null) {
        s.at.POSITION.set(position);
        s.at.NORMAL.set(normal);
      } else {
        this.place(s.at.POSITION, k, moment);
        turn(s.at.NORMAL, s.at.POSITION, s.indices);
      }
      this.viewer.move(s);
    });
    this.viewer.draw();
  }

  // Straight between two frames, as other viewers of the file go.
  place(out, piece, moment) {
    const { low, step, count } = this.told, data = this.frames[piece], size = out.length;
    const first = Math.min(Math.floor(moment), count - 1), next = Math.min(first + 1, count - 1), share = moment - first;
    for (let i = 0; i < size; i++) {
      const a = data[first * size + i], b = data[next * size + i];
      out[i] = low[i % 3] + step * (a + (b - a) * share);
    }
  }
}

// Normals of vertices, the mean of their triangles by area.
function turn(out, at, indices) {
  out.fill(0);
  for (let t = 0; t < indices.length; t += 3) {
    const corners = [0, 1, 2].map((k) => 3 * indices[t + k]), [a, b, c] = corners.map((i) => [at[i], at[i + 1], at[i + 2]]);
    const n = cross(subtract(b, a), subtract(c, a));
    for (const i of corners) for (let k = 0; k < 3; k++) out[i + k] += n[k];
  }
  for (let i = 0; i < out.length; i += 3) out.set(unit([out[i], out[i + 1], out[i + 2]]), i);
}
