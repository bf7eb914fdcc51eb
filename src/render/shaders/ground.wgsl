// Backdrop and ground in one full-screen triangle: each pixel's ray meets z = 0 or the backdrop.
// It writes no depth, so the rims of the rocks, which lie exactly in the ground, cannot flicker.

@vertex
fn vs_main(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
  let corner = vec2f(f32((index << 1u) & 2u), f32(index & 2u));
  return vec4f(corner * 2.0 - 1.0, 0.0, 1.0);
}

// Integer hash to 0…1 (PCG-like): the same bits on every device, unlike the usual sin().
fn hash(cell: vec2i) -> f32 {
  var h = (u32(cell.x) * 0x9e3779b9u) ^ (u32(cell.y) * 0x85ebca6bu);
  h = (h ^ (h >> 15u)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12u)) * 0x297a2d39u;
  return f32((h ^ (h >> 15u)) >> 8u) / 16777216.0;
}

fn noise(at: vec2f) -> f32 {
  let cell = floor(at);
  let f = at - cell;
  let u = f * f * (3.0 - 2.0 * f);
  let i = vec2i(cell);
  let low = mix(hash(i), hash(i + vec2i(1, 0)), u.x);
  let high = mix(hash(i + vec2i(0, 1)), hash(i + vec2i(1, 1)), u.x);
  return mix(low, high, u.y);
}

// Noise of `period` px, faded to its mean where it would be finer than the pixels.
fn grain(at: vec2f, period: f32, footprint: f32) -> f32 {
  return mix(noise(at / period), 0.5, smoothstep(0.25, 0.8, footprint / period));
}

@fragment
fn fs_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
  let viewport = vec2f(globals.ray_right.w, globals.ray_up.w);
  let at = vec2f(2.0, -2.0) * pixel.xy / viewport + vec2f(-1.0, 1.0);
  let ray = globals.ray_forward.xyz + at.x * globals.ray_right.xyz + at.y * globals.ray_up.xyz;
  let backdrop = mix(globals.backdrop_low.rgb, globals.backdrop_high.rgb, smoothstep(-1.0, 1.0, at.y));
  // Above the horizon: a far point keeps the arithmetic finite, and the fade hides it.
  let steps = globals.eye.z / max(-ray.z, 0.0001);
  let world = vec3f(globals.eye.xy + steps * ray.xy, 0.0);
  // World pixels under one screen pixel, along the longer side of its footprint.
  let footprint = 2.0 * steps * length(globals.ray_up.xyz) / viewport.y / max(-normalize(ray).z, 0.05);

  // Outside the image the soil thins out to dust: a wide even fade, its grain finer than its width,
  // so that neither a rectangle nor a haze shows.
  let half_size = 0.5 * field.size.xy;
  let reach = field.ground.x;
  let d = abs(world.xy - half_size) - half_size;
  let outside = length(max(d, vec2f(0.0))) / reach;
  let drift = (grain(world.xy, 0.45 * reach, footprint) - 0.5) * 0.3;
  let crumbs = grain(world.xy, 0.05 * reach, footprint) + grain(world.xy, 0.02 * reach, footprint) - 1.0;
  let fade = 1.0 - smoothstep(0.0, 1.0, outside * (1.0 + drift));
  let soil_share = clamp(fade + crumbs * 0.7 * fade * (1.0 - fade), 0.0, 1.0);

  let fine = grain(world.xy, 2.3, footprint) * 0.5 + grain(world.xy, 6.1, footprint) * 0.3
    + grain(world.xy, 41.0, footprint) * 0.2;
  let up = vec3f(0.0, 0.0, 1.0);
  let soil = shade(globals.soil.rgb * (0.72 + 0.56 * fine), world, up, pixel.xy);
  // Beyond the soil the floor is the backdrop itself; only shadows lie on it.
  let floor_light = mix(0.62, 1.0, sunlight(world, up)) * mix(0.7, 1.0, sky_visibility(world, up, pixel.xy));
  let floor_color = backdrop * select(1.0, floor_light, outside < 3.0);
  let color = mix(floor_color, soil, soil_share);
  let seen = select(backdrop, color, ray.z < -0.0001);
  return finish(seen * mix(1.0, 0.5, globals.ray_forward.w * soil_share), pixel.xy);
}
