//! Sewing of garments.

use drape_cloth::{Cloth, Lattice, SeamBending};
use drape_fabric::Fabric;

use crate::check::checker::Checker;
use crate::scene::garment::Sewing;
use crate::scene::seam::{Seam, SeamPairs};
use crate::spec::garment::SewSpec;

/// Settings of the sewing of a scene.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SewingSettings {
    /// Time until the seams are to be closed, in s.
    seconds: f64,
    /// Bending stiffness of a seam over the bending stiffness of the fabric.
    stiffness: f64,
}

/// Checks the settings of the sewing, if there are seams.
pub(crate) fn sewing_settings(checker: &mut Checker<'_>, is_plain: bool) -> Option<SewingSettings> {
    let spec = checker.spec;
    let SewSpec { seconds, stiffness, .. } = spec.sew;
    if is_plain {
        let usual = SewSpec::default();
        let is_set = (seconds, stiffness) != (usual.seconds, usual.stiffness);
        // A garment with mistakes may have seams.
        if is_set && spec.garment.is_empty() {
            let help = "seams are in the pattern of a [[garment]]";
            checker.fail("sew", "nothing is sewn", help);
        }
        return None;
    }
    if spec.is_breen() {
        let help = "leave it out in a scene with seams";
        checker.fail("model", "\"breen-1994\" cannot sew", help);
    }
    Some(SewingSettings { seconds, stiffness })
}

impl SewingSettings {
    /// Makes the sewing of seams between panels.
    pub(crate) fn sewing(
        self,
        checker: &mut Checker<'_>,
        seams: Vec<Seam>,
        panels: &[(&Lattice, &Fabric)],
    ) -> Option<Sewing> {
        let Self { seconds, stiffness } = self;
        let bending = |seam: &Seam| drape_cloth::Seam {
            stiffness,
            rest_angle: seam.rest_angle,
            ties: seam.pairs.ties.clone(),
            breaks: seam.breaks.clone(),
            ..drape_cloth::Seam::new(seam.pairs.pairs.clone())
        };
        // A seam of one pair, of edges that are too short for the spacing, has nothing to bend.
        let long = seams.iter().filter(|seam| seam.pairs.pairs.len() > 1);
        let bending: Vec<drape_cloth::Seam> = long.map(bending).collect();
        let bending = SeamBending::new(panels, &bending).map_err(|error| {
            let help = "choose another spacing, and report the pattern";
            checker.fail("garment", error.to_string(), help);
        });
        // At the tip of a dart a pair is one particle already.
        let pairs = seams.iter().flat_map(|seam| &seam.pairs.pairs).filter(|[a, b]| a != b);
        let ties = seams.iter().flat_map(|seam| &seam.pairs.ties);
        let pairs = SeamPairs { pairs: pairs.copied().collect(), ties: ties.copied().collect() };
        let cloth = frictionless_cloth(panels).map_err(|error| {
            let help = "choose another spacing, and report the pattern";
            checker.fail("garment", error.to_string(), help);
        });
        Some(Sewing { seams, pairs, cloth: cloth.ok()?, seconds, bending: bending.ok()? })
    }
}

/// Makes a cloth whose laws have no friction: it keeps the account of its strains and of nothing
/// else.
///
/// # Errors
/// The panels make no cloth.
pub(crate) fn frictionless_cloth(
    panels: &[(&Lattice, &Fabric)],
) -> Result<Cloth, drape_cloth::Error> {
    let fabrics: Vec<Fabric> = panels.iter().map(|(_, fabric)| fabric.without_friction()).collect();
    let lattices = panels.iter().map(|(lattice, _)| *lattice);
    Cloth::new(&lattices.zip(&fabrics).collect::<Vec<_>>())
}
