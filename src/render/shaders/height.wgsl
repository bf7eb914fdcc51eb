// Height of the rocks seen from above, for the occlusion of the sky.

struct Varyings {
  @builtin(position) clip: vec4f,
  @location(0) height: f32,
}

@vertex
fn vs_main(@location(0) position: vec3f) -> Varyings {
  var out: Varyings;
  let uv = (position.xy - field.map.xy) * field.map.zw;
  out.height = position.z / field.size.z;
  out.clip = vec4f(uv * 2.0 - 1.0, 1.0 - out.height, 1.0);
  return out;
}

@fragment
fn fs_main(@location(0) height: f32) -> @location(0) vec4f {
  return vec4f(height, 0.0, 0.0, 1.0);
}
