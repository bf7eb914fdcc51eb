// Backdrop and ground in natural colours. Two triangles over the whole picture: the backdrop at the far plane, then
// z = 0 with its depth, which hides what is below it.

struct Varyings {
  // The depth is that of floor.wgsl, to the last bit.
  @builtin(position) @invariant clip: vec4f,
  // 1 on the ground
  @location(0) is_ground: f32,
}

@vertex
fn vs_main(@builtin(vertex_index) index: u32) -> Varyings {
  let i = index % 3u;
  let at = vec2f(f32((i << 1u) & 2u), f32(i & 2u)) * 2.0 - 1.0;
  var out: Varyings;
  out.is_ground = select(0.0, 1.0, index >= 3u);
  out.clip = select(vec4f(at, 1.0, 1.0), ground_clip(at), index >= 3u);
  return out;
}

@fragment
fn fs_main(@builtin(position) pixel: vec4f, @location(0) is_ground: f32) -> @location(0) vec4f {
  let at = place_of(pixel.xy);
  let ray = globals.ray_forward.xyz + at.x * globals.ray_right.xyz + at.y * globals.ray_up.xyz;
  if is_ground < 0.5 || ray.z > -0.0001 {
    if globals.soil.w > 0.5 {
      return backing(1.0, 1.0);
    }
    return taken(sky_seen_by_eye(normalize(ray)), pixel.xy);
  }
  let steps = globals.eye.z / -ray.z;
  let world = vec3f(globals.eye.xy + steps * ray.xy, 0.0);
  let to_eye = -ray / length(ray);
  // px of the world under a pixel, nearer to the longer side of what it covers than to the shorter: flat pebbles would break
  // into dashes towards the horizon.
  let across = 2.0 * steps * length(globals.ray_up.xyz) / globals.ray_up.w;
  let footprint = across * pow(max(to_eye.z, 0.02), -0.75);

  let up = vec3f(0.0, 0.0, 1.0);
  let seen = sky_seen(world, up);
  if globals.soil.w > 0.5 {
    return backing(sun_seen(world, up), seen);
  }
  // Seen flatter than this, stones are drawn as from there: no ray passes more than the next ones.
  let lean = to_eye.xy / max(to_eye.z, 0.38);
  ground_cover(world.xy, lean, footprint);
  var albedo = cover_albedo * mix(0.45, 1.0, cover_open);
  var slope = vec3f(cover_slope, 0.0);
  // Between and under the rocks it stays damp and collects what is fine.
  let damp = 1.0 - smoothstep(0.35, 0.95, seen);
  let wet = max(0.35 * damp, wet_cover(world.xy));
  var rough = mix(0.92, 0.4, globals.weather.y * wet);
  var moss = moss_cover(world, 1.0, 0.0, 1.0 - seen, footprint) * smoothstep(0.0, 0.5, 1.2 - cover_top * 0.3)
    * (1.0 - cover_leaf);
  if moss > 0.0 {
    moss_coat(world, footprint);
    moss = smoothstep(0.15, 0.5, moss + 0.3 * moss_high);
    albedo = mix(albedo, moss_albedo, moss);
    slope = mix(slope, vec3f(moss_slope.xy, 0.0), moss);
    rough = mix(rough, 0.95, moss);
  }
  albedo *= mix(vec3f(1.0), vec3f(0.45) + 0.35 * albedo, wet);
  let shaded = smoothstep(0.0, 0.25 * cover_shade + 0.05, cover_shade - cover_top) * (1.0 - 0.7 * moss);
  albedo *= 1.0 - 0.5 * shaded;
  let light = daylight(albedo, rough, world, up, bumped(up, slope), to_eye, seen * mix(0.6, 1.0, cover_open));

  return developed(light, world - globals.eye.xyz, pixel.xy);
}
