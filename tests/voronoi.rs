//! Cells are the dual of spade's Delaunay triangulation, clipped to the image; degenerate sites have a defined diagram.
#![allow(clippy::unwrap_used, reason = "tests")]

mod common;

use common::{Random, field_test, saturated, sites_at};
use glam::DVec2;
use rock_field::rocks::{Cells, Pixel, Sites, voronoi};
use rock_field::validate::{check_cells, check_ownership};
use spade::{DelaunayTriangulation, Point2, Triangulation};

const PX: f64 = 1.0e-6;

const ROUNDS: usize = if cfg!(target_arch = "wasm32") { 30 } else { 300 };

/// The diagram both ways, checked.
fn diagram(sites: &Sites) -> Cells {
    let (local, global) = (voronoi(&saturated(sites)), voronoi(sites));
    assert_eq!(local.starts, global.starts, "{sites:?}");
    assert_eq!(local.vertices, global.vertices, "{sites:?}");
    check_cells(sites, &local).unwrap_or_else(|violation| panic!("{violation}\n{sites:?}"));
    check_ownership(sites, &local).unwrap_or_else(|violation| panic!("{violation}\n{sites:?}"));
    local
}

fn polygons(cells: &Cells) -> Vec<Vec<[f64; 2]>> {
    (0..cells.len()).map(|i| cells.polygon(i).iter().map(|v| v.to_array()).collect()).collect()
}

field_test! {
    fn cells_are_the_dual_of_spades_triangulation() {
        for round in 0..ROUNDS {
            let mut random = Random(round as u64);
            let [width, height] = [(); 2].map(|()| random.log_between(8.0, 400.0) as u32);
            // From a handful to a third of all pixels: the dense ones are full of exact ties.
            let count = random.log_between(1.0, f64::from(width * height) / 3.0) as usize;
            let sites = random_sites(&mut random, width, height, count);
            assert_is_dual(&sites, &diagram(&sites));
        }
    }
}

fn random_sites(random: &mut Random, width: u32, height: u32, count: usize) -> Sites {
    let mut pixels: Vec<Pixel> =
        (0..count).map(|_| [random.below(width as usize) as u16, random.below(height as usize) as u16]).collect();
    pixels.sort_unstable();
    pixels.dedup();
    for last in (1..pixels.len()).rev() {
        pixels.swap(last, random.below(last + 1));
    }
    sites_at(width, height, random.log_between(1.0, 40.0), pixels)
}

fn assert_is_dual(sites: &Sites, cells: &Cells) {
    let mut triangulation: DelaunayTriangulation<Point2<f64>> = DelaunayTriangulation::new();
    for pixel in &sites.pixels {
        let [x, y] = pixel.map(|c| f64::from(c) + 0.5);
        triangulation.insert(Point2::new(x, y)).unwrap();
    }
    let (w, h) = (f64::from(sites.width), f64::from(sites.height));
    let is_inside = |v: DVec2, margin: f64| v.min_element() > margin && v.x < w - margin && v.y < h - margin;
    for vertex in triangulation.vertices() {
        let i = vertex.fix().index();
        let polygon = cells.polygon(i);
        let centres: Vec<DVec2> = vertex
            .out_edges()
            .filter_map(|edge| edge.face().as_inner())
            .map(|face| face.circumcenter())
            .map(|centre| DVec2::new(centre.x, centre.y))
            .collect();
        let is_near = |v: DVec2, others: &[DVec2]| others.iter().any(|other| v.distance(*other) < PX);
        for v in polygon {
            let on_border = v.x == 0.0 || v.x == w || v.y == 0.0 || v.y == h;
            assert!(on_border || is_near(*v, &centres), "cell {i}: {v} is no circumcentre of {centres:?}");
        }
        for centre in centres.iter().filter(|centre| is_inside(**centre, PX)) {
            assert!(is_near(*centre, polygon), "cell {i}: circumcentre {centre} is missing in {polygon:?}");
        }
    }
}

field_test! {
    fn no_site_has_no_cell() {
        let cells = diagram(&sites_at(30, 20, 5.0, Vec::new()));
        assert!(cells.is_empty() && cells.vertices.is_empty());
        assert_eq!(cells.starts, [0]);
    }
}

field_test! {
    fn one_site_owns_the_image() {
        for pixel in [[0, 0], [29, 0], [17, 8], [29, 19]] {
            let cells = diagram(&sites_at(30, 20, 5.0, vec![pixel]));
            assert_eq!(polygons(&cells), [[[0.0, 0.0], [30.0, 0.0], [30.0, 20.0], [0.0, 20.0]]]);
        }
        let cells = diagram(&sites_at(1, 1, 1.0, vec![[0, 0]]));
        assert_eq!(polygons(&cells), [[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]]);
    }
}

field_test! {
    fn two_sites_share_the_image_along_their_bisector() {
        let cells = diagram(&sites_at(30, 20, 5.0, vec![[19, 4], [9, 4]]));
        let left = [[0.0, 0.0], [14.5, 0.0], [14.5, 20.0], [0.0, 20.0]];
        let right = [[14.5, 0.0], [30.0, 0.0], [30.0, 20.0], [14.5, 20.0]];
        assert_eq!(polygons(&cells), [right, left]);
        // The bisector runs through two corners of the image: no vertex is doubled there.
        let cells = diagram(&sites_at(20, 20, 5.0, vec![[4, 9], [9, 4]]));
        assert_eq!(polygons(&cells)[0], [[0.0, 0.0], [20.0, 20.0], [0.0, 20.0]]);
        assert_eq!(polygons(&cells)[1], [[0.0, 0.0], [20.0, 0.0], [20.0, 20.0]]);
    }
}

field_test! {
    fn sites_on_a_line_make_strips() {
        for (width, height) in [(50, 1), (50, 7), (50, 50)] {
            let row: Vec<Pixel> = [3, 47, 10, 11, 30].map(|x| [x, height as u16 / 2]).to_vec();
            let cells = diagram(&sites_at(width, height, 1.0, row.clone()));
            assert!(polygons(&cells).iter().all(|polygon| polygon.len() == 4));
            let column = row.iter().map(|&[x, y]| [y, x]).collect();
            let cells = diagram(&sites_at(height, width, 1.0, column));
            assert!(polygons(&cells).iter().all(|polygon| polygon.len() == 4));
        }
        let diagonal: Vec<Pixel> = (0..40).map(|k| [k, k]).collect();
        diagram(&sites_at(40, 40, 1.0, diagonal));
        diagram(&sites_at(8192, 1, 1.0, vec![[8191, 0], [0, 0], [1, 0]]));
        diagram(&sites_at(1, 8192, 1.0, vec![[0, 0], [0, 8191], [0, 8190]]));
    }
}

field_test! {
    fn a_site_on_every_pixel_makes_squares() {
        for (width, height) in [(1, 1), (1, 9), (9, 1), (20, 13)] {
            let pixels: Vec<Pixel> = (0..height as u16).flat_map(|y| (0..width as u16).map(move |x| [x, y])).collect();
            let cells = diagram(&sites_at(width, height, 1.0, pixels.clone()));
            for ([x, y], polygon) in pixels.into_iter().zip(polygons(&cells)) {
                let [x, y] = [x, y].map(f64::from);
                assert_eq!(polygon, [[x, y], [x + 1.0, y], [x + 1.0, y + 1.0], [x, y + 1.0]]);
            }
        }
    }
}

field_test! {
    fn cocircular_lattices_have_no_doubled_vertices() {
        let lattice = |step: usize, shift: u16| -> Vec<Pixel> {
            (0..60).step_by(step)
                .flat_map(|y| (0..60).step_by(step).map(move |x| [x + (y as usize / step % 2) as u16 * shift, y]))
                .filter(|&[x, _]| x < 60)
                .collect()
        };
        // Squares: four sites around every inner vertex.
        let cells = diagram(&sites_at(60, 60, 6.0, lattice(6, 0)));
        assert!(polygons(&cells).iter().all(|polygon| polygon.len() == 4));
        // Bricks, and a ring of twelve sites around a thirteenth, all on circles about it.
        diagram(&sites_at(60, 60, 6.0, lattice(6, 3)));
        let ring = [[25, 0], [24, 7], [20, 15], [15, 20], [7, 24], [0, 25], [-7, 24], [-25, 0], [-15, -20], [0, -25], [15, -20], [24, -7]];
        let mut pixels: Vec<Pixel> = ring.iter().map(|[x, y]| [(30 + x) as u16, (30 + y) as u16]).collect();
        let cells = diagram(&sites_at(60, 60, 6.0, pixels.clone()));
        let centre = [30.5, 30.5];
        assert!(polygons(&cells).iter().all(|polygon| polygon.iter().filter(|v| **v == centre).count() == 1));
        pixels.push([30, 30]);
        let cells = diagram(&sites_at(60, 60, 6.0, pixels));
        assert_eq!(cells.polygon(12).len(), 12);
    }
}
