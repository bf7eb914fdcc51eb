// How much of the sky the ground sees, as the map of heights has it: found once for a field, since all pictures ask for it.

@vertex
fn vs_main(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
  return vec4f(vec2f(f32((index << 1u) & 2u), f32(index & 2u)) * 2.0 - 1.0, 0.0, 1.0);
}

// R the share, GB towards where.
@fragment
fn fs_main(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
  // Half as many texels a side as the map of heights has.
  let uv = pixel.xy * 2.0 / vec2f(textureDimensions(height_map));
  let at = field.map.xy + vec2f(uv.x, 1.0 - uv.y) / field.map.zw;
  let seen = sky_seen(vec3f(at, 0.0), vec3f(0.0, 0.0, 1.0), 16);
  return vec4f(seen, open_towards.xy * 0.25 + 0.5, 1.0);
}
