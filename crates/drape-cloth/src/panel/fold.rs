//! Fold lines, along which a panel is bent at rest, and the rest curvature that they give a
//! connector.

/// Component of a line's normal below which the line counts as along a yarn: rounding.
const ALONG: f64 = 1e-6;

/// Distance over which a slanting fold is rounded on both sides of its line, in spacings.
///
/// Without rounding a fold of 90° at 30° to the yarns came to 54° at 10 mm, with 1 spacing to 91°,
/// with 2 to 90°; one through a rim came to 74°, 82° and 88°.
const ROUNDING: f64 = 2.0;

/// Straight line along which a panel is folded at rest: a crease, or the edge of a pleat.
///
/// A panel that is folded by an angle `$\alpha$` along a line has the rest curvature
/// `$\alpha\,\delta(d)\,nn^T$` with the distance `$d$` from the line and its normal `$n$` in the
/// panel. A connector has of it what it would measure on a panel so folded: the second difference
/// of `$\max(d, 0)$`. Along each yarn that crosses the line these parts add up to all of it,
/// wherever the nodes are. A yarn along which the normal has the component `$n_y$` turns, for a
/// fraction `$w$` of the angle, by
///
/// ```math
/// \beta = 2\arcsin\left(|n_y|\sin\frac{w\alpha}{2}\right),\qquad \kappa_0 = \beta/h
/// ```
///
/// as a straight line on a folded sheet of paper does. A slanting fold is rounded over two spacings
/// on each side. Within a spacing of an outline a part of the angle is lost, where yarns end.
///
/// Bending along the yarns cannot tell a slanting fold from its mirror image about a yarn; twist
/// could. Which of the two forms follows from the places of the folded connectors, since cloth
/// hardly stretches. The crease has no stiffness of its own: along it and across it the fabric's
/// laws hold, with friction, which keeps a cloth that starts flat from reaching the whole angle.
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
pub(crate) struct WeightedNode {
    /// Material coordinates, in m.
    pub(crate) coordinates: [f64; 2],
    /// Weight, in 1/m².
    pub(crate) weight: f64,
}

/// Length of the line before a point, and the distance of the point at its left, in m.
pub(crate) struct LineCoordinates {
    pub(crate) along: f64,
    pub(crate) left: f64,
}

impl Fold {
    /// Largest angle of a fold, in rad: up to it angles are exact.
    pub const ANGLE_MAX: f64 = 140.0 * std::f64::consts::PI / 180.0;

    fn span(&self) -> [f64; 2] {
        let [from, to] = self.ends;
        [to[0] - from[0], to[1] - from[1]]
    }

    /// Length of the line, in m.
    pub(crate) fn length(&self) -> f64 {
        let span = self.span();
        span[0].hypot(span[1])
    }

    /// Unit vector along the line.
    pub(crate) fn direction(&self) -> [f64; 2] {
        let length = self.length();
        self.span().map(|x| x / length)
    }

    /// Returns the coordinates of a point along the line and across it.
    pub(crate) fn coordinates(&self, point: [f64; 2]) -> LineCoordinates {
        let [x, y] = self.direction();
        let arm = [point[0] - self.ends[0][0], point[1] - self.ends[0][1]];
        LineCoordinates { along: x * arm[0] + y * arm[1], left: x * arm[1] - y * arm[0] }
    }

    /// Component of the line's normal along the weft (1) or the warp (0).
    fn across(&self, direction: usize) -> f64 {
        self.direction()[direction].abs()
    }

    /// Returns the angle by which a yarn turns that has a part of the fold: the second difference
    /// of `$\max(d, 0)$` over the spacing. A part above one, which a fit may have, counts in
    /// proportion.
    fn turning_angle(&self, part: f64, direction: usize) -> f64 {
        let across = self.across(direction).max(ALONG);
        let half = 0.5 * self.angle * (part.abs() / across).min(1.0);
        let straight = 2.0 * across * half;
        let slanted = 2.0 * (across * half.sin()).asin();
        part * self.angle * if straight == 0.0 { 1.0 } else { slanted / straight }
    }

    /// Distance over which the fold is rounded on both sides of the line, in m: zero along a yarn.
    ///
    /// A sharp fold that slants would meet the two yarns at a node with two different parts of its
    /// angle, and stretch the cells between them.
    fn rounding(&self, spacing: [f64; 2]) -> f64 {
        let slants = self.across(0).min(self.across(1)) > ALONG;
        if slants { ROUNDING * (spacing[0] * spacing[1]).sqrt() } else { 0.0 }
    }

    /// Returns the height, per angle, of a point over the plane at the right of the line, in m; the
    /// curvature falls from the line to zero over the rounding.
    fn height(distance: f64, rounding: f64) -> f64 {
        if distance.abs() >= rounding {
            return distance.max(0.0);
        }
        let cubic = |x: f64| x.max(0.0).powi(3) / 6.0;
        (cubic(distance + rounding) - 2.0 * cubic(distance)) / (rounding * rounding)
    }

    /// Returns the rest curvature that the fold adds to a connector along a direction, in 1/m, from
    /// the nodes of its second difference and its middle; `spacing` is that along weft and warp.
    pub(crate) fn rest_curvature(
        &self,
        nodes: impl Iterator<Item = WeightedNode>,
        middle: [f64; 2],
        direction: usize,
        spacing: [f64; 2],
    ) -> f64 {
        let own = spacing[1 - direction];
        let (along, rounding) = (self.coordinates(middle).along, self.rounding(spacing));
        // The last nodes before an outline lie beyond the end of a line that ends there.
        if !(-own..=self.length() + own).contains(&along) {
            return 0.0;
        }
        let height = |point| Self::height(self.coordinates(point).left, rounding);
        let difference: f64 = nodes.map(|node| node.weight * height(node.coordinates)).sum();
        self.turning_angle(difference * own, direction) / own
    }
}
