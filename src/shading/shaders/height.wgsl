// Height of the rocks seen from above, for the occlusion of the sky.

struct Varyings {
  @builtin(position) clip: vec4f,
  @location(0) height: f32,
}

@vertex
fn vs_main(@location(0) position: vec3f, @location(1) color: vec4f) -> Varyings {
  var out: Varyings;
  let at = settled(position, color);
  let uv = (at.xy - field.map.xy) * field.map.zw;
  out.height = at.z / field.size.w;
  // What is below the ground is flat: nothing reads it, and it must not be clipped away from what is above.
  out.clip = vec4f(uv * 2.0 - 1.0, 1.0 - max(out.height, 0.0), 1.0);
  return out;
}

// R is the nearest of 255 steps and G what is left of it: both can be filtered, and so can their sum.
@fragment
fn fs_main(@location(0) height: f32) -> @location(0) vec4f {
  let steps = max(height, 0.0) * 255.0;
  let step = floor(steps + 0.5);
  return vec4f(step / 255.0, steps - step + 0.5, 0.0, 1.0);
}
