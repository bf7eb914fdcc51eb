// Baseline (b): the rock method as a JavaScript developer would put it together from npm packages.
//
// Same method and same options as ours, hence about as many rocks: least distance r, the whole image as domain, layers in
// descending order of mean cell area, cells in random order until A_s is reached, pixels by their centres; and the same
// buffers for the renderer at the end. It keeps its results in typed arrays and allocates nothing per pixel.
import FastPoissonDiskSampling from 'fast-2d-poisson-disk-sampling';
import { Delaunay } from 'd3-delaunay';
import Delaunator from 'delaunator';

/**
 * One field. `layers` are `{ radius, areaFraction, taper, height }` in px, as in `rock-field/core`.
 *
 * @returns positions, normals, indices, rockStarts, and `ms`: milliseconds per stage
 */
export function npmStack({ imageWidth: width, imageHeight: height, layers, seed }) {
  const random = mulberry32(seed);
  const ms = { sites: 0, voronoi: 0, selection: 0, rocks: 0 };
  const timed = (stage, work) => {
    const start = performance.now();
    const result = work();
    ms[stage] += performance.now() - start;
    return result;
  };
  const sites = layers.map(({ radius }) => timed('sites', () => sample(width, height, radius, random)));
  const cells = sites.map((points) => timed('voronoi', () => diagram(points, width, height)));
  const selected = timed('selection', () => select(layers, cells, width, height, random));
  const mesh = timed('rocks', () => build(layers, cells, selected, random));
  return { ...mesh, ms };
}

/** A generator of good repute, small enough to be inlined; the sampler takes any. */
function mulberry32(state) {
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

/** x, y, x, y … */
function sample(width, height, radius, random) {
  // The number of tries is its README's; the default of 30 takes half as long again for 2 % more points.
  const points = new FastPoissonDiskSampling({ shape: [width, height], radius, tries: 20 }, random).fill();
  const flat = new Float64Array(2 * points.length);
  for (let i = 0; i < points.length; i++) {
    flat[2 * i] = points[i][0];
    flat[2 * i + 1] = points[i][1];
  }
  return flat;
}

/** The clipped cells, flat: cell i has the vertices `starts[i]` … `starts[i + 1] - 1`. */
function diagram(points, width, height) {
  const voronoi = new Delaunay(points).voronoi([0, 0, width, height]);
  const count = points.length / 2;
  const starts = new Uint32Array(count + 1);
  // Fewer than six vertices per cell on average (Euler), and the image's corners.
  const vertices = new Float64Array(2 * (6 * count + 16));
  let end = 0;
  const push = (x, y) => {
    vertices[end++] = x;
    vertices[end++] = y;
  };
  const sink = { moveTo: push, lineTo: push, closePath() {} };
  for (let i = 0; i < count; i++) {
    voronoi.renderCell(i, sink);
    starts[i + 1] = end / 2;
  }
  return { count, starts, vertices };
}

/** Fig. 7 on a byte per pixel. Per layer the selected cells, in the order granted. */
function select(layers, cells, width, height, random) {
  const taken = new Uint8Array(width * height);
  // Of the cell being looked at.
  const pixels = new Uint32Array(width * height);
  const result = layers.map(() => new Uint32Array());
  const order = [...layers.keys()].sort((a, b) => cells[a].count - cells[b].count);
  for (const k of order) {
    const { count, starts, vertices } = cells[k];
    const enough = layers[k].areaFraction * width * height;
    const visits = shuffled(count, random);
    const granted = new Uint32Array(count);
    let rocks = 0;
    let area = 0;
    for (let v = 0; v < count && area < enough; v++) {
      const cell = visits[v];
      const claimed = claim(taken, pixels, width, height, vertices, starts[cell], starts[cell + 1]);
      if (claimed > 0) {
        granted[rocks++] = cell;
        area += claimed;
      }
    }
    result[k] = granted.subarray(0, rocks);
  }
  return result;
}

function shuffled(count, random) {
  const order = new Uint32Array(count);
  for (let i = 0; i < count; i++) {
    const j = (random() * (i + 1)) | 0;
    order[i] = order[j];
    order[j] = i;
  }
  return order;
}

/** Flags the pixels of a cell and counts them; 0, and nothing flagged, when one of them is taken. */
function claim(taken, pixels, width, height, vertices, from, to) {
  let left = width;
  let right = 0;
  let bottom = height;
  let top = 0;
  for (let k = from; k < to; k++) {
    left = Math.min(left, vertices[2 * k]);
    right = Math.max(right, vertices[2 * k]);
    bottom = Math.min(bottom, vertices[2 * k + 1]);
    top = Math.max(top, vertices[2 * k + 1]);
  }
  const x1 = Math.floor(right - 0.5);
  const y1 = Math.floor(top - 0.5);
  let count = 0;
  for (let y = Math.ceil(bottom - 0.5); y <= y1; y++) {
    for (let x = Math.ceil(left - 0.5); x <= x1; x++) {
      if (!isInside(vertices, from, to, x + 0.5, y + 0.5)) continue;
      const pixel = y * width + x;
      if (taken[pixel] === 1) return 0;
      pixels[count++] = pixel;
    }
  }
  for (let k = 0; k < count; k++) taken[pixels[k]] = 1;
  return count;
}

/** Whether a point lies in a convex cell, whose vertices run clockwise. */
function isInside(vertices, from, to, x, y) {
  let ax = vertices[2 * to - 2];
  let ay = vertices[2 * to - 1];
  for (let k = from; k < to; k++) {
    const bx = vertices[2 * k];
    const by = vertices[2 * k + 1];
    if ((bx - ax) * (y - ay) - (by - ay) * (x - ax) < 0) return false;
    ax = bx;
    ay = by;
  }
  return true;
}

/** Fig. 10: as many points as the cell has vertices, the Delaunay triangulation of both, and Eqs 2 and 3. */
function build(layers, cells, selected, random) {
  let rocks = 0;
  let rim = 0;
  let most = 0;
  for (const [k, { starts }] of cells.entries()) {
    for (const cell of selected[k]) {
      const n = starts[cell + 1] - starts[cell];
      rocks++;
      rim += n;
      most = Math.max(most, n);
    }
  }
  const positions = new Float32Array(3 * 2 * rim);
  const normals = new Float32Array(3 * 2 * rim);
  // A convex polygon of n vertices with n points inside has 3n − 2 triangles; rounding may add a few slivers.
  const indices = new Uint32Array(3 * 3 * rim);
  const rockStarts = new Uint32Array(rocks + 1);
  const scratch = new Float64Array(4 * most);
  let rock = 0;
  let vertex = 0;
  let index = 0;
  for (const [k, { taper, height }] of layers.entries()) {
    const { starts, vertices } = cells[k];
    for (const cell of selected[k]) {
      const from = starts[cell];
      const n = starts[cell + 1] - from;
      const points = scratch.subarray(0, 4 * n);
      for (let i = 0; i < 2 * n; i++) points[i] = vertices[2 * from + i];
      scatter(points, n, random);
      const { triangles } = new Delaunator(points);
      for (let i = 0; i < triangles.length; i++) indices[index++] = vertex + triangles[i];
      displace(points, n, taper, height, random, positions, vertex);
      sumNormals(positions, indices, index - triangles.length, index, normals);
      vertex += 2 * n;
      rockStarts[++rock] = index;
    }
  }
  normalize(normals);
  return { positions, normals, indices: indices.subarray(0, index), rockStarts };
}

/** Fills the second half of `points` with points uniform in the convex polygon that is the first half. */
function scatter(points, n, random) {
  const ox = points[0];
  const oy = points[1];
  const doubleArea = (i) => Math.abs((points[2 * i] - ox) * (points[2 * i + 3] - oy) - (points[2 * i + 2] - ox) * (points[2 * i + 1] - oy));
  let total = 0;
  for (let i = 1; i < n - 1; i++) total += doubleArea(i);
  for (let p = n; p < 2 * n; p++) {
    // A triangle of the fan by its area, then a point of it.
    let rest = random() * total;
    let i = 1;
    while (i < n - 2 && rest >= doubleArea(i)) rest -= doubleArea(i++);
    let s = random();
    let t = random();
    if (s + t > 1) [s, t] = [1 - s, 1 - t];
    points[2 * p] = ox + s * (points[2 * i] - ox) + t * (points[2 * i + 2] - ox);
    points[2 * p + 1] = oy + s * (points[2 * i + 1] - oy) + t * (points[2 * i + 3] - oy);
  }
}

/** Writes a rock's vertices, n on the ground and n moved, from `vertex` on. */
function displace(points, n, taper, height, random, positions, vertex) {
  let gx = 0;
  let gy = 0;
  for (let p = n; p < 2 * n; p++) {
    gx += points[2 * p] / n;
    gy += points[2 * p + 1] / n;
  }
  let at = 3 * vertex;
  for (let p = 0; p < n; p++) {
    positions[at++] = points[2 * p];
    positions[at++] = points[2 * p + 1];
    positions[at++] = 0;
  }
  const j1 = random();
  for (let p = n; p < 2 * n; p++) {
    const j2 = random();
    const step = taper[0] + taper[1] * j1 + taper[2] * j2;
    const dx = points[2 * p] - gx;
    const dy = points[2 * p + 1] - gy;
    const distance = Math.sqrt(dx * dx + dy * dy);
    const scale = distance > 0 ? step / distance : 0;
    positions[at++] = points[2 * p] + scale * dx;
    positions[at++] = points[2 * p + 1] + scale * dy;
    positions[at++] = height[0] + height[1] * j1 + height[2] * j2;
  }
}

/** Adds each triangle's normal, as long as the triangle is large, to its three vertices. */
function sumNormals(positions, indices, from, to, normals) {
  for (let i = from; i < to; i += 3) {
    const a = 3 * indices[i];
    const b = 3 * indices[i + 1];
    const c = 3 * indices[i + 2];
    const ux = positions[b] - positions[a];
    const uy = positions[b + 1] - positions[a + 1];
    const uz = positions[b + 2] - positions[a + 2];
    const vx = positions[c] - positions[a];
    const vy = positions[c + 1] - positions[a + 1];
    const vz = positions[c + 2] - positions[a + 2];
    // Delaunator's triangles run clockwise.
    const nx = vy * uz - vz * uy;
    const ny = vz * ux - vx * uz;
    const nz = vx * uy - vy * ux;
    for (let corner = 0; corner < 3; corner++) {
      const at = 3 * indices[i + corner];
      normals[at] += nx;
      normals[at + 1] += ny;
      normals[at + 2] += nz;
    }
  }
}

function normalize(normals) {
  for (let i = 0; i < normals.length; i += 3) {
    const length = Math.sqrt(normals[i] ** 2 + normals[i + 1] ** 2 + normals[i + 2] ** 2);
    const scale = length > 0 ? 1 / length : 0;
    normals[i] *= scale;
    normals[i + 1] *= scale;
    normals[i + 2] *= scale;
  }
}
