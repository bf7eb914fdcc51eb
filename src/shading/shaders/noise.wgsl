// Prepended to the passes in natural colours: hashes and noise in the world's px. Integers all through: the same bits
// on every device, unlike the usual sin().

fn scramble(bits: u32) -> u32 {
  var h = (bits ^ (bits >> 16u)) * 0x7feb352du;
  h = (h ^ (h >> 15u)) * 0x846ca68bu;
  return h ^ (h >> 16u);
}

fn hash3(cell: vec3i) -> u32 {
  return scramble((u32(cell.x) * 0x9e3779b9u) ^ (u32(cell.y) * 0x85ebca6bu) ^ (u32(cell.z) * 0xc2b2ae35u));
}

// Four numbers of 0…1 from one hash.
fn bytes(h: u32) -> vec4f {
  return vec4f(vec4u(h, h >> 8u, h >> 16u, h >> 24u) & vec4u(255u)) / 255.0;
}

fn corner(bits: u32, away: vec3f) -> vec4f {
  let slope = bytes(scramble(bits)).xyz * 2.0 - 1.0;
  return vec4f(slope, dot(slope, away));
}

// Gradient noise: w the value, about -0.7…0.7; xyz its slope.
fn noise3(at: vec3f) -> vec4f {
  let floored = floor(at);
  let f = at - floored;
  let x0 = u32(i32(floored.x)) * 0x9e3779b9u;
  let y0 = u32(i32(floored.y)) * 0x85ebca6bu;
  let z0 = u32(i32(floored.z)) * 0xc2b2ae35u;
  let x1 = x0 + 0x9e3779b9u;
  let y1 = y0 + 0x85ebca6bu;
  let z1 = z0 + 0xc2b2ae35u;
  let u = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
  let du = 30.0 * f * f * (f * (f - 2.0) + 1.0);
  let v000 = corner(x0 ^ y0 ^ z0, f);
  let v100 = corner(x1 ^ y0 ^ z0, f - vec3f(1.0, 0.0, 0.0));
  let v010 = corner(x0 ^ y1 ^ z0, f - vec3f(0.0, 1.0, 0.0));
  let v110 = corner(x1 ^ y1 ^ z0, f - vec3f(1.0, 1.0, 0.0));
  let v001 = corner(x0 ^ y0 ^ z1, f - vec3f(0.0, 0.0, 1.0));
  let v101 = corner(x1 ^ y0 ^ z1, f - vec3f(1.0, 0.0, 1.0));
  let v011 = corner(x0 ^ y1 ^ z1, f - vec3f(0.0, 1.0, 1.0));
  let v111 = corner(x1 ^ y1 ^ z1, f - vec3f(1.0, 1.0, 1.0));
  let x00 = mix(v000, v100, u.x);
  let x10 = mix(v010, v110, u.x);
  let x01 = mix(v001, v101, u.x);
  let x11 = mix(v011, v111, u.x);
  let near = mix(x00, x10, u.y);
  let far = mix(x01, x11, u.y);
  let dx = mix(mix(v100.w - v000.w, v110.w - v010.w, u.y), mix(v101.w - v001.w, v111.w - v011.w, u.y), u.z);
  let dy = mix(x10.w - x00.w, x11.w - x01.w, u.z);
  let whole = mix(near, far, u.z);
  return whole + vec4f(du * vec3f(dx, dy, far.w - near.w), 0.0);
}

// The cell of a jittered grid that `at` lies in: x the distance to its middle, y, z, w three numbers of its own, which run
// into the next cell's within `blur` of the edge. Eight candidates are enough for a jitter of a quarter.
fn grains(at: vec3f, blur: f32) -> vec4f {
  let base = vec3i(floor(at - 0.5));
  var first = vec2f(9.0);
  var nearest = 0u;
  var next = 0u;
  for (var i = 0; i < 8; i++) {
    let cell = base + vec3i(i & 1, (i >> 1u) & 1, i >> 2u);
    let h = hash3(cell);
    let away = vec3f(cell) + 0.25 + 0.5 * bytes(h).xyz - at;
    let far = dot(away, away);
    if far < first.x {
      first = vec2f(far, first.x);
      next = nearest;
      nearest = h;
    } else if far < first.y {
      first.y = far;
      next = h;
    }
  }
  let reach = sqrt(first);
  let inside = 0.5 + 0.5 * min((reach.y - reach.x) / blur, 1.0);
  return vec4f(reach.x, mix(bytes(scramble(next)).xyz, bytes(scramble(nearest)).xyz, inside));
}

fn corner2(bits: u32) -> f32 {
  return f32(scramble(bits) >> 8u) / 8388608.0 - 1.0;
}

// Value noise, -1…1.
fn noise2(at: vec2f) -> f32 {
  let floored = floor(at);
  let f = at - floored;
  let u = f * f * (3.0 - 2.0 * f);
  let x = u32(i32(floored.x)) * 0x9e3779b9u;
  let y = u32(i32(floored.y)) * 0x85ebca6bu;
  let low = mix(corner2(x ^ y), corner2((x + 0x9e3779b9u) ^ y), u.x);
  let high = mix(corner2(x ^ (y + 0x85ebca6bu)), corner2((x + 0x9e3779b9u) ^ (y + 0x85ebca6bu)), u.x);
  return mix(low, high, u.y);
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
