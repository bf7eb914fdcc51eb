// All rocks at once, in natural colours.

struct Varyings {
  @builtin(position) clip: vec4f,
  @location(0) from_eye: vec3f,
  // Three random numbers of the rock, and its kind / 255
  @location(1) own: vec4f,
  @location(2) normal: vec3f,
  // As in rock.wgsl: the same point, but never outside the triangle
  @location(3) @interpolate(perspective, centroid) inside: vec3f,
}

@vertex
fn vs_main(@location(0) position: vec3f, @location(1) color: vec4f, @location(2) normal: vec2f) -> Varyings {
  var out: Varyings;
  out.from_eye = settled(position, color) - globals.eye.xyz;
  out.clip = globals.clip_from_eye * vec4f(out.from_eye, 1.0);
  out.inside = out.from_eye;
  out.own = vec4f(color.xyz, kind_of(color) / 255.0);
  // Octahedral, as scene.rs packs it.
  let z = 1.0 - abs(normal.x) - abs(normal.y);
  let fold = max(-z, 0.0);
  out.normal = normalize(vec3f(normal - fold * select(vec2f(-1.0), vec2f(1.0), normal >= vec2f(0.0)), z));
  return out;
}

@fragment
fn fs_main(
  @builtin(position) pixel: vec4f,
  @location(0) from_eye: vec3f,
  @location(1) own: vec4f,
  @location(2) normal: vec3f,
  @location(3) @interpolate(perspective, centroid) inside: vec3f,
) -> @location(0) vec4f {
  let across = dpdx(from_eye);
  let down = dpdy(from_eye);
  let flat = normalize(cross(across, down));
  let face = select(flat, -flat, dot(flat, from_eye) > 0.0);
  let smooth_normal = normalize(normal);
  // How fast the surface turns over a pixel, and towards which side: edges wear, hollows collect dirt.
  let turn_x = dpdx(smooth_normal);
  let turn_y = dpdy(smooth_normal);
  let step_x = dot(across, across);
  let step_y = dot(down, down);
  let convex = dot(turn_x, across) / max(step_x, 1e-6) + dot(turn_y, down) / max(step_y, 1e-6);

  // Where the mesh means to be smooth its normal and the face's nearly agree; a broken edge stays sharp.
  let agree = smoothstep(0.72, 0.84, dot(smooth_normal, face));
  let base = normalize(mix(face, smooth_normal, agree));

  let world = inside + globals.eye.xyz;
  let far = length(from_eye);
  let to_eye = -from_eye / far;
  let footprint = footprint_of(across, down);

  let random = floor(own * 255.0 + 0.5);
  let numbers = random.xyz / 255.0;
  stone(random.w, numbers, world + random.zxy * vec3f(3.7, 2.9, 4.3), footprint);
  let relief = bumped(base, stone_slope);

  let seen = sky_seen(world, base, pixel.xy);
  let wear = clamp(convex * 2.5, -0.5, 1.0) * agree;
  var albedo = stone_albedo * (1.0 + 0.16 * wear) * mix(0.8, 1.0, smoothstep(0.3, 0.9, seen));
  var rough = stone_rough;
  var bent = relief;

  // Dust and splashed soil: near the ground, and where it can lie.
  let dust = globals.weather.w;
  var loose = 0.0;
  if globals.scene.y > 0.0 {
    loose = noise2(world.xy / 6.3) * 0.5 + noise2(world.yz / 2.7 + 5.0) * 0.35 * shown(2.7, footprint);
  }
  let low = exp(-max(world.z, 0.0) / (2.0 + 0.1 * field.size.z)) * 1.1;
  let lies = smoothstep(0.45, 1.0, relief.z) * 0.55 + low;
  let dusty = dust * smoothstep(0.25, 1.0, lies + 0.5 * loose + 0.4 * dust - 0.2 * wear);
  albedo = mix(albedo, soil_albedo(globals.scene.x) * 1.15, 0.7 * dusty);
  rough = mix(rough, 0.95, dusty);

  let moss = moss_cover(world, base.z, world.z, 1.0 - seen, footprint);
  if moss > 0.0 {
    albedo = mix(albedo, moss_albedo(world, footprint), moss);
    rough = mix(rough, 0.95, moss);
    bent = normalize(mix(relief, base, 0.5 * moss));
  }

  // Water fills the pores: darker, more saturated, and it shines.
  let wet = wet_cover(world.xy) * (1.0 - 0.5 * moss);
  albedo *= mix(vec3f(1.0), vec3f(0.45) + 0.35 * albedo, wet);
  rough = mix(rough, 0.22, wet);
  bent = normalize(mix(bent, base, 0.6 * wet));

  // A rim turned away by less than its relief would be lit from behind.
  let towards = normalize(bent + to_eye * max(0.0, 0.02 - dot(bent, to_eye)));
  // What turns faster than the pixels can show scatters (Kaplanyan et al., Filtering distributions of normals, 2016).
  let spread = min(0.5 * (dot(turn_x, turn_x) + dot(turn_y, turn_y)) * agree, 0.18);
  let square = rough * rough;
  rough = sqrt(sqrt(min(square * square + spread, 1.0)));
  let light = daylight(albedo, rough, world, base, towards, to_eye, seen);
  return developed(light, far, pixel.xy);
}
