//! Work of the forces along a sub-step, by quadrature.
//!
//! Within a sub-step the forces are a function of place, so their work from its start to its end
//! does not depend on the path; the straight one is taken, on which obstacles move along. A rule of
//! Radau with the forces at the end, which are known, and at a third of the way comes first: one
//! evaluation, exact for forces of second degree along the path. Where it misses the fall of the
//! potential, pieces of the path are halved, always the one that misses most, and each is measured
//! by the rule of Gauss and Legendre with three points. Kinks, where contact begins or friction
//! turns, are found that way. The work is a sum of forces times displacements and nothing else: of
//! potentials it takes only where to look closer, so that forces that do not belong to the
//! potential keep missing it however fine the pieces are.

use crate::report::Report;
use crate::step_filter::SystemRef;

/// Tolerance of the quadrature: largest difference of the work of the forces and the decrease of their
/// potential, over the energy that the sub-step exchanges.
const CLOSED: f64 = 2e-7;

/// Relative rounding error of the potentials.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Largest number of pieces of a path.
const MAX_PIECES: usize = 24;

/// Points and weights of the rule of Gauss and Legendre on a piece from 0 to 1.
const GAUSS: [[f64; 2]; 3] = [
    [0.112_701_665_379_258_31, 5.0 / 18.0],
    [0.5, 8.0 / 18.0],
    [0.887_298_334_620_741_7, 5.0 / 18.0],
];

/// Returns whether a sub-step that begins at a time, in s, belongs to the sample, one of so many. A hash
/// of the time decides, so that there is no counter.
pub(crate) fn is_sampled(time: f64, sampling: u64) -> bool {
    let mut mixed = time.to_bits().wrapping_add(0x9e37_79b9_7f4a_7c15);
    mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (mixed ^ (mixed >> 31)).is_multiple_of(sampling.max(1))
}

/// Straight path of a sub-step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Path<'a> {
    /// Positions at its start and at its end, in m.
    pub start: &'a [f64],
    pub end: &'a [f64],
    /// Potentials there, in J.
    pub potentials: [f64; 2],
    /// Work of the forces at the end over the whole path, in J.
    pub end_work: f64,
    /// Energy that the sub-step exchanges, in J.
    pub exchanged: f64,
}

impl Path<'_> {
    /// Miss of the potential that is too small to look closer, in J.
    fn tolerance(&self) -> f64 {
        let [before, after] = self.potentials.map(f64::abs);
        (CLOSED * self.exchanged).max(ROUNDING * (before + after))
    }
}

/// Work along a path, in J.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Work {
    /// Work of the forces on the particles.
    pub forces: f64,
    /// Work of the obstacles that move.
    pub obstacles: f64,
    /// Energy that the sub-step exchanges where the path leads through an obstacle, so that forces
    /// have no work along it: the fall of the potential stands for it.
    pub unproved: f64,
}

/// Work space of the quadrature.
#[derive(Debug)]
pub(crate) struct PathWork {
    place: Vec<f64>,
    forces: Vec<f64>,
    displacements: Vec<f64>,
    pieces: Vec<Piece>,
}

/// Piece of a path.
#[derive(Debug, Clone, Copy)]
struct Piece {
    /// Fractions of the path at its start and its end.
    ends: [f64; 2],
    potentials: [f64; 2],
    work: Work,
}

impl Piece {
    /// Energy that its forces leave open, in J.
    fn miss(&self) -> f64 {
        let [start, end] = self.potentials;
        end - start + self.work.forces - self.work.obstacles
    }
}

impl PathWork {
    pub(crate) fn new(length: usize) -> Self {
        let zeros = || vec![0.0; length];
        Self {
            place: zeros(),
            forces: zeros(),
            displacements: zeros(),
            pieces: Vec::with_capacity(MAX_PIECES),
        }
    }

    /// Measures the work along a path. Obstacles are left at the end of their motion.
    pub(crate) fn measure(
        &mut self,
        system: &mut SystemRef<'_>,
        path: &Path<'_>,
        report: &mut Report,
    ) -> Work {
        for (moved, (end, start)) in
            self.displacements.iter_mut().zip(path.end.iter().zip(path.start))
        {
            *moved = end - start;
        }
        let end_obstacles = system.obstacle_work(path.end);
        let third = self.work_at(system, path, 1.0 / 3.0);
        report.force_evaluations += 1;
        let rule = |third: f64, end: f64| 0.75 * third + 0.25 * end;
        let work = Work {
            forces: rule(third.forces, path.end_work),
            obstacles: rule(third.obstacles, end_obstacles),
            unproved: 0.0,
        };
        let whole = Piece { ends: [0.0, 1.0], potentials: path.potentials, work };
        let work = match whole.miss().abs() <= path.tolerance() {
            true => work,
            false => self.refine(system, path, report),
        };
        system.set_obstacle_time(1.0);
        if work.forces.is_finite() && work.obstacles.is_finite() {
            return work;
        }
        let fall = path.potentials[0] - path.potentials[1];
        Work { forces: fall + end_obstacles, obstacles: end_obstacles, unproved: path.exchanged }
    }

    /// Measures the work piece by piece.
    fn refine(&mut self, system: &mut SystemRef<'_>, path: &Path<'_>, report: &mut Report) -> Work {
        self.pieces.clear();
        let whole = self.piece(system, path, ([0.0, 1.0], path.potentials));
        self.pieces.push(whole);
        loop {
            let miss: f64 = self.pieces.iter().map(|piece| piece.miss().abs()).sum();
            if miss <= path.tolerance() || self.pieces.len() == MAX_PIECES || !miss.is_finite() {
                break;
            }
            let misses = self.pieces.iter().map(|piece| piece.miss().abs());
            let worst = misses.enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |w| w.0);
            let Piece { ends: [from, to], potentials: [before, after], .. } =
                self.pieces.swap_remove(worst);
            let middle = 0.5 * (from + to);
            self.go_to(system, path, middle);
            let between = system.system().potential(&self.place);
            report.potential_evaluations += 1;
            for half in [([from, middle], [before, between]), ([middle, to], [between, after])] {
                let piece = self.piece(system, path, half);
                self.pieces.push(piece);
            }
        }
        // What a system notes of its last potential is that of the end.
        system.set_obstacle_time(1.0);
        system.system().potential(path.end);
        report.potential_evaluations += 1;
        report.force_evaluations += 3 * (2 * self.pieces.len() - 1);
        let sum = |of: fn(&Work) -> f64| self.pieces.iter().map(|piece| of(&piece.work)).sum();
        let [forces, obstacles] = [sum(|work| work.forces), sum(|work| work.obstacles)];
        Work { forces, obstacles, unproved: 0.0 }
    }

    /// Measures a piece between two fractions of the path, with the potentials there.
    fn piece(
        &mut self,
        system: &mut SystemRef<'_>,
        path: &Path<'_>,
        (ends, potentials): ([f64; 2], [f64; 2]),
    ) -> Piece {
        let [from, to] = ends;
        let mut work = Work { forces: 0.0, obstacles: 0.0, unproved: 0.0 };
        for [point, weight] in GAUSS {
            let own = self.work_at(system, path, from + point * (to - from));
            work.forces += weight * (to - from) * own.forces;
            work.obstacles += weight * (to - from) * own.obstacles;
        }
        Piece { ends, potentials, work }
    }

    /// Work over the whole path of the forces at a fraction of it.
    fn work_at(&mut self, system: &mut SystemRef<'_>, path: &Path<'_>, fraction: f64) -> Work {
        self.go_to(system, path, fraction);
        system.system().forces(&self.place, &mut self.forces);
        let work = self.forces.iter().zip(&self.displacements).map(|(f, moved)| f * moved);
        Work { forces: work.sum(), obstacles: system.obstacle_work(&self.place), unproved: 0.0 }
    }

    /// Moves the place and the obstacles to a fraction of the path.
    fn go_to(&mut self, system: &mut SystemRef<'_>, path: &Path<'_>, fraction: f64) {
        for (place, (start, moved)) in
            self.place.iter_mut().zip(path.start.iter().zip(&self.displacements))
        {
            *place = start + fraction * moved;
        }
        system.set_obstacle_time(fraction);
    }
}
