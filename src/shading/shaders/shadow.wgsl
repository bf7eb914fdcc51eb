// Depth of the rocks seen from the sun.

@vertex
fn vs_main(@location(0) position: vec3f, @location(1) color: vec4f) -> @builtin(position) vec4f {
  return field.sun_from_world * vec4f(settled(position, color), 1.0);
}
