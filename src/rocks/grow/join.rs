//! Joins a part of the ground to the outline beside it.

use glam::DVec2;

/// Corners of two outlines nearer than this are the same, px.
const SAME: f64 = 1.0e-6;

/// Corners of an outline nearer than this become one, px.
const NEAR: f64 = 1.0 / 1024.0;

/// A corner that is no farther than this from the line between its neighbours is left out, px.
const STRAIGHT: f64 = 1.0e-6;

/// Adds a part to an outline. Returns the joined outline, and the length of the border that they shared, px; `None` if they do not
/// share exactly one stretch of border, which would leave other ground surrounded.
pub(super) fn join(outline: &[DVec2], part: &[DVec2]) -> Option<(Vec<DVec2>, f64)> {
    let (low, high) = extents(part);
    let (low, high) = (low - SAME, high + SAME);
    let (its_low, its_high) = extents(outline);
    if its_low.cmpgt(high).any() || its_high.cmplt(low).any() {
        return None;
    }
    let mut whole = refined(outline, part, low, high);
    let mut part = refined(part, &whole, low, high);
    simplify(&mut whole, SAME);
    simplify(&mut part, SAME);
    let (count, parts) = (whole.len(), part.len());
    if count < 3 || parts < 3 {
        return None;
    }
    // Corners that are the same get the same place.
    let find = |place: DVec2| (0..count).find(|&k| whole[k].distance_squared(place) < SAME * SAME);
    let places: Vec<Option<usize>> = part.iter().map(|&v| find(v)).collect();
    // An edge of the part is shared if the outline runs along it in the other direction.
    let is_shared = |k: usize| match (places[k], places[(k + 1) % parts]) {
        (Some(from), Some(to)) => (to + 1) % count == from,
        _ => false,
    };
    let starts: Vec<usize> = (0..parts).filter(|&k| is_shared(k) && !is_shared((k + parts - 1) % parts)).collect();
    let [start] = starts[..] else { return None };
    let shared = (0..parts).take_while(|k| is_shared((start + k) % parts)).count();
    let length = (0..shared).map(|k| part[(start + k) % parts].distance(part[(start + k + 1) % parts])).sum();
    // On along the outline from the start of the stretch, and around the rest of the part from its end.
    let (first, last) = (places[start]?, places[(start + shared) % parts]?);
    let mut joined: Vec<DVec2> = Vec::with_capacity(count + parts);
    joined.extend((0..=(last + count - first) % count).map(|k| whole[(first + k) % count]));
    joined.extend((1..parts - shared).map(|k| part[(start + shared + k) % parts]));
    Some((joined, length))
}

/// The lowest and the highest corner of an outline.
pub(super) fn extents(outline: &[DVec2]) -> (DVec2, DVec2) {
    outline.iter().fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), v| (low.min(*v), high.max(*v)))
}

/// An outline with those corners of another that lie on its edges, of all that are in a box.
fn refined(outline: &[DVec2], other: &[DVec2], low: DVec2, high: DVec2) -> Vec<DVec2> {
    let mut refined = Vec::with_capacity(outline.len() + other.len());
    let mut on: Vec<(f64, DVec2)> = Vec::new();
    for (k, &from) in outline.iter().enumerate() {
        refined.push(from);
        let to = outline[(k + 1) % outline.len()];
        if from.min(to).cmpgt(high).any() || from.max(to).cmplt(low).any() {
            continue;
        }
        let along = to - from;
        let length = along.length();
        on.clear();
        for &v in other {
            let (way, beside) = (along.dot(v - from), along.perp_dot(v - from));
            if beside.abs() < SAME * length && way > SAME * length && way < (length - SAME) * length {
                let place = on.iter().take_while(|before| before.0 < way).count();
                on.insert(place, (way, v));
            }
        }
        refined.extend(on.iter().map(|&(_, v)| v));
    }
    refined
}

/// Leaves out of an outline what is no more than rounding: corners near the one before, ways back, and corners on straight lines.
/// Corners on a side of the image lie on it exactly.
pub(super) fn tidy(outline: &mut Vec<DVec2>, image: DVec2) {
    for corner in outline.iter_mut() {
        let far = image - *corner;
        *corner = DVec2::select(far.cmplt(DVec2::splat(SAME)), image, *corner);
        *corner = DVec2::select(corner.cmplt(DVec2::splat(SAME)), DVec2::ZERO, *corner);
    }
    simplify(outline, NEAR);
    let count = outline.len();
    let bent = |k: usize| {
        let [a, b, c] = [outline[(k + count - 1) % count], outline[k], outline[(k + 1) % count]];
        (b - a).perp_dot(c - a).abs() > STRAIGHT * (c - a).length()
    };
    let kept: Vec<DVec2> = (0..count).filter(|&k| bent(k)).map(|k| outline[k]).collect();
    if kept.len() >= 3 {
        *outline = kept;
    }
}

/// Removes from an outline every corner near the one before it, and every way that goes back on itself.
fn simplify(outline: &mut Vec<DVec2>, near: f64) {
    let same = |a: DVec2, b: DVec2| a.distance_squared(b) < near * near;
    let mut kept: Vec<DVec2> = Vec::with_capacity(outline.len());
    for &corner in outline.iter() {
        if kept.last().is_some_and(|&last| same(last, corner)) {
            continue;
        }
        if kept.len() > 1 && same(kept[kept.len() - 2], corner) {
            kept.pop();
            continue;
        }
        kept.push(corner);
    }
    // The end may continue into the start in the same ways.
    let mut from = 0;
    while kept.len() - from > 2 {
        let [last, before] = [kept[kept.len() - 1], kept[kept.len() - 2]];
        if same(last, kept[from]) {
            kept.pop();
        } else if same(before, kept[from]) {
            kept.truncate(kept.len() - 2);
        } else if same(last, kept[from + 1]) {
            kept.pop();
            from += 1;
        } else {
            break;
        }
    }
    outline.clear();
    outline.extend_from_slice(&kept[from..]);
}
