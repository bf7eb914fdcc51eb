// Prepended to the passes that draw rocks in natural colours: what their surface is like, whatever light falls on it.

// What changes slowly over a rock or not at all, to be set before `rock_surface` is called: its own mean albedo, and `mossy` there.
var<private> rock_albedo: vec3f;
var<private> rock_mossy: f32;
// How much soil is splashed there
var<private> rock_soiled: f32;

// The mean albedo of one rock, darker where it sees little of the sky; `own` and `seen` as for `rock_surface`.
fn albedo_of(own: vec4f, seen: f32) -> vec3f {
  let random = floor(own * 255.0 + 0.5);
  return individual(kind_albedo(random.w), random.xyz / 255.0) * mix(0.8, 1.0, smoothstep(0.3, 0.9, seen));
}

// Near the ground most.
fn soiled(world: vec3f) -> f32 {
  return exp(-max(world.z, 0.0) / (2.0 + 0.1 * field.size.z)) * 1.1;
}

// What `rock_surface` found.
var<private> surface_albedo: vec3f;
var<private> surface_rough: f32;
// With its relief
var<private> surface_normal: vec3f;

// Where the mesh means to be smooth its normal and the face's nearly agree: 1. A broken edge stays sharp: 0.
fn agreement(smooth_normal: vec3f, face: vec3f) -> f32 {
  return smoothstep(0.72, 0.84, dot(smooth_normal, face));
}

// How fast the surface turns from a pixel to the next ones, and towards which side: edges wear, hollows collect dirt.
fn worn(across: vec3f, down: vec3f, turn_x: vec3f, turn_y: vec3f) -> f32 {
  let step_x = dot(across, across);
  let step_y = dot(down, down);
  let convex = dot(turn_x, across) / max(step_x, 1e-6) + dot(turn_y, down) / max(step_y, 1e-6);
  return clamp(convex * 2.5, -0.5, 1.0);
}

// `own` three random numbers of the rock and its kind / 255, `base` the normal without relief, `wear` from `worn`, `seen` from
// `sky_seen`, `footprint` from `footprint_of`.
fn rock_surface(world: vec3f, own: vec4f, base: vec3f, wear: f32, seen: f32, footprint: f32) {
  let random = floor(own * 255.0 + 0.5);
  let numbers = random.xyz / 255.0;
  stone(random.w, numbers, rock_albedo, world + random.zxy * vec3f(3.7, 2.9, 4.3), footprint);
  let relief = bumped(base, stone_slope);

  var albedo = stone_albedo * (1.0 + 0.16 * wear);
  var rough = stone_rough;
  var bent = relief;

  // Dust and splashed soil: near the ground, and where it can lie.
  let dust = globals.weather.w;
  let lies = smoothstep(0.45, 1.0, relief.z) * 0.55 + rock_soiled;
  let dusty = dust * smoothstep(0.25, 1.0, lies + 0.6 * stone_patch + 0.4 * dust - 0.2 * wear);
  albedo = mix(albedo, bare_soil * 1.15, 0.7 * dusty);
  rough = mix(rough, 0.95, dusty);

  var moss = moss_cover(world, rock_mossy, base.z, world.z, 1.0 - seen, footprint);
  if moss > 0.0 {
    moss_coat(world, footprint);
    // Each cushion ends where it ends.
    moss = smoothstep(0.25, 0.45, moss + 0.35 * moss_high);
    albedo = mix(albedo, moss_albedo, moss);
    rough = mix(rough, 0.95, moss);
    if quality > 0.0 {
      bent = normalize(mix(relief, bumped(base, moss_slope), moss));
    }
  }

  let snow = snow_cover(world, base.z, footprint);
  if snow > 0.0 {
    albedo = mix(albedo, snow_albedo, snow);
    rough = mix(rough, 0.9, snow);
    bent = normalize(mix(bent, bumped(normalize(base + vec3f(0.0, 0.0, 0.6 + 1.5 * snow_heap - 3.0 * snow * (1.0 - snow))), snow_slope), snow));
  }

  // Water fills the pores: darker, more saturated, and it shines.
  let wet = wet_cover(world) * (1.0 - 0.5 * moss) * (1.0 - snow);
  albedo *= mix(vec3f(1.0), vec3f(0.45) + 0.35 * albedo, wet);
  rough = mix(rough, 0.22, wet);
  surface_albedo = albedo;
  surface_rough = rough;
  surface_normal = bent;
  if quality > 0.0 {
    surface_normal = normalize(mix(bent, base, 0.6 * wet));
  }
}
