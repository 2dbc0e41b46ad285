//! Energy of an angle between two segments: bending and trellising.

use drape_fabric::{BreenWork, Work};

use crate::measure::block::Block;
use crate::measure::half::TRANSPOSED;
use crate::measure::vector::{Vector, add, dot, scale, subtract, vector_at};

/// Two segments between particles, with an energy of the angle between them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Hinge {
    /// Particles, `count` of them.
    particles: [u32; 4],
    /// Signs of each particle in the first and in the second segment.
    signs: [[f64; 2]; 4],
    count: usize,
    size: HingeSize,
    measure: Measure,
}

/// Area and law of a hinge.
#[derive(Debug, Clone, Copy)]
pub(crate) struct HingeSize {
    /// Area of cloth, in m².
    pub(crate) area: f64,
    /// Index of its work among those of the cloth.
    pub(crate) work: u32,
}

/// Measure that the energy is a function of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Measure {
    /// Length of the difference of the directions of two segments of a spacing along a yarn.
    Chord {
        /// Length of a segment at rest, in m.
        spacing: f64,
    },
    /// Cosine of the angle of two lines that cross at right angles at rest.
    Cosine,
}

/// Directions and lengths of the segments, the difference of the directions, and its squared
/// length.
struct Pose {
    units: [Vector; 2],
    lengths: [f64; 2],
    chord: Vector,
    square: f64,
}

impl Hinge {
    /// Returns the hinge of three particles along a yarn.
    pub(crate) fn bend([before, middle, after]: [u32; 3], size: HingeSize, spacing: f64) -> Self {
        let measure = Measure::Chord { spacing };
        Self::new([[before, middle], [middle, after]], size, measure)
    }

    /// Returns the hinge of the two lines through the neighbours of a particle.
    pub(crate) fn trellis(lines: [[u32; 2]; 2], size: HingeSize) -> Self {
        Self::new(lines, size, Measure::Cosine)
    }

    fn new(segments: [[u32; 2]; 2], size: HingeSize, measure: Measure) -> Self {
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

    fn pose(&self, positions: &[f64]) -> Pose {
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
        Pose { units, lengths, chord, square: dot(chord, chord) }
    }

    /// Returns the energy and its derivatives with respect to the cosine `$1 - \frac12|d|^2$` of
    /// the angle, with the difference `$d$` of the directions.
    fn work(&self, works: &[BreenWork], pose: &Pose) -> Work {
        let work = &works[self.size.work as usize];
        let found = match self.measure {
            Measure::Chord { spacing } => {
                let chord = pose.square.sqrt();
                let found = work.of_chord(spacing, chord);
                let secant = secant(&found, chord);
                let bend =
                    if chord > STRAIGHT { (found.second - secant) / pose.square } else { 0.0 };
                Work { work: found.work, first: -secant, second: bend }
            }
            Measure::Cosine => work.of_sine(1.0 - 0.5 * pose.square),
        };
        Work {
            work: found.work * self.size.area,
            first: found.first * self.size.area,
            second: found.second * self.size.area,
        }
    }

    pub(crate) fn energy(&self, works: &[BreenWork], positions: &[f64]) -> f64 {
        let work = &works[self.size.work as usize];
        let square = self.pose(positions).square;
        let found = match self.measure {
            Measure::Chord { spacing } => work.of_chord(spacing, square.sqrt()),
            Measure::Cosine => work.of_sine(1.0 - 0.5 * square),
        };
        found.work * self.size.area
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

    /// Passes the second derivatives to `put`, block by block: see
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
            (Measure::Chord { spacing }, true) => {
                let chord = pose.square.sqrt();
                let found = works[self.size.work as usize].of_chord(spacing, chord);
                pose.of_chord(&found, self.size.area)
            }
            (Measure::Cosine, true) => {
                let found = self.work(works, &pose);
                pose.of_cosine(&Work { first: 0.0, second: found.second.max(0.0), ..found })
            }
            (_, false) => pose.of_cosine(&self.work(works, &pose)),
        };
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

/// Chord below which a yarn counts as straight: the angle is then lost in the rounding of the
/// directions.
const STRAIGHT: f64 = 1e-9;

/// Returns the first derivative over the chord; of a straight yarn the limit.
fn secant(work: &Work, chord: f64) -> f64 {
    if chord > STRAIGHT { work.first / chord } else { work.second }
}

impl Pose {
    /// Cosine of the angle.
    fn cosine(&self) -> f64 {
        1.0 - 0.5 * self.square
    }

    /// Returns the derivatives of the cosine with respect to the two segments, times their lengths:
    /// each direction less its component along the other. For nearly straight segments they are
    /// small, and computed without cancellation.
    fn across(&self) -> [Vector; 2] {
        let half = 0.5 * self.square;
        [
            add(self.chord, scale(self.units[0], half)),
            subtract(scale(self.units[1], half), self.chord),
        ]
    }

    /// Returns the derivatives of the cosine with respect to the two segments.
    fn gradient(&self) -> [Vector; 2] {
        let across = self.across();
        [0, 1].map(|k| scale(across[k], 1.0 / self.lengths[k]))
    }

    /// Returns the second derivatives of a function of the cosine with respect to the first
    /// segment, the second, and both.
    fn of_cosine(&self, work: &Work) -> [Block; 3] {
        let gradient = self.gradient();
        let cosine = self.cosine();
        let own = |k: usize| -> Block {
            let (unit, slope, inverse) = (self.units[k], gradient[k], 1.0 / self.lengths[k]);
            std::array::from_fn(|entry| {
                let (i, j) = (entry / 3, entry % 3);
                let identity = if i == j { 1.0 } else { 0.0 };
                let rotation = unit[i] * slope[j] + slope[i] * unit[j];
                let rotation =
                    (rotation + cosine * inverse * (identity - unit[i] * unit[j])) * inverse;
                work.second * slope[i] * slope[j] - work.first * rotation
            })
        };
        let [a, b] = self.lengths;
        let [p, q] = self.units;
        // (1 − ppᵀ)(1 − qqᵀ) = 1 − ppᵀ − qqᵀ + c pqᵀ.
        let mixed: Block = std::array::from_fn(|entry| {
            let (i, j) = (entry / 3, entry % 3);
            let identity = if i == j { 1.0 } else { 0.0 };
            let both = identity - p[i] * p[j] - q[i] * q[j] + cosine * p[i] * q[j];
            work.second * gradient[0][i] * gradient[1][j] + work.first * both / (a * b)
        });
        [own(0), own(1), mixed]
    }

    /// Returns the positive part of the second derivatives of a work of the chord, without the
    /// rotation of the chord's gradient.
    fn of_chord(&self, work: &Work, area: f64) -> [Block; 3] {
        let chord = self.square.sqrt();
        let secant = secant(work, chord);
        let more = if chord > STRAIGHT { (work.second - secant) / self.square } else { 0.0 };
        let (secant, more) = (area * secant, area * more);
        // Component across the segment, over its length: the change of the direction.
        let project = |k: usize, vector: Vector| {
            let unit = self.units[k];
            let rest = subtract(vector, scale(unit, dot(unit, vector)));
            scale(rest, 1.0 / self.lengths[k])
        };
        let block = |k: usize, l: usize, sign: f64| -> Block {
            let mut block = [0.0; 9];
            let (left, right) = (project(k, self.chord), project(l, self.chord));
            for axis in 0..3 {
                let mut column = [0.0; 3];
                column[axis] = 1.0;
                let image = project(k, project(l, column));
                for row in 0..3 {
                    block[3 * row + axis] =
                        sign * (secant * image[row] + more * left[row] * right[axis]);
                }
            }
            block
        };
        [block(0, 0, 1.0), block(1, 1, 1.0), block(0, 1, -1.0)]
    }
}
