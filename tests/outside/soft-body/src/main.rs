//! A soft cube of springs falls on a floor. The barrier of `drape-collide` keeps it above the
//! floor, and its gradient is held against differences of its energy.

use std::time::Instant;

use drape_collide::{
    ContactDistances, Error, PlainMesh, Surface, SurfaceContact, SurfaceParts, SurfaceSettings,
    SurfaceStart, SurfaceTrial,
};

/// Particles along an edge of the cube, and their distance in m.
const SIDE: usize = 5;
const SPACING: f64 = 0.025;

/// Mass of a particle in kg, stiffness of a spring in N/m, gravity in m/s².
const MASS: f64 = 2e-3;
const STIFFNESS: f64 = 60.0;
const GRAVITY: f64 = 9.81;

/// Length of a step in s, and number of steps.
const STEP: f64 = 2e-4;
const STEPS: usize = 6000;

/// Half distances of the cube and of the floor.
const HALF: ContactDistances = ContactDistances { activation_distance: 3e-4, min_separation: 1e-4 };

/// Floor of two triangles at y = 0.
const FLOOR: [[f64; 3]; 4] =
    [[-1.0, 0.0, -1.0], [-1.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, -1.0]];

/// Returns the number of the particle in a column, row and layer.
fn particle([i, j, k]: [usize; 3]) -> usize {
    (i * SIDE + j) * SIDE + k
}

/// Returns the places of the particles in the cube's own grid.
fn grid() -> impl Iterator<Item = [usize; 3]> {
    (0..SIDE).flat_map(|i| (0..SIDE).flat_map(move |j| (0..SIDE).map(move |k| [i, j, k])))
}

/// Returns the triangles of the surface of the cube.
fn surface_triangles() -> Vec<[u32; 3]> {
    let mut triangles = Vec::new();
    for axis in 0..3 {
        for (level, outwards) in [(0, false), (SIDE - 1, true)] {
            for cell in 0..(SIDE - 1) * (SIDE - 1) {
                let (a, b) = (cell / (SIDE - 1), cell % (SIDE - 1));
                let corner = |a: usize, b: usize| {
                    let mut place = [level; 3];
                    (place[(axis + 1) % 3], place[(axis + 2) % 3]) = (a, b);
                    particle(place) as u32
                };
                let square =
                    [corner(a, b), corner(a + 1, b), corner(a + 1, b + 1), corner(a, b + 1)];
                let [p, q, r, s] =
                    if outwards { square } else { [square[3], square[2], square[1], square[0]] };
                triangles.extend([[p, q, r], [p, r, s]]);
            }
        }
    }
    triangles
}

/// Springs between neighbours along edges, faces and diagonals, with their lengths at rest.
struct Springs(Vec<([usize; 2], f64)>);

impl Springs {
    fn new() -> Self {
        let mut springs = Vec::new();
        for from in grid() {
            for to in grid().filter(|to| *to > from) {
                let square: usize = (0..3).map(|k| to[k].abs_diff(from[k]).pow(2)).sum();
                if square <= 3 && (0..3).all(|k| to[k].abs_diff(from[k]) <= 1) {
                    let length = SPACING * (square as f64).sqrt();
                    springs.push(([particle(from), particle(to)], length));
                }
            }
        }
        Self(springs)
    }

    /// Adds the forces of the springs at `x` to `forces`, in N.
    fn add_forces(&self, x: &[f64], forces: &mut [f64]) {
        for ([i, j], rest) in &self.0 {
            let d = [0, 1, 2].map(|k| x[3 * j + k] - x[3 * i + k]);
            let length = d.iter().map(|d| d * d).sum::<f64>().sqrt();
            for k in 0..3 {
                let tension = STIFFNESS * (1.0 - rest / length) * d[k];
                forces[3 * i + k] += tension;
                forces[3 * j + k] -= tension;
            }
        }
    }
}

/// Moves the cube for one step with its contact.
fn step(
    contact: &mut SurfaceContact,
    springs: &Springs,
    positions: &mut Vec<f64>,
    velocities: &mut [f64],
) -> Result<(), Error> {
    let floor = FLOOR.as_flattened();
    let mut step = contact.begin(SurfaceStart::new(positions, floor))?;
    let mut forces = [0.0, -GRAVITY * MASS, 0.0].repeat(SIDE.pow(3));
    springs.add_forces(positions, &mut forces);
    step.energy(positions)?.add_forces(&mut forces)?;

    // A little drag lets the cube come to rest.
    let advance = |(v, f): (&f64, &f64)| STEP * (0.995 * v + STEP * f / MASS);
    let mut displacements: Vec<f64> = velocities.iter().zip(&forces).map(advance).collect();
    step.limit(SurfaceTrial {
        start: positions,
        displacements: &mut displacements,
        held: &[],
        obstacle_time: 0.0,
        obstacle_advance: &mut 1.0,
    })?;

    let end: Vec<f64> = positions.iter().zip(&displacements).map(|(x, dx)| x + dx).collect();
    assert!(step.intersections(&end)?.is_empty(), "the cube never meets the floor");
    step.commit(&end)?;
    *positions = end;
    velocities.iter_mut().zip(displacements).for_each(|(v, dx)| *v = dx / STEP);
    Ok(())
}

/// Returns the largest difference of the contact forces at `x` from the slope of the energy, over
/// the largest force.
fn gradient_error(contact: &mut SurfaceContact, x: &[f64]) -> Result<f64, Error> {
    let mut forces = vec![0.0; x.len()];
    contact.energy(x)?.add_forces(&mut forces)?;
    let largest = forces.iter().fold(0.0, |largest: f64, force| largest.max(force.abs()));

    let mut worst: f64 = 0.0;
    let mut moved = x.to_vec();
    for (k, force) in forces.iter().enumerate() {
        let mut energy_at = |offset: f64| {
            moved[k] = x[k] + offset;
            contact.energy(&moved).map(|energy| energy.potential())
        };
        let slope = (energy_at(1e-8)? - energy_at(-1e-8)?) / 2e-8;
        moved[k] = x[k];
        worst = worst.max((force + slope).abs() / largest);
    }
    Ok(worst)
}

fn main() -> Result<(), Error> {
    let cube: Vec<[f64; 3]> =
        grid().map(|[i, j, k]| [i, j, k].map(|n| SPACING * n as f64)).collect();
    let triangles = surface_triangles();
    let free = PlainMesh { positions: &cube, triangles: &triangles };
    let body = PlainMesh { positions: &FLOOR, triangles: &[[0, 1, 2], [0, 2, 3]] };
    let surface = Surface::new(SurfaceParts::from_meshes(&[free], &[body], HALF)?)?;

    // The weight on the lower face is carried halfway between separation and activation.
    let weight = GRAVITY * MASS * SIDE.pow(3) as f64;
    let pressure = weight / (SPACING * (SIDE - 1) as f64).powi(2);
    let pair = ContactDistances { activation_distance: 6e-4, min_separation: 2e-4 };
    let stiffness = SurfaceSettings::stiffness_for_pressure(pressure, 4e-4, pair);
    let settings = SurfaceSettings::new(stiffness, vec![0.3; 4]);
    let mut contact = SurfaceContact::new(surface, settings, FLOOR.concat())?;

    // It starts turned and 5 mm up.
    let turned = |[x, y, z]: &[f64; 3]| [0.96 * x - 0.28 * y, 0.28 * x + 0.96 * y + 0.005, *z];
    let mut positions: Vec<f64> = cube.iter().flat_map(turned).collect();
    let mut velocities = vec![0.0; positions.len()];
    let springs = Springs::new();
    let begin = Instant::now();
    for _ in 0..STEPS {
        step(&mut contact, &springs, &mut positions, &mut velocities)?;
    }
    let milliseconds = 1e3 * begin.elapsed().as_secs_f64();

    // At rest the floor carries the weight, and the energy is the potential of the forces.
    let mut forces = vec![0.0; positions.len()];
    contact.energy(&positions)?.add_forces(&mut forces)?;
    let carried: f64 = forces.chunks_exact(3).map(|force| force[1]).sum();
    assert!((carried / weight - 1.0).abs() < 0.01, "{carried} N of {weight} N");
    let lowest = positions.chunks_exact(3).map(|x| x[1]).fold(f64::MAX, f64::min);
    assert!(lowest > 2e-4 && lowest < 6e-4, "{lowest} m above the floor");
    let error = gradient_error(&mut contact, &positions)?;
    assert!(error < 1e-5, "the gradient is off by {error:e}");
    println!(
        "a cube rests {:.2} mm above its floor, gradient right to {error:.0e}: {milliseconds:.0} ms",
        1e3 * lowest
    );
    Ok(())
}
