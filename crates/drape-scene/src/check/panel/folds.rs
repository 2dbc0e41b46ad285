//! Folds of a panel at rest.

use drape_cloth::{Fold, Lattice};

use crate::check::checker::Checker;

/// Folds a panel of a name along lines in its own frame, in m, by angles in rad; mistakes are those
/// of a key.
pub(crate) fn folded(
    checker: &mut Checker<'_>,
    key: &str,
    name: &str,
    panel: UnfoldedPanel<impl Iterator<Item = FoldLine>>,
) -> Option<Lattice> {
    let UnfoldedPanel { lattice, lines } = panel;
    let grain = lattice.grain();
    let fold = |line: FoldLine| Fold {
        ends: line.ends.map(|end| grain.to_material(end)),
        angle: line.angle,
    };
    let folds: Vec<Fold> = lines.map(fold).collect();
    let folded = lattice.with_folds(&folds).map_err(|error| {
        let help = "from and to are the ends of a line across the panel, the angle is in degrees";
        checker.fail(key, format!("panel \"{name}\": {error}"), help);
    });
    folded.ok()
}

/// Panel with the lines along which it is to be folded.
pub(crate) struct UnfoldedPanel<L> {
    pub(crate) lattice: Lattice,
    pub(crate) lines: L,
}

/// Line of a fold.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FoldLine {
    /// Its ends in the panel's frame, in m.
    pub(crate) ends: [[f64; 2]; 2],
    /// Angle by which the panel is turned towards its right side, in rad.
    pub(crate) angle: f64,
}
