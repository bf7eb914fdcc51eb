// Prepended to the passes in natural colours: noise and random numbers in the world's px, from textures that are the same on every
// device (patterns.rs).

// Slope along x, y, z and value of gradient noise, four texels per cell
@group(3) @binding(0) var noise_volume: texture_3d<f32>;
// Random values, a texel each
@group(3) @binding(1) var noise_plane: texture_2d<f32>;
// Four random numbers for each cell of a lattice
@group(3) @binding(2) var noise_points: texture_3d<f32>;
@group(3) @binding(3) var noise_sampler: sampler;

// Gradient noise: w the value, about -0.7…0.7; xyz its slope. It repeats after 16 units along each axis.
fn noise3(at: vec3f) -> vec4f {
  return textureSampleLevel(noise_volume, noise_sampler, fract(at / 16.0), 0.0) * vec4f(2.5, 2.5, 2.5, 1.0);
}

// The volume repeats along its axes, and what lies in a plane of the world must not: turned out of all of them, no plane meets the same
// noise again. Slopes that belong to points turned by it are turned back by `slope * TURN`.
const TURN = mat3x3f(0.5312, 0.3175, 0.7855, -0.829, 0.3863, 0.4044, -0.1751, -0.866, 0.4684);

// Where moss likes to grow in the world, a number of no more than this.
const MOSSIEST = 2.4;

fn mossy(at: vec3f) -> f32 {
  let q = TURN * at;
  return 2.0 * noise3(q / 83.0 + 31.3).w + 1.1 * noise3(q / 29.0).w;
}

// Four value noises that have nothing to do with each other, each -1…1.
fn noises2(at: vec2f) -> vec4f {
  let floored = floor(at);
  let f = at - floored;
  // From texel to texel the device goes straight: the way between them is eased here.
  let eased = floored + f * f * (3.0 - 2.0 * f) + 0.5;
  return textureSampleLevel(noise_plane, noise_sampler, fract(eased / 256.0), 0.0);
}

// Value noise, -1…1.
fn noise2(at: vec2f) -> f32 {
  return noises2(at).x;
}

fn point_of(cell: vec3i) -> vec4f {
  return textureLoad(noise_points, cell & vec3i(31), 0);
}

// Four random numbers of a cell of a grid on the ground, 0…1; other numbers for every `which`. Every 32 cells the next layer of the
// lattice begins, so that nothing comes again for a thousand.
fn numbers_of(cell: vec2i, which: i32) -> vec4f {
  let block = cell >> vec2u(5u);
  return point_of(vec3i(cell, which + 5 * block.x + 9 * block.y));
}

// From a point that `grains` was asked for to the middle of its cell.
var<private> grain_middle: vec3f;

// The cell of a jittered grid that `at` lies in: x the distance to its middle, y, z, w three numbers of its own, which run
// into the next cell's within about 1 / (2 · `sharp`) of the edge. Eight candidates are enough for a jitter of a quarter.
fn grains(at: vec3f, sharp: f32) -> vec4f {
  let start = floor(at - 0.5);
  let base = vec3i(start);
  let least = start + 0.25 - at;
  // The nearest and the next: how far, squared, and in the lowest three bits which corner.
  var first = vec2f(9.0);
  for (var i = 0; i < 8; i++) {
    let corner = vec3i(i & 1, (i >> 1u) & 1, i >> 2u);
    let away = least + vec3f(corner) + 0.5 * point_of(base + corner).xyz;
    let far = bitcast<f32>((bitcast<u32>(dot(away, away)) & 0xfffffff8u) | u32(i));
    first = vec2f(min(first.x, far), min(max(first.x, far), first.y));
  }
  let which = bitcast<vec2u>(first);
  let nearest = base + vec3i(vec3u(which.x, which.x >> 1u, which.x >> 2u) & vec3u(1u));
  let next = base + vec3i(vec3u(which.y, which.y >> 1u, which.y >> 2u) & vec3u(1u));
  grain_middle = vec3f(nearest) + 0.25 + 0.5 * point_of(nearest).xyz - at;
  let inside = 0.5 + 0.5 * min(sharp * (first.y - first.x), 1.0);
  // Numbers that have nothing to do with where its middle lies: another cell's.
  const OTHER = vec3i(11, 5, 23);
  return vec4f(sqrt(first.x), mix(point_of(next + OTHER).xyz, point_of(nearest + OTHER).xyz, inside));
}

// How much of a pattern of this period is shown: none of it where it would be finer than the pixels, and shimmer.
fn shown(period: f32, footprint: f32) -> f32 {
  return 1.0 - smoothstep(0.3, 0.75, footprint / period);
}
