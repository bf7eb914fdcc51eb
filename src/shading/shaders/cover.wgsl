// Prepended to the passes in natural colours: what lies on the ground and on the rocks.

// What lies between the stones: `soil_albedo` of this ground, to be set first of all. What is the same everywhere is found at vertices.
var<private> bare_soil: vec3f;

// What `ground_cover` found.
var<private> cover_albedo: vec3f;
// Slope of the relief along x and y
var<private> cover_slope: vec2f;
// 0 deep between the stones, 1 in the open
var<private> cover_open: f32;
// Height of the highest stone so far, and of the highest whose shadow falls here, px
var<private> cover_top: f32;
var<private> cover_shade: f32;
// 1 on a leaf
var<private> cover_leaf: f32;

// Linear; between the stones.
fn soil_albedo(ground: f32) -> vec3f {
  let c = select(vec3f(0.115, 0.092, 0.069), vec3f(0.4, 0.335, 0.245), ground == 1.0);
  let mixed = select(c, vec3f(0.19, 0.174, 0.148), ground == 2.0);
  let debris = globals.scene.w;
  let share = select(select(0.12, 0.0, ground == 1.0), 0.85, ground == 2.0);
  return mix(mixed, 0.8 * kind_albedo(debris), select(share, 0.0, debris < 0.5));
}

// Of the highest stone: three random numbers and its height as a share of the most it has, how far it covers the ground, slope along x and y,
// and 1 if it is coloured as river stones, 0 as the ground.
var<private> highest: vec4f;
var<private> highest_covers: f32;
var<private> highest_slope: vec2f;
var<private> highest_own: f32;

// Stones of about half a `period`, one per cell of a jittered grid, turned by `axis` so that no two sizes' grids agree: halves of
// ellipsoids that rise out of the ground. `lean` how far a ray to the eye moves for each px that it rises, `here` the share of cells
// that have a stone, `own` 1: coloured as river stones, 0: as the ground. Which stone is the highest is kept, and `stones_laid` has it seen.
fn scatter(at: vec2f, lean: vec2f, period: f32, axis: vec2f, here: f32, own: f32, footprint: f32) {
  let seen = shown(period * 0.75, footprint);
  if seen <= 0.0 {
    return;
  }
  let aside = vec2f(-axis.y, axis.x);
  let q = vec2f(dot(at, axis), dot(at, aside)) / period;
  var ray = vec2f(0.0);
  if quality > 0.0 {
    ray = vec2f(dot(lean, axis), dot(lean, aside));
  }
  let sun = field.sun.xy / max(field.sun.z, 0.6);
  let beam = vec2f(dot(sun, axis), dot(sun, aside));
  // A large stone may reach into the next cells; a small one, or any at less than high quality, stays within its own and throws no shadow.
  let is_large = quality > 1.5 && period > 5.0;
  // A stone hides what is behind it: those that are met stand nearer to the eye.
  let base = vec2i(floor(q + 0.1 * ray - select(0.0, 0.5, is_large)));
  let least = select(3.2, 2.8, is_large);
  let cells = select(1, 4, is_large);
  // Of the stone that the ray meets first: how high it meets it, in periods, where from its middle, and what it is like.
  var met = 0.0;
  var found = vec4f(0.0);
  var found_at = vec2f(0.0);
  var found_form = vec4f(1.0);
  var rim = 0.0;
  var shade = 0.0;
  for (var i = 0; i < cells; i++) {
    let cell = base + vec2i(i & 1, i >> 1u);
    let r = numbers_of(cell, i32(period * 64.0));
    if fract(13.0 * r.x + 7.0 * r.w) >= here {
      continue;
    }
    let away = q - (vec2f(cell) + 0.31 + 0.38 * r.xy);
    // What makes a ball of it: in the middle one over its half axis, less along one direction and more across it, and still more upwards.
    let size = least - 1.2 * r.y;
    let form = size * vec4f(0.5 * r.zw - 0.25, 1.12, 1.3 + 0.9 * r.x);
    let local = formed(form, away);
    let rising = vec3f(formed(form, ray), form.w);
    let a = dot(rising, rising);
    let b = dot(local, rising.xy);
    // Where the ray comes nearest to its middle; there its outline is bent a little off an ellipse.
    let nearest = local - (b / a) * rising.xy;
    let bend = select(0.3, 0.0, quality < 0.5) * form.x * nearest.x * (nearest.x * nearest.x - 3.0 * nearest.y * nearest.y);
    let outside = dot(local, local) - 1.0;
    let inside = b * b - (outside + bend) * a;
    let high = (sqrt(max(inside, 0.0)) - b) / a;
    if inside > 0.0 && high > met && dot(nearest, nearest) < 2.0 {
      met = high;
      found = r;
      found_at = local + high * rising.xy;
      found_form = form;
      rim = inside / a;
    }
    // Where its shadow falls, in the same way.
    if is_large {
      let falling = vec3f(formed(form, beam), form.w);
      let c = dot(falling, falling);
      let d = dot(local, falling.xy);
      let umbra = clamp(1.6 * (d * d / c - outside), 0.0, 1.0) * clamp(-4.0 * d / c, 0.0, 1.0);
      shade = max(shade, umbra);
    }
  }
  // About half as high as stones are.
  cover_shade = max(cover_shade, period * 0.13 * shade * seen);
  // What is too small to be told apart goes into the ground.
  let top = period * met * seen;
  if top <= cover_top {
    return;
  }
  cover_top = top;
  let height = met * found_form.w;
  let slope = formed(found_form, found_at) / -(max(height, 0.4) * found_form.w);
  highest = vec4f(fract(found.zxy * 13.0 + found.wzx * 5.0), height);
  highest_slope = slope.x * axis + slope.y * aside;
  highest_own = own;
  // Half of what is left to its outline, in pixels.
  highest_covers = seen * clamp(0.5 * rim * period / (found_form.z * footprint), 0.0, 1.0);
}

// A vector on the ground as a stone of this form has it: drawn out along two directions that are square to each other.
fn formed(form: vec4f, vector: vec2f) -> vec2f {
  return form.z * vector + vec2f(form.x * vector.x + form.y * vector.y, form.y * vector.x - form.x * vector.y);
}

// Lays the highest of the stones that `scatter` found on the ground.
fn stones_laid() {
  if cover_top <= 0.0 {
    return;
  }
  let own = highest.xyz;
  var stone = individual(debris_albedo(fract(own.x * 3.7 + own.y)), own);
  // All of gravel is coloured as river stones.
  if ground_kind != 2.0 {
    stone = mix(bare_soil * (0.75 + 0.6 * own.x), stone, highest_own);
  }
  cover_slope = mix(cover_slope, highest_slope, highest_covers);
  cover_albedo = mix(cover_albedo, stone, highest_covers);
  cover_open = mix(cover_open, 0.45 + 0.55 * smoothstep(0.0, 0.6, highest.w), highest_covers);
}

// What light finds on the ground, between stones and under snow.
fn ground_albedo() -> vec3f {
  return select(bare_soil, mix(bare_soil, SNOW, min(2.0 * globals.waters.x, 0.9)), has_snow);
}

// A point as the log has it: x along its axis from its middle, y across and z up from the axis, px.
fn about_log(at: vec3f) -> vec3f {
  let from_middle = at.x - field.log.x;
  let t = from_middle / max(field.log.y, 1.0);
  let b = field.bow;
  let aside = at.y - (b.x + t * (b.y + t * (b.z + t * b.w)));
  let steep = (b.y + t * (2.0 * b.z + 3.0 * t * b.w)) / max(field.log.y, 1.0);
  let lean = inverseSqrt(1.0 + steep * steep);
  return vec3f(from_middle + aside * steep * lean * lean, aside * lean, at.z - field.log.w);
}

// Dead leaves and bits of bark of about `period`, as `scatter` lays stones.
fn litter(at: vec2f, period: f32, axis: vec2f, here: f32, footprint: f32) {
  let seen = shown(period * 0.5, footprint);
  if seen <= 0.0 {
    return;
  }
  let q = vec2f(dot(at, axis), dot(at, vec2f(-axis.y, axis.x))) / period;
  let base = vec2i(floor(q - 0.5));
  for (var i = 0; i < 4; i++) {
    let cell = base + vec2i(i & 1, i >> 1u);
    let r = numbers_of(cell, i32(period * 64.0) + 7);
    let s = numbers_of(cell.yx + 7, i32(period * 64.0) + 20);
    let turn = normalize(r.zw - 0.5013);
    let away = q - (vec2f(cell) + 0.27 + 0.46 * r.xy);
    let long = dot(away, turn) / (0.34 + 0.2 * s.x);
    // Bent along its rib.
    let wide = dot(away, vec2f(-turn.y, turn.x)) + (s.z - 0.5) * 0.12 * long * long;
    let half = (0.1 + 0.13 * s.w) * (1.0 - long * long) * (1.0 + 0.35 * long);
    let inside = 1.0 - abs(wide) / max(half, 0.001);
    let high = 0.5 + 1.9 * fract(7.0 * s.x + s.z);
    if s.y < here && abs(long) < 1.0 {
      if abs(wide) < half + 0.05 {
        cover_shade = max(cover_shade, (high + 0.25) * seen);
      }
      if inside > 0.0 && high > cover_top {
        cover_top = high;
        let rib = smoothstep(0.1, 0.0, abs(wide)) * 0.35 + 0.12 * sin(24.0 * (long + 1.5 * abs(wide)));
        let hue = mix(vec3f(0.19, 0.13, 0.075), mix(vec3f(0.125, 0.06, 0.033), vec3f(0.07, 0.05, 0.038), s.w), fract(5.0 * r.x + s.z));
        cover_albedo = mix(cover_albedo, hue * (0.8 + 0.5 * s.x) * (1.0 + rib * seen), seen);
        // Its edges curl up.
        let curl = (0.9 * (s.z - 0.3) * wide / max(half, 0.02)) * vec2f(-turn.y, turn.x) + 0.5 * (r.y - 0.5) * long * turn;
        cover_slope = mix(cover_slope, curl.x * axis + curl.y * vec2f(-axis.y, axis.x), seen);
        cover_open = mix(cover_open, 0.9, seen);
        cover_leaf = max(cover_leaf, seen);
      }
    }
  }
}

// The ground where a ray meets z = 0, and what lies there. `lean` as in `scatter`.
fn ground_cover(at: vec2f, lean: vec2f, footprint: f32) {
  let widest = noises2(at / 71.0);
  var patches = widest.x;
  if quality > 0.0 {
    patches += 0.5 * noise2(at / 23.0);
  }
  cover_top = 0.0;
  cover_shade = 0.0;
  cover_leaf = 0.0;
  cover_slope = vec2f(0.0);
  cover_open = 0.8;
  let warm = 0.05 * widest.y;
  let hue = vec3f(1.0 + warm, 1.0, 1.0 - warm);
  cover_albedo = bare_soil * hue * (1.0 + 0.2 * patches);
  if ground_kind == 1.0 {
    // Wind ripples, and now and then a pebble.
    const ACROSS = vec2f(0.4, 0.29);
    let phase = dot(at, ACROSS) + 3.0 * widest.z + 1.5 * noise2(at / 15.0);
    let strength = (0.5 + 0.5 * widest.w) * shown(12.0, footprint);
    cover_albedo *= 1.0 + 0.05 * sin(phase) * strength;
    cover_slope += ACROSS * 0.24 * cos(phase) * strength;
    cover_open = 1.0;
    scatter(at, lean, 1.3, vec2f(-0.5583, -0.8296), 0.1 + 0.1 * patches, 0.3, footprint);
    scatter(at, lean, 3.7, vec2f(-0.8982, -0.4397), 0.03 + 0.05 * patches, 0.8, footprint);
  } else if ground_kind == 2.0 {
    // What is between stones is darker than they are; where they are too small to be told apart it is both.
    cover_albedo *= mix(select(0.95, 0.82, globals.scene.w < 0.5), 0.6, shown(3.0, footprint));
    // The large ones at every level: they are what goes on beyond the field's border.
    if quality > 0.0 {
      scatter(at, lean, 1.6, vec2f(0.3594, -0.9332), 0.95, 1.0, footprint);
      scatter(at, lean, 2.4, vec2f(-0.5530, 0.8331), 0.85 + 0.2 * patches, 1.0, footprint);
    }
    scatter(at, lean, 4.4, vec2f(0.6109, 0.7917), 0.85 + 0.25 * patches, 1.0, footprint);
    scatter(at, lean, 8.0, vec2f(-0.4791, 0.8778), 0.58 + 0.3 * patches, 1.0, footprint);
  } else {
    cover_albedo *= mix(1.0, 0.8, shown(1.2, footprint));
    if quality > 0.0 {
      scatter(at, lean, 1.2, vec2f(-0.7395, -0.6731), 0.8, 0.0, footprint);
    }
    scatter(at, lean, 2.2, vec2f(0.9721, 0.2346), 0.6 + 0.3 * patches, 0.3, footprint);
    scatter(at, lean, 3.6, vec2f(0.8646, -0.5024), 0.35 + 0.3 * patches, 0.6, footprint);
    if quality > 0.0 {
      scatter(at, lean, 6.9, vec2f(0.8078, 0.5895), 0.15, 1.0, footprint);
    }
  }
  stones_laid();
  if has_log {
    // What falls from a log, and what it stops, thickest along its foot.
    let from_log = about_log(vec3f(at, 0.0));
    let away = length(max(abs(from_log.xy) - vec2f(field.log.y, 0.45 * field.log.z), vec2f(0.0)));
    let near = exp(-away / (0.8 * field.log.z));
    let here = 0.7 * near + 0.16 * exp(-away / (6.0 * field.log.z)) + 0.1 * patches * near;
    cover_albedo *= mix(vec3f(1.0), vec3f(0.66, 0.6, 0.54), near);
    if quality > 0.0 {
      litter(at, 2.1, vec2f(0.4384, 0.8988), here, footprint);
    }
    litter(at, 4.3, vec2f(-0.9165, 0.4), 0.8 * here, footprint);
    litter(at, 7.4, vec2f(0.2198, -0.9755), 0.8 * here, footprint);
  }
  var top = vec3f(at, 0.0);
  if quality > 0.0 {
    top += vec3f(lean, 1.0) * cover_top;
  }
  grain_ground(top, footprint);
}

// Grain upon grain on stones and between them, down to the pixel.
fn grain_ground(at: vec3f, footprint: f32) {
  let is_stone = smoothstep(0.0, 0.3, cover_top) * (1.0 - cover_leaf);
  var period = 2.1;
  var q = TURN * at / period;
  var value = 0.0;
  var slope = vec3f(0.0);
  let octaves = select(select(4, 2, quality < 1.5), 1, quality < 0.5);
  for (var i = 0; i < octaves; i++) {
    let seen = shown(period, footprint);
    if seen <= 0.0 {
      break;
    }
    let fine = noise3(q) * seen;
    value += fine.w;
    slope += fine.xyz;
    period /= 3.1;
    q = q * 3.1 + 3.7;
  }
  // Sand lies smooth.
  let loose = select(vec2f(0.42, 0.26), vec2f(0.24, 0.09), ground_kind == 1.0);
  let strength = mix(loose, vec2f(0.36, 0.16), is_stone);
  cover_albedo *= max(1.0 + strength.x * value, 0.2);
  if quality > 0.0 {
    cover_slope += strength.y * (slope * TURN).xy;
  }
}

// How high water stands above the ground, px.
fn water_level() -> f32 {
  return globals.waters.y * field.size.z;
}

// How wet it is, 0…1: in patches that grow together, and what water reaches.
fn wet_cover(at: vec3f) -> f32 {
  var wet = 0.0;
  if is_wet {
    let wetness = globals.weather.y;
    wet = wetness * smoothstep(-0.5, 0.4, noise2(at.xy / 37.0) + wetness);
  }
  if has_water {
    let above = at.z - water_level();
    wet = max(wet, 0.8 * (1.0 - smoothstep(0.6, 2.2, above + 0.8 * noise2(at.xy / 9.0))));
  }
  return wet;
}

// What `moss_cover` found: noise whose patches are some px wide.
var<private> moss_patch: vec4f;

// How thick moss lies, 0…1: in patches of the world, more where it is low and faces up. `places` from `mossy`, `upward` 0…1, `height` px.
fn moss_cover(at: vec3f, places: f32, upward: f32, height: f32, sheltered: f32, footprint: f32) -> f32 {
  if !has_moss {
    return 0.0;
  }
  let moss = globals.weather.z;
  let q = TURN * at;
  var patches = places;
  if quality > 0.0 {
    moss_patch = noise3(q / 9.0);
    patches += 0.6 * moss_patch.w + 0.55 * noise3(q / 2.6).w * shown(2.6, footprint);
  }
  // Over small stones it lies as over the ground.
  let facing = mix(1.0, upward, smoothstep(0.0, 3.0, height));
  let want = patches + 0.4 * (facing - 0.7) + 0.6 * sheltered - 0.012 * height - 0.3 * (1.0 - smoothstep(1.5, 5.0, height));
  // Half the moss covers about a third.
  return smoothstep(0.0, 0.3, want - mix(1.2, -0.8, moss)) * smoothstep(0.1, 0.5, facing);
}

const SNOW = vec3f(0.73, 0.75, 0.775);

// What `snow_cover` found: its colour, the slope of the drifts, and how far snow is heaped against a surface rather than held by it, 0…1.
var<private> snow_albedo: vec3f;
var<private> snow_slope: vec3f;
var<private> snow_heap: f32;

// How much of a surface is under snow, 0…1: what has fallen on it, unless it is so steep that snow slides off, and what it stands in.
fn snow_cover(at: vec3f, upward: f32, footprint: f32) -> f32 {
  if !has_snow {
    return 0.0;
  }
  let q = TURN * at;
  let drift = noise3(q / 47.0);
  // The wind draws it out.
  const WIND = vec3f(0.5, 1.2, 1.0);
  let lump = noise3(TURN * (at * WIND) / 9.0 + 3.0);
  var loose = 0.6 * lump.w + 0.4 * drift.w;
  snow_slope = (0.3 * drift.xyz) * TURN + (0.2 * lump.xyz) * TURN * WIND;
  var period = 2.9;
  for (var i = 0; i < 4; i++) {
    let seen = shown(period, footprint);
    if seen <= 0.0 || quality < 0.5 {
      break;
    }
    let fine = noise3(q / period) * seen;
    loose += 0.3 * fine.w;
    snow_slope += (0.1 * fine.xyz) * TURN;
    period /= 3.1;
  }
  // Blue in its hollows; some crystals, as large as a pixel or two, flash.
  let crystal = point_of(vec3i(floor(q / exp2(ceil(log2(footprint))))));
  snow_albedo = SNOW + vec3f(0.3, 0.27, 0.22) * loose + 0.7 * smoothstep(0.985, 1.0, crystal.x) * shown(1.5, footprint);
  let held = smoothstep(-0.1, 0.08, upward + 0.22 * loose - mix(1.05, 0.7, sqrt(globals.waters.x)));
  // Rocks stand in it already.
  snow_heap = smoothstep(-0.4, 0.5, 6.0 * globals.waters.x * (1.0 + 2.2 * drift.w + 0.6 * lump.w) - field.sunshine.w * globals.scene.z + 0.5 * loose - at.z);
  return max(held, snow_heap);
}

// What `moss_coat` found.
var<private> moss_albedo: vec3f;
// Slope of its cushions and stems; px per px
var<private> moss_slope: vec3f;
// How high it stands here among the rest, about -1…1
var<private> moss_high: f32;

// Olive to yellow-green; cushions of stems, dark between their tips. To be called after `moss_cover`.
fn moss_coat(at: vec3f, footprint: f32) {
  if quality < 0.5 {
    moss_albedo = vec3f(0.084, 0.083, 0.028);
    moss_slope = vec3f(0.0);
    moss_high = 0.0;
    return;
  }
  let q = TURN * at;
  let lump = noise3(q / 4.7 + 9.2);
  let broad = moss_patch;
  var high = 0.5 * lump.w;
  var slope = 0.3 * lump.xyz;
  // Stems are drawn out upwards.
  const STEMS = vec3f(1.0, 1.0, 0.7);
  var period = 1.9;
  var p = TURN * (at * STEMS) / period;
  let octaves = select(2, 3, quality > 1.5);
  for (var i = 0; i < octaves; i++) {
    let seen = shown(period, footprint);
    if seen <= 0.0 {
      break;
    }
    let tips = noise3(p) * seen;
    high += 0.5 * tips.w;
    slope += 0.7 * tips.xyz;
    period /= 2.7;
    p = p * 2.7 + 4.3;
  }
  let hue = 0.5 + 0.8 * broad.w + 0.15 * broad.x;
  moss_albedo = mix(vec3f(0.05, 0.058, 0.019), vec3f(0.105, 0.102, 0.034), clamp(hue, 0.0, 1.0)) * max(1.0 + 1.1 * high + 0.5 * broad.w, 0.25);
  moss_slope = slope * TURN;
  moss_high = high;
}
