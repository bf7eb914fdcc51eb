// Prepended to the passes in natural colours: the light, and how a camera sees it.

@group(2) @binding(0) var shadow_map: texture_depth_2d;
@group(2) @binding(1) var shadow_sampler: sampler_comparison;
// Height / field.size.w, seen from above: R in steps of 1/255, G the rest of it
@group(2) @binding(2) var height_map: texture_2d<f32>;
@group(2) @binding(3) var height_sampler: sampler;
// The shadow map again: its depths themselves
@group(2) @binding(4) var shadow_depths: texture_2d<f32>;
@group(2) @binding(5) var depth_sampler: sampler;

// What `sky_seen` found: towards the open sky, not of length 1.
var<private> open_towards: vec3f;

// By the golden angle: the next step of a spiral.
fn turned(way: vec2f) -> vec2f {
  return vec2f(way.x * -0.7373688 - way.y * 0.6754902, way.x * 0.6754902 + way.y * -0.7373688);
}

fn height_at(at: vec2f) -> f32 {
  let uv = (at - field.map.xy) * field.map.zw;
  let found = textureSampleLevel(height_map, height_sampler, vec2f(uv.x, 1.0 - uv.y), 0.0).rg;
  return (found.r + (found.g - 0.5) / 255.0) * field.size.w;
}

// Where the spiral of `sky_seen` begins: everywhere alike. A dither in its stead shows as a hatch, above all where something has a
// threshold, as moss has.
var<private> spiral_start: f32 = 0.6;

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

// How much of the sky `world` sees, 0…1: what stands higher on a spiral around it blocks. The inner turns find the
// neighbour it touches, the outer ones the boulder beside it. `face` is the surface without its relief.
fn sky_seen(world: vec3f, face: vec3f) -> f32 {
  // What depends on it besides the light is a mean over all samples.
  let taps = select(select(16, 10, quality < 1.5), 5, quality < 0.5 || is_sampled);
  let texel = field.ground.y;
  let reach = max(30.0, 3.0 * texel);
  var blocked = 0.0;
  var lost = vec2f(0.0);
  var way = vec2f(cos(spiral_start), sin(spiral_start));
  for (var i = 0; i < taps; i++) {
    let share = (f32(i) + 0.5) / f32(taps);
    let radius = max(reach * share * share, 1.2 * texel);
    let away = way * radius;
    way = turned(way);
    let rise = height_at(world.xy + away) - world.z;
    // What the face itself would hide; of a wall, all that stands behind it, or every boulder's foot would be black.
    let own = clamp(-dot(face.xy, away) / max(face.z, 0.04), -radius, 25.0 * radius);
    let above = max(rise - max(own, 0.0) - 0.25, 0.0);
    let sine = above * inverseSqrt(above * above + radius * radius);
    blocked += sine;
    lost += away * (sine / radius);
  }
  open_towards = vec3f(-lost / f32(taps) * 2.0, 1.0);
  return 1.0 - blocked / f32(taps);
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
  let lifted = world + face * side * texel * (0.5 + 1.5 * (1.0 - facing));
  let clip = (field.sun_from_world * vec4f(lifted, 1.0)).xyz;
  let uv = clip.xy * vec2f(0.5, -0.5) + 0.5;
  if any(abs(vec3f(clip.xy, 2.0 * clip.z - 1.0)) > vec3f(0.999)) {
    return 1.0;
  }
  let depth = clip.z - 0.0003;
  if quality < 0.5 {
    return textureSampleCompareLevel(shadow_map, shadow_sampler, uv, depth);
  }
  // Depth is 1 over so many px; the rows of the matrix are as long as the map is deep and wide.
  let row = vec3f(field.sun_from_world[0].z, field.sun_from_world[1].z, field.sun_from_world[2].z);
  let deep = inverseSqrt(dot(row, row));
  let wide = vec2f(
    length(vec3f(field.sun_from_world[0].x, field.sun_from_world[1].x, field.sun_from_world[2].x)),
    length(vec3f(field.sun_from_world[0].y, field.sun_from_world[1].y, field.sun_from_world[2].y)),
  ) * 0.5;
  // Width of the half-shadow per px to its caster: the sun's disc and the bright sky round it.
  const SPREAD = 0.035;
  let most = 0.5 * SPREAD * field.size.w / max(field.sun.z, 0.2);
  var soft = 1.2 * texel * side;
  if quality > 1.5 {
    var found = 0.0;
    var sum = 0.0;
    var way = vec2f(1.0, 0.0);
    for (var i = 0; i < 9; i++) {
      let radius = (most + 2.0 * texel * side) * sqrt(f32(i) / 9.0);
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
    soft = clamp(SPREAD * deep * sum / found * 0.5, soft * 0.75, max(most, soft));
  }
  let taps = select(8, 16, quality > 1.5);
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

// What comes from a rock that stands before the sky: a constant, fitted to what Blender's Cycles gives for a riverbed.
fn light_of_rocks() -> vec3f {
  let lit = 0.38 * sunshine() * (0.5 + field.sun.z) + 0.5 * sky_light(vec3f(0.0, 0.0, 1.0));
  return 0.85 * kind_albedo(globals.scene.w) * lit;
}

// Light from a surface to the eye. `face` without its relief, `normal` with it; `seen` from `sky_seen`.
fn daylight(albedo: vec3f, rough: f32, world: vec3f, face: vec3f, normal: vec3f, to_eye: vec3f, seen: f32) -> vec3f {
  let sun = field.sun.xyz;
  let sun_color = sunshine();
  let bounce_color = soil_albedo(globals.scene.x) * (sun_color * sun.z * 0.8 + sky_light(vec3f(0.0, 0.0, 1.0)) * 0.6);

  let n_l = dot(normal, sun);
  // At the terminator a shadow map is unsure; of many that are not the same, the mean is not.
  let facing = select(smoothstep(-0.05, 0.2, dot(face, sun)), step(0.0, dot(face, sun)), is_sampled);
  var direct = 0.0;
  if n_l > 0.0 && facing > 0.0 {
    direct = sun_seen(world, face) * facing * select(mix(0.8, 1.0, seen), 1.0, is_sampled);
  }
  // Towards where it is open; what is not sky is ground.
  let open = normalize(normal + vec3f(0.7 * open_towards.xy, 0.0));
  var ambient = mix(light_of_rocks(), sky_light(open) + bounce_color * (0.5 - 0.5 * open.z), seen * seen);
  if is_sampled {
    ambient = around(world, face, normal);
  }
  var light = albedo * (sun_color * max(n_l, 0.0) * direct + ambient);

  let n_v = max(dot(normal, to_eye), 0.05);
  let half_way = normalize(sun + to_eye);
  let n_h = clamp(dot(normal, half_way), 0.0, 1.0);
  light += sun_color * direct * glint(n_h, n_v, max(n_l, 0.001), max(dot(to_eye, half_way), 0.0), rough);
  // The sky in the surface (Karis, Physically based shading on mobile, 2014).
  let r = vec4f(-1.0, -0.0275, -0.572, 0.022) * rough + vec4f(1.0, 0.0425, 1.04, -0.04);
  let a = min(r.x * r.x, exp2(-9.28 * n_v)) * r.x + r.y;
  let mirrored = reflect(-to_eye, normal);
  // What is rough shows so much of the sky at once that it is as the light on a matte surface.
  let above = mix(sky_radiance(mirrored), sky_light(mirrored), smoothstep(0.15, 0.6, rough));
  let sky = mix(bounce_color, above, smoothstep(-0.3, 0.3, mirrored.z));
  return light + sky * (0.04 * (-1.04 * a + r.z) + 1.04 * a + r.w) * seen * seen;
}

// Relief and roughness: facets of the relief that are too small to be seen scatter the light.
fn bumped(normal: vec3f, slope: vec3f) -> vec3f {
  return normalize(normal - (slope - normal * dot(slope, normal)));
}
