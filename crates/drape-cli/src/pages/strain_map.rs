//! Maps of a garment's strains, as one SVG file.

use drape::cloth::TriangleStrain;
use drape::dynamics::Snapshot;
use drape::export::rounded_up;
use drape::report::plot::{StrainMap, strain_svg};
use drape::report::{Colour, diverging};

use super::picture::Pictures;
use crate::failure::Failure;

/// Azimuths of the maps: front and back, in degrees.
const SIDES: [f64; 2] = [0.0, 180.0];

/// Fraction of the cloth's area that the scale of a map leaves out.
const BEYOND: f64 = 0.01;

/// A quantity that a map shows.
struct Kind {
    caption: &'static str,
    unit: &'static str,
    /// Returns the value of a strain, in the unit.
    value: fn(&TriangleStrain) -> f64,
}

const KINDS: [Kind; 3] = [
    Kind { caption: "strain along the warp", unit: "%", value: |strain| 100.0 * strain.warp },
    Kind { caption: "strain along the weft", unit: "%", value: |strain| 100.0 * strain.weft },
    Kind { caption: "shear angle", unit: "°", value: |strain| strain.shear.to_degrees() },
];

/// A value of a triangle, weighted by the triangle's area.
struct Weighted {
    value: f64,
    area: f64,
}

/// Draws the strains of a garment from the front and from the back.
pub(crate) fn draw_strains(
    snapshot: &Snapshot,
    pictures: &Pictures<'_>,
) -> Result<String, Failure> {
    let maps = KINDS.iter().map(|Kind { caption, unit, value }| {
        let weighted =
            |strain: &TriangleStrain| Weighted { value: value(strain), area: strain.area };
        let values: Vec<Weighted> = snapshot.strains.iter().map(weighted).collect();
        let limit = limit(&values);
        let tints: Vec<Colour> =
            at_particles(snapshot, &values).iter().map(|value| diverging(*value, limit)).collect();
        let (caption, unit) = ((*caption).to_owned(), (*unit).to_owned());
        let picture = pictures.draw_from(&SIDES, Some(&tints))?;
        Ok(StrainMap { caption, limit, unit, picture })
    });
    let maps: Result<Vec<StrainMap>, Failure> = maps.collect();
    strain_svg(&maps?).map_err(|error| Failure::Output(error.to_string()))
}

/// Returns the size of value that all but a fraction of the area is below, rounded up to 1, 2 or 5
/// times a power of ten.
fn limit(values: &[Weighted]) -> f64 {
    let size = |&Weighted { value, area }: &Weighted| Weighted { value: value.abs(), area };
    let mut sizes: Vec<Weighted> = values.iter().map(size).collect();
    sizes.sort_by(|a, b| b.value.total_cmp(&a.value));
    let mut left = BEYOND * sizes.iter().map(|size| size.area).sum::<f64>();
    let first = sizes.iter().find(|size| {
        left -= size.area;
        left <= 0.0
    });
    let size = first.map_or(0.0, |size| size.value).max(1e-6);
    rounded_up(size)
}

/// Returns the mean at each particle of the triangles around it, weighted by their areas.
fn at_particles(snapshot: &Snapshot, values: &[Weighted]) -> Vec<f64> {
    let mut sums = vec![(0.0, 0.0); snapshot.positions.len() / 3];
    for (triangle, Weighted { value, area }) in snapshot.triangles.iter().zip(values) {
        for corner in triangle {
            let (sum, whole) = &mut sums[*corner as usize];
            *sum += area * value;
            *whole += area;
        }
    }
    sums.into_iter().map(|(sum, whole)| if whole > 0.0 { sum / whole } else { 0.0 }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn weighted<const N: usize>(values: [[f64; 2]; N]) -> [Weighted; N] {
        values.map(|[value, area]| Weighted { value, area })
    }

    #[test]
    fn a_scale_ends_at_a_round_number_and_leaves_outliers_out() {
        assert_eq!(limit(&weighted([[-0.3, 1.0], [0.1, 1.0]])), 0.5);
        assert_eq!(limit(&weighted([[-70.0, 0.001], [1.7, 0.5], [0.1, 0.5]])), 2.0);
        assert!((limit(&weighted([[0.09, 1.0]])) - 0.1).abs() < 1e-12);
        assert!(limit(&[]) > 0.0);
    }
}
