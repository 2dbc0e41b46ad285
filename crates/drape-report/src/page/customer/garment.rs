//! Garment of the fabrics on a body: girths and ease at bust, waist and hip.

use serde::Serialize;

use crate::check;
use crate::error::Error;

/// Garment in a report, from a run of a scene.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct ReportedGarment {
    /// Name in the scene.
    pub name: String,
    /// Run that it is from, and its fabrics, in a sentence.
    pub source: String,
    /// Girths from the top down.
    pub girths: Vec<ReportedGirth>,
}

/// Girths of a garment and of its body at a height, in m.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct ReportedGirth {
    /// Name of the place, such as "waist".
    pub place: String,
    /// Height.
    pub height: f64,
    /// Height at which the garment was measured, where that is another one.
    pub garment_height: Option<f64>,
    /// Girth of the body.
    pub body: f64,
    /// Girth of the garment as worn, if it is known.
    pub garment: Option<f64>,
    /// Girth of the garment in the flat pattern, if it is known.
    pub pattern: Option<f64>,
    /// Remark, such as why a girth is not known; may be empty.
    pub remark: String,
}

impl ReportedGirth {
    /// Returns the ease as worn and in the pattern, in m.
    #[must_use]
    pub fn ease(&self) -> [Option<f64>; 2] {
        [self.garment, self.pattern].map(|girth| Some(girth? - self.body))
    }

    /// Returns its numbers in whole millimetres, with a sign where they are ease: body, garment, ease, girth
    /// in the pattern, ease in the pattern.
    pub(super) fn figures(&self) -> [String; 5] {
        let whole = |length: f64| (1e3 * length).round();
        let girth = |length: Option<f64>| {
            length.map_or_else(|| "–".to_owned(), |length| format!("{:.0}", whole(length)))
        };
        // The ease that is shown is the difference of the girths that are shown.
        let ease = |length: Option<f64>| match length.map(|own| whole(own) - whole(self.body)) {
            None => "–".to_owned(),
            Some(ease) if ease < 0.0 => format!("−{:.0}", -ease),
            Some(ease) => format!("{ease:.0}"),
        };
        [
            girth(Some(self.body)),
            girth(self.garment),
            ease(self.garment),
            girth(self.pattern),
            ease(self.pattern),
        ]
    }

    /// Returns the place with its height, and that of the garment where it is another one.
    pub(super) fn place_text(&self) -> String {
        let at = |height: f64| format!("{:.0} mm", 1e3 * height);
        match self.garment_height {
            Some(own) if (own - self.height).abs() > 5e-4 => {
                format!("at {}, the garment at {}", at(self.height), at(own))
            }
            _ => format!("at {}", at(self.height)),
        }
    }
}

impl ReportedGarment {
    pub(super) fn check(&self) -> Result<(), Error> {
        check::text("the name of a garment", &self.name)?;
        check::text("the source of a garment", &self.source)?;
        for girth in &self.girths {
            check::text("the name of a place", &girth.place)?;
            check::text("a remark on a girth", &girth.remark)?;
            let numbers = [Some(girth.height), girth.garment_height, Some(girth.body)];
            let mut numbers = numbers.into_iter().chain([girth.garment, girth.pattern]).flatten();
            let what = || format!("a girth at the {} of {}", girth.place, self.name);
            numbers.try_for_each(|number| check::number(what, number))?;
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
