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

// Of a surface: what the camera makes of its light.
fn developed(light: vec3f, from_eye: vec3f, pixel: vec2f) -> vec4f {
  return taken(through_air(light, from_eye), pixel);
}
