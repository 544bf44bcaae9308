// Threads lead from points of pieces to the points that they are sewn to, wherever the pieces are on their way.
class Threads {
  constructor(viewer, list) {
    const gl = viewer.gl, sides = [[0, -1], [1, -1], [1, 1], [0, -1], [1, 1], [0, 1]];
    this.list = list.slice().sort((a, b) => a[0] - b[0]);
    this.ranges = new Map();
    this.list.forEach(([line], i) => {
      const range = this.ranges.get(line) || [i, 0];
      this.ranges.set(line, [range[0], range[1] + 1]);
    });
    this.vao = gl.createVertexArray();
    gl.bindVertexArray(this.vao);
    const count = this.list.length;
    this.ends = ["from", "to"].map((name) => attribute(gl, viewer.line, name, new Float32Array(18 * count), 3));
    attribute(gl, viewer.line, "corner", new Float32Array(this.list.flatMap(() => sides.flat())), 2);
    gl.bindVertexArray(null);
    this.viewer = viewer;
  }

  // Puts the ends where their pieces are.
  place() {
    const { viewer } = this, { gl, share } = viewer;
    if (this.placedAt === share) return;
    this.placedAt = share;
    const poses = viewer.model.surfaces.map((s) => pose(s.frame, share, viewer.lay()));
    this.ends.forEach((buffer, side) => {
      const at = this.list.flatMap((thread) => {
        const [piece, [x, y, z, u, v]] = thread[1 + side];
        const p = posed(poses[piece], [x, y, z], [u, v]);
        return [...p, ...p, ...p, ...p, ...p, ...p];
      });
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(at), gl.DYNAMIC_DRAW);
    });
  }

  // The line program is in use.
  draw(p) {
    const { gl, picked, data } = this.viewer;
    this.place();
    this.viewer.pose(p, null);
    gl.bindVertexArray(this.vao);
    for (const [line, [first, count]] of this.ranges) {
      const isPicked = picked === "seam:" + line;
      gl.uniform4fv(p.at.colour, [...(data.seams[line].colour || [0, 0, 0]), isPicked ? 1 : 0.6]);
      gl.uniform1f(p.at.width, isPicked ? 3 : 1.3);
      gl.drawArrays(gl.TRIANGLES, 6 * first, 6 * count);
    }
  }
}
