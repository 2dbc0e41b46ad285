//! Coarser grids of a scene, on which its cloth comes to rest first.

use drape_input::{Diagnostics, Setting, figure};

use super::check as check_scene;
use crate::check::checker::{Checker, UNITS};
use crate::check::documents::Documents;
use crate::error::Error;
use crate::file::SceneFile;
use crate::scene::Scene;
use crate::spacings::{Spacing, spacings};

/// Key of the grids.
const KEY: &str = "refine.spacings";

/// Smallest ratio of the spacings of two grids.
const RATIO_MIN: f64 = 1.1;

/// Largest number of coarser grids.
const GRIDS_MAX: usize = 8;

/// Checks the spacings of the coarser grids, and that the cloth comes to rest on them.
pub(crate) fn check(checker: &mut Checker<'_>) {
    let Some(refine) = &checker.file.refine else { return };
    if checker.file.settle.is_none() {
        let message = "cloth that does not come to rest has no coarser grids";
        checker.fail("refine", message, "add [settle], or leave [refine] out");
    }
    if !(1..=GRIDS_MAX).contains(&refine.spacings.len()) {
        let message = format!("{} coarser grids", refine.spacings.len());
        checker.fail(KEY, message, &format!("name 1 to {GRIDS_MAX}, such as [0.02]"));
        return;
    }
    let unit = checker.unit;
    let Ok(own) = spacings(checker.document()) else { return };
    let grids = refine.spacings.iter().map(|spacing| *spacing * unit);
    let grids: Vec<f64> = grids.chain([own[0].value]).collect();
    // A comparison that NaN fails.
    let too_close = grids.windows(2).position(|pair| !(pair[0] >= 0.999_999 * RATIO_MIN * pair[1]));
    if let Some(index) = too_close {
        let message = format!(
            "a grid of {} mm before one of {} mm",
            figure(1e3 * grids[index]),
            figure(1e3 * grids[index + 1])
        );
        let help = format!(
            "the coarsest comes first and each is {RATIO_MIN} times as coarse as the next or more, the \
             last one against the spacing of the scene"
        );
        checker.fail(&format!("{KEY}[{index}]"), message, &help);
    }
}

/// Returns the scene of a file, which has been checked, on its coarser grids.
///
/// # Errors
/// What keeps it from being simulated there.
pub(crate) fn coarser_scenes(
    documents: &Documents<'_>,
    file: &SceneFile,
) -> Result<Vec<Scene>, Error> {
    let Some(refine) = &file.refine else { return Ok(Vec::new()) };
    let unit = UNITS.iter().find(|(name, _)| file.length.as_deref() == Some(name));
    let unit = unit.map_or(1.0, |(_, unit)| *unit);
    let own = spacings(documents.scene)?;
    let grids = refine.spacings.iter().enumerate();
    grids.map(|(index, spacing)| on_grid(documents, &own, (index, *spacing * unit))).collect()
}

/// Returns the scene on the grid of a number and a spacing, in m.
fn on_grid(
    documents: &Documents<'_>,
    own: &[Spacing],
    (index, spacing): (usize, f64),
) -> Result<Scene, Error> {
    let settings: Vec<Setting> =
        own.iter().map(|part| part.scaled(spacing / own[0].value)).collect();
    let scene = documents.scene.clone().with_settings(&settings)?;
    let (mut file, faults) = scene.decode_with_faults::<SceneFile>()?;
    file.refine = None;
    let documents = Documents { scene: &scene, ..*documents };
    check_scene(&documents, &file, faults).map_err(|error| {
        let message = format!("a grid of {} mm: {error}", figure(1e3 * spacing));
        let mistake = documents.scene.at(&format!("{KEY}[{index}]"), message);
        Diagnostics::from(mistake.help("take a finer one, or leave it out")).into()
    })
}
