//! Maps of a garment's strains, as one SVG file.

use drape::cloth::TriangleStrain;
use drape::dynamics::Snapshot;
use drape::export::rounded_up;
use drape::render::{Colour, diverging};
use drape::report::plot::{StrainMap, strain_svg};

use super::picture::SnapshotPictures;
use crate::failure::Failure;

/// Azimuths of the maps, in degrees: front and back.
const SIDES: [f64; 2] = [0.0, 180.0];

/// Fraction of the cloth's area whose values may lie beyond the scale of a map.
const BEYOND_SCALE: f64 = 0.01;

/// A component of the strain that a map shows.
struct StrainComponent {
    caption: &'static str,
    unit: &'static str,
    /// Returns the component, in `unit`.
    value: fn(&TriangleStrain) -> f64,
}

const COMPONENTS: [StrainComponent; 3] = [
    StrainComponent {
        caption: "strain along the warp",
        unit: "%",
        value: |strain| 100.0 * strain.warp,
    },
    StrainComponent {
        caption: "strain along the weft",
        unit: "%",
        value: |strain| 100.0 * strain.weft,
    },
    StrainComponent {
        caption: "shear angle",
        unit: "°",
        value: |strain| strain.shear.to_degrees(),
    },
];

/// Value of a triangle, weighted by the triangle's area in m².
struct Weighted {
    value: f64,
    area: f64,
}

/// Draws the strains of a garment from the front and from the back as SVG, one map for each of
/// [`COMPONENTS`].
pub(crate) fn draw_strains(
    snapshot: &Snapshot,
    pictures: &SnapshotPictures<'_>,
) -> Result<String, Failure> {
    let maps = COMPONENTS.iter().map(|StrainComponent { caption, unit, value }| {
        let strains = snapshot.strains.iter();
        let values: Vec<Weighted> =
            strains.map(|strain| Weighted { value: value(strain), area: strain.area }).collect();
        let limit = scale_limit(&values);
        let tints: Vec<Colour> =
            at_particles(snapshot, &values).iter().map(|value| diverging(*value, limit)).collect();
        let (caption, unit) = ((*caption).to_owned(), (*unit).to_owned());
        let picture = pictures.draw_sides(&SIDES, Some(&tints))?;
        Ok(StrainMap { caption, limit, unit, picture })
    });
    let maps: Result<Vec<StrainMap>, Failure> = maps.collect();
    strain_svg(&maps?).map_err(|error| Failure::Output(error.to_string()))
}

/// Returns the absolute value below which all but [`BEYOND_SCALE`] of the area lies, rounded up to
/// 1, 2 or 5 times a power of ten.
fn scale_limit(values: &[Weighted]) -> f64 {
    let values = values.iter();
    let mut sizes: Vec<Weighted> =
        values.map(|&Weighted { value, area }| Weighted { value: value.abs(), area }).collect();
    sizes.sort_by(|a, b| b.value.total_cmp(&a.value));
    let mut remaining = BEYOND_SCALE * sizes.iter().map(|size| size.area).sum::<f64>();
    let first = sizes.iter().find(|size| {
        remaining -= size.area;
        remaining <= 0.0
    });
    let size = first.map_or(0.0, |size| size.value).max(1e-6);
    rounded_up(size)
}

/// Returns for each particle the mean of `values` over the triangles around it, weighted by area.
fn at_particles(snapshot: &Snapshot, values: &[Weighted]) -> Vec<f64> {
    let mut sums = vec![(0.0, 0.0); snapshot.positions.len() / 3];
    for (triangle, Weighted { value, area }) in snapshot.triangles.iter().zip(values) {
        for corner in triangle {
            let (sum, total_area) = &mut sums[*corner as usize];
            *sum += area * value;
            *total_area += area;
        }
    }
    sums.into_iter()
        .map(|(sum, total_area)| if total_area > 0.0 { sum / total_area } else { 0.0 })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn weighted<const N: usize>(values: [[f64; 2]; N]) -> [Weighted; N] {
        values.map(|[value, area]| Weighted { value, area })
    }

    #[test]
    fn a_scale_ends_at_a_round_number_and_leaves_outliers_out() {
        assert_eq!(scale_limit(&weighted([[-0.3, 1.0], [0.1, 1.0]])), 0.5);
        assert_eq!(scale_limit(&weighted([[-70.0, 0.001], [1.7, 0.5], [0.1, 0.5]])), 2.0);
        assert!((scale_limit(&weighted([[0.09, 1.0]])) - 0.1).abs() < 1e-12);
        assert!(scale_limit(&[]) > 0.0);
    }
}
