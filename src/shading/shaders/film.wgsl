// Prepended to the passes in natural colours, and to the one that makes a picture of a still: the camera's tone curve.

// The picture that light gives: T. Sobotka's AgX, whose curve is B. Wrensch's polynomial (2023), with a little more contrast and colour.
fn toned(light: vec3f) -> vec3f {
  const INSET = mat3x3f(
    vec3f(0.842479062, 0.042328242, 0.042375655),
    vec3f(0.0784336, 0.878468636, 0.0784336),
    vec3f(0.079223745, 0.079166127, 0.879142974),
  );
  const OUTSET = mat3x3f(
    vec3f(1.196879005, -0.052896852, -0.052971636),
    vec3f(-0.098020881, 1.151903130, -0.098043450),
    vec3f(-0.099029744, -0.098961177, 1.151073673),
  );
  let stops = log2(max(INSET * light, vec3f(1e-6)));
  let x = clamp((stops + 12.47393) / 16.5, vec3f(0.0), vec3f(1.0));
  let y = -0.00232 + x * (0.1191 + x * (0.4298 + x * (-6.868 + x * (31.96 + x * (-40.14 + x * 15.5)))));
  let film = max(OUTSET * y, vec3f(0.0));
  let punch = pow(film, vec3f(TONE_CONTRAST));
  return max(mix(vec3f(dot(punch, vec3f(0.2126, 0.7152, 0.0722))), punch, TONE_COLOR), vec3f(0.0));
}

const TONE_CONTRAST = 1.22;
const TONE_COLOR = 1.15;

// From light at the camera to the picture. Samples of a still keep the light.
fn taken(light: vec3f, pixel: vec2f) -> vec4f {
  if is_sampled {
    return vec4f(light, 1.0);
  }
  return shown_as(toned(light), pixel);
}
