use drape_implicit::BlockMatrix;
use drape_scene::{Stitching, Thread};

/// Stiffness of a stitch, in N/m: some ten times that of a yarn of a usual weave, which is all that a thread must be. The
/// gaps that its pull leaves, micrometres, go when the nodes become one.
const STIFFNESS: f64 = 1e5;

/// Threads between the two sides of the seams, which are drawn together while the garment is sewn.
///
/// Each keeps what lies between its ends near what lay there at the start times the part that is left, which falls
/// evenly to nothing: pulled straight, without a choice of way, and with an energy that is a square.
#[derive(Debug, Clone)]
pub(crate) struct Stitches {
    threads: Vec<Thread>,
    /// What lay between the ends of each at the start, in m.
    gaps: Vec<[f64; 3]>,
    /// How long the drawing together takes, in s.
    seconds: f64,
    /// Part of the gaps that the end of this step leaves.
    left: f64,
}

impl Stitches {
    /// Stitches between nodes at their places at the start; seconds tells how long drawing together takes.
    pub(crate) fn new(stitching: &Stitching, positions: &[f64], seconds: f64) -> Self {
        let threads: Vec<Thread> = stitching.threads().collect();
        let gaps = threads.iter().map(|thread| thread.gap(positions)).collect();
        Self { threads, gaps, seconds, left: 1.0 }
    }

    /// Pairs of nodes that are coupled.
    pub(crate) fn pairs(&self) -> Vec<[u32; 2]> {
        let pairs = self.threads.iter().flat_map(|thread| {
            let nodes = thread.parts.iter().map(|part| part.0).enumerate();
            nodes.flat_map(|(k, a)| thread.parts[k + 1..].iter().map(move |&(b, _)| [a, b]))
        });
        pairs.collect()
    }

    /// Opens a step that ends at a time, in s.
    pub(crate) fn begin(&mut self, end_time: f64) {
        self.left = (1.0 - end_time / self.seconds).max(0.0);
    }

    /// When the sides have been drawn together, in s.
    pub(crate) fn end(&self) -> f64 {
        self.seconds
    }

    /// The widest gap, in m, and two nodes that it is between.
    pub(crate) fn widest(&self, positions: &[f64]) -> (f64, [u32; 2]) {
        let ends = |thread: &Thread| [0, 1].map(|k| thread.parts[k].0);
        let widths = self.threads.iter().map(|thread| (thread.width(positions), ends(thread)));
        widths.fold((0.0, [0; 2]), |widest, width| if width.0 > widest.0 { width } else { widest })
    }

    pub(crate) fn add_forces(&self, positions: &[f64], forces: &mut [f64]) {
        for (thread, excess) in self.threads.iter().zip(self.excess(positions)) {
            for &(node, weight) in &thread.parts {
                for (axis, excess) in excess.iter().enumerate() {
                    forces[3 * node as usize + axis] -= weight * STIFFNESS * excess;
                }
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
        for Thread { parts } in &self.threads {
            for (k, &(a, weight)) in parts.iter().enumerate() {
                for &(b, other) in &parts[k..] {
                    matrix.add(a as usize, b as usize, &block(weight * other * STIFFNESS));
                }
            }
        }
    }

    /// What lies between the ends of each thread beyond what is left.
    fn excess(&self, positions: &[f64]) -> impl Iterator<Item = [f64; 3]> {
        self.threads.iter().zip(&self.gaps).map(move |(thread, start)| {
            let now = thread.gap(positions);
            [0, 1, 2].map(|axis| now[axis] - self.left * start[axis])
        })
    }
}
