//! Panels cut at an angle to the yarns.

use drape_cloth::{Error, Grain, Lattice};

/// Rectangles at many angles, sizes and offsets of the grid, with a description.
fn rectangles() -> Vec<(String, [f64; 2], Lattice)> {
    let mut rectangles = Vec::new();
    for angle in [-75.0, -10.0, 3.0, 15.0, 30.0, 45.0, 60.0, 89.0, 135.0, 170.0] {
        for size in [[0.2, 0.05], [0.021, 0.1], [0.064, 0.058]] {
            for grid in [[0.0, 0.0], [0.003, 0.001], [0.005, 0.005], [-0.0021, 0.0044]] {
                let grain = Grain::from_degrees(angle);
                let lattice = Lattice::rectangle_at(grain, grid, size, 0.01).expect("a rectangle");
                rectangles.push((format!("{angle}°, {size:?} on {grid:?}"), size, lattice));
            }
        }
    }
    rectangles
}

#[test]
fn a_turned_rectangle_has_its_own_area() {
    for (what, [width, height], lattice) in rectangles() {
        let part = lattice.area() / (width * height);
        assert!((part - 1.0).abs() < 1e-12, "{what}: {part} of it");
    }
}

#[test]
fn its_particles_are_on_the_yarns_and_within_a_cell_of_it() {
    for (what, size, lattice) in rectangles() {
        let [u, v] = lattice.coordinates()[0];
        for place in lattice.coordinates() {
            let rows = [(place[0] - u) / 0.01, (place[1] - v) / 0.01];
            assert!(rows.iter().all(|row| (row - row.round()).abs() < 1e-9), "{what}: {rows:?}");
        }
        for place in lattice.panel_coordinates() {
            let beyond = [0, 1].map(|axis| (-place[axis]).max(place[axis] - size[axis]));
            let farthest = beyond[0].max(beyond[1]);
            assert!(farthest < 0.01 * 2.0_f64.sqrt(), "{what}: {place:?}");
        }
    }
}

#[test]
fn it_hangs_together_and_no_particle_is_without_area() {
    for (what, _, lattice) in rectangles() {
        let mut areas = vec![0.0; lattice.coordinates().len()];
        let mut piece: Vec<usize> = (0..areas.len()).collect();
        for cell in lattice.cells() {
            for (corner, quadrant) in cell.corners.iter().zip(cell.quadrants) {
                areas[*corner as usize] += quadrant;
            }
        }
        // Cells that share a side are of one piece: sides are joined until nothing changes.
        let mut changed = true;
        while changed {
            changed = false;
            for cell in lattice.cells() {
                let corners = cell.corners.map(|corner| corner as usize);
                let least = corners.iter().map(|corner| piece[*corner]).min().expect("four");
                for corner in corners {
                    changed |= piece[corner] != least;
                    piece[corner] = least;
                }
            }
        }
        assert!(piece.iter().all(|number| *number == 0), "{what}: {piece:?}");
        let least = areas.iter().fold(f64::INFINITY, |least, area| least.min(*area)) / 1e-4;
        assert!(least > 0.004, "{what}: {least} of a cell");
    }
}

#[test]
fn a_quarter_of_a_circle_exchanges_the_sides() {
    let lattice = |angle, size| {
        Lattice::rectangle_at(Grain::from_degrees(angle), [0.0; 2], size, 0.01).expect("a panel")
    };
    let (straight, turned) = (lattice(0.0, [0.2, 0.05]), lattice(90.0, [0.05, 0.2]));
    assert_eq!(turned.spacing(), straight.spacing());
    assert_eq!(turned.cells(), straight.cells());
    // The lower left corner of the one is the lower right of the other.
    for (place, [x, y]) in turned.panel_coordinates().iter().zip(straight.panel_coordinates()) {
        assert!((place[0] - (0.05 - y)).hypot(place[1] - x) < 1e-15, "{place:?} {x} {y}");
    }
    assert_eq!(straight, Lattice::rectangle(0.2, 0.05, 0.01).expect("a panel"));
}

#[test]
fn depths_count_from_the_sides() {
    for angle in [0.0, 20.0, 90.0] {
        let grain = Grain::from_degrees(angle);
        let lattice = Lattice::rectangle_at(grain, [0.0; 2], [0.1, 0.2], 0.01).expect("a panel");
        let sides = [(0, -1.0), (0, 1.0), (1, -1.0), (1, 1.0)];
        let depths = sides.map(|(axis, end)| lattice.depths(axis, end));
        for (k, [x, y]) in lattice.panel_coordinates().into_iter().enumerate() {
            let expected = [x, 0.1 - x, y, 0.2 - y].map(|depth| depth / 0.01);
            for (found, expected) in depths.iter().zip(expected) {
                assert!((found[k] - expected).abs() < 1e-9, "{angle}°: {} {expected}", found[k]);
            }
        }
    }
}

#[test]
fn what_is_no_panel_is_refused() {
    let grain = Grain::from_degrees(45.0);
    let cut = |grid, size, spacing| Lattice::rectangle_at(grain, grid, size, spacing);
    assert!(matches!(cut([0.0; 2], [0.1, -0.1], 0.01), Err(Error::Length { .. })));
    assert!(matches!(cut([f64::NAN, 0.0], [0.1, 0.1], 0.01), Err(Error::Length { .. })));
    assert!(matches!(cut([0.0; 2], [0.1, 0.01], 0.01), Err(Error::Spacing { .. })));
    assert!(matches!(cut([0.0; 2], [0.1, 0.1], 1e-5), Err(Error::TooMany { .. })));
}
