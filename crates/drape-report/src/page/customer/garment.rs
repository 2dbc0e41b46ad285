//! Garment of the fabrics on a body: girths and ease at bust, waist and hip.

use serde::Serialize;

use crate::check;
use crate::error::Error;

/// Garment in a report, from a run of a scene.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct ReportedGarment {
    /// Name in the scene.
    pub name: String,
    /// Run of the garment and its fabrics, in a sentence.
    pub source: String,
    /// Girths from the top to the bottom.
    pub girths: Vec<ReportedGirth>,
}

/// Girths of a garment and of its body at one height, in m.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct ReportedGirth {
    /// Name of the place, such as "waist".
    pub place: String,
    /// Height on the body.
    pub height: f64,
    /// Height at which the garment was measured, where it differs from `height`.
    pub garment_height: Option<f64>,
    /// Girth of the body.
    pub body: f64,
    /// Girth of the garment as worn, if it is known.
    pub garment: Option<f64>,
    /// Girth of the garment in the flat pattern, if it is known.
    pub pattern: Option<f64>,
    /// Remark, such as the reason why a girth is not known. The text may be empty.
    pub remark: String,
}

impl ReportedGirth {
    /// Returns the ease in the worn garment and in the flat pattern, in m. The ease is the girth
    /// minus the girth of the `body`.
    #[must_use]
    pub fn ease(&self) -> [Option<f64>; 2] {
        [self.garment, self.pattern].map(|girth| Some(girth? - self.body))
    }

    /// Returns the numbers in whole millimetres: `body`, `garment`, its ease, `pattern`, its ease.
    /// A negative ease has a sign.
    pub(super) fn figures(&self) -> [String; 5] {
        let [ease, pattern_ease] =
            [self.garment, self.pattern].map(|girth| shown_ease(girth, self.body));
        [
            shown_girth(Some(self.body)),
            shown_girth(self.garment),
            ease,
            shown_girth(self.pattern),
            pattern_ease,
        ]
    }

    /// Returns the `height` of the place in words, with the `garment_height` where it differs.
    pub(super) fn place_text(&self) -> String {
        let millimetres = |height: f64| format!("{:.0} mm", 1e3 * height);
        match self.garment_height {
            Some(garment) if (garment - self.height).abs() > 5e-4 => {
                format!("at {}, the garment at {}", millimetres(self.height), millimetres(garment))
            }
            _ => format!("at {}", millimetres(self.height)),
        }
    }
}

/// Returns a `length`, in m, in whole millimetres.
fn whole(length: f64) -> f64 {
    (1e3 * length).round()
}

/// Returns a girth, in m, as text in millimetres, or a dash for `None`.
fn shown_girth(girth: Option<f64>) -> String {
    girth.map_or_else(|| "–".to_owned(), |girth| format!("{:.0}", whole(girth)))
}

/// Returns the ease of a `girth` on a `body`, in m, as text in millimetres, or a dash without a
/// girth.
///
/// The shown ease is the difference of the shown girths.
fn shown_ease(girth: Option<f64>, body: f64) -> String {
    match girth.map(|girth| whole(girth) - whole(body)) {
        None => "–".to_owned(),
        Some(ease) if ease < 0.0 => format!("−{:.0}", -ease),
        Some(ease) => format!("{ease:.0}"),
    }
}

impl ReportedGarment {
    /// Refuses texts that cannot be shown and girths that are not finite, as [`Error`].
    pub(super) fn check(&self) -> Result<(), Error> {
        check::text("the name of a garment", &self.name)?;
        check::text("the source of a garment", &self.source)?;
        for girth in &self.girths {
            check::text("the name of a place", &girth.place)?;
            check::text("a remark on a girth", &girth.remark)?;
            let numbers = [Some(girth.height), girth.garment_height, Some(girth.body)];
            let numbers = numbers.into_iter().chain([girth.garment, girth.pattern]).flatten();
            for number in numbers {
                check::number(
                    || format!("a girth at the {} of {}", girth.place, self.name),
                    number,
                )?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ease_is_the_difference_of_the_girths_that_are_shown() {
        let girth = ReportedGirth {
            height: 1.08,
            body: 0.6694,
            garment: Some(0.6606),
            pattern: Some(0.66),
            ..ReportedGirth::default()
        };
        assert_eq!(girth.figures(), ["669", "661", "−8", "660", "−9"]);
        let [ease, _] = girth.ease();
        assert!((ease.unwrap_or_default() + 0.0088).abs() < 1e-12);
        let open = ReportedGirth { garment: None, pattern: None, ..girth };
        assert_eq!(open.figures(), ["669", "–", "–", "–", "–"]);
        assert_eq!(open.place_text(), "at 1080 mm");
        let below = ReportedGirth { garment_height: Some(1.05), ..open };
        assert_eq!(below.place_text(), "at 1080 mm, the garment at 1050 mm");
    }
}
