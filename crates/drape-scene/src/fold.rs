use drape_cloth::{Fold, Lattice};

use crate::reader::Reader;

impl Reader<'_> {
    /// A panel with folds, whose ends are given in its own frame, in m, and their angles in rad.
    pub(crate) fn folded(
        &mut self,
        (key, name): (&str, &str),
        lattice: Lattice,
        folds: impl Iterator<Item = ([[f64; 2]; 2], f64)>,
    ) -> Option<Lattice> {
        let grain = lattice.grain;
        let fold = |(ends, angle): ([[f64; 2]; 2], f64)| Fold {
            ends: ends.map(|end| grain.to_material(end)),
            angle,
        };
        let folds: Vec<Fold> = folds.map(fold).collect();
        let folded = lattice.with_folds(&folds).map_err(|error| {
            let help =
                "from and to are the ends of a line across the panel, the angle is in degrees";
            self.fail(key, format!("panel \"{name}\": {error}"), help);
        });
        folded.ok()
    }
}
