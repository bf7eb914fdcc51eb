// Prepended, after common.wgsl, to the passes that are lit: sun with shadow, sky and bounce with occlusion.

@group(2) @binding(0) var shadow_map: texture_depth_2d;
@group(2) @binding(1) var shadow_sampler: sampler_comparison;
// Height / field.size.w, seen from above: R in steps of 1/255, G the rest of it (height.wgsl)
@group(2) @binding(2) var height_map: texture_2d<f32>;
@group(2) @binding(3) var height_sampler: sampler;

// Share of the sun that reaches `world`, 0…1: 3 × 3 taps, each a hardware 2 × 2.
// The receiver is lifted along its own normal by the size of the kernel, which is what keeps
// slanted faces free of acne without letting shadows come off the foot of a rock.
fn sunlight(world: vec3f, normal: vec3f) -> f32 {
  let slope = 1.0 - max(dot(normal, field.sun.xyz), 0.0);
  let texel = 1.0 / vec2f(textureDimensions(shadow_map));
  let lifted = world + normal * field.sun.w * texel.x * (0.6 + 1.8 * slope);
  let clip = (field.sun_from_world * vec4f(lifted, 1.0)).xyz;
  let uv = clip.xy * vec2f(0.5, -0.5) + 0.5;
  // Beyond the map lies open ground, in all three directions.
  let inside = all(abs(vec3f(clip.xy, 2.0 * clip.z - 1.0)) < vec3f(0.999));
  var lit = 0.0;
  for (var y = -1; y <= 1; y++) {
    for (var x = -1; x <= 1; x++) {
      let at = uv + vec2f(f32(x), f32(y)) * texel;
      lit += textureSampleCompareLevel(shadow_map, shadow_sampler, at, clip.z - 0.0004);
    }
  }
  return select(1.0, lit / 9.0, inside);
}

fn height_at(at: vec2f) -> f32 {
  let uv = (at - field.map.xy) * field.map.zw;
  return textureSampleLevel(height_map, height_sampler, vec2f(uv.x, 1.0 - uv.y), 0.0).r * field.size.w;
}

// How much of the sky `world` sees, 0…1: what stands higher on a spiral around it blocks.
// 16 taps on a golden-angle spiral, 1…REACH px of the world, turned per pixel by less than one tap.
fn sky_visibility(world: vec3f, normal: vec3f, pixel: vec2f) -> f32 {
  const TAPS = 16;
  const REACH = 26.0;
  let start = dither(pixel) * 0.8;
  let reach = max(REACH, 3.0 * field.ground.y);
  // Rocks that are sunk into the ground meet it with steep walls, which hide much of what stands behind them: else they would
  // be black in the middle and at the foot.
  let sunk = field.ground.z > 0.5;
  let flattest = select(0.2, 0.04, sunk);
  let steepest = select(2.0, 25.0, sunk);
  var blocked = 0.0;
  for (var i = 0; i < TAPS; i++) {
    let share = (f32(i) + 0.5) / f32(TAPS);
    let radius = max(reach * share * share, 1.5 * field.ground.y);
    let angle = f32(i) * 2.39996 + start;
    let away = vec2f(cos(angle), sin(angle)) * radius;
    let rise = height_at(world.xy + away) - world.z;
    // The sine of the horizon's elevation, less what the face itself would hide.
    let own = clamp(-dot(normal.xy, away) / max(normal.z, flattest), -radius, steepest * radius);
    let above = max(rise - max(own, 0.0) - 0.4, 0.0);
    blocked += above * inverseSqrt(above * above + radius * radius);
  }
  return 1.0 - blocked / f32(TAPS);
}

// Diffuse light on a face. `albedo` linear.
fn shade(albedo: vec3f, world: vec3f, normal: vec3f, pixel: vec2f) -> vec3f {
  let visible = sky_visibility(world, normal, pixel);
  let facing = max(dot(normal, field.sun.xyz), 0.0);
  let direct = SUN_COLOR * facing * sunlight(world, normal);
  let hemisphere = mix(BOUNCE_COLOR, SKY_COLOR, 0.5 + 0.5 * normal.z);
  return albedo * (direct * mix(0.75, 1.0, visible) + hemisphere * visible * visible);
}
