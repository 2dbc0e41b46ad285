use drape::cloth::TriangleStrain;
use drape::dynamics::Snapshot;
use drape::report::{Colour, StrainMap, diverging, strain_svg};

use crate::failure::Failure;
use crate::picture::draw_from;

/// From where a garment's strains are seen: from the front and the back, in degrees around the vertical.
const SIDES: [f64; 2] = [0.0, 180.0];

/// Part of the cloth's area that the ends of a scale leave out.
const BEYOND: f64 = 0.01;

/// What a map shows: its caption, its unit, and how a value in that follows from a strain.
type Kind = (&'static str, &'static str, fn(&TriangleStrain) -> f64);

const KINDS: [Kind; 3] = [
    ("strain along the warp", "%", |strain| 100.0 * strain.warp),
    ("strain along the weft", "%", |strain| 100.0 * strain.weft),
    ("shear angle", "°", |strain| strain.shear.to_degrees()),
];

/// Maps of the strains of a garment, from the front and from the back, as one SVG file.
pub(crate) fn draw_strains(snapshot: &Snapshot) -> Result<String, Failure> {
    let maps = KINDS.iter().map(|(caption, unit, value)| {
        let values: Vec<(f64, f64)> =
            snapshot.strains.iter().map(|strain| (value(strain), strain.area)).collect();
        let limit = limit(&values);
        let tints: Vec<Colour> =
            at_particles(snapshot, &values).iter().map(|value| diverging(*value, limit)).collect();
        let (caption, unit) = ((*caption).to_owned(), (*unit).to_owned());
        let picture = draw_from(snapshot, &SIDES, Some(&tints))?;
        Ok(StrainMap { caption, limit, unit, picture })
    });
    let maps: Result<Vec<StrainMap>, Failure> = maps.collect();
    strain_svg(&maps?).map_err(|error| Failure::Output(error.to_string()))
}

/// What all but a part of the area is below, rounded up to 1, 2 or 5 times a power of ten.
fn limit(values: &[(f64, f64)]) -> f64 {
    let mut sizes: Vec<(f64, f64)> =
        values.iter().map(|(value, area)| (value.abs(), *area)).collect();
    sizes.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut left = BEYOND * sizes.iter().map(|(_, area)| area).sum::<f64>();
    let first = sizes.iter().find(|(_, area)| {
        left -= area;
        left <= 0.0
    });
    let size = first.map_or(0.0, |(size, _)| *size).max(1e-6);
    let power = 10.0_f64.powf(size.log10().floor());
    [1.0, 2.0, 5.0, 10.0]
        .map(|step| step * power)
        .into_iter()
        .find(|limit| *limit >= size)
        .unwrap_or(size)
}

/// The means of the triangles around each particle, which count by their areas.
fn at_particles(snapshot: &Snapshot, values: &[(f64, f64)]) -> Vec<f64> {
    let mut sums = vec![(0.0, 0.0); snapshot.positions.len() / 3];
    for (triangle, (value, area)) in snapshot.triangles.iter().zip(values) {
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

    #[test]
    fn a_scale_ends_at_a_round_number_and_leaves_strays_out() {
        assert_eq!(limit(&[(-0.3, 1.0), (0.1, 1.0)]), 0.5);
        assert_eq!(limit(&[(-70.0, 0.001), (1.7, 0.5), (0.1, 0.5)]), 2.0);
        assert!((limit(&[(0.09, 1.0)]) - 0.1).abs() < 1e-12);
        assert!(limit(&[]) > 0.0);
    }
}
