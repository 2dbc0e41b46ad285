//! Breen's particles: energies that are known, forces and stiffness against differences.

use drape_cloth::{Block, Breen, Cloth, Lattice};
use drape_fabric::{BreenWork, Fabric};
use drape_input::Document;

fn fabric() -> Fabric {
    let text = r#"
        name = "plain weave"
        density = 0.12
        thickness = 0.0003
        shear = { stiffness = 35.0, growth = 4.0, friction = [{ plateau = 0.5, length = 0.004 }] }
        [warp]
        traction.primed = { stiffness = 5000, toe_ratio = 0.7, toe_strain = 0.01, toe_strain_after = 0.015 }
        bending = { rigidity = 1.2e-5, friction = [{ plateau = 6e-4, length = 4 }] }
        [weft]
        traction.primed = { stiffness = 4000, toe_ratio = 0.7, toe_strain = 0.02, toe_strain_after = 0.03 }
        bending = { rigidity = 0.4e-5, friction = [{ plateau = 2e-4, length = 4 }] }
    "#;
    Fabric::from_document(&Document::new("plain.toml", text)).expect("right")
}

fn laws(fabric: &Fabric) -> [BreenWork; 2] {
    [&fabric.warp, &fabric.weft].map(|laws| BreenWork::from_laws(&laws.bending, &fabric.shear))
}

/// Positions of a lattice's particles as a function of weft and warp.
fn placed(lattice: &Lattice, place: impl Fn(f64, f64) -> [f64; 3]) -> Vec<f64> {
    lattice.coordinates().iter().flat_map(|&[u, v]| place(u, v)).collect()
}

/// Numbers between −1 and 1, the same on every machine.
fn random(count: usize) -> Vec<f64> {
    let mut state = 11_u64;
    let mut next = || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    (0..count).map(|_| next()).collect()
}

/// A sheet that is sheared, wavy, stretched here and compressed there, and folded back onto itself
/// at one end.
fn crumpled(lattice: &Lattice) -> Vec<f64> {
    let width = 0.12;
    let mut positions = placed(lattice, |u, v| {
        let (fold, over) = (0.08, u - 0.08);
        let flat = if u <= fold {
            [u, v, 0.0]
        } else {
            // Half a turn of a radius below half the spacing, then back.
            let radius = 0.003;
            let turn = (over / radius).min(std::f64::consts::PI);
            let back = (over - radius * std::f64::consts::PI).max(0.0);
            [fold + radius * turn.sin() - back, v, radius * (1.0 - turn.cos())]
        };
        [flat[0] + 0.3 * v, 0.97 * v + 0.05 * u * u / width, flat[2] + 0.004 * (40.0 * v).sin()]
    });
    let noise = random(positions.len());
    positions.iter_mut().zip(noise).for_each(|(x, noise)| *x += 4e-4 * noise);
    positions
}

/// A sheared sheet rolled on a cylinder, shaken by a two-thousandth of the spacing: yarns hardly
/// change their lengths, and angles hold nearly all of the energy.
fn rolled(lattice: &Lattice) -> Vec<f64> {
    let (shear, radius) = (0.3_f64, 0.04);
    let mut positions = placed(lattice, |u, v| {
        let [x, y] = [u + v * shear.sin(), v * shear.cos()];
        let angle = x / radius;
        [radius * angle.sin(), y, radius * (1.0 - angle.cos())]
    });
    let noise = random(positions.len());
    positions.iter_mut().zip(noise).for_each(|(x, noise)| *x += 5e-6 * noise);
    positions
}

/// The matrix of all blocks.
fn dense(breen: &mut Breen, positions: &[f64], definite: bool) -> Vec<Vec<f64>> {
    let size = positions.len();
    let mut matrix = vec![vec![0.0; size]; size];
    breen
        .add_stiffness(positions, definite, &mut |[a, b], block: &Block| {
            assert!(a <= b, "{a} and {b}");
            let (a, b) = (3 * a as usize, 3 * b as usize);
            for k in 0..9 {
                matrix[a + k / 3][b + k % 3] += block[k];
                if a != b {
                    matrix[b + k % 3][a + k / 3] += block[k];
                }
            }
        })
        .expect("the lists fit");
    matrix
}

fn forces(breen: &mut Breen, positions: &[f64]) -> Vec<f64> {
    let mut forces = vec![0.0; positions.len()];
    breen.add_forces(positions, &mut forces).expect("the lists fit");
    forces
}

#[test]
fn forces_are_the_fall_of_the_energy() {
    let (lattice, fabric) = (Lattice::rectangle(0.12, 0.1, 0.01).expect("a sheet"), fabric());
    let mut breen = Breen::new(&[(&lattice, &fabric)]).expect("no rim");
    let crumpled = crumpled(&lattice);
    // The sheet lies on itself.
    let far = |&&[a, b]: &&[u32; 2]| {
        let [p, q] = [a, b].map(|particle| lattice.coordinates()[particle as usize]);
        (p[0] - q[0]).hypot(p[1] - q[1]) > 0.03
    };
    let met = breen.close_pairs(&crumpled).expect("the lists fit").iter().filter(far).count();
    assert!(met > 20, "{met} pairs");
    for positions in [crumpled, rolled(&lattice)] {
        let found = forces(&mut breen, &positions);
        let largest = found.iter().fold(0.0, |size: f64, f| size.max(f.abs()));
        let h = 1e-7;
        for (k, force) in found.iter().enumerate() {
            let mut at = |step: f64| {
                let mut moved = positions.clone();
                moved[k] += step;
                breen.energy(&moved).expect("the lists fit")
            };
            let slope = (8.0 * (at(h) - at(-h)) - at(2.0 * h) + at(-2.0 * h)) / (12.0 * h);
            // The energy is rounded to 1e-16 of itself, and the forces are it over a tenth of the
            // spacing or so.
            let message = format!("{k}: {force} N, but {} by differences", -slope);
            assert!((slope + force).abs() < 1e-7 * largest, "{message}");
        }
    }
}

#[test]
fn the_stiffness_is_the_fall_of_the_forces() {
    let (lattice, fabric) = (Lattice::rectangle(0.12, 0.1, 0.01).expect("a sheet"), fabric());
    let mut breen = Breen::new(&[(&lattice, &fabric)]).expect("no rim");
    for (positions, seed) in
        (0..8).map(|seed| (if seed % 2 == 0 { crumpled(&lattice) } else { rolled(&lattice) }, seed))
    {
        let matrix = dense(&mut breen, &positions, false);
        let h = 1e-7;
        let direction: Vec<f64> = random(positions.len() + 97 * seed).split_off(97 * seed);
        let mut at = |step: f64| {
            let moved = positions.iter().zip(&direction).map(|(x, d)| x + step * d);
            forces(&mut breen, &moved.collect::<Vec<_>>())
        };
        let [near, far] = [h, 2.0 * h].map(|step| {
            let (after, before) = (at(step), at(-step));
            after.iter().zip(&before).map(|(a, b)| a - b).collect::<Vec<_>>()
        });
        let exact = matrix.iter().map(|row| row.iter().zip(&direction).map(|(k, d)| k * d).sum());
        let exact: Vec<f64> = exact.collect();
        let size = exact.iter().map(|x: &f64| x * x).sum::<f64>().sqrt();
        let off = exact.iter().zip(near.iter().zip(&far));
        let off = off.map(|(exact, (near, far))| exact + (8.0 * near - far) / (12.0 * h));
        let off = off.map(|x| x * x).sum::<f64>().sqrt();
        assert!(off < 1e-6 * size, "{off:e} of {size:e}");
    }
}

/// Whether a symmetric matrix plus a small multiple of the identity has a Cholesky factor.
fn definite(mut matrix: Vec<Vec<f64>>) -> bool {
    let size = matrix.len();
    let largest = (0..size).fold(0.0, |largest: f64, k| largest.max(matrix[k][k]));
    matrix.iter_mut().enumerate().for_each(|(k, row)| row[k] += 1e-12 * largest);
    for k in 0..size {
        for j in 0..k {
            let dot: f64 = (0..j).map(|i| matrix[k][i] * matrix[j][i]).sum();
            matrix[k][j] = (matrix[k][j] - dot) / matrix[j][j];
        }
        let square: f64 = (0..k).map(|i| matrix[k][i] * matrix[k][i]).sum();
        let rest = matrix[k][k] - square;
        if !(rest > 0.0) {
            return false;
        }
        matrix[k][k] = rest.sqrt();
    }
    true
}

#[test]
fn the_definite_stiffness_is_definite_and_the_exact_one_need_not_be() {
    let (lattice, fabric) = (Lattice::rectangle(0.12, 0.1, 0.01).expect("a sheet"), fabric());
    let mut breen = Breen::new(&[(&lattice, &fabric)]).expect("no rim");
    for positions in [crumpled(&lattice), rolled(&lattice)] {
        assert!(definite(dense(&mut breen, &positions, true)));
        assert!(!definite(dense(&mut breen, &positions, false)));
    }
}

#[test]
fn a_straight_sheet_has_one_stiffness_of_both_kinds() {
    // Without loads and without bends nothing is left out of the definite one.
    let (lattice, fabric) = (Lattice::rectangle(0.12, 0.1, 0.01).expect("a sheet"), fabric());
    let mut breen = Breen::new(&[(&lattice, &fabric)]).expect("no rim");
    let flat = placed(&lattice, |u, v| [u, v, 0.0]);
    let [exact, definite] = [false, true].map(|kind| dense(&mut breen, &flat, kind));
    let size = exact.iter().flatten().fold(0.0, |size: f64, x| size.max(x.abs()));
    let pairs = exact.iter().flatten().zip(definite.iter().flatten());
    let apart = pairs.fold(0.0, |apart: f64, (a, b)| apart.max((a - b).abs()));
    assert!(apart < 1e-12 * size, "{apart:e} of {size:e} N/m");
}

#[test]
fn forces_and_moments_cancel() {
    let lattice = Lattice::disc(0.06, 0.008).expect("a disc");
    let fabric = fabric();
    let mut breen = Breen::new(&[(&lattice, &fabric)]).expect("no rim");
    let mut positions = placed(&lattice, |u, v| [u + 0.4 * v, 1.02 * v, 0.01 * (60.0 * u).sin()]);
    let noise = random(positions.len());
    positions.iter_mut().zip(noise).for_each(|(x, noise)| *x += 5e-4 * noise);
    let found = forces(&mut breen, &positions);
    let size: f64 = found.iter().map(|f| f.abs()).sum();
    let pairs = positions.chunks_exact(3).zip(found.chunks_exact(3));
    let (mut force, mut moment) = ([0.0; 3], [0.0; 3]);
    for (x, f) in pairs {
        for axis in 0..3 {
            let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
            force[axis] += f[axis];
            moment[axis] += x[j] * f[k] - x[k] * f[j];
        }
    }
    for axis in 0..3 {
        assert!(force[axis].abs() < 1e-14 * size, "{force:?} of {size}");
        assert!(moment[axis].abs() < 1e-14 * size, "{moment:?} of {size} N");
    }
}

#[test]
fn a_flat_sheet_is_at_rest() {
    let (lattice, fabric) = (Lattice::rectangle(0.3, 0.2, 0.013).expect("a sheet"), fabric());
    let mut breen = Breen::new(&[(&lattice, &fabric)]).expect("no rim");
    let flat = placed(&lattice, |u, v| [u, v, 0.0]);
    let largest = forces(&mut breen, &flat).iter().fold(0.0, |size: f64, f| size.max(f.abs()));
    assert!(
        breen.energy(&flat).expect("the lists fit") < 1e-15 && largest < 1e-12,
        "{largest:e} N"
    );
}

#[test]
fn a_cylinder_has_the_work_of_its_curvature() {
    // Particles on a circle have chords between them that are a spacing long.
    let (lattice, fabric) = (Lattice::rectangle(0.2, 0.3, 0.01).expect("a sheet"), fabric());
    let mut breen = Breen::new(&[(&lattice, &fabric)]).expect("no rim");
    let (spacing, curvature) = (0.01, 15.0);
    let turn = 2.0 * f64::asin(0.5 * curvature * spacing);
    let [warp, weft] = laws(&fabric);
    for (work, along_weft) in [(weft, true), (warp, false)] {
        let bent = placed(&lattice, |u, v| {
            let (along, across) = if along_weft { (u, v) } else { (v, u) };
            let angle = turn * along / spacing;
            [angle.sin() / curvature, across, (1.0 - angle.cos()) / curvature]
        });
        // Eq. 5.5 takes for the curvature of the circle through the particles a chord's: cos(θ/2)
        // for the half turn.
        let exact = lattice.area() * work.bending(spacing, std::f64::consts::PI - turn);
        let found = breen.energy(&bent).expect("the lists fit");
        // Trellising is nought, and the repulsion of the diagonals too.
        assert!((found / exact - 1.0).abs() < 1e-9, "{found} J, not {exact} J");
    }
}

#[test]
fn an_even_shear_has_the_work_of_its_angle_until_the_diagonals_repel_each_other() {
    let (lattice, fabric) = (Lattice::rectangle(0.2, 0.3, 0.01).expect("a sheet"), fabric());
    let mut breen = Breen::new(&[(&lattice, &fabric)]).expect("no rim");
    let [_, weft] = laws(&fabric);
    let mut energy = |angle: f64| {
        let sheared = placed(&lattice, |u, v| [u + v * angle.sin(), v * angle.cos(), 0.0]);
        breen.energy(&sheared).expect("the lists fit") / (lattice.area() * weft.shearing(angle))
    };
    for degrees in [0.5, 3.0, 8.0, 15.0, 29.0] {
        let ratio = energy(f64::to_radians(degrees));
        assert!((ratio - 1.0).abs() < 1e-9, "{ratio} at {degrees}°");
    }
    // The short diagonal of a rhombus of 60° is as long as its sides.
    let ratio = energy(f64::to_radians(35.0));
    assert!(ratio > 1.01, "{ratio} at 35°");
}

#[test]
fn two_sheets_repel_each_other_where_they_are_near() {
    let (lattice, fabric) = (Lattice::rectangle(0.06, 0.06, 0.01).expect("a sheet"), fabric());
    let pair = [(&lattice, &fabric), (&lattice, &fabric)];
    let mut breen = Breen::new(&pair).expect("no rim");
    let count = Cloth::new(&pair).expect("a cloth").particle_count();
    let mut at = |gap: f64| {
        let lower = placed(&lattice, |u, v| [u, v, 0.0]);
        let upper = placed(&lattice, |u, v| [u, v, gap]);
        let found = forces(&mut breen, &[lower, upper].concat());
        found[3 * count / 2..].chunks(3).map(|f| f[2]).sum::<f64>()
    };
    assert_eq!(at(0.0101), 0.0);
    let (near, nearer) = (at(0.008), at(0.006));
    assert!(near > 0.0 && nearer > 10.0 * near, "{near} N, then {nearer} N");
}

#[test]
fn where_pairs_were_looked_for_before_changes_no_bit() {
    let (lattice, fabric) = (Lattice::rectangle(0.12, 0.1, 0.01).expect("a sheet"), fabric());
    let positions = crumpled(&lattice);
    let near: Vec<f64> =
        positions.iter().zip(random(positions.len())).map(|(x, r)| x + 1e-3 * r).collect();
    let mut breen = Breen::new(&[(&lattice, &fabric)]).expect("no rim");
    let fresh = (breen.energy(&positions).expect("the lists fit"), forces(&mut breen, &positions));
    let mut other = Breen::new(&[(&lattice, &fabric)]).expect("no rim");
    let _ = other.energy(&near).expect("the lists fit");
    assert!(
        fresh == (other.energy(&positions).expect("the lists fit"), forces(&mut other, &positions))
    );
}
