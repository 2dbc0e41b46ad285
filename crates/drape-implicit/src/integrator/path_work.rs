//! Work of the forces along a sub-step, by quadrature.
//!
//! Within a sub-step the forces are a function of the positions, so their work from start to end
//! does not depend on the path. The quadrature follows the straight path, along which obstacles
//! move too.
//!
//! The first rule is Radau's with two points: the end, where the forces are known, and a third of
//! the path. It needs one evaluation of the forces, and is exact for forces of second degree along
//! the path. If this work differs from the decrease of the potential, the path is divided into
//! pieces. The rule of Gauss and Legendre with three points measures the work over each piece. The
//! piece with the largest difference is halved until the sum of the differences is below the
//! tolerance. Halving thus finds kinks, where contact begins or the direction of friction changes.
//!
//! The work is a sum of forces times displacements only. The potentials only decide which pieces
//! are halved. Forces that are not the gradient of the potential therefore keep their difference
//! however fine the pieces are.

use crate::report::Report;
use crate::step_filter::SystemRef;

/// Tolerance of the quadrature: largest difference between the work of the forces and the decrease
/// of the potential, as a fraction of the energy that the sub-step exchanges.
const CLOSED: f64 = 2e-7;

/// Relative rounding error of the potentials.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Largest number of pieces of a path.
const MAX_PIECES: usize = 48;

/// Points and weights of the rule of Gauss and Legendre on a piece from 0 to 1.
const GAUSS: [[f64; 2]; 3] = [
    [0.112_701_665_379_258_31, 5.0 / 18.0],
    [0.5, 8.0 / 18.0],
    [0.887_298_334_620_741_7, 5.0 / 18.0],
];

/// Returns whether a sub-step that begins at `time`, in s, belongs to the sample: about one of
/// `sampling` sub-steps does. A hash of the time decides, so the stepper needs no counter.
pub(crate) fn is_sampled(time: f64, sampling: u64) -> bool {
    let mut mixed = time.to_bits().wrapping_add(0x9e37_79b9_7f4a_7c15);
    mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (mixed ^ (mixed >> 31)).is_multiple_of(sampling.max(1))
}

/// Straight path of a sub-step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Path<'a> {
    /// Positions at the start of the path, in m.
    pub start: &'a [f64],
    /// Positions at the end of the path, in m.
    pub end: &'a [f64],
    /// Potentials at start and end, in J.
    pub potentials: [f64; 2],
    /// Work of the forces at the end over the whole path, in J.
    pub end_work: f64,
    /// Energy that the sub-step exchanges, in J.
    pub exchanged: f64,
}

impl Path<'_> {
    /// Returns the admissible difference between the work and the decrease of the potential, in J.
    fn tolerance(&self) -> f64 {
        let [before, after] = self.potentials.map(f64::abs);
        (CLOSED * self.exchanged).max(ROUNDING * (before + after))
    }

    /// Returns the energy, in J, of which the admissible difference is the fraction [`CLOSED`]: the
    /// energy that the sub-step exchanges, or what the rounding of the potentials resolves.
    pub(crate) fn resolved_energy(&self) -> f64 {
        self.tolerance() / CLOSED
    }
}

/// Work along a path, in J.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Work {
    /// Work of the forces on the particles.
    pub forces: f64,
    /// Work of the moving obstacles.
    pub obstacles: f64,
    /// Energy that the sub-step exchanges if the path leads through an obstacle, otherwise 0. The
    /// forces have no finite work along such a path, and `forces` follows from the decrease of the
    /// potential.
    pub unproved: f64,
}

/// Work space of the quadrature.
#[derive(Debug)]
pub(crate) struct PathWork {
    positions: Vec<f64>,
    forces: Vec<f64>,
    displacements: Vec<f64>,
    pieces: Vec<Piece>,
}

/// Returns the mean over the path by Radau's rule, from the values at a `third` of the path and at
/// the `end`.
fn radau(third: f64, end: f64) -> f64 {
    0.75 * third + 0.25 * end
}

/// Piece of a path.
#[derive(Debug, Clone, Copy)]
struct Piece {
    /// Fractions of the path at the start and the end of the piece.
    ends: [f64; 2],
    /// Potentials at both ends, in J.
    potentials: [f64; 2],
    work: Work,
}

impl Piece {
    /// Returns the increase of the potential plus the work of the forces less the work of the
    /// obstacles, in J: 0 for exact quadrature of forces with this potential.
    fn imbalance(&self) -> f64 {
        let [start, end] = self.potentials;
        end - start + self.work.forces - self.work.obstacles
    }
}

impl PathWork {
    /// Allocates work space for vectors of `length` entries.
    pub(crate) fn new(length: usize) -> Self {
        let zeros = vec![0.0; length];
        Self {
            positions: zeros.clone(),
            forces: zeros.clone(),
            displacements: zeros,
            pieces: Vec::with_capacity(MAX_PIECES),
        }
    }

    /// Returns the work along `path`. Afterwards the obstacles are at the end of their motion.
    pub(crate) fn measure(
        &mut self,
        system: &mut SystemRef<'_>,
        path: &Path<'_>,
        report: &mut Report,
    ) -> Work {
        for (displacement, (end, start)) in
            self.displacements.iter_mut().zip(path.end.iter().zip(path.start))
        {
            *displacement = end - start;
        }

        // Radau's rule needs one further evaluation and usually suffices.
        let end_obstacles = system.obstacle_work(path.end);
        let third = self.work_at(system, path, 1.0 / 3.0);
        report.force_evaluations += 1;
        let mut work = Work {
            forces: radau(third.forces, path.end_work),
            obstacles: radau(third.obstacles, end_obstacles),
            unproved: 0.0,
        };
        let whole = Piece { ends: [0.0, 1.0], potentials: path.potentials, work };
        let is_close = whole.imbalance().abs() <= path.tolerance();
        if !is_close {
            work = self.refine(system, path, report);
        }
        system.set_obstacle_time(1.0);

        if work.forces.is_finite() && work.obstacles.is_finite() {
            return work;
        }
        // The path leads through an obstacle: the decrease of the potential replaces the work.
        let decrease = path.potentials[0] - path.potentials[1];
        Work {
            forces: decrease + end_obstacles,
            obstacles: end_obstacles,
            unproved: path.exchanged,
        }
    }

    /// Returns the work along `path`, measured over pieces that are halved where needed.
    fn refine(&mut self, system: &mut SystemRef<'_>, path: &Path<'_>, report: &mut Report) -> Work {
        self.pieces.clear();
        let whole = self.piece(system, path, ([0.0, 1.0], path.potentials));
        self.pieces.push(whole);

        loop {
            let sum: f64 = self.pieces.iter().map(|piece| piece.imbalance().abs()).sum();
            if sum <= path.tolerance() || self.pieces.len() == MAX_PIECES || !sum.is_finite() {
                break;
            }

            let imbalances = self.pieces.iter().map(|piece| piece.imbalance().abs());
            let worst =
                imbalances.enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |w| w.0);
            let Piece { ends: [from, to], potentials: [before, after], .. } =
                self.pieces.swap_remove(worst);
            let middle = 0.5 * (from + to);
            self.move_to(system, path, middle);
            let between = system.system().potential(&self.positions);
            report.potential_evaluations += 1;
            for half in [([from, middle], [before, between]), ([middle, to], [between, after])] {
                let piece = self.piece(system, path, half);
                self.pieces.push(piece);
            }
        }

        // A system may keep results of its last potential: the last one must be at the end.
        system.set_obstacle_time(1.0);
        system.system().potential(path.end);
        report.potential_evaluations += 1;
        report.force_evaluations += 3 * (2 * self.pieces.len() - 1);

        Work {
            forces: self.pieces.iter().map(|piece| piece.work.forces).sum(),
            obstacles: self.pieces.iter().map(|piece| piece.work.obstacles).sum(),
            unproved: 0.0,
        }
    }

    /// Returns the piece of `path` between the two fractions `ends`, with the `potentials` there.
    fn piece(
        &mut self,
        system: &mut SystemRef<'_>,
        path: &Path<'_>,
        (ends, potentials): ([f64; 2], [f64; 2]),
    ) -> Piece {
        let [from, to] = ends;
        let mut work = Work { forces: 0.0, obstacles: 0.0, unproved: 0.0 };
        for [point, weight] in GAUSS {
            let sample = self.work_at(system, path, from + point * (to - from));
            work.forces += weight * (to - from) * sample.forces;
            work.obstacles += weight * (to - from) * sample.obstacles;
        }
        Piece { ends, potentials, work }
    }

    /// Returns the work that the forces at `fraction` of the path would do over the whole path.
    fn work_at(&mut self, system: &mut SystemRef<'_>, path: &Path<'_>, fraction: f64) -> Work {
        self.move_to(system, path, fraction);
        system.system().forces(&self.positions, &mut self.forces);
        let work = self.forces.iter().zip(&self.displacements).map(|(f, moved)| f * moved);
        Work { forces: work.sum(), obstacles: system.obstacle_work(&self.positions), unproved: 0.0 }
    }

    /// Moves `self.positions` and the obstacles to `fraction` of the path.
    fn move_to(&mut self, system: &mut SystemRef<'_>, path: &Path<'_>, fraction: f64) {
        for (position, (start, displacement)) in
            self.positions.iter_mut().zip(path.start.iter().zip(&self.displacements))
        {
            *position = start + fraction * displacement;
        }
        system.set_obstacle_time(fraction);
    }
}
