// Draws the model. The camera is orthographic: sizes on the screen can be compared.

function program(gl, vertex, fragment) {
  const made = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(made));
  const at = {};
  const count = gl.getProgramParameter(made, gl.ACTIVE_UNIFORMS);
  for (let i = 0; i < count; i++) {
    const name = gl.getActiveUniform(made, i).name.replace("[0]", "");
    at[name] = gl.getUniformLocation(made, name);
  }
  return { made, at };
}

function attribute(gl, p, name, data, size) {
  const where = gl.getAttribLocation(p.made, name);
  if (where < 0) return null;
  if (!data) {
    gl.vertexAttrib4f(where, 1, 1, 0, 0);
    return null;
  }
  const buffer = gl.createBuffer();
  gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
  gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
  gl.enableVertexAttribArray(where);
  gl.vertexAttribPointer(where, size, gl.FLOAT, false, 0, 0);
  return buffer;
}

function bounds(surfaces, name, size) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (const s of surfaces) {
    const data = s.at[name] || [];
    for (let i = 0; i < data.length; i++) {
      low[i % size] = Math.min(low[i % size], data[i]);
      high[i % size] = Math.max(high[i % size], data[i]);
    }
  }
  return { low, high, middle: low.map((x, k) => 0.5 * (x + high[k])) };
}

const VIEWS = { front: [0, 0], back: [180, 0], left: [90, 0], right: [-90, 0], "three-quarter": [38, 12] };

class Viewer {
  constructor(canvas, model, data) {
    const gl = canvas.getContext("webgl2", { antialias: true, alpha: true, preserveDrawingBuffer: true });
    if (!gl) throw new Error("no WebGL 2");
    Object.assign(this, { canvas, gl, model, data });
    this.cloth = model.surfaces.filter((s) => s.name !== "body" || s.material !== undefined);
    this.body = model.surfaces.find((s) => s.name === "body" && s.material === undefined);
    this.worn = bounds(this.cloth, "POSITION", 3);
    this.laid = bounds(this.cloth, "_FLAT", 2);
    Object.assign(this, { turn: 0, rise: 0, zoom: 1, shift: [0, 0], share: 1, cut: Infinity, map: null });
    Object.assign(this, { withBody: !!this.body, picked: null, view: "front" });
    this.surface = program(gl, VERTEX, FRAGMENT);
    this.ids = program(gl, VERTEX, PICK_FRAGMENT);
    this.line = program(gl, LINE_VERTEX, LINE_FRAGMENT);
    this.upload();
    this.seams = data.seams.map((seam) => seam.runs.map((run) => this.strip(...this.points(run))));
    this.threads = data.threads ? new Threads(this, data.threads) : null;
    this.motion = data.motion ? new Motion(this, data.motion) : null;
    this.colours = null;
  }

  upload() {
    const gl = this.gl;
    for (const s of this.model.surfaces) {
      const open = s.at._OPEN && new Float32Array(s.at._OPEN.length * 2);
      if (open) s.at._OPEN.forEach((x, i) => { open[2 * i] = x; open[2 * i + 1] = s.at._SHUT[i]; });
      s.buffers = [];
      s.arrays = [this.surface, this.ids].map((p) => {
        const vao = gl.createVertexArray();
        gl.bindVertexArray(vao);
        s.buffers.push([attribute(gl, p, "position", s.at.POSITION, 3), attribute(gl, p, "normal", s.at.NORMAL, 3)]);
        attribute(gl, p, "flat_", s.at._FLAT, 2);
        attribute(gl, p, "uv", s.at.TEXCOORD_0, 2);
        attribute(gl, p, "open", open, 2);
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
        gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, s.indices, gl.STATIC_DRAW);
        return vao;
      });
      s.frame = frame(s.at, s.indices);
      s.type = s.indices instanceof Uint16Array ? gl.UNSIGNED_SHORT : gl.UNSIGNED_INT;
    }
    gl.bindVertexArray(null);
    for (const m of this.model.materials.filter((m) => m.image)) {
      createImageBitmap(m.image).then((bitmap) => {
        m.texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, m.texture);
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, bitmap);
        gl.generateMipmap(gl.TEXTURE_2D);
        const sharp = gl.getExtension("EXT_texture_filter_anisotropic");
        if (sharp) gl.texParameterf(gl.TEXTURE_2D, sharp.TEXTURE_MAX_ANISOTROPY_EXT, 8);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
        this.draw();
      });
    }
  }

  // Vertices of a surface have moved.
  move(s) {
    const gl = this.gl, data = [s.at.POSITION, s.at.NORMAL];
    for (const [k, buffer] of s.buffers.flatMap((both) => [...both.entries()])) {
      if (!buffer) continue;
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.bufferSubData(gl.ARRAY_BUFFER, 0, data[k]);
    }
  }

  // Is the garment at rest? Seams and frames of pieces are known there only.
  atRest() { return !this.motion || this.motion.moment === null; }

  // A run is vertices of a piece, or points of it: its piece, and each point worn and flat.
  points(run) {
    if (run.points) return [run.piece, run.points.map(([x, y, z, u, v]) => [[x, y, z], [u, v]])];
    const [piece, vertices] = run, at = this.model.surfaces[piece].at;
    const flat = (v) => (at._FLAT ? [...at._FLAT.subarray(2 * v, 2 * v + 2)] : [0, 0]);
    return [piece, vertices.map((v) => [[...at.POSITION.subarray(3 * v, 3 * v + 3)], flat(v)])];
  }

  // A run as strips of two triangles for each segment.
  strip(piece, points) {
    const gl = this.gl, out = { from: [], to: [], fromFlat: [], toFlat: [], corner: [] };
    for (let i = 0; i + 1 < points.length; i++) {
      for (const corner of [[0, -1], [1, -1], [1, 1], [0, -1], [1, 1], [0, 1]]) {
        out.from.push(...points[i][0]);
        out.to.push(...points[i + 1][0]);
        out.fromFlat.push(...points[i][1]);
        out.toFlat.push(...points[i + 1][1]);
        out.corner.push(...corner);
      }
    }
    const vao = gl.createVertexArray();
    gl.bindVertexArray(vao);
    for (const [name, size] of [["from", 3], ["to", 3], ["fromFlat", 2], ["toFlat", 2], ["corner", 2]]) {
      attribute(gl, this.line, name, new Float32Array(out[name]), size);
    }
    gl.bindVertexArray(null);
    return { piece, vao, count: out.corner.length / 2, points };
  }

  setMap(field) {
    this.map = field;
    const gl = this.gl, where = gl.getAttribLocation(this.surface.made, "value");
    for (const s of this.cloth) {
      const values = field && valuesOf(s, field);
      gl.bindVertexArray(s.arrays[0]);
      if (values) attribute(gl, this.surface, "value", values, 1);
      else gl.disableVertexAttribArray(where);
    }
    gl.bindVertexArray(null);
    this.draw();
  }

  // Where the flat lay lies: its middle is that of the worn garment.
  lay() {
    return [0, 1].map((k) => this.worn.middle[k] - this.laid.middle[k]).concat(this.worn.middle[2]);
  }

  camera() {
    const { width, height } = this.canvas;
    const rad = Math.PI / 180, [st, ct] = [Math.sin(this.turn * rad), Math.cos(this.turn * rad)];
    const [sr, cr] = [Math.sin(this.rise * rad), Math.cos(this.rise * rad)];
    const right = [ct, 0, -st], up = [-st * sr, cr, -ct * sr], toward = [st * cr, sr, ct * cr];
    const span = (box, k) => box.high[k] - box.low[k];
    const deep = Math.hypot(span(this.worn, 0), span(this.worn, 2));
    const mix = (flat, worn) => flat + (worn - flat) * this.share;
    const wide = mix(span(this.laid, 0), Math.max(span(this.worn, 0), this.turn % 180 ? deep : 0));
    const tall = mix(span(this.laid, 1), span(this.worn, 1) * cr + deep * Math.abs(sr));
    const scale = (this.zoom * 0.88 * Math.min(width / wide, height / tall)) || 1;
    const c = this.worn.middle, dot = (a) => a[0] * c[0] + a[1] * c[1] + a[2] * c[2];
    const [sx, sy] = [(2 * scale) / width, (2 * scale) / height], sz = 1 / 4;
    const [dx, dy] = this.shift;
    const matrix = [
      right[0] * sx, up[0] * sy, -toward[0] * sz, 0,
      right[1] * sx, up[1] * sy, -toward[1] * sz, 0,
      right[2] * sx, up[2] * sy, -toward[2] * sz, 0,
      -dot(right) * sx + dx, -dot(up) * sy + dy, dot(toward) * sz, 1,
    ];
    const turn = [right[0], up[0], toward[0], right[1], up[1], toward[1], right[2], up[2], toward[2]];
    return { matrix, turn, right, up, toward, scale };
  }

  draw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => { this.waiting = false; this.paint(); });
  }

  resize() {
    const ratio = Math.max(1.5, Math.min(2, window.devicePixelRatio || 1));
    const [w, h] = [this.canvas.clientWidth, this.canvas.clientHeight].map((x) => Math.max(1, Math.round(x * ratio)));
    if (this.canvas.width !== w || this.canvas.height !== h) Object.assign(this.canvas, { width: w, height: h });
  }

  common(p, camera) {
    const gl = this.gl;
    gl.useProgram(p.made);
    gl.uniformMatrix4fv(p.at.camera, false, camera.matrix);
    if (p.at.turn) gl.uniformMatrix3fv(p.at.turn, false, camera.turn);
    gl.uniform1f(p.at.cut, this.cut);
  }

  // The body stands still; pieces are on their way between the flat lay and the garment.
  pose(p, s) {
    const gl = this.gl, now = pose(s && s.frame, s && s.frame ? this.share : 1, this.lay());
    gl.uniformMatrix3fv(p.at.whole, false, now.whole.flat());
    gl.uniformMatrix3fv(p.at.now, false, now.now.flat());
    gl.uniform3fv(p.at.wornMiddle, now.worn);
    gl.uniform2fv(p.at.flatMiddle, now.flat);
    gl.uniform3fv(p.at.middle, now.at);
    gl.uniform1f(p.at.share, now.share);
  }

  paint() {
    this.resize();
    const gl = this.gl, p = this.surface, camera = this.camera();
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    this.common(p, camera);
    for (const s of this.model.surfaces) {
      const isBody = s === this.body;
      if (isBody && !this.showsBody()) continue;
      const material = this.model.materials[s.material];
      const own = this.colours && this.colours[s.material];
      const mapped = !isBody && !!this.map;
      gl.uniform4fv(p.at.colour, isBody ? [0.6, 0.56, 0.52, 1] : own ? [...own, 1] : material.colour);
      gl.uniform1i(p.at.isCloth, !isBody);
      gl.uniform1i(p.at.mapped, mapped);
      gl.uniform1i(p.at.textured, !isBody && !mapped && !!material.texture);
      if (material && material.texture) {
        gl.bindTexture(gl.TEXTURE_2D, material.texture);
        gl.uniform2fv(p.at.repeat, material.scale);
      }
      if (mapped) {
        gl.uniform2fv(p.at.ends, this.map.ends);
        gl.uniform3fv(p.at.stops, this.map.stops.flat().map((x) => x / 255));
      }
      // A tint would change the colours that the legend explains.
      const isPicked = !mapped && this.picked === "piece:" + this.model.surfaces.indexOf(s);
      gl.uniform3fv(p.at.tint, isPicked ? [0.9, 0.42, 0.06] : [0, 0, 0]);
      this.pose(p, s);
      this.mesh(s, 0);
    }
    this.lines(camera);
    if (this.painted) this.painted(camera);
  }

  // The body stands beside the worn garment only, and in a motion only where it does not move itself.
  showsBody() {
    const stands = this.atRest() || this.motion.told.bodyStands;
    return this.withBody && this.share >= 0.97 && stands;
  }

  mesh(s, which) {
    this.gl.bindVertexArray(s.arrays[which]);
    this.gl.drawElements(this.gl.TRIANGLES, s.indices.length, s.type, 0);
    this.gl.bindVertexArray(null);
  }

  lines(camera) {
    const gl = this.gl, p = this.line;
    this.common(p, camera);
    gl.uniform2f(p.at.size, this.canvas.width, this.canvas.height);
    gl.enable(gl.BLEND);
    gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    (this.atRest() ? this.seams : []).forEach((seam, k) => {
      const isPicked = this.picked === "seam:" + k;
      const own = this.data.seams[k].colour, thin = Math.max(1.2, 0.0022 * camera.scale) * (own ? 3 : 1);
      gl.uniform4fv(p.at.colour, own ? [...own, 1] : isPicked ? [0.91, 0.35, 0.05, 1] : [0, 0, 0, 0.4]);
      gl.uniform1f(p.at.width, isPicked ? Math.max(own ? 12 : 5, 2.5 * thin) : thin);
      for (const run of seam) {
        this.pose(p, this.model.surfaces[run.piece]);
        gl.bindVertexArray(run.vao);
        gl.drawArrays(gl.TRIANGLES, 0, run.count);
      }
    });
    if (this.threads) this.threads.draw(p);
    gl.bindVertexArray(null);
    gl.disable(gl.BLEND);
  }

  // The seam, else the piece at a pixel of the canvas; null beside the cloth.
  at(x, y) {
    const piece = this.pieceAt(x, y);
    if (piece === null) return null;
    const camera = this.camera(), near = (7 * this.canvas.width) / this.canvas.clientWidth;
    let best = [near, null];
    (this.atRest() ? this.seams : []).forEach((seam, k) => {
      for (const run of seam.filter((r) => r.piece === piece)) {
        const now = pose(this.model.surfaces[piece].frame, this.share, this.lay());
        const at = run.points.map(([worn, flat]) => this.onScreen(posed(now, worn, flat), camera));
        for (let i = 0; i + 1 < at.length; i++) {
          const d = distance([x, y], at[i], at[i + 1]);
          if (d < best[0]) best = [d, "seam:" + k];
        }
      }
    });
    return best[1] || "piece:" + piece;
  }

  // The value of the map at a pixel of the canvas; null beside the cloth and where there is none.
  valueAt(x, y) {
    const found = this.map && this.triangleAt(x, y), values = found && valuesOf(this.model.surfaces[found.piece], this.map);
    if (!values) return null;
    const value = found.corners.reduce((sum, v, k) => sum + found.shares[k] * values[v], 0);
    return Number.isFinite(value) ? value : null;
  }

  // The largest strain of the cloth at a pixel, percent, and its angle to the warp, degrees; null where it is not known.
  strainAt(x, y) {
    const found = this.triangleAt(x, y), warp = found && (this.data.warps || [])[found.piece];
    if (!warp) return null;
    const { POSITION, _FLAT } = this.model.surfaces[found.piece].at;
    if (!_FLAT) return null;
    const [p, q, r] = found.corners.map((v) => POSITION.subarray(3 * v, 3 * v + 3));
    const [a, b, c] = found.corners.map((v) => _FLAT.subarray(2 * v, 2 * v + 2));
    const cross = (d, e) => d[0] * e[1] - d[1] * e[0];
    const [u, v] = [b, c].map((e) => [e[0] - a[0], e[1] - a[1]]), twice = cross(u, v);
    // A step of one metre along a direction of the cloth, in space.
    const step = (d) => [0, 1, 2].map((k) => ((q[k] - p[k]) * cross(d, v) + (r[k] - p[k]) * cross(u, d)) / twice);
    const [along, across] = [warp, [-warp[1], warp[0]]].map(step);
    const [long, wide, both] = [dot(along, along), dot(across, across), dot(along, across)];
    const stretch = Math.sqrt(0.5 * (long + wide) + Math.hypot(0.5 * (long - wide), both));
    const angle = Math.abs(Math.atan2(2 * both, long - wide) * 90) / Math.PI;
    return Number.isFinite(stretch) ? { strain: 100 * (stretch - 1), angle } : null;
  }

  // The triangle at a pixel of the canvas: its piece, its corners, and their shares; null beside the cloth.
  triangleAt(x, y) {
    const piece = this.pieceAt(x, y), s = this.model.surfaces[piece];
    if (!s) return null;
    const camera = this.camera(), now = pose(s.frame, this.share, this.lay()), at = s.at;
    const flat = (v) => (at._FLAT ? at._FLAT.subarray(2 * v, 2 * v + 2) : [0, 0]);
    const seen = Array.from({ length: at.POSITION.length / 3 }, (_, v) => {
      const point = posed(now, [...at.POSITION.subarray(3 * v, 3 * v + 3)], [...flat(v)]);
      return [...this.onScreen(point, camera), this.depth(point, camera)];
    });
    let best = [Infinity, null];
    for (let t = 0; t < s.indices.length; t += 3) {
      const corners = [0, 1, 2].map((k) => s.indices[t + k]), shares = inTriangle([x, y], ...corners.map((v) => seen[v]));
      if (!shares) continue;
      const sum = (of) => corners.reduce((total, v, k) => total + shares[k] * of(v), 0);
      if (sum((v) => at.POSITION[3 * v + 1]) > this.cut) continue;
      const depth = sum((v) => seen[v][2]);
      if (depth < best[0]) best = [depth, { piece, corners, shares }];
    }
    return best[1];
  }

  // How far a point lies behind the screen.
  depth([a, b, c], camera) {
    const m = camera.matrix;
    return m[2] * a + m[6] * b + m[10] * c + m[14];
  }

  // Pixels of the canvas at which a point is seen.
  onScreen([a, b, c], camera) {
    const m = camera.matrix, row = (k) => m[k] * a + m[4 + k] * b + m[8 + k] * c + m[12 + k];
    return [(0.5 + 0.5 * row(0)) * this.canvas.width, (0.5 - 0.5 * row(1)) * this.canvas.height];
  }

  pieceAt(x, y) {
    const gl = this.gl, { width, height } = this.canvas;
    const target = gl.createFramebuffer(), colour = gl.createRenderbuffer(), depth = gl.createRenderbuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    const part = (buffer, format, where) => {
      gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
      gl.renderbufferStorage(gl.RENDERBUFFER, format, width, height);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, where, gl.RENDERBUFFER, buffer);
    };
    part(colour, gl.RGBA8, gl.COLOR_ATTACHMENT0);
    part(depth, gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT);
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const p = this.ids;
    this.common(p, this.camera());
    this.model.surfaces.forEach((s, k) => {
      const isBody = s === this.body;
      if (isBody && !this.showsBody()) return;
      const number = isBody ? 0 : k + 1;
      gl.uniform4f(p.at.colour, (number & 255) / 255, (number >> 8) / 255, 0, 1);
      this.pose(p, s);
      this.mesh(s, 1);
    });
    const pixel = new Uint8Array(4);
    gl.readPixels(Math.round(x), Math.round(height - 1 - y), 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.deleteFramebuffer(target);
    gl.deleteRenderbuffer(colour);
    gl.deleteRenderbuffer(depth);
    const number = pixel[0] + 256 * pixel[1];
    return number ? number - 1 : null;
  }

  // Lines in which a height cuts cloth and body, seen from above: [x, z] pairs in metres, with the length of the cloth.
  section(height) {
    const cutOf = (s) => {
      const lines = [], at = s.at.POSITION;
      for (let t = 0; t < s.indices.length; t += 3) {
        const ends = [];
        for (let k = 0; k < 3; k++) {
          const i = 3 * s.indices[t + k], j = 3 * s.indices[t + ((k + 1) % 3)];
          if (at[i + 1] < height === at[j + 1] < height) continue;
          const f = (height - at[i + 1]) / (at[j + 1] - at[i + 1]);
          ends.push([at[i] + f * (at[j] - at[i]), at[i + 2] + f * (at[j + 2] - at[i + 2])]);
        }
        if (ends.length === 2) lines.push(ends);
      }
      return lines;
    };
    const cloth = this.cloth.flatMap(cutOf);
    const length = cloth.reduce((sum, [a, b]) => sum + Math.hypot(b[0] - a[0], b[1] - a[1]), 0);
    return { cloth, body: this.body ? cutOf(this.body) : [], length };
  }

  // A page may mark places.
  show() {}

  look(view) {
    [this.turn, this.rise] = VIEWS[view];
    Object.assign(this, { view, zoom: 1, shift: [0, 0] });
    this.draw();
  }

  orbit(dx, dy) {
    this.turn = (this.turn + dx) % 360;
    this.rise = Math.max(-85, Math.min(85, this.rise + dy));
    this.view = "free";
    this.draw();
  }

  scale(by) {
    this.zoom = Math.max(0.3, Math.min(30, this.zoom * by));
    this.draw();
  }
}

// The values of a quantity at the vertices of a surface.
function valuesOf(surface, field) { return surface.at["_" + field.key.toUpperCase().replace("-", "_")]; }

// The shares of three corners at a point of the screen; null outside their triangle.
function inTriangle([x, y], [ax, ay], [bx, by], [cx, cy]) {
  const area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
  const b = ((x - ax) * (cy - ay) - (cx - ax) * (y - ay)) / area, c = ((bx - ax) * (y - ay) - (x - ax) * (by - ay)) / area;
  const shares = [1 - b - c, b, c];
  return shares.every((s) => s >= 0) ? shares : null;
}

function distance([x, y], [ax, ay], [bx, by]) {
  const dx = bx - ax, dy = by - ay, long = dx * dx + dy * dy;
  const t = long > 0 ? Math.max(0, Math.min(1, ((x - ax) * dx + (y - ay) * dy) / long)) : 0;
  return Math.hypot(x - ax - t * dx, y - ay - t * dy);
}
