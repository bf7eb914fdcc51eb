// Backdrop and ground in one full-screen triangle: each pixel's ray meets z = 0 or the backdrop.
// It writes no depth, so the rims of the rocks, which lie exactly in the ground, cannot flicker; where rocks go on below it,
// floor.wgsl follows.

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
  let at = place_of(pixel.xy);
  let ray = globals.ray_forward.xyz + at.x * globals.ray_right.xyz + at.y * globals.ray_up.xyz;
  let backdrop = mix(globals.backdrop_low.rgb, globals.backdrop_high.rgb, smoothstep(-1.0, 1.0, at.y));
  // Above the horizon: a far point keeps the arithmetic finite, and the fade hides it.
  let steps = globals.eye.z / max(-ray.z, 0.0001);
  let world = vec3f(globals.eye.xy + steps * ray.xy, 0.0);
  // World pixels under one screen pixel, along the longer side of its footprint.
  let footprint = 2.0 * steps * length(globals.ray_up.xyz) / globals.ray_up.w / max(-normalize(ray).z, 0.05);

  // Outside the image the soil dries to dust and the dust runs out into the backdrop: two wide even
  // fades, so that neither a rectangle nor a haze shows.
  let half_size = 0.5 * field.size.xy;
  let reach = field.ground.x;
  let d = abs(world.xy - half_size) - half_size;
  let outside = length(max(d, vec2f(0.0))) / reach;
  let drift = (grain(world.xy, 0.35 * reach, footprint) - 0.5) * 0.25;
  let crumbs = (grain(world.xy, 0.013 * reach, footprint) - 0.5) * 0.1
    + (grain(world.xy, 0.04 * reach, footprint) - 0.5) * 0.05;
  let along = outside * (1.0 + drift);
  let dry = smoothstep(0.0, 0.5, along + crumbs * smoothstep(0.0, 0.1, along));
  let gone = smoothstep(0.1, 1.0, along);

  let fine = grain(world.xy, 2.3, footprint) * 0.5 + grain(world.xy, 6.1, footprint) * 0.3
    + grain(world.xy, 41.0, footprint) * 0.2;
  let up = vec3f(0.0, 0.0, 1.0);
  if globals.soil.w > 0.5 {
    let sky = sky_visibility(world, up, pixel.xy);
    let lit = backing(sunlight(world, up) * mix(0.75, 1.0, sky), sky * sky);
    return select(backing(1.0, 1.0), lit, ray.z < -0.0001);
  }
  let albedo = mix(globals.soil.rgb, globals.dust.rgb, dry) * (0.74 + 0.52 * mix(fine, 0.5, 0.6 * dry));
  let earth = shade(albedo, world, up, pixel.xy);
  // Where no dust lies the floor is the backdrop itself.
  let color = mix(earth, backdrop, gone);
  let seen = select(backdrop, color, ray.z < -0.0001);
  return finish(seen * mix(1.0, 0.5, globals.ray_forward.w * (1.0 - gone)), pixel.xy);
}
