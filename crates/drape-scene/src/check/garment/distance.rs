//! Distance of garments from their bodies at the start, and sizes of bodies that wear them.

use drape_collide::Shape;

use crate::check::body::CheckedBody;
use crate::check::checker::Checker;
use crate::check::panel::PlacedPanel;
use crate::check::start::places::PlaceRemedy;
use crate::spec::body::MeshSpec;
use crate::wearing::solids::Solids;

/// Largest distance of a garment from every body at the start, in m: a pattern that was made for
/// another figure, or in another frame, is metres off.
const FAR: f64 = 0.5;

/// Sizes of the figures that wear garments, from a doll's to a statue's, in m.
const FIGURES: [f64; 2] = [0.1, 5.0];

/// Checks the sizes of bodies: a figure from a file in another unit is a hundred times too large,
/// or as much too small.
fn check_sizes(checker: &mut Checker<'_>, bodies: &[CheckedBody]) {
    let spec = checker.spec;
    for CheckedBody { body, .. } in bodies {
        let Shape::Mesh(mesh) = &body.shape else { continue };
        let vertices = mesh.vertices();
        let size = |axis: usize| {
            let [low, high] = ends(axis, &mut vertices.iter());
            high - low
        };
        let size = size(0).max(size(1)).max(size(2));
        let named = |(index, mesh): (usize, &MeshSpec)| {
            let name = mesh.common().name.map_or(format!("mesh {}", index + 1), str::to_owned);
            name == body.name
        };
        let index = spec.collider.mesh.iter().enumerate().position(named).unwrap_or(0);
        // Its unit has been asked for.
        let is_asked = !checker.is_sound(&format!("collider.mesh[{index}].file"));
        if !is_asked && !(FIGURES[0]..=FIGURES[1]).contains(&size) {
            let [low, high] = FIGURES;
            let message = format!(
                "\"{}\" measures {size:.4} m; what wears a garment measures {low} to {high} m",
                body.name
            );
            let help =
                "set scale to the metres that a unit of its file stands for: 0.01 for centimetres";
            checker.fail(&format!("collider.mesh[{index}].scale"), message, help);
        }
    }
}

/// Checks that garments start near a body: one that is far from all would be sewn beside them and
/// fall.
pub(crate) fn check_distance(
    checker: &mut Checker<'_>,
    garments: &[PlacedPanel],
    bodies: &[CheckedBody],
) {
    if !garments.is_empty() {
        check_sizes(checker, bodies);
    }
    let solid = bodies.iter().filter(|checked| !matches!(checked.body.shape, Shape::Plane));
    let outlines = solid.filter_map(|checked| checked.body.triangulate().ok());
    let vertices: Vec<[f64; 3]> = outlines.flat_map(|outline| outline.vertices).collect();
    if garments.is_empty() || vertices.is_empty() {
        return;
    }
    let places = garments.iter().flat_map(|placed| placed.positions.as_chunks::<3>().0);
    let gap = |axis: usize| {
        let [low, high] = ends(axis, &mut places.clone());
        let [bottom, top] = ends(axis, &mut vertices.iter());
        if low > top { low - top } else { -(bottom - high).max(0.0) }
    };
    let gaps = [0, 1, 2].map(gap);
    let distance = gaps.iter().map(|gap| gap * gap).sum::<f64>().sqrt();
    if distance > FAR {
        let [x, y, z] = gaps;
        let message = format!(
            "no panel is within {FAR} m of a body: they start {distance:.2} m away ({x:+.2}, {y:+.2}, {z:+.2}) m"
        );
        let solids = Solids::new(bodies.iter().map(|checked| &checked.body));
        let places: Vec<[f64; 3]> = places.copied().collect();
        // Its girths are measured with its seams, which need sound panels.
        let shift = solids.and_then(|solids| solids.shift(&places, None));
        let remedy = PlaceRemedy::new(checker, 0, shift);
        let help = format!("was the pattern made for another body? {}", remedy.help);
        let mistake = checker.fail("garment[0]", message, &help);
        remedy.attach(checker, mistake, 0);
    }
}

/// Returns the smallest and the largest value of a coordinate.
fn ends(axis: usize, points: &mut dyn Iterator<Item = &[f64; 3]>) -> [f64; 2] {
    points.fold([f64::MAX, f64::MIN], |[low, high], point| {
        [low.min(point[axis]), high.max(point[axis])]
    })
}
