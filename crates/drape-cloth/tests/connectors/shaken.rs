//! Cloth in shapes with noise, products with its stiffness, and sums of its forces.

use drape_cloth::{Cloth, Lattice, State};
use drape_fabric::Fabric;

pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    }
}

/// A cylinder about an axis at 30° to the weft, stretched and shaken.
pub fn bent(lattice: &Lattice, radius: f64, shake: f64, random: &mut Random) -> Vec<f64> {
    let (sin, cos) = 0.5_f64.sin_cos();
    let place = |[u, v]: [f64; 2]| {
        let (along, across) = (cos * u + sin * v, cos * v - sin * u);
        let angle = across / radius;
        [1.02 * along, 1.01 * radius * (1.0 - angle.cos()), 1.01 * radius * angle.sin()]
    };
    let shaken = |x: f64| x + shake * random.next();
    lattice.coordinates().iter().flat_map(|&c| place(c)).map(shaken).collect()
}

/// A cloth committed twice before a shape with noise, and a trial at the radius.
pub fn tried(
    lattice: &Lattice,
    fabric: &Fabric,
    shake: f64,
    radius: f64,
) -> (Cloth, State, Vec<f64>) {
    let mut random = Random(7);
    let cloth = Cloth::new(&[(lattice, fabric)]).expect("a cloth");
    let mut state = cloth.state(bent(lattice, 0.4, 0.0, &mut random)).expect("fits");
    let rest = vec![0.0; 3 * cloth.particle_count()];
    for radius in [0.1, 0.06] {
        let positions = bent(lattice, radius, shake, &mut random);
        cloth.commit(&mut state, &positions, &rest).expect("the lists fit");
    }
    let trial = bent(lattice, radius, shake, &mut random);
    (cloth, state, trial)
}

/// Multiplies the symmetric block matrix with a vector.
pub fn multiply(cloth: &Cloth, values: &[f64], vector: &[f64]) -> Vec<f64> {
    let sparsity = cloth.sparsity();
    let mut product = vec![0.0; vector.len()];
    for row in 0..cloth.particle_count() {
        for slot in sparsity.offsets[row]..sparsity.offsets[row + 1] {
            let column = sparsity.columns[slot];
            for i in 0..3 {
                for j in 0..3 {
                    let value = values[9 * slot + 3 * i + j];
                    product[3 * row + i] += value * vector[3 * column + j];
                    if row != column {
                        product[3 * column + j] += value * vector[3 * row + i];
                    }
                }
            }
        }
    }
    product
}

/// Sums of the internal forces and torques over the sums of their magnitudes.
pub fn balance(cloth: &Cloth, state: &State, trial: &[f64]) -> (f64, f64) {
    let mut forces = vec![0.0; trial.len()];
    cloth.add_forces(state, trial, &mut forces).expect("the lists fit");
    let (mut force, mut torque, mut size, mut lever) = ([0.0; 3], [0.0; 3], 0.0, 0.0);
    for (x, f) in trial.chunks(3).zip(forces.chunks(3)) {
        let cross =
            [x[1] * f[2] - x[2] * f[1], x[2] * f[0] - x[0] * f[2], x[0] * f[1] - x[1] * f[0]];
        for axis in 0..3 {
            force[axis] += f[axis];
            torque[axis] += cross[axis];
        }
        let norm = |v: &[f64]| v.iter().map(|c| c * c).sum::<f64>().sqrt();
        size += norm(f);
        lever += norm(&cross);
    }
    let norm = |v: [f64; 3]| v.iter().map(|c| c * c).sum::<f64>().sqrt();
    (norm(force) / size, norm(torque) / lever)
}

pub fn norm(values: &[f64]) -> f64 {
    values.iter().map(|v| v * v).sum::<f64>().sqrt()
}

pub fn distance(found: &[f64], exact: &[f64]) -> f64 {
    let gap: Vec<f64> = found.iter().zip(exact).map(|(a, b)| a - b).collect();
    norm(&gap) / norm(exact)
}
