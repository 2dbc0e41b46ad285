//! Cloth on a cube: a square metre of cloth is lowered onto a cube of half a metre \[BHW94\].

use drape_dynamics::{Simulation, Snapshot};
use drape_fabric::Fabric;
use drape_scene::{BoxSpec, NoiseSpec, PanelSpec, SceneSpec, SettleSpec, TimeSpec};

use crate::error::ValidationError;
use crate::outline::{Harmonics, evenly, length, maxima, section};
use crate::setup::{finish_with, simulation, with_panel};

/// Half of the cube's side, in m.
const HALF: f64 = 0.25;

/// Model in which the cloth is simulated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Model {
    /// The laws of the fabric.
    Kes,
    /// Breen's particles.
    Breen,
}

impl Model {
    /// Both models, in the order of the pictures.
    pub(crate) const ALL: [Self; 2] = [Self::Kes, Self::Breen];

    /// Returns the model as a scene has it.
    fn of_scene(self) -> drape_scene::Model {
        match self {
            Self::Kes => drape_scene::Model::Kes,
            Self::Breen => drape_scene::Model::Breen1994,
        }
    }

    /// Returns the name of the model in a report.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Kes => "laws of the fabric",
            Self::Breen => "Breen's particles",
        }
    }
}

/// Cloth at rest on the cube.
#[derive(Debug, Clone)]
pub(crate) struct CubeDrape {
    /// The cloth and the cube.
    pub(crate) snapshot: Snapshot,
    /// Horizontal cut of the cloth: points (x, z), in m.
    pub(crate) cut: Vec<[f64; 2]>,
    /// Number of billows at each corner: maxima of the distance of the cut from the cube that lie
    /// nearer to the corner than to the middle of a side.
    pub(crate) billows: [usize; 4],
    /// Middle of each corner of the cloth, seen from the vertical edge of the cube, along x and z,
    /// in m. A corner is the part of the cloth that would lie beside two sides of the cube.
    pub(crate) corners: [[f64; 2]; 4],
    /// Time of each step, in s, and energy of fabric, weight and contact since the start, in J.
    pub(crate) energy: Vec<[f64; 2]>,
    /// Imbalance of the forces at rest, over g.
    pub(crate) imbalance: f64,
    /// Number of particles in the cube.
    pub(crate) inside: usize,
}

impl CubeDrape {
    /// Simulates a cloth of `fabric` that is lowered onto the cube, with particles at `spacing`, in
    /// m. `seed` perturbs the start.
    ///
    /// The weft lies along x and the warp along z.
    pub(crate) fn simulate(
        fabric: &Fabric,
        model: Model,
        spacing: f64,
        seed: u64,
    ) -> Result<Self, ValidationError> {
        let mut spec = SceneSpec {
            name: Some("cube".into()),
            model: model.of_scene(),
            spacing,
            time: TimeSpec { step: 0.005, end: 100.0, ..TimeSpec::default() },
            settle: Some(SettleSpec::default()),
            ..SceneSpec::default()
        };
        let panel = PanelSpec {
            name: "cloth".into(),
            fabric: "cloth".into(),
            rectangle: Some([1.0, 1.0]),
            center: [0.0, 0.505, 0.0],
            turn: [-90.0, 0.0, 0.0],
            noise: Some(NoiseSpec { amplitude: 1e-4, length: None, seed }),
            ..PanelSpec::default()
        };
        spec.collider.boxes.push(BoxSpec {
            name: Some("cube".into()),
            size: [0.5; 3],
            center: [0.0, HALF, 0.0],
            friction: Some(0.3),
            ..BoxSpec::default()
        });
        spec.contact.surfaces = Some(false);
        spec.contact.offset = 0.002;
        let mut simulation = simulation(&with_panel(spec, panel, fabric))?;
        let mut energy = Vec::new();
        finish_with(&mut simulation, |simulation, step| {
            let stored = simulation.energy().unwrap_or_default();
            energy.push([step.time, stored.elastic + stored.gravity + stored.contact]);
        })?;
        Ok(Self::read(&simulation, energy))
    }

    /// Reads the drape from `simulation` at its end. `energy` is the history of the energy.
    fn read(simulation: &Simulation, energy: Vec<[f64; 2]>) -> Self {
        /// Height of the cut, in m: just above the hem between the corners.
        const CUT: f64 = 0.3;

        let snapshot = simulation.snapshot();
        let summary = simulation.summary();
        let cut = section(&snapshot.triangles, &snapshot.positions, CUT).unwrap_or_default();
        Self {
            billows: billows(&cut, snapshot.spacing),
            corners: corners(&snapshot),
            cut,
            energy,
            imbalance: summary.imbalance,
            inside: summary.contact.intersections,
            snapshot,
        }
    }

    /// Returns the directions of `corners`, in degrees from the diagonal of the cube. A positive
    /// lean is towards the sides of the cube on which the warp hangs down.
    pub(crate) fn leans(&self) -> [f64; 4] {
        self.corners.map(|[x, z]| z.atan2(x).to_degrees() - 45.0)
    }

    /// Returns the mean distance of `corners` from the vertical edges of the cube, in m.
    pub(crate) fn reach(&self) -> f64 {
        self.corners.iter().map(|[x, z]| x.hypot(*z)).sum::<f64>() / 4.0
    }

    /// Returns the largest rise of `energy` in a step, over its whole fall.
    pub(crate) fn rise(&self) -> f64 {
        let fall = self.energy.last().map_or(f64::NAN, |[_, last]| -last);
        let before = std::iter::once(0.0).chain(self.energy.iter().map(|[_, energy]| *energy));
        let rises = self.energy.iter().zip(before).map(|([_, now], before)| now - before);
        rises.fold(0.0, f64::max) / fall
    }
}

/// Returns the distance of the point (`x`, `z`) from the sides of the cube, in m. The distance of a
/// point inside is negative.
fn distance([x, z]: [f64; 2]) -> f64 {
    let (x, z) = (x.abs() - HALF, z.abs() - HALF);
    x.max(0.0).hypot(z.max(0.0)) + x.max(z).min(0.0)
}

/// Returns the number of billows of `cut` at each corner, for cloth with particles at `spacing`.
fn billows(cut: &[[f64; 2]], spacing: f64) -> [usize; 4] {
    /// Points of the cut at which its distance from the cube is read.
    const POINTS: usize = 720;

    /// Shortest wave of the cut that a grid can show, over the spacing.
    const SHORTEST_WAVE: f64 = 4.0;

    /// Prominence of a billow, in m. It is in proportion to the cloth as 3 mm on a drapemeter.
    const PROMINENCE: f64 = 0.01;

    let mut counts = [0; 4];
    if cut.is_empty() {
        return counts;
    }

    let points = evenly(cut, POINTS);
    let distances: Vec<f64> = points.iter().map(|point| distance(*point)).collect();
    let harmonics = (length(cut) / (SHORTEST_WAVE * spacing)) as usize;
    let smooth = Harmonics::new(&distances, harmonics).curve(POINTS);
    for [x, z] in maxima(&smooth, PROMINENCE).into_iter().map(|index| points[index]) {
        if x.abs().min(z.abs()) > 0.5 * HALF {
            counts[usize::from(x > 0.0) + 2 * usize::from(z > 0.0)] += 1;
        }
    }
    counts
}

/// Returns the middle of each corner of the cloth in `snapshot`, seen from the nearest vertical
/// edge of the cube, along x and z, in m.
fn corners(snapshot: &Snapshot) -> [[f64; 2]; 4] {
    let mut sums = [[0.0; 3]; 4];
    let particles = snapshot.coordinates.iter().zip(snapshot.positions.chunks_exact(3));
    for ([u, v], x) in particles {
        let (u, v) = (u - 0.5, v - 0.5);
        if u.abs().min(v.abs()) >= HALF - 1e-9 {
            let sum = &mut sums[usize::from(u > 0.0) + 2 * usize::from(v > 0.0)];
            // The warp of a lying panel runs against z.
            sum[0] += x[0] * u.signum() - HALF;
            sum[1] += -x[2] * v.signum() - HALF;
            sum[2] += 1.0;
        }
    }
    sums.map(|[x, z, count]| [x / count, z / count])
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    /// Returns a cut around the cube with the number `waves` of waves at each corner.
    fn wavy(waves: f64) -> Vec<[f64; 2]> {
        let at = |k: usize| {
            let angle = TAU * k as f64 / 2000.0;
            let quarter = (angle / (0.25 * TAU)).fract() - 0.5;
            let hump = (1.0 - (4.0 * quarter).powi(2)).max(0.0);
            let wave = 1.0 + 0.5 * (TAU * waves * (2.0 * quarter + 0.5) - 0.5 * TAU).cos();
            let (sin, cos) = angle.sin_cos();
            let radius = HALF / sin.abs().max(cos.abs()) + 0.02 + 0.1 * hump * wave;
            [radius * cos, radius * sin]
        };
        (0..2000).map(at).collect()
    }

    #[test]
    fn billows_are_counted_at_the_corners() {
        assert_eq!(billows(&wavy(1.0), 0.02), [1; 4]);
        assert_eq!(billows(&wavy(2.0), 0.02), [2; 4]);
        assert_eq!(billows(&[], 0.02), [0; 4]);
    }

    #[test]
    fn distances_are_from_the_sides_and_the_edges() {
        assert!((distance([0.3, 0.1]) - 0.05).abs() < 1e-15);
        assert!((distance([-0.28, 0.29]) - 0.05).abs() < 1e-15);
        assert!((distance([0.2, -0.24]) + 0.01).abs() < 1e-15);
    }
}
