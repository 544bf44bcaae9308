// The way of a piece from the flat lay to where it is worn: it is turned and moved as a whole while it takes its shape.

function subtract(a, b) { return a.map((x, k) => x - b[k]); }
function dot(a, b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
function cross(a, b) { return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]; }
function unit(a) { const n = Math.hypot(...a) || 1; return a.map((x) => x / n); }

// The frame of a piece: its middle when worn and when flat, and the turn between both as a quaternion.
function frame(at, indices) {
  const worn = at.POSITION, flat = at._FLAT, count = worn.length / 3;
  const middle = (data, size) => Array.from({ length: size }, (_, k) => {
    let sum = 0;
    for (let i = k; i < data.length; i += size) sum += data[i];
    return sum / count;
  });
  if (!flat) return null;
  // How far each triangle goes along x and y of the flat piece, as it is worn, by its area.
  const x = [0, 0, 0], y = [0, 0, 0];
  for (let t = 0; t < indices.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => indices[t + k]);
    const p = (i) => worn.subarray(3 * i, 3 * i + 3), f = (i) => flat.subarray(2 * i, 2 * i + 2);
    const [u1, v1] = subtract([...f(b)], f(a)), [u2, v2] = subtract([...f(c)], f(a));
    const e1 = subtract([...p(b)], p(a)), e2 = subtract([...p(c)], p(a));
    for (let k = 0; k < 3; k++) {
      x[k] += e1[k] * v2 - e2[k] * v1;
      y[k] += e2[k] * u1 - e1[k] * u2;
    }
  }
  const up = unit(y), out = unit(cross(x, up)), right = cross(up, out);
  return { worn: middle(worn, 3), flat: middle(flat, 2), turn: quaternion(right, up, out) };
}

// From the columns of a matrix.
function quaternion(a, b, c) {
  const trace = a[0] + b[1] + c[2];
  const q = trace > 0 ? [1 + trace, b[2] - c[1], c[0] - a[2], a[1] - b[0]]
    : a[0] > b[1] && a[0] > c[2] ? [b[2] - c[1], 1 + a[0] - b[1] - c[2], a[1] + b[0], c[0] + a[2]]
    : b[1] > c[2] ? [c[0] - a[2], a[1] + b[0], 1 - a[0] + b[1] - c[2], b[2] + c[1]]
    : [a[1] - b[0], c[0] + a[2], b[2] + c[1], 1 - a[0] - b[1] + c[2]];
  const n = Math.hypot(...q) || 1;
  return q.map((v) => (q[0] < 0 ? -v : v) / n);
}

// The columns of a part of the turn: 0 none, 1 all.
function part([w, x, y, z], share) {
  const half = Math.acos(Math.min(1, w)), s = Math.sin(half);
  const f = s > 1e-6 ? Math.sin(share * half) / s : share;
  const [i, j, k] = [x * f, y * f, z * f], r = Math.cos(share * half);
  return [
    [1 - 2 * (j * j + k * k), 2 * (i * j + r * k), 2 * (i * k - r * j)],
    [2 * (i * j - r * k), 1 - 2 * (i * i + k * k), 2 * (j * k + r * i)],
    [2 * (i * k + r * j), 2 * (j * k - r * i), 1 - 2 * (i * i + j * j)],
  ];
}

// What the shaders and the picking need of a piece at a share of its way; `lay` moves the flat lay.
function pose(f, share, lay) {
  const none = { whole: part([1, 0, 0, 0], 0), now: part([1, 0, 0, 0], 0), worn: [0, 0, 0], flat: [0, 0], at: [0, 0, 0], share };
  if (!f) return none;
  const from = [f.flat[0] + lay[0], f.flat[1] + lay[1], lay[2]];
  const at = f.worn.map((x, k) => from[k] + (x - from[k]) * share);
  return { whole: part(f.turn, 1), now: part(f.turn, share), worn: f.worn, flat: f.flat, at, share };
}

function posed(p, worn, flat) {
  const d = subtract(worn, p.worn), own = p.whole.map((column) => dot(column, d));
  const lie = [flat[0] - p.flat[0], flat[1] - p.flat[1], 0];
  const local = own.map((x, k) => lie[k] + (x - lie[k]) * p.share);
  return p.at.map((x, k) => x + p.now[0][k] * local[0] + p.now[1][k] * local[1] + p.now[2][k] * local[2]);
}
