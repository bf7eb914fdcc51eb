// Prepended to the passes that ask how much of the sky a point sees.

// Height / field.size.w, seen from above: R in steps of 1/255, G the rest of it
@group(2) @binding(2) var height_map: texture_2d<f32>;
@group(2) @binding(3) var height_sampler: sampler;

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

// How much of the sky `world` sees, 0…1: what stands higher on a spiral around it blocks. The inner turns find the
// neighbour it touches, the outer ones the boulder beside it. `face` is the surface without its relief.
fn sky_seen(world: vec3f, face: vec3f, taps: i32) -> f32 {
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
