//! Fold lines, along which a panel is bent at rest, and the rest curvature that they give to
//! connectors.

/// Component of a line's normal below which the line counts as along a yarn: rounding.
const ALONG: f64 = 1e-6;

/// Distance over which a slanting fold is rounded on both sides of its line, in spacings.
///
/// Without rounding, a fold of 90° at 30° to the yarns came to 54° at 10 mm. With 1 spacing it came
/// to 91°, with 2 to 90°. A fold through a rim came to 74°, 82° and 88°.
const ROUNDING: f64 = 2.0;

/// Straight line along which a panel is folded at rest: a crease, or the edge of a pleat.
///
/// A panel that is folded by an angle `$\alpha$` along a line has the rest curvature
/// `$\alpha\,\delta(d)\,nn^T$` with the distance `$d$` from the line and its normal `$n$` in the
/// panel. A connector gets the part that it would measure on a panel so folded: the second
/// difference of `$\max(d, 0)$`. Along each yarn that crosses the line these parts add up to the
/// whole fold, wherever the nodes are. A yarn along which the normal has the component `$n_y$`
/// turns, for a fraction `$w$` of the angle, by
///
/// ```math
/// \beta = 2\arcsin\left(|n_y|\sin\frac{w\alpha}{2}\right),\qquad \kappa_0 = \beta/h
/// ```
///
/// as a straight line on a folded sheet of paper does. A slanting fold is rounded over two spacings
/// on each side. Within a spacing of an outline a part of the angle is lost, because yarns end
/// there.
///
/// Bending along the yarns cannot distinguish a slanting fold from its mirror image about a yarn;
/// twist could. The places of the folded connectors decide between the two forms, since cloth
/// hardly stretches. The crease adds no stiffness: along it and across it the fabric's laws hold,
/// with friction, which keeps a cloth that starts flat from reaching the whole angle.
///
/// ```
/// use drape_cloth::{Fold, Lattice};
///
/// let strip = Lattice::rectangle(0.2, 0.05, 0.01)?;
/// let crease = Fold { ends: [[0.1, -0.01], [0.1, 0.06]], angle: 1.0 };
/// assert_eq!(strip.with_folds(&[crease])?.folds(), [crease]);
/// # Ok::<(), drape_cloth::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fold {
    /// Ends of the line in material coordinates (u along the weft, v along the warp), in m. They
    /// may lie outside the panel.
    pub ends: [[f64; 2]; 2],
    /// Angle by which the panel is turned towards its right side, in rad.
    pub angle: f64,
}

/// Node of a connector at rest and its weight in the second difference.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WeightedPoint {
    /// Material coordinates, in m.
    pub(crate) coordinates: [f64; 2],
    /// Weight, in 1/m².
    pub(crate) weight: f64,
}

/// Coordinates of a point along and across a line, in m.
pub(crate) struct LineCoordinates {
    /// Length of the line before the point.
    pub(crate) along: f64,
    /// Distance of the point from the line, positive at the left.
    pub(crate) left: f64,
}

impl Fold {
    /// Largest angle of a fold, in rad. Up to this value angles are exact.
    pub const ANGLE_MAX: f64 = 140.0 * std::f64::consts::PI / 180.0;

    fn span(&self) -> [f64; 2] {
        let [from, to] = self.ends;
        [to[0] - from[0], to[1] - from[1]]
    }

    /// Returns the length of the line, from one of its `ends` to the other, in m.
    pub(crate) fn length(&self) -> f64 {
        let span = self.span();
        span[0].hypot(span[1])
    }

    /// Returns the unit vector along the line, from the first of its `ends`.
    pub(crate) fn direction(&self) -> [f64; 2] {
        let length = self.length();
        self.span().map(|x| x / length)
    }

    /// Returns the coordinates of `point` along the line and across it.
    pub(crate) fn coordinates(&self, point: [f64; 2]) -> LineCoordinates {
        let [x, y] = self.direction();
        let arm = [point[0] - self.ends[0][0], point[1] - self.ends[0][1]];
        LineCoordinates { along: x * arm[0] + y * arm[1], left: x * arm[1] - y * arm[0] }
    }

    /// Returns the component of the line's normal along the weft (`direction` 1) or the warp (0).
    fn across(&self, direction: usize) -> f64 {
        self.direction()[direction].abs()
    }

    /// Returns the angle by which a yarn along `direction` turns, in rad. `part` is its part of the
    /// fold: the second difference of `$\max(d, 0)$` over the spacing. A part above one, which a
    /// fit may have, counts in proportion.
    fn turning_angle(&self, part: f64, direction: usize) -> f64 {
        let across = self.across(direction).max(ALONG);
        let half = 0.5 * self.angle * (part.abs() / across).min(1.0);
        let straight = 2.0 * across * half;
        let slanted = 2.0 * (across * half.sin()).asin();
        part * self.angle * if straight == 0.0 { 1.0 } else { slanted / straight }
    }

    /// Returns the distance over which the fold is rounded on both sides of the line, in m. It is
    /// zero for a fold along a yarn. `spacing` holds the spacings along weft and warp.
    ///
    /// A sharp fold that slants would meet the two yarns at a node with two different parts of its
    /// angle, and stretch the cells between them.
    fn rounding(&self, spacing: [f64; 2]) -> f64 {
        let slants = self.across(0).min(self.across(1)) > ALONG;
        if slants { ROUNDING * (spacing[0] * spacing[1]).sqrt() } else { 0.0 }
    }

    /// Returns the height, per angle, of a point at `distance` from the line over the plane at the
    /// right of the line, in m. The curvature falls from the line to zero over `rounding`.
    fn height(distance: f64, rounding: f64) -> f64 {
        if distance.abs() >= rounding {
            return distance.max(0.0);
        }
        let beyond = (distance + rounding).max(0.0).powi(3) / 6.0;
        let at_line = distance.max(0.0).powi(3) / 6.0;
        (beyond - 2.0 * at_line) / (rounding * rounding)
    }

    /// Returns the rest curvature that the fold adds to a connector along `direction`, in 1/m.
    /// `nodes` are the nodes of its second difference and `middle` is its middle. `spacing` holds
    /// the spacings along weft and warp.
    pub(crate) fn rest_curvature(
        &self,
        nodes: impl Iterator<Item = WeightedPoint>,
        middle: [f64; 2],
        direction: usize,
        spacing: [f64; 2],
    ) -> f64 {
        let yarn_spacing = spacing[1 - direction];
        let (along, rounding) = (self.coordinates(middle).along, self.rounding(spacing));
        // The last nodes before an outline lie beyond the end of a line that ends at the outline.
        if !(-yarn_spacing..=self.length() + yarn_spacing).contains(&along) {
            return 0.0;
        }
        let terms = nodes.map(|node| {
            node.weight * Self::height(self.coordinates(node.coordinates).left, rounding)
        });
        let difference: f64 = terms.sum();
        self.turning_angle(difference * yarn_spacing, direction) / yarn_spacing
    }
}
