// Prepended to the passes in natural colours: the light of one sample of a still. A sample knows three directions, the same for all
// pixels (sample.rs): to a point of the sun's disc, to a point of the sky, and to one of the ground. Their mean over many samples is
// what the sun, the sky and one bounce give.

// Depth of the rocks seen from the point of the sky, and seen from under the ground.
@group(2) @binding(8) var high_map: texture_depth_2d;
@group(2) @binding(9) var below_map: texture_depth_2d;

// 1 over the density of the directions that are drawn, by the cosine of the normal and by their height above the horizon (sample.rs).
fn drawn(cosine: f32, height: f32) -> f32 {
  return 2.0 * max(cosine, 0.0) / (height + 0.5);
}

// Where a point is in the map of a light that shines along -`way`, and whether it is in it; lifted by what the map is too coarse for.
fn in_map(from_world: mat4x4f, way: vec3f, texel: f32, world: vec3f, face: vec3f) -> vec4f {
  let lifted = world + face * texel * (0.25 + 0.75 * (1.0 - max(dot(face, way), 0.0)));
  let clip = (from_world * vec4f(lifted, 1.0)).xyz;
  let inside = all(abs(vec3f(clip.xy, 2.0 * clip.z - 1.0)) < vec3f(0.999));
  return vec4f(clip.xy * vec2f(0.5, -0.5) + 0.5, clip.z - 0.0001, select(0.0, 1.0, inside));
}

fn sun_drawn(world: vec3f, face: vec3f) -> f32 {
  let texel = field.sun.w / f32(textureDimensions(shadow_map).x);
  let at = in_map(field.sun_from_world, field.sun.xyz, texel, world, face);
  return mix(1.0, textureSampleCompareLevel(shadow_map, shadow_sampler, at.xy, at.z), at.w);
}

fn sky_drawn(world: vec3f, face: vec3f) -> f32 {
  let texel = field.sky_way.w / f32(textureDimensions(high_map).x);
  let at = in_map(field.sky_from_world, field.sky_way.xyz, texel, world, face);
  return mix(1.0, textureSampleCompareLevel(high_map, shadow_sampler, at.xy, at.z), at.w);
}

fn ground_drawn(world: vec3f, face: vec3f) -> f32 {
  let texel = field.below_way.w / f32(textureDimensions(below_map).x);
  let at = in_map(field.below_from_world, field.below_way.xyz, texel, world, face);
  return mix(1.0, textureSampleCompareLevel(below_map, shadow_sampler, at.xy, at.z), at.w);
}

// What comes from a rock that stands before the light from `way`: as bright as a ball there is on the mean, of which the less is lit the nearer it
// stands to the sun (Lambert's phase function), under the sky as far as rocks see of it.
fn sent_by_rock(way: vec3f, open_sky: vec3f) -> vec3f {
  let cosine = clamp(-dot(way, field.sun.xyz), -1.0, 1.0);
  let phase = (sqrt(1.0 - cosine * cosine) + (3.14159 - acos(cosine)) * cosine) * (2.0 / (3.0 * 3.14159));
  return kind_albedo(globals.scene.w) * (sunshine() * phase + 0.5 * open_sky);
}

// What comes to a point from all around, by the cosine, as a share of what a white surface would send on; `face` without its relief.
fn around(world: vec3f, face: vec3f, normal: vec3f) -> vec3f {
  let sun_color = sunshine();
  let open_sky = sky_light(vec3f(0.0, 0.0, 1.0));

  let up = field.sky_way.xyz;
  var light = vec3f(0.0);
  let rising = drawn(dot(normal, up), up.z);
  if rising > 0.0 {
    let open = select(0.0, sky_drawn(world, face), dot(face, up) > 0.0);
    light += rising * mix(sent_by_rock(up, open_sky), sky_radiance(up), open);
  }
  let down = field.below_way.xyz;
  let falling = drawn(dot(normal, down), -down.z);
  if falling > 0.0 {
    let open = select(0.0, ground_drawn(world, face), dot(face, down) > 0.0);
    let there = vec3f(world.xy + down.xy * (max(world.z, 0.0) / -down.z), 0.0);
    let lit = sun_color * field.sun.z * sun_drawn(there, vec3f(0.0, 0.0, 1.0)) + 0.6 * open_sky;
    light += falling * mix(sent_by_rock(down, open_sky), ground_albedo() * lit, open);
  }
  return light;
}
