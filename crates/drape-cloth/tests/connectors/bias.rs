//! Specimens cut at an angle to the grain: stretched, and bent.

use drape_cloth::{Cloth, Grain, Lattice, State};

use crate::panels::{LINEAR, fabric, rectangle};
use crate::shaken::multiply;

/// Sides of a strip, in m.
const STRIP: [f64; 2] = [0.05, 0.2];

pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Solves with a symmetric operator that has no negative direction, by conjugate gradients.
pub fn solve(apply: impl Fn(&[f64]) -> Vec<f64>, right: &[f64], tolerance: f64) -> Vec<f64> {
    let mut solution = vec![0.0; right.len()];
    let mut rest = right.to_vec();
    let mut direction = rest.clone();
    let mut square = dot(&rest, &rest);
    let enough = tolerance * tolerance * square;
    for _ in 0..20 * right.len() {
        if square <= enough {
            break;
        }
        let image = apply(&direction);
        let step = square / dot(&direction, &image);
        solution.iter_mut().zip(&direction).for_each(|(x, w)| *x += step * w);
        rest.iter_mut().zip(&image).for_each(|(r, i)| *r -= step * i);
        let next = dot(&rest, &rest);
        direction.iter_mut().zip(&rest).for_each(|(w, r)| *w = r + next / square * *w);
        square = next;
    }
    solution
}

/// Sides that belong to one triangle only.
pub fn outline(lattice: &Lattice) -> Vec<[u32; 2]> {
    let triangles = lattice.triangles();
    let mut sides: Vec<[u32; 2]> =
        triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
    sides.iter_mut().for_each(|side| side.sort_unstable());
    sides.sort_unstable();
    sides.chunk_by(|a, b| a == b).filter(|same| same.len() == 1).map(|same| same[0]).collect()
}

/// Stiffness of a strip under a uniform stress at its ends, over that of the laws.
fn stretched(degrees: f64, spacing: f64) -> f64 {
    let lattice = rectangle(STRIP, degrees, spacing);
    let cloth = Cloth::new(&[(&lattice, &fabric(LINEAR))]).expect("a cloth");
    let points = lattice.panel_coordinates();
    let flat: Vec<f64> = points.iter().flat_map(|&[x, y]| [x, y, 0.0]).collect();
    let state = cloth.state(flat.clone()).expect("it fits");
    let mut values = vec![0.0; 9 * cloth.sparsity().block_count()];
    cloth.add_stiffness(&state, &flat, false, &mut values).expect("the lists fit");
    let mut load = vec![0.0; flat.len()];
    for [a, b] in outline(&lattice) {
        let [one, other] = [a, b].map(|node| points[node as usize]);
        for (height, sign) in [(0.0, -1.0), (STRIP[1], 1.0)] {
            if [one, other].iter().all(|point| (point[1] - height).abs() < 1e-9) {
                let half = 0.5 * sign * (one[0] - other[0]).abs();
                [a, b].iter().for_each(|&node| load[3 * node as usize + 1] += half);
            }
        }
    }
    let moved = solve(|direction| multiply(&cloth, &values, direction), &load, 1e-10);
    let (s, c) = degrees.to_radians().sin_cos();
    let exact = c.powi(4) / 4000.0 + s.powi(4) / 2500.0 + (s * c).powi(2) / 30.0;
    exact * STRIP[0] * STRIP[1] / dot(&load, &moved)
}

#[test]
fn a_strip_at_any_angle_is_as_stiff_as_the_laws_say() {
    let mut worst = 0.0_f64;
    for degrees in [0.0, 15.0, 30.0, 45.0] {
        for spacing in [0.02, 0.01] {
            let part = stretched(degrees, spacing);
            println!("strip at {degrees}°, {spacing} m: stiffness over exact {part:.6}");
            worst = worst.max((part - 1.0).abs());
        }
    }
    assert!(worst < 1e-6, "{worst:e}");
}

/// A specimen on a cylinder, along which its nodes slide until they are at rest: their coordinates
/// across and around, in m.
struct Rolled<'a> {
    cloth: &'a Cloth,
    radius: f64,
    points: Vec<[f64; 2]>,
}

impl Rolled<'_> {
    fn positions(&self, points: &[f64]) -> Vec<f64> {
        let point = |p: &[f64]| {
            let (sin, cos) = (p[1] / self.radius).sin_cos();
            [p[0], self.radius * sin, self.radius * (1.0 - cos)]
        };
        points.chunks_exact(2).flat_map(point).collect()
    }

    /// Directions in space of directions across and around the cylinder.
    fn spread(&self, points: &[f64], directions: &[f64]) -> Vec<f64> {
        let along = |(p, w): (&[f64], &[f64])| {
            let (sin, cos) = (p[1] / self.radius).sin_cos();
            [w[0], w[1] * cos, w[1] * sin]
        };
        points.chunks_exact(2).zip(directions.chunks_exact(2)).flat_map(along).collect()
    }

    fn gather(&self, points: &[f64], forces: &[f64]) -> Vec<f64> {
        let along = |(p, f): (&[f64], &[f64])| {
            let (sin, cos) = (p[1] / self.radius).sin_cos();
            [f[0], f[1] * cos + f[2] * sin]
        };
        points.chunks_exact(2).zip(forces.chunks_exact(3)).flat_map(along).collect()
    }

    /// Energy at rest per area, in J/m².
    fn settle(&self) -> f64 {
        let cloth = self.cloth;
        let mut points = self.points.concat();
        let state = cloth.state(self.positions(&points)).expect("it fits");
        let energy = |state: &State, points: &[f64]| {
            cloth.potential(state, &self.positions(points)).expect("the lists fit")
        };
        for _ in 0..30 {
            let trial = self.positions(&points);
            let mut forces = vec![0.0; trial.len()];
            let mut values = vec![0.0; 9 * cloth.sparsity().block_count()];
            cloth.add_forces(&state, &trial, &mut forces).expect("the lists fit");
            cloth.add_stiffness(&state, &trial, true, &mut values).expect("the lists fit");
            let apply = |direction: &[f64]| {
                self.gather(&points, &multiply(cloth, &values, &self.spread(&points, direction)))
            };
            let force = self.gather(&points, &forces);
            let step = solve(apply, &force, 1e-6);
            let (now, gain) = (energy(&state, &points), dot(&step, &force));
            let at = |part: f64| -> Vec<f64> {
                points.iter().zip(&step).map(|(x, s)| x + part * s).collect()
            };
            let part = (0..30).map(|k| 0.5_f64.powi(k));
            let mut part =
                part.filter(|&part| energy(&state, &at(part)) <= now - 0.1 * part * gain);
            let Some(part) = part.next() else { break };
            points = at(part);
            if gain < 1e-9 * now {
                break;
            }
        }
        let area: f64 = cloth.areas().iter().sum();
        cloth
            .stored(&cloth.state(self.positions(&points)).expect("it fits"))
            .expect("the lists fit")
            / area
    }
}

#[test]
fn a_specimen_bent_on_the_bias_has_the_moment_of_both_yarns() {
    // Unequal yarns would rotate the specimen about its middle, the stiffer ones towards the axis.
    let fabric = fabric(&LINEAR.replace("0.7e-5", "1.2e-5"));
    let (size, radius) = ([0.06, 0.03], 0.03);
    let exact = 0.5 * 0.25 * (1.2e-5 + 1.2e-5) / (radius * radius);
    let mut parts = Vec::new();
    for spacing in [0.005, 0.0025] {
        let grid = Lattice::rectangle_at(Grain::from_degrees(45.0), [0.0; 2], size, spacing);
        for (name, lattice) in
            [("grid", grid.expect("a panel")), ("rim", rectangle(size, 45.0, spacing))]
        {
            let cloth = Cloth::new(&[(&lattice, &fabric)]).expect("a cloth");
            let rolled = Rolled { cloth: &cloth, radius, points: lattice.panel_coordinates() };
            let part = rolled.settle() / exact;
            println!("bent at 45°, {name}, {spacing} m: energy over the closed form {part:.4}");
            parts.push(part);
        }
    }
    assert!(parts[..2].iter().all(|part| (part - 1.0).abs() < 0.03), "{parts:?}");
    assert!(parts[2..].iter().all(|part| (part - 1.0).abs() < 0.01), "{parts:?}");
}
