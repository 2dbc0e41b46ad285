//! Check of places: whether garments start round a body, with the place that is advised.

use crate::check::checker::Checker;
use crate::scene::Scene;
use crate::wearing::solids::{FEET, GarmentPlace, Solids, extent};
use crate::wearing::{is_held, points, shift_to_body};

/// Results of the check of the places of all garments.
#[derive(Default)]
pub(crate) struct PlaceReport {
    /// Notes on garments about the feet of a figure.
    pub(crate) notes: Vec<String>,
    /// Whether a garment is at a wrong place for which another place is advised.
    pub(crate) advised: bool,
}

/// Checks the places of the garments of `scene`. Garments that pins hold need no body. A garment at
/// a wrong place is a mistake with the advised place as its remedy.
pub(crate) fn check_places(checker: &mut Checker<'_>, scene: &Scene) -> PlaceReport {
    let mut report = PlaceReport::default();
    let Some(solids) = Solids::new(scene.bodies.iter().map(|moving| &moving.body)) else {
        return report;
    };
    for (number, garment) in scene.garments.iter().enumerate() {
        if is_held(scene, garment) {
            continue;
        }
        let points = points(scene, garment);
        let place = solids.place(&points);
        if place == GarmentPlace::About
            || (matches!(place, GarmentPlace::Inside { .. }) && grows(scene))
        {
            continue;
        }

        let fault = describe(&garment.name, place, &points, &solids);
        let shift = shift_to_body(scene, &solids, garment, &points);
        let remedy = PlaceRemedy::new(checker, number, shift);

        match place {
            GarmentPlace::Feet => report.notes.push(format!("{fault}; {}", remedy.help)),
            _ => {
                let key = format!("garment[{number}].pattern");
                let mistake = checker.fail(&key, fault, &remedy.help);
                remedy.attach(checker, mistake, number);
                report.advised |= shift.is_some();
            }
        }
    }
    report
}

/// Returns whether the bodies of `scene` grow at the start.
fn grows(scene: &Scene) -> bool {
    scene.contact.inflation.is_some()
}

/// Describes where `garment`, with its particles at `points`, starts relative to `solids`.
fn describe(
    garment: &str,
    place: GarmentPlace,
    points: &[[f64; 3]],
    solids: &Solids<'_>,
) -> String {
    let [low, high] = extent(points.iter());
    let [bottom, top] = [solids.low[1], solids.high[1]];
    let heights = format!(
        "between {:.2} and {:.2} m, and the body is between {bottom:.2} and {top:.2} m",
        low[1], high[1]
    );

    match place {
        GarmentPlace::Feet | GarmentPlace::About => {
            format!("\"{garment}\" starts about the feet of the body: it is {heights}")
        }
        GarmentPlace::Inside { fraction } => {
            let percent = match 100.0 * fraction {
                percent if percent < 1.0 => "Less than 1".to_owned(),
                percent => format!("{percent:.0}"),
            };
            format!("{percent} % of \"{garment}\" starts inside the body: it is {heights}")
        }
        GarmentPlace::Beside { fraction } => {
            let side = if high[1] < bottom + FEET * (top - bottom) {
                "at the feet of"
            } else if low[1] > top {
                "above"
            } else {
                "beside"
            };
            format!(
                "\"{garment}\" starts {side} the body, not about it: it goes round it at {:.0} % of its heights; it is \
                 {heights}",
                100.0 * fraction
            )
        }
    }
}

/// Remedy for a wrong place of a garment, in words and as the TOML value of its `center`, if a
/// place was found.
pub(crate) struct PlaceRemedy {
    pub(crate) help: String,
    center: Option<String>,
}

impl PlaceRemedy {
    /// Returns the remedy for the garment with the number `garment`. `shift` leads to the place
    /// that was found, in m.
    pub(crate) fn new(checker: &Checker<'_>, garment: usize, shift: Option<[f64; 3]>) -> Self {
        let (Some(shift), Some(entry)) = (shift, checker.spec.garment.get(garment)) else {
            let help = "no place about the body was found: does the pattern fit it? turn or move its panels";
            return Self { help: help.into(), center: None };
        };
        let unit = checker.spec.length.metres();
        let [x, y, z] = [0, 1, 2].map(|k| (entry.center[k] + shift[k]) / unit);
        let digits = if unit == 1.0 { 3 } else { 0 };
        let center = format!("[{x:.digits$}, {y:.digits$}, {z:.digits$}]");
        let help =
            format!("write center = {center} in its [[garment]]; there it is about the body");
        Self { help, center: Some(center) }
    }

    /// Attaches the new `center` of the garment with the number `garment` to the mistake with the
    /// index `mistake`.
    pub(crate) fn attach(&self, checker: &mut Checker<'_>, mistake: usize, garment: usize) {
        if let Some(center) = &self.center {
            checker.remedy(mistake, &format!("garment[{garment}].center"), Some(center));
        }
    }
}
