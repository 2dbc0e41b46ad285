//! Placement of a panel in space before it is sewn.

/// Placement of a panel in space: bent to a cylinder or flat, then rotated and translated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    /// Rows of the rotation matrix from the panel's frame, whose z axis points to its right side,
    /// to space.
    pub rotation: [[f64; 3]; 3],
    /// Position of the origin of the panel's frame, in m.
    pub translation: [f64; 3],
    /// Radius of the cylinder to which the panel is bent before it is rotated, in m; `None` if it
    /// is flat.
    ///
    /// The axis runs along the panel's y axis, at this distance behind the right side of the
    /// origin; in front of it if negative.
    pub wrap: Option<f64>,
}

impl Placement {
    /// Returns the placement of a flat panel: rotated about x, then y, then z by `angles`, in rad,
    /// and translated by `translation`, in m.
    #[must_use]
    pub fn new(angles: [f64; 3], translation: [f64; 3]) -> Self {
        let [(sx, cx), (sy, cy), (sz, cz)] = angles.map(f64::sin_cos);
        let rotation = [
            [cy * cz, sx * sy * cz - cx * sz, cx * sy * cz + sx * sz],
            [cy * sz, sx * sy * sz + cx * cz, cx * sy * sz - sx * cz],
            [-sy, sx * cy, cx * cy],
        ];
        Self { rotation, translation, wrap: None }
    }

    /// Returns the placement with the panel bent to a cylinder with the radius `wrap`, in m, or
    /// flat.
    #[must_use]
    pub fn with_wrap(mut self, wrap: Option<f64>) -> Self {
        self.wrap = wrap;
        self
    }

    /// Returns the position in space of a point of the panel, both in m.
    #[must_use]
    pub fn point(&self, [x, y]: [f64; 2]) -> [f64; 3] {
        let [x, z] = match self.wrap {
            None => [x, 0.0],
            // The height of the arc is `r (cos(x/r) − 1)`, written without cancellation.
            Some(r) => [r * (x / r).sin(), -2.0 * r * (0.5 * x / r).sin().powi(2)],
        };
        [0, 1, 2].map(|k| {
            let row = self.rotation[k];
            row[0] * x + row[1] * y + row[2] * z + self.translation[k]
        })
    }

    /// Returns the placement of the panel reflected in its y axis: half a turn about that axis.
    pub(crate) fn turned_over(mut self) -> Self {
        for row in &mut self.rotation {
            row[0] = -row[0];
            row[2] = -row[2];
        }
        self.wrap = self.wrap.map(|radius| -radius);
        self
    }

    /// Returns the placement of a mirror image in the plane x = 0 of space.
    pub(crate) fn mirrored(mut self) -> Self {
        for (row, is_x) in self.rotation.iter_mut().zip([true, false, false]) {
            for (column, number) in row.iter_mut().enumerate() {
                // Both the frame and space are reflected in x.
                if is_x != (column == 0) {
                    *number = -*number;
                }
            }
        }
        self.translation[0] = -self.translation[0];
        self
    }

    /// Returns the rotations about x, then y, then z that [`Placement::new`] takes as `angles`, in
    /// rad.
    #[must_use]
    pub fn angles(&self) -> [f64; 3] {
        let r = &self.rotation;
        let cosine = r[0][0].hypot(r[1][0]);
        let y = (-r[2][0]).atan2(cosine);
        if cosine < 1e-9 {
            // Rotations about x and z have one axis. The whole rotation counts as about x.
            return [(-r[1][2]).atan2(r[1][1]), y, 0.0];
        }
        [r[2][1].atan2(r[2][2]), y, r[1][0].atan2(r[0][0])]
    }

    /// Returns whether all numbers are finite.
    pub(crate) fn is_finite(&self) -> bool {
        let numbers = self.rotation.iter().flatten().chain(&self.translation).chain(&self.wrap);
        numbers.copied().all(f64::is_finite)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;

    fn apart(p: [f64; 3], q: [f64; 3]) -> f64 {
        (0..3).map(|k| (p[k] - q[k]).powi(2)).sum::<f64>().sqrt()
    }

    #[test]
    fn a_quarter_of_a_cylinder_ends_beside_its_axis() {
        let flat = Placement::new([0.0; 3], [0.0; 3]);
        for r in [0.2, -0.2] {
            let bent = flat.with_wrap(Some(r));
            let corner = bent.point([0.2 * FRAC_PI_2, 0.7]);
            assert!(apart(corner, [0.2, 0.7, -r]) < 1e-15, "{corner:?}");
            let far = bent.point([0.2 * PI, 0.0]);
            assert!(apart(far, [0.0, 0.0, -2.0 * r]) < 1e-15, "{far:?}");
        }
        let almost = flat.with_wrap(Some(1e9)).point([0.3, 0.1]);
        assert!(apart(almost, flat.point([0.3, 0.1])) < 1e-9, "{almost:?}");
    }

    #[test]
    fn bending_keeps_lengths_and_the_distance_from_the_axis() {
        let placement = Placement::new([0.3, -1.1, 2.0], [1.0, 2.0, 3.0]).with_wrap(Some(0.15));
        let [x, y] = [0.21, -0.4];
        let step = 1e-6;
        let here = placement.point([x, y]);
        for (dx, dy) in [(step, 0.0), (0.0, step), (0.6 * step, 0.8 * step)] {
            let length = apart(here, placement.point([x + dx, y + dy]));
            assert!((length / step - 1.0).abs() < 1e-8, "{length}");
        }
        let axis = Placement { wrap: None, ..placement };
        let behind = [0, 1, 2].map(|k| axis.point([0.0, y])[k] - 0.15 * axis.rotation[k][2]);
        assert!((apart(here, behind) - 0.15).abs() < 1e-12);
    }

    #[test]
    fn angles_give_the_rotation_again() {
        for angles in
            [[0.3, -1.1, 2.0], [-3.0, 0.2, -0.4], [0.4, FRAC_PI_2, 0.9], [0.4, -FRAC_PI_2, 0.9]]
        {
            let placement = Placement::new(angles, [0.1, 0.2, 0.3]);
            let again = Placement::new(placement.angles(), [0.1, 0.2, 0.3]);
            for point in [[0.3, 0.1], [-0.2, 0.7]] {
                let off = apart(placement.point(point), again.point(point));
                assert!(off < 1e-8, "{angles:?}: {off}");
            }
        }
    }

    #[test]
    fn a_mirrored_point_lies_across_the_plane() {
        let placement = Placement::new([0.3, -1.1, 2.0], [1.0, 2.0, 3.0]).with_wrap(Some(0.15));
        let [x, y, z] = placement.point([0.21, -0.4]);
        let across = placement.mirrored().point([-0.21, -0.4]);
        assert!(apart([-x, y, z], across) < 1e-15, "{across:?}");
    }

    #[test]
    fn turned_over_a_mirrored_point_lies_where_it_lay() {
        let placement = Placement::new([0.3, -1.1, 2.0], [1.0, 2.0, 3.0]).with_wrap(Some(0.15));
        let (before, after) =
            (placement.point([0.21, -0.4]), placement.turned_over().point([-0.21, -0.4]));
        assert!(apart(before, after) < 1e-15, "{before:?} {after:?}");
    }
}
