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
// into the next cell's within `blur` of the edge. Eight candidates are enough for a jitter of a quarter.
fn grains(at: vec3f, blur: f32) -> vec4f {
  let base = vec3i(floor(at - 0.5));
  var first = vec2f(9.0);
  var nearest = base;
  var next = base;
  for (var i = 0; i < 8; i++) {
    let cell = base + vec3i(i & 1, (i >> 1u) & 1, i >> 2u);
    let away = vec3f(cell) + 0.25 + 0.5 * point_of(cell).xyz - at;
    let far = dot(away, away);
    if far < first.x {
      first = vec2f(far, first.x);
      next = nearest;
      nearest = cell;
    } else if far < first.y {
      first.y = far;
      next = cell;
    }
  }
  grain_middle = vec3f(nearest) + 0.25 + 0.5 * point_of(nearest).xyz - at;
  let reach = sqrt(first);
  let inside = 0.5 + 0.5 * min((reach.y - reach.x) / blur, 1.0);
  // Numbers that have nothing to do with where its middle lies: another cell's.
  const OTHER = vec3i(11, 5, 23);
  return vec4f(reach.x, mix(point_of(next + OTHER).xyz, point_of(nearest + OTHER).xyz, inside));
}

// How much of a pattern of this period is shown: none of it where it would be finer than the pixels, and shimmer.
fn shown(period: f32, footprint: f32) -> f32 {
  return 1.0 - smoothstep(0.3, 0.75, footprint / period);
}

// px of the world under a pixel of a surface that goes on by `across` and `down` to the next pixels; not stretched all the way at
// the rim, where nothing is seen anyway.
fn footprint_of(across: vec3f, down: vec3f) -> f32 {
  let step_x = dot(across, across);
  let step_y = dot(down, down);
  return sqrt(sqrt(step_x * step_y)) * 0.5 + sqrt(max(step_x, step_y)) * 0.5;
}
