// Backdrop and ground in natural colours. Two triangles over the whole picture: the backdrop at the far plane, then
// z = 0 with its depth, which hides what is below it.

struct Varyings {
  // The depth is that of floor.wgsl, to the last bit.
  @builtin(position) @invariant clip: vec4f,
  // 1 on the ground
  @location(0) is_ground: f32,
  @location(1) from_ground: vec3f,
  @location(2) from_rocks: vec3f,
  // The colours of the ground and of the finest rocks
  @location(3) soil: vec3f,
  @location(4) finest: vec3f,
}

@vertex
fn vs_main(@builtin(vertex_index) index: u32) -> Varyings {
  let i = index % 3u;
  let at = vec2f(f32((i << 1u) & 2u), f32(i & 2u)) * 2.0 - 1.0;
  var out: Varyings;
  bare_soil = soil_albedo(globals.scene.x);
  light_nearby();
  out.from_ground = ground_light;
  if quality < 0.5 {
    out.from_ground = light_all_around(vec3f(0.0, 0.0, 1.0));
  }
  out.from_rocks = rock_light;
  out.soil = bare_soil;
  out.finest = finest_albedo;
  out.is_ground = select(0.0, 1.0, index >= 3u);
  out.clip = select(vec4f(at, 1.0, 1.0), ground_clip(at), index >= 3u);
  return out;
}

// What `rock_afar` or `stones_afar` found: 1 on a rock, where, its normal there, and 0 where a pixel reaches over so many rocks that only their mean
// is shown.
var<private> afar_one: f32 = 1.0;
var<private> afar_rock: f32;
// Its colour
var<private> afar_albedo: vec3f;
var<private> afar_at: vec3f;
var<private> afar_normal: vec3f;

// Rocks that are not drawn, since they would be small, are left in the map of heights: whether the way from `home` on the ground to the
// eye meets one, looked for in a few places. `apart` px lie between points whose heights tell a slope.
fn rock_afar(home: vec3f, to_eye: vec3f, apart: f32, footprint: f32) {
  let steep = max(to_eye.z, 0.08) * inverseSqrt(max(1.0 - to_eye.z * to_eye.z, 1e-4));
  let towards = to_eye.xy * inverseSqrt(max(dot(to_eye.xy, to_eye.xy), 1e-6));
  var at = home;
  for (var i = 4; i >= 0; i--) {
    let share = f32(i) / 4.0;
    // Denser near the ground, where most rocks are.
    let ray = 0.55 * field.size.z * share * share;
    let place = home.xy + towards * (ray / steep);
    let high = height_at(place);
    if high > max(ray, 0.1) {
      at = vec3f(place, high);
      break;
    }
  }
  let slope = vec2f(height_at(at.xy + vec2f(apart, 0.0)), height_at(at.xy + vec2f(0.0, apart))) - at.z;
  // The sides of single rocks and their shadows would glitter along the horizon; those that are not drawn are small ones.
  afar_one = 1.0 - smoothstep(0.1, 0.4, footprint / min(field.size.z, 10.0));
  afar_rock = mix(0.8, select(0.0, 1.0, at.z > 0.0), afar_one);
  afar_at = at;
  // Of what is smaller than a pixel, the sides towards the eye are seen.
  let lean = to_eye.xy * ((1.0 - to_eye.z) * mix(select(0.6, 0.15, has_snow), 0.7, afar_one));
  afar_normal = normalize(vec3f((lean - slope * afar_one / apart) * afar_rock, 1.0));
}

// Where rocks of copies are too small to be drawn, and beyond the copies, rows of stones go on, ring after ring round the field. How much farther out
// each row is than the one before it, as a power of 2, and how many rows a ray passes low enough to meet them.
const ROW = 0.12;
const ROWS = 5;

// What a ray to the eye meets of those rows, which comes from `world` on the ground; `across` px of the world are as wide as a pixel. They are as high as
// the field's own rocks are in some place of it: then they lie as dense. To be called after `rock_afar`, whose mean is between them.
fn stones_afar(world: vec3f, to_eye: vec3f, across: f32) {
  let least = min(field.bricks.x, field.bricks.y);
  let out = length(world.xy - 0.5 * field.size.xy);
  let begun = smoothstep(0.1, 0.2, across / field.size.z) * (1.0 - afar_one);
  if begun <= 0.0 || out < least {
    return;
  }
  let flat = -to_eye.xy * inverseSqrt(max(dot(to_eye.xy, to_eye.xy), 1e-6));
  let from_middle = world.xy - 0.5 * field.size.xy;
  let way = globals.eye.z / max(to_eye.z, 1e-4) * length(to_eye.xy);
  let from_eye = from_middle - flat * way;
  let b = dot(from_eye, flat);
  let c = dot(from_eye, from_eye);
  let row = floor(log2(out / least) / ROW);
  let turn = atan2(from_middle.y, from_middle.x) / 6.2831853 + 0.5;
  let aside = (from_middle.x * flat.y - from_middle.y * flat.x) / (6.2831853 * out);
  // No higher than the rows behind the last one that is looked at.
  let highest = min(1.0, globals.eye.z * (1.0 - exp2(-ROW * f32(ROWS - 1))) / field.size.z);
  let pitch = 1.5 * field.size.z;
  let lateral = vec2f(-from_middle.y, from_middle.x) / out;
  for (var i = 0; i < ROWS; i++) {
    let which = row - f32(i);
    let radius = least * exp2(ROW * which);
    let count = floor(6.2831853 * radius / pitch);
    // Where the ray passes over the row: how much nearer to the eye than the ground that it reaches.
    let nearer = way + b - sqrt(max(b * b - c + radius * radius, 0.0));
    let along = (turn - aside * nearer / radius) * count;
    let cell = floor(along);
    let r = numbers_of(vec2i(vec2f(cell, which)), 91);
    let high = height_at(field.size.xy * (0.15 + 0.7 * r.xy)) * highest;
    let half = min(0.45, (1.3 * high + 0.05 * pitch) / pitch);
    let u = (along - cell - half - (1.0 - 2.0 * half) * r.z) / half;
    let base = globals.eye.z / max(way, 1.0) * (nearer - (exp2(ROW * r.w) - 1.0) * radius);
    let v = base / max(high, 0.01);
    let inside = 1.0 - u * u - v * v;
    let tall = high / across;
    let covers = clamp(0.8 * inside * tall, 0.0, 1.0) * begun * smoothstep(0.3, 1.5, tall) * step(max(water_level(), 0.0), base) * step(0.0, which);
    let ball = vec3f(lateral * (0.9 * u) - flat * sqrt(max(inside, 0.05)), v + 0.15);
    afar_normal = mix(afar_normal, normalize(ball), covers);
    // Its foot is in the shade of others.
    let stone = individual(debris_albedo(r.w), r.zwx) * min(0.5 + 0.7 * v, 1.0);
    afar_albedo = mix(afar_albedo, stone, covers);
    afar_rock = mix(afar_rock, 1.0, covers);
  }
}

// Beyond the field the ground rolls: how light it is.
fn rolling(at: vec2f) -> f32 {
  let side = max(field.size.x, field.size.y);
  let outside = length(max(abs(at - 0.5 * field.size.xy) - 0.5 * field.size.xy, vec2f(0.0))) / side;
  if outside < 0.5 {
    return 1.0;
  }
  let near = noises2(at / (0.6 * side));
  let far = noises2(at / (3.1 * side) + 9.0);
  return 1.0 + smoothstep(0.5, 3.0, outside) * (0.14 * far.x + 0.08 * far.y + 0.1 * near.x);
}

// What `ground_surface` found.
var<private> found_albedo: vec3f;
var<private> found_rough: f32;
// Of the relief; px per px
var<private> found_slope: vec3f;

// What the ground is like, whatever light falls on it; `seen` of the sky.
fn ground_surface(world: vec3f, to_eye: vec3f, seen: f32, footprint: f32) {
  // Seen flatter than this, stones are drawn as from there: no ray passes more than the next ones.
  let lean = to_eye.xy / max(to_eye.z, 0.38);
  ground_cover(world.xy, lean, footprint);
  var albedo = cover_albedo * mix(0.45, 1.0, cover_open);
  var slope = vec3f(cover_slope, 0.0);
  // Between and under the rocks it stays damp and collects what is fine.
  let damp = 1.0 - smoothstep(0.35, 0.95, seen);
  let wet = max(0.35 * damp, wet_cover(world));
  var rough = mix(0.92, 0.4, globals.weather.y * wet);
  var moss = moss_cover(world, mossy(world), 1.0, 0.0, 1.0 - seen, footprint) * (1.0 - cover_leaf);
  if moss > 0.0 {
    moss_coat(world, footprint);
    moss = smoothstep(0.25, 0.45, moss + 0.35 * moss_high);
    albedo = mix(albedo, moss_albedo, moss);
    slope = mix(slope, vec3f(moss_slope.xy, 0.0), moss);
    rough = mix(rough, 0.95, moss);
  }
  albedo *= mix(vec3f(1.0), vec3f(0.45) + 0.35 * albedo, wet);
  // Stones that rise higher than it is deep look out.
  let snow = snow_cover(vec3f(world.xy, cover_top - field.sunshine.w), 0.4, footprint);
  cover_open = mix(cover_open, 1.0, snow);
  if quality > 1.5 || has_log {
    let shaded = smoothstep(0.0, 0.25 * cover_shade + 0.05, cover_shade - cover_top) * (1.0 - 0.7 * moss);
    albedo *= 1.0 - 0.5 * shaded;
  }
  albedo = mix(albedo, snow_albedo, snow);
  // It drifts against what stands there.
  slope = mix(slope, vec3f(snow_slope.xy - 0.35 * open_towards.xy, 0.0), snow);
  rough = mix(rough, 0.9, snow);
  albedo = mix(albedo, mix(afar_albedo, SNOW, 0.85 * snow), afar_rock);
  albedo *= rolling(world.xy);
  found_albedo = albedo;
  found_rough = select(rough, 0.95, water_deep > 0.0);
  found_slope = slope;
}

@fragment
fn fs_main(
  @builtin(position) pixel: vec4f,
  @location(0) is_ground: f32,
  @location(1) from_ground: vec3f,
  @location(2) from_rocks: vec3f,
  @location(3) soil: vec3f,
  @location(4) finest: vec3f,
) -> @location(0) vec4f {
  ground_light = from_ground;
  all_around = from_ground;
  rock_light = from_rocks;
  bare_soil = soil;
  finest_albedo = finest;
  let at = place_of(pixel.xy);
  let ray = globals.ray_forward.xyz + at.x * globals.ray_right.xyz + at.y * globals.ray_up.xyz;
  if is_ground < 0.5 || ray.z > -0.0001 {
    if globals.soil.w > 0.5 {
      return backing(1.0, 1.0);
    }
    let direction = normalize(ray);
    let pixel_angle = 2.0 * length(globals.ray_up.xyz) / globals.ray_up.w;
    return taken(with_hills(sky_seen_by_eye(direction), direction, pixel_angle), pixel.xy);
  }
  let steps = globals.eye.z / -ray.z;
  var world = vec3f(globals.eye.xy + steps * ray.xy, 0.0);
  let to_eye = -ray / length(ray);
  // px of the world under a pixel, nearer to the longer side of what it covers than to the shorter: flat pebbles would break
  // into dashes towards the horizon.
  let across = 2.0 * steps * length(globals.ray_up.xyz) / globals.ray_up.w;
  let footprint = across * pow(max(to_eye.z, 0.02), -0.75);

  // Under water another place of the ground is seen.
  let on_level = world;
  dive(world, to_eye, footprint);
  if water_deep > 0.0 {
    let bent = refract(-to_eye, water_normal, 0.75);
    world = vec3f(water_at.xy - bent.xy * (water_deep / min(bent.z, -0.1)), 0.0);
  }
  let shift = shift_at(world.xy);
  var home = at_home(world, shift);
  var up = vec3f(0.0, 0.0, 1.0);
  if field.bricks.w > 0.5 && (any(shift != vec3f(0.0)) || across > 1.2) {
    rock_afar(home, to_eye, max(0.7 * across, field.ground.y), footprint);
    home = afar_at;
    afar_albedo = finest_albedo * (0.85 + 0.3 * noise2(world.xy / 11.0));
    stones_afar(on_level, to_eye, across);
    up = afar_normal;
    water_deep = select(water_deep, 0.0, afar_one > 0.5 && home.z > water_level());
  }
  let rock = afar_rock;
  let one = afar_one * (1.0 - rock);
  let seen = mix(0.85, sky_seen_by_ground(home.xy), one);
  open_towards *= one;
  // Where only the mean is shown, nothing lies in a shadow of its own.
  home = select(home, vec3f(home.xy + 1e6, home.z), afar_one < 0.5);
  if globals.soil.w > 0.5 {
    return backing(sun_seen(world, up), seen);
  }
  ground_surface(world, to_eye, seen, footprint);
  let open = seen * mix(mix(0.6, 1.0, cover_open), 1.0, rock);
  // In the shadow of so many rocks lies about a quarter of the ground.
  gathered = caustics(world, footprint) * mix(0.75, 1.0, afar_one);
  let normal = bumped(up, found_slope * (1.0 - rock));
  let light = daylight(found_albedo, found_rough, home, up, normal, to_eye, open);

  return developed(through_water(light, to_eye), on_level - globals.eye.xyz, pixel.xy);
}
