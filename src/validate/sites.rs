//! Checks sites: they lie within the image, no two are closer than r, and no pixel is free if the layer is reported as
//! saturated.

use super::buckets::Buckets;
use super::{Violation, ensure};
use crate::rocks::Sites;

/// Checks the sites of one layer.
///
/// Squared distances are integers, and r² is r·r rounded to f64, as in the disc that is stamped, so *d ≥ r* is decided
/// exactly. A saturated layer must have a site nearer than r to every pixel; any other may have at most N_p sites.
///
/// # Errors
/// Returns the first violation.
pub fn check_sites(sites: &Sites) -> Result<(), Violation> {
    let (width, height) = (sites.width, sites.height);
    let count = sites.pixels.len();
    for (index, &[x, y]) in sites.pixels.iter().enumerate() {
        ensure(u32::from(x) < width && u32::from(y) < height, || {
            format!("site {index} at {x}, {y} lies outside of {width} × {height}")
        })?;
    }
    ensure(count as u64 <= sites.target, || format!("{count} sites, more than N_p {}", sites.target))?;
    check_distances(sites)?;
    if sites.saturated { check_saturated(sites) } else { Ok(()) }
}

fn check_distances(sites: &Sites) -> Result<(), Violation> {
    let buckets = Buckets::new(sites.width, sites.height, &sites.pixels);
    let squared = sites.radius * sites.radius;
    let reach = (sites.radius.ceil() as u32).min(sites.width.max(sites.height));
    for (index, &[x, y]) in sites.pixels.iter().enumerate() {
        let mut closest: Option<(u64, usize)> = None;
        buckets.visit_near(x.into(), y.into(), reach, |other, d2| {
            if other != index && closest.is_none_or(|best| (d2, other) < best) {
                closest = Some((d2, other));
            }
        });
        if let Some((d2, other)) = closest {
            ensure(d2 > 0 && d2 as f64 >= squared, || {
                let there = sites.pixels[other];
                format!(
                    "site {index} at {x}, {y} and site {other} at {there:?}: d² {d2} under r² {squared} (r {})",
                    sites.radius
                )
            })?;
        }
    }
    Ok(())
}

/// Counts the discs over every pixel, row by row, from differences along x.
fn check_saturated(sites: &Sites) -> Result<(), Violation> {
    let (width, height) = (sites.width as usize, sites.height as usize);
    let squared = sites.radius * sites.radius;
    let nearer = |dx: u64, dy: u64| ((dx * dx + dy * dy) as f64) < squared;
    // Half widths of the disc's rows, from the middle outward, px.
    let mut half_widths = Vec::new();
    let mut half = width.max(height) as u64;
    for dy in (0..height as u64).take_while(|&dy| nearer(0, dy)) {
        while half > 0 && !nearer(half, dy) {
            half -= 1;
        }
        half_widths.push(half as usize);
    }
    let stride = width + 1;
    let mut steps = vec![0_i32; stride * height];
    for &[x, y] in &sites.pixels {
        let (x, y) = (usize::from(x), usize::from(y));
        for (dy, &half) in half_widths.iter().enumerate() {
            let (from, to) = (x.saturating_sub(half), (x + half + 1).min(width));
            let rows = [y.checked_sub(dy), (dy > 0).then_some(y + dy).filter(|&row| row < height)];
            for row in rows.into_iter().flatten() {
                steps[row * stride + from] += 1;
                steps[row * stride + to] -= 1;
            }
        }
    }
    for (y, row) in steps.chunks_exact(stride).enumerate() {
        let mut discs = 0;
        for (x, step) in row[..width].iter().enumerate() {
            discs += step;
            ensure(discs > 0, || format!("said to be saturated, yet pixel {x}, {y} is free (r {})", sites.radius))?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sites(radius: f64, target: u64, saturated: bool, pixels: &[[u16; 2]]) -> Sites {
        Sites { width: 10, height: 4, radius, pixels: pixels.to_vec(), target, saturated }
    }

    #[test]
    fn valid_sites_pass() {
        assert_eq!(check_sites(&sites(5.0, 2, false, &[[3, 3], [8, 3]])), Ok(()));
        assert_eq!(check_sites(&sites(7.0, 9, true, &[[6, 3]])), Ok(()));
        assert_eq!(check_sites(&sites(900.0, 9, true, &[[9, 3]])), Ok(()));
        assert_eq!(check_sites(&sites(5.0, 0, false, &[])), Ok(()));
    }

    #[test]
    fn invalid_sites_are_named() {
        let message = |sites: Sites| check_sites(&sites).map_or_else(|v| v.to_string(), |()| String::new());
        assert!(message(sites(5.1, 2, false, &[[3, 3], [8, 3]])).contains("d² 25 under r² 26"));
        assert!(message(sites(1.0, 2, false, &[[3, 3], [3, 3]])).contains("d² 0"));
        assert!(message(sites(5.0, 1, false, &[[3, 3], [8, 3]])).contains("more than N_p 1"));
        assert!(message(sites(5.0, 1, false, &[[10, 3]])).contains("outside"));
        assert!(message(sites(6.0, 9, true, &[[6, 3]])).contains("pixel 0, 0 is free"));
    }
}
