// Prepended to the passes in natural colours: what lies on the ground and on the rocks.

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

// Stones of about half a `period`, one per cell of a jittered grid, turned by `axis` so that no two sizes' grids agree: halves of
// ellipsoids that rise out of the ground. `lean` how far a ray to the eye moves for each px that it rises, `here` the share of cells
// that have a stone, `own` 1: coloured as river stones, 0: as the ground.
fn scatter(at: vec2f, lean: vec2f, period: f32, axis: vec2f, here: f32, own: f32, footprint: f32) {
  let seen = shown(period * 0.75, footprint);
  if seen <= 0.0 {
    return;
  }
  let aside = vec2f(-axis.y, axis.x);
  let q = vec2f(dot(at, axis), dot(at, aside)) / period;
  let ray = vec2f(dot(lean, axis), dot(lean, aside));
  let sun = field.sun.xy / max(field.sun.z, 0.6);
  let beam = vec2f(dot(sun, axis), dot(sun, aside));
  // A stone hides what is behind it: those that are met stand nearer to the eye.
  let base = vec2i(floor(q + 0.1 * ray - 0.5));
  // Of the stone that the ray meets first: how high it meets it and how high the stone is, in periods.
  var met = 0.0;
  var summit = 1.0;
  var found = vec4f(0.0);
  var slope = vec2f(0.0);
  var rim = 0.0;
  var shade = 0.0;
  for (var i = 0; i < 4; i++) {
    let cell = base + vec2i(i & 1, i >> 1u);
    let s = numbers_of(cell.yx + 7, i32(period * 64.0) + 13);
    if s.y >= here {
      continue;
    }
    let r = numbers_of(cell, i32(period * 64.0));
    let turn = normalize(r.zw - 0.5013);
    let across = vec2f(-turn.y, turn.x);
    let away = q - (vec2f(cell) + 0.27 + 0.46 * r.xy);
    // One over its half axes: 0.32…0.58, less across, and still less up.
    let scale = (3.1 - 1.38 * s.w) * vec3f(1.0, 1.1 + 0.6 * s.x, 1.3 + 0.9 * s.z);
    let local = vec2f(dot(away, turn), dot(away, across)) * scale.xy;
    let rising = vec3f(vec2f(dot(ray, turn), dot(ray, across)) * scale.xy, scale.z);
    let a = dot(rising, rising);
    let b = dot(local, rising.xy) / a;
    // Where the ray comes nearest to its middle; there its outline is bent a little off an ellipse.
    let nearest = local - b * rising.xy;
    let bend = 0.36 * (s.x - 0.3) * nearest.x * (nearest.x * nearest.x - 3.0 * nearest.y * nearest.y);
    let inside = select(0.0, b * b - (dot(local, local) - 1.0 + bend) / a, dot(nearest, nearest) < 2.0);
    let high = sqrt(max(inside, 0.0)) - b;
    if inside > 0.0 && high > met {
      met = high;
      summit = 1.0 / scale.z;
      found = s;
      rim = inside * a / scale.x;
      let hit = local + high * rising.xy;
      let steep = -1.0 / (max(high * scale.z, 0.4) * scale.z);
      slope = steep * (hit.x * scale.x * turn + hit.y * scale.y * across);
    }
    // Where its shadow falls, in the same way.
    if quality > 0.0 {
      let falling = vec3f(vec2f(dot(beam, turn), dot(beam, across)) * scale.xy, scale.z);
      let c = dot(falling, falling);
      let d = dot(local, falling.xy) / c;
      let under = d * d - (dot(local, local) - 1.0) / c;
      let umbra = clamp(1.6 * under * c, 0.0, 1.0) * clamp(-4.0 * d, 0.0, 1.0);
      shade = max(shade, 0.5 * umbra / scale.z);
    }
  }
  cover_shade = max(cover_shade, period * shade * seen);
  let top = period * met;
  if top <= cover_top {
    return;
  }
  cover_top = top;
  let kind = debris_kind(fract(found.x * 3.7 + found.z));
  let crumb = soil_albedo(globals.scene.x) * (0.75 + 0.6 * found.x);
  // Half of what is left to its outline, in pixels.
  let covered = seen * clamp(0.5 * rim * period / footprint, 0.0, 1.0);
  cover_slope = mix(cover_slope, slope.x * axis + slope.y * aside, covered);
  cover_albedo = mix(cover_albedo, mix(crumb, individual(kind_albedo(kind), found.xzw), own), covered);
  cover_open = mix(cover_open, 0.45 + 0.55 * smoothstep(0.0, 0.6, met / summit), covered);
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
  let patches = widest.x + 0.5 * noise2(at / 23.0);
  cover_top = 0.0;
  cover_shade = 0.0;
  cover_leaf = 0.0;
  cover_slope = vec2f(0.0);
  cover_open = 0.8;
  let warm = 0.05 * widest.y;
  let hue = vec3f(1.0 + warm, 1.0, 1.0 - warm);
  cover_albedo = soil_albedo(ground_kind) * hue * (1.0 + 0.13 * patches);
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
    cover_albedo *= mix(0.82, 0.85, shown(2.0, footprint));
    // The large ones at every level: they are what goes on beyond the field's border.
    if quality > 0.0 {
      scatter(at, lean, 1.7, vec2f(0.3594, -0.9332), 0.95, 1.0, footprint);
    }
    scatter(at, lean, 3.1, vec2f(-0.5530, 0.8331), 0.8 + 0.2 * patches, 1.0, footprint);
    scatter(at, lean, 5.2, vec2f(0.6109, 0.7917), 0.5 + 0.3 * patches, 1.0, footprint);
    scatter(at, lean, 8.3, vec2f(-0.4791, 0.8778), 0.22 + 0.2 * patches, 1.0, footprint);
  } else {
    cover_albedo *= mix(1.0, 0.8, shown(1.2, footprint));
    if quality > 0.0 {
      scatter(at, lean, 1.2, vec2f(-0.7395, -0.6731), 0.8, 0.0, footprint);
    }
    scatter(at, lean, 2.3, vec2f(0.9721, 0.2346), 0.55 + 0.2 * patches, 0.06, footprint);
    scatter(at, lean, 4.6, vec2f(0.8646, -0.5024), 0.2 + 0.15 * patches, 0.5, footprint);
    if quality > 0.0 {
      scatter(at, lean, 7.7, vec2f(0.8078, 0.5895), 0.06, 1.0, footprint);
    }
  }
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
  grain_ground(vec3f(at + lean * cover_top, cover_top), footprint);
}

// Grain upon grain on stones and between them, down to the pixel.
fn grain_ground(at: vec3f, footprint: f32) {
  let is_stone = smoothstep(0.0, 0.3, cover_top) * (1.0 - cover_leaf);
  var period = 2.1;
  var q = TURN * at / period;
  var value = 0.0;
  var slope = vec3f(0.0);
  let octaves = select(4, 1, quality < 0.5);
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
  cover_slope += strength.y * (slope * TURN).xy;
}

// How wet it is, 0…1: in patches that grow together.
fn wet_cover(at: vec2f) -> f32 {
  if !is_wet {
    return 0.0;
  }
  let wetness = globals.weather.y;
  return wetness * smoothstep(-0.5, 0.4, noise2(at / 37.0) + wetness);
}

// How thick moss lies, 0…1: in patches of the world, more where it is low and faces up. `upward` 0…1, `height` px.
fn moss_cover(at: vec3f, upward: f32, height: f32, sheltered: f32, footprint: f32) -> f32 {
  if !has_moss {
    return 0.0;
  }
  let moss = globals.weather.z;
  let q = TURN * at;
  var patches = 2.0 * noise3(q / 83.0 + 31.3).w + 1.1 * noise3(q / 29.0).w;
  if quality > 0.0 {
    patches += 0.6 * noise3(q / 9.0).w + 0.55 * noise3(q / 2.6).w * shown(2.6, footprint);
  }
  let want = patches + 0.4 * (upward - 0.7) + 0.6 * sheltered - 0.012 * height - 0.3 * (1.0 - smoothstep(0.0, 1.5, height));
  // Half the moss covers about a third.
  return smoothstep(0.0, 0.36, want - mix(1.2, -0.8, moss)) * smoothstep(0.1, 0.5, upward);
}

// What `moss_coat` found.
var<private> moss_albedo: vec3f;
// Slope of its cushions and stems; px per px
var<private> moss_slope: vec3f;
// How high it stands here among the rest, about -1…1
var<private> moss_high: f32;

// Olive to yellow-green; cushions of stems, dark between their tips.
fn moss_coat(at: vec3f, footprint: f32) {
  let q = TURN * at;
  let broad = noise3(q / 13.0 + 3.3);
  let lump = noise3(q / 4.7 + 9.2);
  var high = 0.5 * lump.w;
  var slope = 0.3 * lump.xyz;
  if quality > 0.0 {
    // Stems are drawn out upwards.
    const STEMS = vec3f(1.0, 1.0, 0.7);
    var period = 1.9;
    var p = TURN * (at * STEMS) / period;
    for (var i = 0; i < 4; i++) {
      let seen = shown(period, footprint);
      if seen <= 0.0 {
        break;
      }
      let tips = noise3(p) * seen;
      high += 0.5 * tips.w;
      slope += 0.4 * tips.xyz;
      period /= 2.7;
      p = p * 2.7 + 4.3;
    }
  }
  let hue = 0.5 + 0.8 * broad.w + 0.15 * broad.x;
  moss_albedo = mix(vec3f(0.05, 0.058, 0.019), vec3f(0.135, 0.126, 0.042), clamp(hue, 0.0, 1.0)) * max(1.0 + 1.1 * high + 0.5 * broad.w, 0.25);
  moss_slope = slope * TURN;
  moss_high = high;
}
