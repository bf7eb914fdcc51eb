// Prepended to the passes in natural colours: the light, and how a camera sees it.

// Of the ground, what open.wgsl found: how much of the sky it sees, and towards where.
@group(2) @binding(11) var open_map: texture_2d<f32>;

@group(2) @binding(0) var shadow_map: texture_depth_2d;
@group(2) @binding(1) var shadow_sampler: sampler_comparison;
// The shadow map again: its depths themselves
@group(2) @binding(4) var shadow_depths: texture_2d<f32>;
@group(2) @binding(5) var depth_sampler: sampler;

// As `sky_seen`, of a point of the ground where the maps have it.
fn sky_seen_by_ground(at: vec2f) -> f32 {
  let uv = (at - field.map.xy) * field.map.zw;
  let found = textureSampleLevel(open_map, height_sampler, vec2f(uv.x, 1.0 - uv.y), 0.0).xyz;
  // Beyond the map it gets as open as anywhere.
  let outside = max(abs(uv - 0.5) - 0.5, vec2f(0.0)) / field.map.zw;
  let near = 1.0 - smoothstep(0.0, 15.0, outside.x + outside.y);
  open_towards = vec3f((found.yz * 4.0 - 2.0) * near, 1.0);
  return mix(1.0, found.x, near);
}

// How much more of the sun's light than on the mean falls on what is shaded (water.wgsl).
var<private> gathered: f32 = 1.0;

// Where the maps have a point of a copy of the field. Beyond what they have it is open and sunny.
fn at_home(world: vec3f, shift: vec3f) -> vec3f {
  return world - shift * field.bricks.w;
}

// How far the copy is moved that a point of the ground belongs to.
fn shift_at(at: vec2f) -> vec3f {
  let from_middle = at - 0.5 * field.size.xy;
  let row = round(from_middle.y / field.bricks.y);
  let aside = row * field.bricks.z;
  return vec3f(round((from_middle.x - aside) / field.bricks.x) * field.bricks.x + aside, row * field.bricks.y, 0.0);
}

// In how many places a pixel looks for what hides the sky. What depends on it besides the light is a mean over all samples.
fn sky_taps() -> i32 {
  return select(select(16, 10, quality < 1.5), 5, quality < 0.5 || is_sampled);
}

// Share of the sun that reaches `world`, 0…1. High quality looks first for what casts the shadow: the farther off it
// is, the softer (Fernando, Percentage-closer soft shadows, 2005).
fn sun_seen(world: vec3f, face: vec3f) -> f32 {
  if is_sampled {
    return sun_drawn(world, face);
  }
  let side = field.sun.w;
  let texel = 1.0 / f32(textureDimensions(shadow_map).x);
  let facing = max(dot(face, field.sun.xyz), 0.0);
  // At low quality rocks lie lower than the map has them.
  let least = select(0.5, 1.5, quality < 0.5);
  let lifted = world + face * side * texel * (least + 1.5 * (1.0 - facing));
  let clip = (field.sun_from_world * vec4f(lifted, 1.0)).xyz;
  let uv = clip.xy * vec2f(0.5, -0.5) + 0.5;
  if any(abs(vec3f(clip.xy, 2.0 * clip.z - 1.0)) > vec3f(0.999)) {
    return 1.0;
  }
  let depth = clip.z - 0.0003;
  if quality < 0.5 {
    return textureSampleCompareLevel(shadow_map, shadow_sampler, uv, depth);
  }
  let wide = field.shadow.xy;
  let most = field.shadow.w;
  var soft = 1.2 * texel * side;
  if quality > 1.5 {
    var found = 0.0;
    var sum = 0.0;
    var way = vec2f(1.0, 0.0);
    for (var i = 0; i < 5; i++) {
      let radius = (most + 2.0 * texel * side) * sqrt(f32(i) / 5.0);
      let away = way * radius * wide;
      way = turned(way);
      let there = textureSampleLevel(shadow_depths, depth_sampler, uv + away, 0.0).r;
      let before = select(0.0, 1.0, there < depth);
      found += before;
      sum += before * (depth - there);
    }
    if found == 0.0 {
      return 1.0;
    }
    soft = clamp(field.shadow.z * sum / found, soft * 0.75, max(most, soft));
  }
  let taps = select(6, 10, quality > 1.5);
  var lit = 0.0;
  var way = vec2f(1.0, 0.0);
  for (var i = 0; i < taps; i++) {
    let radius = soft * sqrt((f32(i) + 0.5) / f32(taps));
    let away = way * radius * wide;
    way = turned(way);
    lit += textureSampleCompareLevel(shadow_map, shadow_sampler, uv + away, depth);
  }
  return lit / f32(taps);
}

// Trowbridge-Reitz distribution with Smith's masking, as approximated by Hammon; all angles' cosines above 0.
fn glint(n_h: f32, n_v: f32, n_l: f32, v_h: f32, rough: f32) -> f32 {
  let a = rough * rough;
  let d = n_h * n_h * (a * a - 1.0) + 1.0;
  let masking = 0.5 / mix(2.0 * n_l * n_v, n_l + n_v, a);
  let grazing = (1.0 - v_h) * (1.0 - v_h);
  let fresnel = 0.04 + 0.96 * grazing * grazing * (1.0 - v_h);
  return a * a / (3.14159 * d * d) * masking * fresnel * n_l;
}

// The light that comes from nearby, the same everywhere: what the ground sends up, and what comes from a rock that stands before the sky, a
// constant, fitted to what Blender's Cycles gives for a riverbed. `light_nearby` finds both.
var<private> ground_light: vec3f;
var<private> rock_light: vec3f;

// `bare_soil` being set.
fn light_nearby() {
  finest_albedo = kind_albedo(globals.scene.w);
  let open_sky = sky_light(vec3f(0.0, 0.0, 1.0));
  ground_light = ground_albedo() * (sunshine() * field.sun.z * 0.8 + open_sky * 0.6);
  rock_light = 0.85 * finest_albedo * (0.38 * sunshine() * (0.5 + field.sun.z) + 0.5 * open_sky);
}

// Of the open sky, and of the ground below it. At low quality it is found at vertices, and to be set before `daylight` is called.
var<private> all_around: vec3f;

fn light_all_around(normal: vec3f) -> vec3f {
  return sky_light(normal) + ground_light * (0.5 - 0.5 * normal.z);
}

// Share of the sun that reached the surface that `daylight` was asked for.
var<private> direct: f32;

// What is dry mirrors little, and of everything around: only high quality looks for it.
fn is_matte() -> bool {
  return quality < 0.5 || (quality < 1.5 && !is_wet && !has_water);
}

// Light from a surface to the eye. `face` without its relief, `normal` with it; `seen` from `sky_seen`.
fn daylight(albedo: vec3f, rough: f32, world: vec3f, face: vec3f, normal: vec3f, to_eye: vec3f, seen: f32) -> vec3f {
  let sun = field.sun.xyz;
  let sun_color = sunshine();

  let n_l = dot(normal, sun);
  // At the terminator a shadow map is unsure; of many that are not the same, the mean is not.
  let facing = select(smoothstep(-0.05, 0.2, dot(face, sun)), step(0.0, dot(face, sun)), is_sampled);
  direct = 0.0;
  if n_l > 0.0 && facing > 0.0 {
    direct = gathered * sun_seen(world, face) * facing * select(mix(0.8, 1.0, seen), 1.0, is_sampled);
  }
  // Low in a shadow, the ground and the rocks nearby are in it, too.
  if quality > 0.5 {
    let near = 1.0 - 2.4 * (1.0 - direct) / (4.0 + world.z);
    ground_light *= near;
    rock_light *= near;
  }
  // Towards where it is open; what is not sky is ground.
  if quality > 0.0 {
    all_around = light_all_around(normalize(normal + vec3f(0.7 * open_towards.xy, 0.0)));
  }
  var ambient = mix(rock_light, all_around, seen * seen);
  if is_sampled {
    ambient = around(world, face, normal);
  }
  let sunny = sun_color * max(n_l, 0.0) * direct;
  let light = albedo * (sunny + ambient);
  if is_matte() {
    return light + 0.04 * ambient + select(0.0, 0.01, quality > 0.5) * sunny;
  }
  return light + mirrored_light(rough, normal, to_eye, seen);
}

// What a surface mirrors of the sun, after `daylight`, and of the sky.
fn mirrored_light(rough: f32, normal: vec3f, to_eye: vec3f, seen: f32) -> vec3f {
  let sun = field.sun.xyz;
  let n_l = dot(normal, sun);
  let n_v = max(dot(normal, to_eye), 0.05);
  let half_way = normalize(sun + to_eye);
  let n_h = clamp(dot(normal, half_way), 0.0, 1.0);
  let shine = sunshine() * direct * glint(n_h, n_v, max(n_l, 0.001), max(dot(to_eye, half_way), 0.0), rough);
  // The sky in the surface (Karis, Physically based shading on mobile, 2014).
  let r = vec4f(-1.0, -0.0275, -0.572, 0.022) * rough + vec4f(1.0, 0.0425, 1.04, -0.04);
  let a = min(r.x * r.x, exp2(-9.28 * n_v)) * r.x + r.y;
  let mirrored = reflect(-to_eye, normal);
  // What is rough shows so much of the sky at once that it is as the light on a matte surface.
  var sky = all_around;
  if quality > 1.5 {
    let above = mix(sky_radiance(mirrored), sky_light(mirrored), smoothstep(0.15, 0.6, rough));
    sky = mix(ground_light, above, smoothstep(-0.3, 0.3, mirrored.z));
  }
  return shine + sky * (0.04 * (-1.04 * a + r.z) + 1.04 * a + r.w) * seen * seen;
}

// Relief and roughness: facets of the relief that are too small to be seen scatter the light.
fn bumped(normal: vec3f, slope: vec3f) -> vec3f {
  return normalize(normal - (slope - normal * dot(slope, normal)));
}
