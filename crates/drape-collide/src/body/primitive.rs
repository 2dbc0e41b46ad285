//! Exact signed distances from a ball, a box and a cylinder, in the body's frame.
//!
//! The box and the cylinder have a *core*: the solid that is smaller by the edge radius on all
//! sides. The rounded solid is the set of points within the edge radius of the core. The distance
//! from the rounded solid is therefore the distance from the core less the radius, inside as well
//! as outside.

use super::signed_distance::SignedDistance;
use crate::vector::{Vector, combine, norm, outer, projection, scale};

/// Returns the [`SignedDistance`] of `point` from a ball about the origin, all in m.
pub(crate) fn sphere(point: Vector, radius: f64) -> SignedDistance {
    let length = norm(point);
    if length == 0.0 {
        // At the centre every direction is a normal.
        return SignedDistance::flat(-radius, [0.0, 1.0, 0.0]);
    }
    let normal = scale(point, 1.0 / length);
    SignedDistance {
        distance: length - radius,
        normal,
        curvature: projection(normal).map(|c| c / length),
    }
}

/// Returns the [`SignedDistance`] of `point` from a rounded box. `core` holds the half extents of
/// the core, in m.
pub(crate) fn cuboid(point: Vector, core: Vector, edge_radius: f64) -> SignedDistance {
    let sign = point.map(|p| if p < 0.0 { -1.0 } else { 1.0 });
    let excess: Vector = std::array::from_fn(|k| point[k].abs() - core[k]);
    let beyond = excess.map(|e| e > 0.0);

    // Inside the core the nearest side decides.
    if !beyond.contains(&true) {
        let nearest = (1..3).fold(0, |best, k| if excess[k] > excess[best] { k } else { best });
        let mut normal = [0.0; 3];
        normal[nearest] = sign[nearest];
        return SignedDistance::flat(excess[nearest] - edge_radius, normal);
    }
    // Outside, only the axes beyond the core count: one at a face, two at an edge, three at
    // a corner.
    let away: Vector = std::array::from_fn(|k| if beyond[k] { sign[k] * excess[k] } else { 0.0 });
    let length = norm(away);
    let normal = scale(away, 1.0 / length);
    let mut curvature = outer(normal).map(|c| -c / length);
    for k in 0..3 {
        if beyond[k] {
            curvature[4 * k] += 1.0 / length;
        }
    }
    SignedDistance { distance: length - edge_radius, normal, curvature }
}

/// Returns the [`SignedDistance`] of `point` from a rounded cylinder about the y axis. `core` holds
/// radius and half height of the core, in m.
pub(crate) fn cylinder(point: Vector, core: [f64; 2], edge_radius: f64) -> SignedDistance {
    let [x, y, z] = point;
    let radius = x.hypot(z);
    let radial = if radius > 0.0 { [x / radius, 0.0, z / radius] } else { [1.0, 0.0, 0.0] };
    let along = [-radial[2], 0.0, radial[0]];
    let axial = [0.0, if y < 0.0 { -1.0 } else { 1.0 }, 0.0];
    let [side, cap] = [radius - core[0], y.abs() - core[1]];
    let is_inside = side <= 0.0 && cap <= 0.0;
    let (out, up) = if is_inside {
        if side <= cap {
            return SignedDistance::flat(cap - edge_radius, axial);
        }
        (1.0, 0.0)
    } else {
        (side.max(0.0), cap.max(0.0))
    };
    // The nearest point is on the wall (`out` only), the cap (`up` only) or the rim (both).
    let length = out.hypot(up);
    let normal = [radial[0] * out / length, axial[1] * up / length, radial[2] * out / length];
    // The wall bends around the axis, the rim also from the wall to the cap.
    let mut curvature = [0.0; 9];
    if out > 0.0 && radius > 0.0 {
        curvature = outer(along).map(|c| c * out / (length * radius));
    }
    if out > 0.0 && up > 0.0 {
        let over = [-radial[0] * up / length, axial[1] * out / length, -radial[2] * up / length];
        curvature = combine(&curvature, 1.0, &outer(over), 1.0 / length);
    }
    let distance = if is_inside { side } else { length };
    SignedDistance { distance: distance - edge_radius, normal, curvature }
}
