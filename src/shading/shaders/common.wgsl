// Prepended to every pass. World: x right, y up, z up, pixels of the image. Colour maths is linear.

// Group 0, once per frame and view.
// size 288 B, align 16; mirrored by Globals in uniforms.rs
struct Globals {
  // Takes positions relative to the eye: far from the origin an f32 keeps its digits that way.
  clip_from_eye: mat4x4f,
  // xyz the eye; w device pixels per CSS pixel
  eye: vec4f,
  // Ray through the picture at (x, y) in -1…1: forward + x·right + y·up. w: width, height of the whole picture, px.
  ray_right: vec4f,
  ray_up: vec4f,
  // w: 1 in the wireframe view, where fills are dimmed
  ray_forward: vec4f,
  // Plans: xy the middle in px of the image, zw from px to clip space
  plan: vec4f,
  // The part of the picture that is drawn, px: xy its upper left corner, zw its size
  tile: vec4f,
  // Linear; w unused
  backdrop_low: vec4f,
  backdrop_high: vec4f,
  // Linear albedo of the ground under and round the rocks; w: 1 or 2 where black or white stands in for ground and backdrop
  soil: vec4f,
  // Linear; w unused
  dust: vec4f,
  // Natural colours: variation, wetness, moss, dust, 0…1
  weather: vec4f,
  // x how much snow has fallen, 0…1; y how high water stands, as a share of the height of the highest rock
  waters: vec4f,
  // x ground: 0 soil, 1 sand, 2 gravel; y 1 / the number of the sample; z 1 in natural colours; w the kind of the debris, 0: mixed
  scene: vec4f,
  // Wood ears: moisture, variation, translucency, velvet, 0…1
  flesh: vec4f,
}

// Group 1, once per field.
// size 480 B, align 16; mirrored by FieldUniforms in uniforms.rs
struct FieldUniforms {
  // World to the sun's clip space, depth 0…1
  sun_from_world: mat4x4f,
  // xyz towards the sun; w the side of the shadow map in px of the world
  sun: vec4f,
  // xy the height map's corner, zw 1 / its sides, px
  map: vec4f,
  // xy image width and height, z the top of the highest rock, w that of everything, px
  size: vec4f,
  // x width over which the soil fades outside the image, y one texel of the height map in px, z 1 where something goes on
  // below the ground, w the least height that casts a shadow
  ground: vec4f,
  // x the middle of the log's reach along x, y half of it (0: no log), z its radius, w the height of its axis, px
  log: vec4f,
  // y of its axis, px: a polynomial in t, -1…1 from end to end
  bow: vec4f,
  // The sun's light; w how deep the rocks stand in snow, px
  sunshine: vec4f,
  // What the sky lights, by the direction of a surface (sky.rs); w of the first two: the direction of the sun's azimuth, of
  // the next two: cosine and sine of how far the hills are turned
  sky: array<vec4f, 6>,
  // Of a sample of a still, as for the sun above: the light from a point of the sky, and from one of the ground
  sky_from_world: mat4x4f,
  sky_way: vec4f,
  below_from_world: mat4x4f,
  below_way: vec4f,
  // Of the sun's shadow map: xy 1 / its sides, px; z half the width of a half-shadow whose caster is before it by a depth of 1, w of the widest, px
  shadow: vec4f,
  // Of a copy of the field, how far it is moved; w a number of its own, 0 for the field itself
  shift: vec4f,
  // xy how far apart copies are, z how far each row is shifted, px; w 1 where the maps are right for copies
  bricks: vec4f,
}

@group(0) @binding(0) var<uniform> globals: Globals;
@group(1) @binding(0) var<uniform> field: FieldUniforms;

// Set where the surface has no linear-storage format: the hardware encodes then, and we must not.
override target_is_srgb: bool = false;

const SUN_COLOR = vec3f(1.20, 1.12, 0.99);
const SKY_COLOR = vec3f(0.235, 0.275, 0.33);
const BOUNCE_COLOR = vec3f(0.12, 0.10, 0.082);

fn srgb_to_linear(c: vec3f) -> vec3f {
  return select(pow((c + 0.055) / 1.055, vec3f(2.4)), c / 12.92, c <= vec3f(0.04045));
}

fn linear_to_srgb(c: vec3f) -> vec3f {
  return select(1.055 * pow(c, vec3f(1.0 / 2.4)) - 0.055, c * 12.92, c <= vec3f(0.0031308));
}

// Jimenez' interleaved gradient noise, 0…1: a dither without visible structure, across the tiles of a picture.
fn dither(pixel: vec2f) -> f32 {
  return fract(52.9829189 * fract(dot(pixel + globals.tile.xy, vec2f(0.06711056, 0.00583715))));
}

// Where a pixel of the tile is in the whole picture, -1…1.
fn place_of(pixel: vec2f) -> vec2f {
  return vec2f(2.0, -2.0) * (pixel + globals.tile.xy) / vec2f(globals.ray_right.w, globals.ray_up.w) + vec2f(-1.0, 1.0);
}

// What stands in for the ground and the backdrop in pictures whose ground is left out: black, and in another picture white. How
// far the two differ is how much is seen through. Shadows are black in both. Shares of the sun and of the sky that are seen.
fn backing(sun: f32, sky: f32) -> vec4f {
  let most = vec2f(SUN_COLOR.g * max(field.sun.z, 0.0), SKY_COLOR.g);
  let lit = clamp(dot(most, vec2f(sun, sky)) / (most.x + most.y), 0.0, 1.0) * (globals.soil.w - 1.0);
  return vec4f(select(linear_to_srgb(vec3f(lit)), vec3f(lit), target_is_srgb), 1.0);
}

// The only place where a colour is encoded; half a step of dither keeps the backdrop from banding.
fn finish(linear: vec3f, pixel: vec2f) -> vec4f {
  let c = clamp(linear, vec3f(0.0), vec3f(1.0));
  let encoded = linear_to_srgb(c) + (dither(pixel) - 0.5) / 255.0;
  return vec4f(select(encoded, c, target_is_srgb), 1.0);
}

// Like `finish`, of a colour that is encoded already.
fn shown_as(encoded: vec3f, pixel: vec2f) -> vec4f {
  let dithered = clamp(encoded, vec3f(0.0), vec3f(1.0)) + (dither(pixel) - 0.5) / 255.0;
  return vec4f(select(dithered, srgb_to_linear(max(encoded, vec3f(0.0))), target_is_srgb), 1.0);
}

// Of the plane z = 0, at (x, y) of the tile in -1…1: the ray's point on it, divided by how far along the ray it is. Stays
// finite at the horizon and flips beyond it, where the far plane cuts it off. A plane's depth is linear over the picture, so
// three corners do.
fn ground_clip(at: vec2f) -> vec4f {
  let whole = place_of((at * vec2f(0.5, -0.5) + 0.5) * globals.tile.zw);
  let ray = globals.ray_forward.xyz + whole.x * globals.ray_right.xyz + whole.y * globals.ray_up.xyz;
  // Its w is 1.
  let ground = globals.clip_from_eye * vec4f(ray, -ray.z / max(globals.eye.z, 0.01));
  return vec4f(at, ground.z, 1.0);
}

// Natural colours only: what is painted of a rock is three random bytes, then its kind in the lower three bits and in the
// upper five how far it sinks into the ground (sink.rs); and all of them stand in the snow. In every pass that draws rocks alike.
fn settled(position: vec3f, painted: vec4f) -> vec3f {
  let steps = floor((painted.w * 255.0 + 0.5) / 8.0);
  return position + field.shift.xyz - vec3f(0.0, 0.0, (steps / 31.0 * field.size.z + field.sunshine.w) * globals.scene.z);
}

// A normal that is folded to an octahedron, as buffers.rs does it; not of length 1.
fn unfolded(normal: vec2f) -> vec3f {
  let z = 1.0 - abs(normal.x) - abs(normal.y);
  let fold = max(-z, 0.0);
  return vec3f(normal - fold * select(vec2f(-1.0), vec2f(1.0), normal >= vec2f(0.0)), z);
}

fn kind_of(painted: vec4f) -> f32 {
  let byte = floor(painted.w * 255.0 + 0.5);
  return byte - 8.0 * floor(byte / 8.0);
}

// Of a log and of wood ears in the papers' style; see wood.rs for what is painted.
fn wood_color(painted: vec4f) -> vec3f {
  let kind = painted.w * 255.0;
  let wood = mix(vec3f(0.2, 0.16, 0.125), vec3f(0.42, 0.33, 0.23), min(kind, 1.0));
  let flesh = mix(vec3f(0.2, 0.085, 0.06), vec3f(0.27, 0.21, 0.18), smoothstep(1.2, 1.8, kind));
  // A log has no random bytes; of wood ears one in 65536.
  return select(flesh, wood, all(painted.yz == vec2f(0.0)));
}
