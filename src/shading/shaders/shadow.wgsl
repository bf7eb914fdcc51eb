// Depth of the rocks seen from a light, which may be below them.

@vertex
fn vs_main(@location(0) position: vec3f, @location(1) color: vec4f) -> @builtin(position) vec4f {
  let at = settled(position, color);
  // From below, what is under the ground does not stand before it.
  return field.sun_from_world * vec4f(at.xy, max(at.z, field.ground.w), 1.0);
}
