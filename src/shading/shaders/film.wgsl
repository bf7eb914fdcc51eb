// Prepended to the passes in natural colours, and to the one that makes a picture of a still: the camera's tone curve.

// The picture that light gives: T. Sobotka's AgX with B. Wrensch's curve (2023) and a little more contrast (a power of 1.22) and colour (1.15 times as far
// from grey). As both of AgX' matrices do hardly more than mix a colour with one grey, contrast can stand in the curve, and colour in the last step: film.rs
// tests that the picture is the same.
fn toned(light: vec3f) -> vec3f {
  let film = 0.8 * light + dot(light, vec3f(0.0423, 0.0784, 0.0792));
  let x = clamp(log2(max(film, vec3f(1e-6))) * 0.060606061 + 0.75599576, vec3f(0.0), vec3f(1.0));
  let y = max(0.0014327 + x * (-0.1515847 + x * (3.239357 + x * (-20.50378 + x * (58.06634 + x * (-61.37358 + x * 21.71865))))), vec3f(0.0));
  return max(1.4375 * y - dot(y, vec3f(0.0928, 0.2321, 0.1126)), vec3f(0.0));
}

// From light at the camera to the picture. Samples of a still keep the light.
fn taken(light: vec3f, pixel: vec2f) -> vec4f {
  if is_sampled {
    return vec4f(light, 1.0);
  }
  return shown_as(toned(light), pixel);
}

// Like `taken`, of what has a grain of its own: at low quality without a dither.
fn taken_of_surface(light: vec3f, pixel: vec2f) -> vec4f {
  if quality < 0.5 && !is_sampled && !target_is_srgb {
    return vec4f(toned(light), 1.0);
  }
  return taken(light, pixel);
}

// px of the world under a pixel of a surface that goes on by `across` and `down` to the next pixels; not stretched all the way at
// the rim, where nothing is seen anyway.
fn footprint_of(across: vec3f, down: vec3f) -> f32 {
  let step_x = dot(across, across);
  let step_y = dot(down, down);
  if quality < 0.5 {
    return sqrt(0.5 * (step_x + step_y));
  }
  return sqrt(sqrt(step_x * step_y)) * 0.5 + sqrt(max(step_x, step_y)) * 0.5;
}
