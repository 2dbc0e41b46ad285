use drape_implicit::BlockMatrix;

/// Stiffness of a stitch, in N/m: some ten times that of a yarn of a usual weave, which is all that a thread must be. The
/// gaps that its pull leaves, micrometres, go when the nodes become one.
const STIFFNESS: f64 = 1e5;

/// Threads between the two sides of the seams, which are drawn together while the garment is sewn.
///
/// Each keeps what lies between its nodes near what lay there at the start times the part that is left, which falls
/// evenly to nothing: pulled straight, without a choice of way, and with an energy that is a square.
#[derive(Debug, Clone)]
pub(crate) struct Stitches {
    pairs: Vec<[u32; 2]>,
    /// From the second node to the first at the start, in m.
    gaps: Vec<[f64; 3]>,
    /// How long the drawing together takes, in s.
    seconds: f64,
    /// Part of the gaps that the end of this step leaves.
    left: f64,
}

impl Stitches {
    /// Stitches between pairs of nodes at their places at the start; seconds tells how long drawing together takes.
    pub(crate) fn new(pairs: &[[u32; 2]], positions: &[f64], seconds: f64) -> Self {
        let gaps = pairs.iter().map(|&pair| gap(positions, pair)).collect();
        Self { pairs: pairs.to_vec(), gaps, seconds, left: 1.0 }
    }

    /// The pairs of nodes.
    pub(crate) fn pairs(&self) -> &[[u32; 2]] {
        &self.pairs
    }

    /// Opens a step that ends at a time, in s.
    pub(crate) fn begin(&mut self, end_time: f64) {
        self.left = (1.0 - end_time / self.seconds).max(0.0);
    }

    /// When the sides have been drawn together, in s.
    pub(crate) fn end(&self) -> f64 {
        self.seconds
    }

    /// The widest gap, in m, and the pair that it is between.
    pub(crate) fn widest(&self, positions: &[f64]) -> (f64, [u32; 2]) {
        let widths = self.pairs.iter().map(|&pair| (width(positions, pair), pair));
        widths.fold((0.0, [0; 2]), |widest, width| if width.0 > widest.0 { width } else { widest })
    }

    pub(crate) fn add_forces(&self, positions: &[f64], forces: &mut [f64]) {
        for (&pair, excess) in self.pairs.iter().zip(self.excess(positions)) {
            let [a, b] = pair.map(|node| 3 * node as usize);
            for axis in 0..3 {
                forces[a + axis] -= STIFFNESS * excess[axis];
                forces[b + axis] += STIFFNESS * excess[axis];
            }
        }
    }

    pub(crate) fn potential(&self, positions: &[f64]) -> f64 {
        let squares = self.excess(positions).map(|e| e.iter().map(|x| x * x).sum::<f64>());
        0.5 * STIFFNESS * squares.sum::<f64>()
    }

    pub(crate) fn add_stiffness(&self, matrix: &mut BlockMatrix) {
        let block = |size: f64| -> [f64; 9] {
            std::array::from_fn(|k| if k % 4 == 0 { size } else { 0.0 })
        };
        let (own, other) = (block(STIFFNESS), block(-STIFFNESS));
        for &pair in &self.pairs {
            let [a, b] = pair.map(|node| node as usize);
            matrix.add(a, a, &own);
            matrix.add(b, b, &own);
            matrix.add(a, b, &other);
        }
    }

    /// What lies between the nodes of each pair beyond what is left.
    fn excess(&self, positions: &[f64]) -> impl Iterator<Item = [f64; 3]> {
        self.pairs.iter().zip(&self.gaps).map(move |(&pair, start)| {
            let now = gap(positions, pair);
            [0, 1, 2].map(|axis| now[axis] - self.left * start[axis])
        })
    }
}

/// Distance of the nodes of a pair, in m.
pub(crate) fn width(positions: &[f64], pair: [u32; 2]) -> f64 {
    gap(positions, pair).iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn gap(positions: &[f64], pair: [u32; 2]) -> [f64; 3] {
    let [a, b] = pair.map(|node| 3 * node as usize);
    [0, 1, 2].map(|axis| positions[a + axis] - positions[b + axis])
}
