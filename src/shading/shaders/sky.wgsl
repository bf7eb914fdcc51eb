// Prepended to the passes in natural colours: the sky (sky.rs has the model), the air in between, and the camera's tone curve. All light is in the units of
// sky.rs: multiplied by exposure and white balance.

// Radiance of the sky without the sun. Columns from the sun's azimuth to the opposite one, rows from the horizon up.
@group(2) @binding(6) var sky_map: texture_2d<f32>;
@group(2) @binding(7) var sky_sampler: sampler;

// The sun's light, as `daylight` wants it: its irradiance divided by π.
fn sunshine() -> vec3f {
  return field.sunshine.rgb;
}

// From a direction of length 1; below the horizon, that of the horizon.
fn sky_radiance(direction: vec3f) -> vec3f {
  let azimuth = vec2f(field.sky[0].w, field.sky[1].w);
  let aside = azimuth.x * direction.y - azimuth.y * direction.x;
  let from_sun = atan2(abs(aside), dot(azimuth, direction.xy)) / 3.1415927;
  let height = sqrt(asin(clamp(direction.z, 0.0, 1.0)) / 1.5707964);
  return textureSampleLevel(sky_map, sky_sampler, vec2f(from_sun, height), 0.0).rgb;
}

// The sky's irradiance of a surface with this normal, divided by π, as long as nothing hides any of it.
fn sky_light(normal: vec3f) -> vec3f {
  let azimuth = vec2f(field.sky[0].w, field.sky[1].w);
  let x = dot(azimuth, normal.xy);
  let y = azimuth.x * normal.y - azimuth.y * normal.x;
  let z = normal.z;
  let light = field.sky[0].rgb + z * (field.sky[1].rgb + z * field.sky[3].rgb) + x * (field.sky[2].rgb + z * field.sky[4].rgb)
    + (x * x - y * y) * field.sky[5].rgb;
  return max(light, vec3f(0.0));
}

// What the eye sees of the sky: with the sun's disc and its glow in the haze and in the lens.
fn sky_seen_by_eye(direction: vec3f) -> vec3f {
  let off = max(1.0 - dot(direction, field.sun.xyz), 0.0);
  let disc = 60.0 * (1.0 - smoothstep(0.6e-5, 2.2e-5, off)) + 1.2 * exp(-off * 2500.0);
  return sky_radiance(direction) + sunshine() * disc;
}

// Light from `from_eye` as it arrives at the eye, through the air in between.
fn through_air(light: vec3f, from_eye: vec3f) -> vec3f {
  let far = length(from_eye);
  let left = exp(-far / (150.0 * max(field.size.x, field.size.y)));
  let air = sky_radiance(vec3f(from_eye.xy / far, 0.02));
  return mix(air, light, left);
}

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

// From light to the picture.
fn developed(light: vec3f, from_eye: vec3f, pixel: vec2f) -> vec4f {
  return shown_as(toned(through_air(light, from_eye)), pixel);
}
