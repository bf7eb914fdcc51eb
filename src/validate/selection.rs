//! Checks selections: no pixel is owned twice over all layers, and each layer ends where its threshold or its cells
//! end.

use super::{Violation, ensure};
use crate::params::Border;
use crate::rocks::FieldLayer;

/// Checks the selection of all layers, given the owner of every pixel in each of them ([`super::check_ownership`]).
///
/// Layers are taken in descending order of their mean cell area, equal ones in input order. A layer that reached its
/// threshold must overshoot it by less than one cell. A layer that did not must have no unselected cell left whose
/// pixels are all free, except for border cells if they are dropped.
///
/// # Errors
/// Returns the first violation.
pub fn check_selection(border: Border, layers: &[FieldLayer], owners: &[Vec<u32>]) -> Result<(), Violation> {
    let mut order: Vec<usize> = (0..layers.len()).collect();
    // The mean area is W·H / n, so the fewer cells there are, the larger they are.
    order.sort_by_key(|&k| layers[k].sites.pixels.len());
    let pixels = layers.first().map_or(0, |layer| layer.sites.width as usize * layer.sites.height as usize);
    let mut taken = vec![false; pixels];
    for k in order {
        check_layer(border, &layers[k], &owners[k], &mut taken)
            .map_err(|violation| violation.within(format_args!("layer {k} (id {})", layers[k].layer.id)))?;
    }
    let covered = taken.iter().filter(|&&pixel| pixel).count() as u64;
    let counted: u64 = layers.iter().map(|layer| layer.selection.pixels).sum();
    ensure(covered == counted, || format!("{covered} pixels are covered, the layers count {counted}"))
}

fn check_layer(border: Border, layer: &FieldLayer, owners: &[u32], taken: &mut [bool]) -> Result<(), Violation> {
    let (cells, selection) = (&layer.cells, &layer.selection);
    let count = cells.len();
    let mut is_selected = vec![false; count];
    for &site in &selection.selected {
        let flag = is_selected.get_mut(site as usize);
        ensure(flag.as_deref() == Some(&false), || format!("cell {site} of {count} is selected twice, or is none"))?;
        is_selected[site as usize] = true;
        ensure(border == Border::Clip || !cells.touches_border(site as usize), || {
            format!("cell {site} touches the border and was to be dropped")
        })?;
    }

    let mut pixels = vec![0_u64; count];
    let mut is_free = vec![true; count];
    for (place, (&owner, taken)) in owners.iter().zip(taken).enumerate() {
        let owner = owner as usize;
        pixels[owner] += 1;
        if *taken {
            is_free[owner] = false;
            ensure(!is_selected[owner], || {
                let width = layer.sites.width as usize;
                format!("pixel {}, {} of selected cell {owner} is taken already", place % width, place / width)
            })?;
        }
        *taken |= is_selected[owner];
    }

    let size = |&site: &u32| pixels[site as usize];
    let sum: u64 = selection.selected.iter().map(size).sum();
    ensure(sum == selection.pixels, || format!("the selected cells own {sum} pixels, not {}", selection.pixels))?;
    let area = f64::from(layer.sites.width) * f64::from(layer.sites.height);
    let reached_by = |cells: usize, pixels: u64| match layer.layer.cell_count {
        Some(wanted) => cells as u64 >= u64::from(wanted),
        None => pixels as f64 >= layer.layer.area_fraction * area,
    };
    let cells_taken = selection.selected.len();
    let reached = reached_by(cells_taken, sum);
    let state = || {
        let Some(wanted) = layer.layer.cell_count else {
            return format!("{sum} pixels of {} in {cells_taken} cells", layer.layer.area_fraction * area);
        };
        format!("{cells_taken} cells of {wanted}")
    };
    ensure(selection.saturated != reached, || format!("saturated is {}: {}", selection.saturated, state()))?;
    if let (true, Some(last)) = (reached, selection.selected.last()) {
        ensure(!reached_by(cells_taken - 1, sum - size(last)), || {
            format!("the last cell, of {} pixels, was one too many: {}", size(last), state())
        })?;
    }
    for i in (0..count).filter(|&i| !reached && is_free[i] && !is_selected[i]) {
        ensure(border == Border::Drop && cells.touches_border(i), || {
            format!("all {} pixels of cell {i} are free, and it was not selected: {}", pixels[i], state())
        })?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::params::Params;
    use crate::rocks::{Field, generate};
    use crate::validate::check_ownership;

    fn check(params: &Params, field: &Field) -> Result<(), Violation> {
        let owners: Result<Vec<_>, _> =
            field.layers.iter().map(|layer| check_ownership(&layer.sites, &layer.cells)).collect();
        check_selection(params.border, &field.layers, &owners?)
    }

    #[test]
    fn a_tampered_selection_is_found_out() {
        let params = Params { image_width: 300, image_height: 260, ..Params::default() };
        let field = generate(&params).unwrap_or_default();
        assert_eq!(check(&params, &field), Ok(()));
        let with = |k: usize, change: &dyn Fn(&mut FieldLayer)| {
            let mut field = field.clone();
            change(&mut field.layers[k]);
            check(&params, &field).map_or_else(|violation| violation.to_string(), |()| String::new())
        };
        let pixels = |k: usize, change: i64| {
            with(k, &|layer| layer.selection.pixels = layer.selection.pixels.wrapping_add_signed(change))
        };
        assert!(pixels(0, 1).contains("pixels, not"));
        assert!(with(1, &|layer| layer.selection.saturated ^= true).contains("saturated is"));
        assert!(with(1, &|layer| layer.layer.area_fraction = 0.1).contains("one too many"));
        assert!(with(2, &|layer| layer.selection.selected.push(u32::MAX)).contains("or is none"));
        let twice = |layer: &mut FieldLayer| layer.selection.selected.extend(layer.selection.selected.first().copied());
        assert!(with(2, &twice).contains("selected twice"));
        // A cell of the finest layer is left out although all its pixels are free …
        let area = f64::from(params.image_width * params.image_height);
        let unowned = |layer: &mut FieldLayer| {
            let site = layer.selection.selected.pop().unwrap_or_default() as usize;
            layer.selection.pixels -= crate::rocks::cell_pixels(&layer.sites, &layer.cells, site).len() as u64;
            assert!((layer.selection.pixels as f64) < layer.layer.area_fraction * area);
        };
        assert!(with(2, &unowned).contains("was not selected"));
        // … and one is selected that lies under a coarser rock.
        let any = |layer: &mut FieldLayer| layer.selection.selected = (0..layer.cells.len() as u32).collect();
        assert!(with(2, &any).contains("is taken already"));
    }
}
