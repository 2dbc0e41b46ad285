//! Check of grading: panels whose particles are farther apart where the cloth is flat.

use drape_cloth::{GradedPanel, Lattice};
use drape_input::{Remedy, excerpt};

use crate::check::checker::Checker;
use crate::grading::Grading;

/// Reads the run that `[grading]` names.
pub(crate) fn grading(checker: &mut Checker<'_>) -> Option<Grading> {
    let entry = checker.spec.grading.as_ref()?;
    if checker.spec.is_breen() {
        let message = "particles of Breen's model are on one grid";
        checker.fail("grading", message, "leave [grading] out");
        return None;
    }
    let folder = checker.locate("grading.run", &entry.run)?;
    let read = Grading::read(&folder, entry.angle.to_radians());
    let remedy = Remedy::RunWithoutGrading;
    read.map_err(|error| checker.fail("grading.run", error.to_string(), remedy)).ok()
}

/// Returns a panel of a name with larger cells where its curvature allows them.
pub(crate) fn graded(
    checker: &mut Checker<'_>,
    name: &str,
    lattice: &Lattice,
    grading: &Grading,
) -> Option<GradedPanel> {
    let Some(spacing_max) = grading.spacing_max(name) else {
        let message = format!("that run has no panel \"{}\"", excerpt(name));
        checker.fail("grading.run", message, "name a run of this scene");
        return None;
    };
    let graded = lattice.graded(spacing_max);
    let report = |error| {
        let message = format!("panel \"{}\": {error}", excerpt(name));
        checker.fail("grading", message, "leave [grading] out");
    };
    graded.map_err(report).ok()
}
