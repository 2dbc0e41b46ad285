use drape_implicit::BlockMatrix;
use drape_scene::Pin;

/// Stiffness of an attachment, in N/m for each of its particles and directions: as stiff as a stitch. It gives way by a
/// tenth of a micrometre under a hundredth of a newton, more than what hangs on a particle weighs.
const STIFFNESS: f64 = 1e5;

/// Springs of the pins that hold in some directions and leave their particles free in the others.
///
/// Between particles at `$x$` and their places `$\bar x$` at the end of the step their energy is
/// `$\frac k2\sum(x_a-\bar x_a)^2$`, summed over the directions `$a$` that are held: a square, whose force and tangent are
/// exact. A particle that is held altogether has no spring: the solver leaves it out.
#[derive(Debug, Clone, Default)]
pub(crate) struct Attachments(Vec<Spring>);

/// A particle, its place, and the directions in which it is held there.
#[derive(Debug, Clone, Copy)]
struct Spring {
    particle: usize,
    place: [f64; 3],
    axes: [bool; 3],
}

impl Attachments {
    /// Those of a pin at a time, in s.
    pub(crate) fn of(pin: &Pin, time: f64) -> Self {
        let mut own = Self::default();
        own.add(pin, time);
        own
    }

    pub(crate) fn clear(&mut self) {
        self.0.clear();
    }

    /// Adds those of a pin at a time, in s.
    pub(crate) fn add(&mut self, pin: &Pin, time: f64) {
        let spring = |(particle, place)| Spring { particle, place, axes: pin.axes };
        self.0.extend(pin.places(time).map(spring));
    }

    pub(crate) fn add_forces(&self, positions: &[f64], forces: &mut [f64]) {
        for (number, excess) in self.excess(positions) {
            forces[number] -= STIFFNESS * excess;
        }
    }

    /// Forces of the cloth on them, three for each particle, in N.
    pub(crate) fn pulls(&self, positions: &[f64]) -> Vec<f64> {
        let mut pulls = vec![0.0; positions.len()];
        for (number, excess) in self.excess(positions) {
            pulls[number] += STIFFNESS * excess;
        }
        pulls
    }

    pub(crate) fn potential(&self, positions: &[f64]) -> f64 {
        let squares = self.excess(positions).map(|(_, excess)| excess * excess);
        0.5 * STIFFNESS * squares.sum::<f64>()
    }

    /// Work on the cloth along a straight way with the force at its end, and the fall of the potential, in J.
    pub(crate) fn work(&self, from: &[f64], to: &[f64]) -> [f64; 2] {
        let powers = self.excess(to).map(|(number, excess)| excess * (to[number] - from[number]));
        let work = -STIFFNESS * powers.sum::<f64>();
        [work, self.potential(from) - self.potential(to)]
    }

    pub(crate) fn add_stiffness(&self, matrix: &mut BlockMatrix) {
        for &Spring { particle, axes, .. } in &self.0 {
            let block =
                std::array::from_fn(|k| if k % 4 == 0 && axes[k / 4] { STIFFNESS } else { 0.0 });
            matrix.add(particle, particle, &block);
        }
    }

    /// The numbers of all places that are held, and how far each is from where it belongs, in m.
    fn excess(&self, positions: &[f64]) -> impl Iterator<Item = (usize, f64)> {
        self.0.iter().flat_map(move |&Spring { particle, place, axes }| {
            let held = (0..3).filter(move |&axis| axes[axis]);
            held.map(move |axis| {
                let number = 3 * particle + axis;
                (number, positions[number] - place[axis])
            })
        })
    }
}
