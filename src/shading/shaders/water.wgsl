// Prepended to the passes that draw rocks and ground in natural colours: clear water over the field, as it is seen from above. No surface is drawn:
// whatever lies under it is shaded as what is seen of it from the air, with what the surface mirrors.

// How deep the point lies that is shaded, px; 0 in the air.
var<private> water_deep: f32;
// Where the ray to the eye leaves the water, and the surface's normal there.
var<private> water_at: vec3f;
var<private> water_normal: vec3f;

// Ripples of what flows along x.
fn ripples(at: vec2f, footprint: f32) -> vec2f {
  var slope = vec3f(0.0);
  var period = 37.0;
  var q = TURN * vec3f(at * vec2f(0.6, 1.0), 0.0) / period;
  for (var i = 0; i < 4; i++) {
    let seen = shown(period, footprint);
    if seen <= 0.0 {
      break;
    }
    slope += (0.045 * seen) * noise3(q).xyz;
    period /= 2.6;
    q = q * 2.6 + 3.7;
  }
  return (slope * TURN).xy;
}

// To be called first: finds out whether `world` is under water, and through which point of the surface it is seen.
fn dive(world: vec3f, to_eye: vec3f, footprint: f32) {
  water_deep = 0.0;
  let level = water_level();
  if !has_water || world.z >= level || globals.eye.z <= level || globals.soil.w > 0.5 {
    return;
  }
  water_deep = level - world.z;
  water_at = world + to_eye * (water_deep / max(to_eye.z, 0.001));
  water_normal = normalize(vec3f(-ripples(water_at.xy, footprint), 1.0));
}

// How far light goes through so deep water for each px of depth, which arrives from `way` in the air.
fn slant(way: vec3f) -> f32 {
  return inverseSqrt(1.0 - 0.565 * (1.0 - way.z * way.z));
}

// How much more of the sun's light than on the mean falls on a point under water: what the ripples gather.
fn caustics(world: vec3f, footprint: f32) -> f32 {
  if !has_water || water_deep <= 0.0 {
    return 1.0;
  }
  let at = world.xy + field.sun.xy * (0.6 * water_deep);
  let wide = noise3(TURN * vec3f(at, 0.0) / 9.0 + 0.15 * noise3(TURN * vec3f(at, 4.0) / 4.0).xyz).w;
  let fine = noise3(TURN * vec3f(at, 9.0) / 5.3).w;
  let line = (1.0 - smoothstep(0.0, 0.16, abs(wide))) + 0.6 * (1.0 - smoothstep(0.0, 0.14, abs(fine)));
  return 1.0 + (0.9 * line - 0.45) * smoothstep(0.0, 6.0, water_deep) * shown(5.0, footprint);
}

// What the eye sees of `light` from under water.
fn through_water(light: vec3f, to_eye: vec3f) -> vec3f {
  if !has_water || water_deep <= 0.0 {
    return light;
  }
  let path = water_deep * (slant(to_eye) + slant(field.sun.xyz));
  // Of a mountain stream, per px: red is absorbed most.
  let left = exp(-path * vec3f(0.018, 0.0075, 0.0085));
  let scattered = vec3f(0.012, 0.03, 0.028) * (sunshine() * field.sun.z + sky_light(vec3f(0.0, 0.0, 1.0)));
  let under = light * left + scattered * (1.0 - left);
  let facing = clamp(dot(water_normal, to_eye), 0.0, 1.0);
  let grazing = 1.0 - facing;
  let fresnel = 0.02 + 0.98 * grazing * grazing * grazing * grazing * grazing;
  var mirrored = reflect(-to_eye, water_normal);
  mirrored.z = abs(mirrored.z) + 0.01;
  // Rocks in the mirror: a few places along the way are looked at.
  let home = at_home(water_at, shift_at(water_at.xy));
  var open = 1.0;
  if quality > 0.5 {
    for (var i = 1; i < 6; i++) {
      let away = f32(i * i) * 2.5;
      let above = height_at(home.xy + mirrored.xy * away) - water_level() - mirrored.z * away;
      open = min(open, 1.0 - smoothstep(-0.5, 1.5, above));
    }
  }
  let half_way = normalize(field.sun.xyz + to_eye);
  let shine = glint(clamp(dot(water_normal, half_way), 0.0, 1.0), max(facing, 0.05), max(field.sun.z, 0.001), max(dot(to_eye, half_way), 0.0), 0.1);
  return mix(under, mix(rock_light, sky_radiance(mirrored), open), fresnel) + sunshine() * min(shine, 4.0);
}
