//! Chains of edges on the sides of seams, in the order in which their outlines run.
//!
//! A side of a seam is listed in the order in which the seam runs. The listing of edges along or
//! against their outlines does not change how the edges are sewn: the seam runs from one end to the
//! other, or back. A seam whose sides are both listed backwards is turned round, so that each edge
//! begins where the edge before it ends. Called by `pattern` on checked seams.
//!
//! An edge begins where another edge ends if both ends are one corner, or if other seams sew their
//! corners together, as at the mouth of a dart or where two panels meet.

use crate::panel::Panel;
use crate::pattern::partition::Partition;
use crate::pattern::seam::{EdgeId, Seam};

/// Corners of the panels of a pattern, and which of them seams join.
struct Corners {
    /// Number of the first corner of each panel. Corner `k` of a panel is where its edge `k`
    /// begins.
    first: Vec<usize>,
    joined: Partition,
}

/// Number of neighbours on a side that are listed along their outlines, and against them.
#[derive(Default)]
struct Listing {
    along: usize,
    against: usize,
}

/// Turns each of `seams` round whose sides are listed against the direction of the seam.
pub(crate) fn turn_listings(panels: &[Panel], seams: &mut [Seam]) {
    let mut corners = Corners::new(panels);
    let mut undecided: Vec<usize> = Vec::new();
    for (number, seam) in seams.iter().enumerate() {
        if seam.sides.iter().all(|side| side.len() == 1) {
            corners.join(panels, seam);
        } else {
            undecided.push(number);
        }
    }

    // A decided seam joins corners. These corners may decide further seams.
    loop {
        let before = undecided.len();
        undecided.retain(|&number| {
            let seam = &mut seams[number];
            let listing = corners.listing(panels, seam);
            let is_decided = (listing.along > 0) != (listing.against > 0);
            if is_decided && listing.against > 0 {
                seam.sides.iter_mut().for_each(|side| side.reverse());
            }
            if is_decided {
                corners.join(panels, seam);
            }
            !is_decided
        });
        if undecided.len() == before {
            break;
        }
    }
}

impl Corners {
    fn new(panels: &[Panel]) -> Self {
        let mut first = Vec::new();
        let mut count = 0;
        for panel in panels {
            first.push(count);
            count += panel.edges().count();
        }
        Self { first, joined: Partition::new(count) }
    }

    /// Returns the corners at which the edge `id` begins and ends on a side of a seam that runs
    /// `along` outlines, or against them.
    fn ends(&self, panels: &[Panel], id: EdgeId, along: bool) -> [usize; 2] {
        let next = panels[id.panel].next_edge(id.edge);
        let ends = [id.edge, next].map(|corner| self.first[id.panel] + corner);
        if along { ends } else { [ends[1], ends[0]] }
    }

    /// Joins the corners at the ends of both sides of `seam`.
    fn join(&mut self, panels: &[Panel], seam: &Seam) {
        let along = [true, seam.reversed];
        let ends = [0, 1].map(|side| {
            let ids = &seam.sides[side];
            let [begin, _] = self.ends(panels, ids[0], along[side]);
            let [_, end] = self.ends(panels, ids[ids.len() - 1], along[side]);
            [begin, end]
        });
        (0..2).for_each(|end| self.joined.unite(ends[0][end], ends[1][end]));
    }

    /// Counts the neighbours on both sides of `seam` that are listed along and against outlines.
    fn listing(&self, panels: &[Panel], seam: &Seam) -> Listing {
        let along = [true, seam.reversed];
        let mut listing = Listing::default();
        for (side, along) in seam.sides.iter().zip(along) {
            for pair in side.windows(2) {
                let [[begin, end], [next_begin, next_end]] = [pair[0], pair[1]]
                    .map(|id| self.ends(panels, id, along))
                    .map(|ends| ends.map(|corner| self.joined.root(corner)));
                let (follows, precedes) = (end == next_begin, next_end == begin);
                if follows && !precedes {
                    listing.along += 1;
                } else if precedes && !follows {
                    listing.against += 1;
                }
            }
        }
        listing
    }
}
