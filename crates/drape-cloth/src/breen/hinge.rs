//! Energy of an angle between two segments: bending and trellising.

use drape_fabric::{BreenWork, Work};

use crate::measure::block::Block;
use crate::measure::half::TRANSPOSED;
use crate::measure::vector::{Vector, add, dot, scale, subtract, vector_at};

/// Two segments between particles, with an energy of the angle between them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Hinge {
    /// Particles, of which the first `count` are used.
    particles: [u32; 4],
    /// Signs of each particle in the first and in the second segment.
    signs: [[f64; 2]; 4],
    count: usize,
    size: HingeSize,
    measure: HingeMeasure,
}

/// Area and law of a hinge.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HingeSize {
    /// Area of cloth, in m².
    pub(crate) area: f64,
    /// Index of the hinge's work among all works of the cloth.
    pub(crate) work: u32,
}

/// Measure on which the energy depends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum HingeMeasure {
    /// Length of the difference of the directions of two segments along a yarn.
    Chord {
        /// Length of a segment at rest, in m.
        spacing: f64,
    },
    /// Cosine of the angle between two lines that cross at right angles at rest.
    Cosine,
}

/// Directions and lengths of the two segments at given positions.
struct SegmentPose {
    units: [Vector; 2],
    lengths: [f64; 2],
    /// Difference of the directions.
    chord: Vector,
    /// Squared length of the chord.
    square: f64,
}

impl Hinge {
    /// Returns the hinge of three particles along a yarn, `before`, `middle` and `after`.
    pub(crate) fn bend([before, middle, after]: [u32; 3], size: HingeSize, spacing: f64) -> Self {
        let measure = HingeMeasure::Chord { spacing };
        Self::new([[before, middle], [middle, after]], size, measure)
    }

    /// Returns the hinge of the two `lines` through the neighbours of a particle.
    pub(crate) fn trellis(lines: [[u32; 2]; 2], size: HingeSize) -> Self {
        Self::new(lines, size, HingeMeasure::Cosine)
    }

    fn new(segments: [[u32; 2]; 2], size: HingeSize, measure: HingeMeasure) -> Self {
        let (mut particles, mut signs, mut count) = ([0; 4], [[0.0; 2]; 4], 0);
        for (segment, ends) in segments.into_iter().enumerate() {
            for (end, sign) in ends.into_iter().zip([-1.0, 1.0]) {
                let known = particles[..count].iter().position(|&particle| particle == end);
                let index = known.unwrap_or(count);
                count = count.max(index + 1);
                particles[index] = end;
                signs[index][segment] += sign;
            }
        }
        Self { particles, signs, count, size, measure }
    }

    fn pose(&self, positions: &[f64]) -> SegmentPose {
        let mut segments = [[0.0; 3]; 2];
        for (particle, signs) in self.particles[..self.count].iter().zip(self.signs) {
            let at = vector_at(positions, *particle);
            for (segment, sign) in segments.iter_mut().zip(signs) {
                *segment = add(*segment, scale(at, sign));
            }
        }
        let lengths = segments.map(|segment| dot(segment, segment).sqrt());
        let units = [0, 1].map(|k| scale(segments[k], 1.0 / lengths[k]));
        let chord = subtract(units[1], units[0]);
        SegmentPose { units, lengths, chord, square: dot(chord, chord) }
    }

    /// Returns the energy at `pose` and its derivatives with respect to the cosine
    /// `$1 - \frac12|d|^2$` of the angle, with the difference `$d$` of the directions.
    fn work(&self, works: &[BreenWork], pose: &SegmentPose) -> Work {
        let work = &works[self.size.work as usize];
        let per_area = match self.measure {
            HingeMeasure::Chord { spacing } => {
                let chord = pose.square.sqrt();
                let chord_work = work.at_chord(spacing, chord);
                let secant = secant(&chord_work, chord);
                let bend =
                    if chord > STRAIGHT { (chord_work.second - secant) / pose.square } else { 0.0 };
                Work { work: chord_work.work, first: -secant, second: bend }
            }
            HingeMeasure::Cosine => work.at_sine(1.0 - 0.5 * pose.square),
        };
        Work {
            work: per_area.work * self.size.area,
            first: per_area.first * self.size.area,
            second: per_area.second * self.size.area,
        }
    }

    pub(crate) fn energy(&self, works: &[BreenWork], positions: &[f64]) -> f64 {
        let work = &works[self.size.work as usize];
        let square = self.pose(positions).square;
        let per_area = match self.measure {
            HingeMeasure::Chord { spacing } => work.at_chord(spacing, square.sqrt()),
            HingeMeasure::Cosine => work.at_sine(1.0 - 0.5 * square),
        };
        per_area.work * self.size.area
    }

    pub(crate) fn add_forces(&self, works: &[BreenWork], positions: &[f64], forces: &mut [f64]) {
        let pose = self.pose(positions);
        let first = self.work(works, &pose).first;
        let gradient = pose.gradient();
        for (&particle, signs) in self.particles[..self.count].iter().zip(self.signs) {
            for (segment, sign) in gradient.iter().zip(signs) {
                for axis in 0..3 {
                    forces[3 * particle as usize + axis] -= first * sign * segment[axis];
                }
            }
        }
    }

    /// Passes the second derivatives at `positions` to `put`, block by block, like
    /// [`Breen::add_stiffness`](crate::Breen::add_stiffness).
    pub(crate) fn add_stiffness(
        &self,
        works: &[BreenWork],
        positions: &[f64],
        definite: bool,
        put: &mut dyn FnMut([u32; 2], &Block),
    ) {
        let pose = self.pose(positions);
        let [first, second, mixed] = match (self.measure, definite) {
            (HingeMeasure::Chord { spacing }, true) => {
                let chord = pose.square.sqrt();
                let work = works[self.size.work as usize].at_chord(spacing, chord);
                pose.chord_hessian(&work, self.size.area)
            }
            (HingeMeasure::Cosine, true) => {
                let work = self.work(works, &pose);
                pose.cosine_hessian(&Work { first: 0.0, second: work.second.max(0.0), ..work })
            }
            (_, false) => pose.cosine_hessian(&self.work(works, &pose)),
        };

        // Each particle takes the blocks of the segments with its signs.
        for i in 0..self.count {
            for j in i..self.count {
                let ([a, b], [c, d]) = (self.signs[i], self.signs[j]);
                let block: Block = std::array::from_fn(|k| {
                    let transposed = TRANSPOSED[k];
                    a * c * first[k]
                        + b * d * second[k]
                        + a * d * mixed[k]
                        + b * c * mixed[transposed]
                });
                let [p, q] = [self.particles[i], self.particles[j]];
                if p <= q {
                    put([p, q], &block);
                } else {
                    put([q, p], &TRANSPOSED.map(|k| block[k]));
                }
            }
        }
    }
}

/// Chord below which a yarn counts as straight. The angle is then lost in the rounding of the
/// directions.
const STRAIGHT: f64 = 1e-9;

/// Returns the first derivative of `work` over the chord or, for a straight yarn, its limit.
fn secant(work: &Work, chord: f64) -> f64 {
    if chord > STRAIGHT { work.first / chord } else { work.second }
}

impl SegmentPose {
    /// Returns the cosine of the angle, `$1 - \frac12|d|^2$`.
    fn cosine(&self) -> f64 {
        1.0 - 0.5 * self.square
    }

    /// Returns the derivatives of the cosine with respect to the two segments, times their lengths:
    /// each of `units` less its component along the other. For nearly straight segments the
    /// derivatives are small, and computed without cancellation.
    fn across(&self) -> [Vector; 2] {
        let half = 0.5 * self.square;
        [
            add(self.chord, scale(self.units[0], half)),
            subtract(scale(self.units[1], half), self.chord),
        ]
    }

    /// Returns the derivatives of the cosine with respect to the two segments, in 1/m.
    fn gradient(&self) -> [Vector; 2] {
        let across = self.across();
        [0, 1].map(|k| scale(across[k], 1.0 / self.lengths[k]))
    }

    /// Returns the second derivatives of a function of the cosine with respect to the first
    /// segment, the second, and both. `work` holds the derivatives of the function.
    fn cosine_hessian(&self, work: &Work) -> [Block; 3] {
        let gradient = self.gradient();
        let cosine = self.cosine();
        let single = [0, 1].map(|k| -> Block {
            let (unit, slope, inverse) = (self.units[k], gradient[k], 1.0 / self.lengths[k]);
            std::array::from_fn(|entry| {
                let (i, j) = (entry / 3, entry % 3);
                let identity = if i == j { 1.0 } else { 0.0 };
                let rotation = unit[i] * slope[j] + slope[i] * unit[j];
                let rotation =
                    (rotation + cosine * inverse * (identity - unit[i] * unit[j])) * inverse;
                work.second * slope[i] * slope[j] - work.first * rotation
            })
        });

        // (1 − ppᵀ)(1 − qqᵀ) = 1 − ppᵀ − qqᵀ + c pqᵀ.
        let [a, b] = self.lengths;
        let [p, q] = self.units;
        let mixed: Block = std::array::from_fn(|entry| {
            let (i, j) = (entry / 3, entry % 3);
            let identity = if i == j { 1.0 } else { 0.0 };
            let both = identity - p[i] * p[j] - q[i] * q[j] + cosine * p[i] * q[j];
            work.second * gradient[0][i] * gradient[1][j] + work.first * both / (a * b)
        });
        [single[0], single[1], mixed]
    }

    /// Returns the positive part of the second derivatives of a `work` of the chord times `area`,
    /// without the rotation of the chord's gradient.
    fn chord_hessian(&self, work: &Work, area: f64) -> [Block; 3] {
        let chord = self.square.sqrt();
        let secant = secant(work, chord);
        let excess = if chord > STRAIGHT { (work.second - secant) / self.square } else { 0.0 };
        let (secant, excess) = (area * secant, area * excess);
        [(0, 0, 1.0), (1, 1, 1.0), (0, 1, -1.0)].map(|(k, l, sign)| {
            let mut block = [0.0; 9];
            let (left, right) = (self.turn(k, self.chord), self.turn(l, self.chord));
            for axis in 0..3 {
                let mut column = [0.0; 3];
                column[axis] = 1.0;
                let image = self.turn(k, self.turn(l, column));
                for row in 0..3 {
                    block[3 * row + axis] =
                        sign * (secant * image[row] + excess * left[row] * right[axis]);
                }
            }
            block
        })
    }

    /// Returns the change of the direction of segment `k` when its end moves by `vector`: the
    /// component of `vector` across the segment, over the segment's length.
    fn turn(&self, k: usize, vector: Vector) -> Vector {
        let unit = self.units[k];
        let across = subtract(vector, scale(unit, dot(unit, vector)));
        scale(across, 1.0 / self.lengths[k])
    }
}
