use drape_collide::Shape;

use crate::collider::Moving;
use crate::panel::Laid;
use crate::reader::Reader;

/// Farthest that a garment may start from every body, in m: a pattern that was made for another figure, or in another
/// frame, is metres off.
const FAR: f64 = 0.5;

impl Reader<'_> {
    /// A garment that starts far from all bodies would be sewn beside them and fall.
    pub(crate) fn near_a_body(&mut self, garments: &[Laid], bodies: &[Moving]) {
        let solid = bodies.iter().filter(|moving| !matches!(moving.body.shape, Shape::Plane));
        let outlines = solid.filter_map(|moving| moving.body.triangulate().ok());
        let vertices: Vec<[f64; 3]> = outlines.flat_map(|outline| outline.vertices).collect();
        if garments.is_empty() || vertices.is_empty() {
            return;
        }
        let places = garments.iter().flat_map(|laid| laid.positions.as_chunks::<3>().0);
        let ends = |axis: usize, points: &mut dyn Iterator<Item = &[f64; 3]>| {
            points.fold([f64::MAX, f64::MIN], |[low, high], point| {
                [low.min(point[axis]), high.max(point[axis])]
            })
        };
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
            let help = "was the pattern made for another body? shift it with center = [x, y, z]";
            self.fail("garment", message, help);
        }
    }
}
