// Depth of the rocks seen from the sun.

@vertex
fn vs_main(@location(0) position: vec3f) -> @builtin(position) vec4f {
  return field.sun_from_world * vec4f(position, 1.0);
}
