//! Pattern cut at one spacing: the cuts of its panels and the nodes of its seams.

use super::panel_cut::Cut;
use super::seam_nodes::SeamNodes;
use crate::note::PatternNote;
use crate::pattern::partition::Partition;

/// Pattern cut at one spacing.
#[derive(Debug, Clone, PartialEq)]
pub struct CutPattern {
    /// Spacing of the particles, in m.
    pub spacing: f64,
    /// Cuts of the panels, in the order of the pattern.
    pub panels: Vec<Cut>,
    /// Nodes of the seams, in the order of the pattern.
    pub seams: Vec<SeamNodes>,
    /// Notes on the cut for its user.
    pub notes: Vec<PatternNote>,
}

impl CutPattern {
    /// Returns the number of particles when all seams are closed. The two nodes of a pair are one
    /// particle. Tied nodes are no particles.
    #[must_use]
    pub fn particle_count(&self) -> usize {
        let mut first = Vec::new();
        let mut count = 0;
        for cut in &self.panels {
            first.push(count);
            count += cut.positions.len();
        }
        let mut particles = Partition::new(count);
        for pair in self.seams.iter().flat_map(|seam| &seam.pairs) {
            let [a, b] = pair.map(|id| first[id.panel] + id.node as usize);
            particles.unite(a, b);
        }
        let tied = self.seams.iter().map(|seam| seam.ties.len()).sum::<usize>();
        particles.set_count() - tied
    }
}
