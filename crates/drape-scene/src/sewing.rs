use drape_cloth::{Cloth, Lattice, SeamBending};
use drape_fabric::Fabric;
use drape_input::Diagnostic;

use crate::file::SceneFile;
use crate::garment::Seam;
use crate::panel::Laid;
use crate::reader::Reader;
use crate::scene::without_friction;
use crate::stitching::Stitching;

/// How long the sides of the seams are drawn together when the scene does not say, in s.
const SECONDS: f64 = 1.0;

/// How a garment is sewn before it hangs: the sides of all seams are drawn together, without gravity and without inertia,
/// and then become one.
#[derive(Debug, Clone)]
pub struct Sewing {
    /// The seams.
    pub seams: Vec<Seam>,
    /// The particles of all of them.
    pub stitching: Stitching,
    /// The cloth as it is sewn: its laws have no friction, so that how the sides are drawn together is no history.
    pub cloth: Cloth,
    /// How long it takes, in s.
    pub seconds: f64,
    /// How they bend when they are sewn.
    pub bending: SeamBending,
}

impl Reader<'_> {
    pub(crate) fn sewing(
        &mut self,
        file: &SceneFile,
        seams: Vec<Seam>,
        panels: &[(&Lattice, &Fabric)],
    ) -> Option<Sewing> {
        let seconds = file.sew.seconds.unwrap_or(SECONDS);
        self.within("sew.seconds", seconds, (1e-3, 1e3), "in s; 1 is usual");
        if seams.is_empty() {
            if file.sew.seconds.is_some() || file.sew.stiffness.is_some() {
                let help = "seams are in the pattern of a [[garment]]";
                self.fail("sew", "nothing is sewn".into(), help);
            }
            return None;
        }
        let explicit = file.solver.integrator.as_deref() == Some("explicit");
        for (wrong, key, word) in [
            (explicit, "solver.integrator", "explicit"),
            (file.model.as_deref() == Some("breen-1994"), "model", "breen-1994"),
        ] {
            if wrong {
                let message = format!("\"{word}\" cannot sew");
                self.fail(key, message, "leave it out in a scene with seams");
            }
        }
        let stiffness = file.sew.stiffness.unwrap_or(drape_cloth::Seam::STIFFNESS);
        let help = "how many times as stiff as the fabric a seam is; 3 is usual";
        self.within("sew.stiffness", stiffness, (0.0, 1e3), help);
        let bending = |seam: &Seam| drape_cloth::Seam {
            stiffness,
            rest_angle: seam.angle,
            ties: seam.stitching.ties.clone(),
            ..drape_cloth::Seam::new(seam.stitching.pairs.clone())
        };
        let bending: Vec<drape_cloth::Seam> = seams.iter().map(bending).collect();
        let bending = SeamBending::new(panels, &bending).map_err(|error| {
            self.fail(
                "garment",
                error.to_string(),
                "choose another spacing, and report the pattern",
            );
        });
        let pairs = seams.iter().flat_map(|seam| &seam.stitching.pairs).filter(|[a, b]| a != b);
        let pairs = pairs.copied().collect();
        let ties = seams.iter().flat_map(|seam| &seam.stitching.ties).copied().collect();
        let stitching = Stitching { pairs, ties };
        let cloth = without_friction(panels);
        Some(Sewing { seams, stitching, cloth, seconds, bending: bending.ok()? })
    }

    /// Panels are told apart by their names. Those that the scene itself names twice have been reported.
    pub(crate) fn names_differ(&mut self, file: &SceneFile, laid: &[Laid]) {
        let twice = |name: &str| file.panel.iter().filter(|panel| panel.name == name).count() > 1;
        let laid: Vec<&Laid> = laid.iter().filter(|laid| !twice(&laid.panel.name)).collect();
        for (index, Laid { panel, .. }) in laid.iter().enumerate() {
            if laid[..index].iter().any(|other| other.panel.name == panel.name) {
                let message = format!("there are two panels \"{}\"", panel.name);
                let help = "give each its own name; the panels of a garment with a name are called NAME.PANEL";
                self.mistakes.push(Diagnostic::new(self.document.path(), message).help(help));
            }
        }
    }
}
