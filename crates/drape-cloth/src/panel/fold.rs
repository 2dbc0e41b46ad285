//! Folds: lines along which a panel is bent at rest.

use drape_fabric::BendingBackbone;

use crate::angle::Angle;
use crate::bend::HALF;
use crate::field::{Vector, add, dot, scale, subtract};
use crate::{Error, Lattice};

/// Largest part of a line's length across a yarn that counts as along it: rounding.
const ALONG: f64 = 1e-6;

/// How far a slanting fold is rounded on both sides of its line, in spacings. Without it a fold of 90° at 30° to the yarns
/// came to 54° at 10 mm, with 1 to 91°, with 2 to 90°; one through a rim came to 74°, 82° and 88°.
const WIDTH: f64 = 2.0;

/// Least product of a line's parts along weft and warp for a slanting one.
const SLANTED: f64 = 0.02;

/// Rounding of an angle, relative.
const EXACT: f64 = 1e-6;

/// A straight line along which a panel is folded at rest: a crease, or the edge of a pleat.
///
/// The curvature at rest of a panel that is folded by an angle `$\alpha$` along a line is `$\alpha\,\delta(d)\,nn^T$` with
/// the distance `$d$` from the line and its normal `$n$` in the panel. A connector has of it what it would measure on a
/// panel so folded, the second difference of `$\max(d, 0)$`: along each yarn that crosses the line these parts add up to
/// all of it, whichever nodes are near. A yarn that the normal has the component `$n_y$` along turns at a part `$w$` of
/// the angle by
///
/// ```math
/// \beta = 2\arcsin\left(|n_y|\sin\frac{w\alpha}{2}\right),\qquad \kappa_0 = \beta/h
/// ```
///
/// as a straight line on a sheet of paper does that is folded. Where the line slants, the fold is rounded over two
/// spacings on each side. Within a spacing of an outline a part of the angle is lost, where yarns end.
///
/// Bending along the yarns cannot tell a fold from its mirror image about a yarn. Which of the two a slanting one is,
/// twist would say; it follows from where the folded connectors are, since cloth hardly stretches. Nor has the crease
/// a stiffness of its own: along it and across it the fabric's laws hold, friction and all, which keeps a cloth that
/// starts flat from coming to the whole angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fold {
    /// Its ends in material coordinates (u along the weft, v along the warp), in m. They may lie outside the panel.
    pub ends: [[f64; 2]; 2],
    /// Angle by which the panel is turned towards its right side, in rad.
    pub angle: f64,
}

impl Fold {
    /// Largest angle of a fold, in rad: up to it angles are exact.
    pub const ANGLE_MAX: f64 = 140.0 * std::f64::consts::PI / 180.0;

    /// Unit vector along the line, and its length, in m.
    fn way(&self) -> ([f64; 2], f64) {
        let [from, to] = self.ends;
        let way = [to[0] - from[0], to[1] - from[1]];
        let length = way[0].hypot(way[1]);
        (way.map(|x| x / length), length)
    }

    /// How far a place is along the line, and at its left, in m.
    fn at(&self, place: [f64; 2]) -> [f64; 2] {
        let ([x, y], _) = self.way();
        let arm = [place[0] - self.ends[0][0], place[1] - self.ends[0][1]];
        [x * arm[0] + y * arm[1], x * arm[1] - y * arm[0]]
    }

    /// Component along the weft (1) or the warp (0) of the line's normal.
    fn across(&self, direction: usize) -> f64 {
        self.way().0[direction].abs()
    }

    /// Angle by which a yarn turns that has a part of the fold: the second difference of `$\max(d, 0)$` over the spacing.
    /// More than all of it, which a fit may see, counts in proportion.
    fn turn(&self, part: f64, direction: usize) -> f64 {
        let across = self.across(direction).max(ALONG);
        let half = 0.5 * self.angle * (part.abs() / across).min(1.0);
        let straight = 2.0 * across * half;
        let slanted = 2.0 * (across * half.sin()).asin();
        part * self.angle * if straight == 0.0 { 1.0 } else { slanted / straight }
    }

    /// How far the fold is rounded on both sides of the line, in m: not at all along a yarn.
    ///
    /// A sharp fold that slants would meet the two yarns at a node with two different parts of its angle, and stretch
    /// the cells between them.
    fn width(&self, spacing: [f64; 2]) -> f64 {
        let slants = self.across(0).min(self.across(1)) > ALONG;
        if slants { WIDTH * (spacing[0] * spacing[1]).sqrt() } else { 0.0 }
    }

    /// Height over the plane at the right of the line, in m, of a place with a distance from it, in m, per angle; the
    /// curvature falls from the line to nothing at the width.
    fn height(distance: f64, width: f64) -> f64 {
        if distance.abs() >= width {
            return distance.max(0.0);
        }
        let cubic = |x: f64| x.max(0.0).powi(3) / 6.0;
        (cubic(distance + width) - 2.0 * cubic(distance)) / (width * width)
    }

    /// What the fold adds to the rest curvature of a connector along a direction, in 1/m, from the places of its nodes and
    /// their weights in the curvature, in 1/m²; `spacing` is that along the weft and the warp.
    pub(crate) fn curvature(
        &self,
        parts: impl Iterator<Item = ([f64; 2], f64)>,
        middle: [f64; 2],
        (direction, spacing): (usize, [f64; 2]),
    ) -> f64 {
        let own = spacing[1 - direction];
        let (along, width) = (self.at(middle)[0], self.width(spacing));
        // The last nodes before an outline lie beyond the end of a line that ends there.
        if !(-own..=self.way().1 + own).contains(&along) {
            return 0.0;
        }
        let height = |place| Self::height(self.at(place)[1], width);
        let bow: f64 = parts.map(|(place, weight)| weight * height(place)).sum();
        self.turn(bow * own, direction) / own
    }
}

impl Lattice {
    /// The lines along which it is folded at rest.
    #[must_use]
    pub fn folds(&self) -> &[Fold] {
        &self.folds
    }

    /// The panel with folds, besides those that it has.
    ///
    /// # Errors
    /// When a fold has no length or no number, its angle is beyond [`Fold::ANGLE_MAX`], or nothing of the panel is on
    /// both sides of it; and when folds add up to more at a node.
    pub fn with_folds(mut self, folds: &[Fold]) -> Result<Self, Error> {
        for (fold, line) in folds.iter().enumerate() {
            let wrong = |what| Err(Error::Fold { fold, what });
            if !line.ends.iter().flatten().chain([&line.angle]).all(|x| x.is_finite()) {
                return wrong("has a number that is not finite");
            }
            if !(line.way().1 > 0.0) {
                return wrong("ends where it begins");
            }
            if line.angle.abs() > Fold::ANGLE_MAX {
                return wrong("has an angle beyond 140°");
            }
            let beside = |sign: f64| {
                let mut places = self.coordinates.iter().map(|&place| line.at(place));
                places
                    .any(|[along, left]| (0.0..=line.way().1).contains(&along) && sign * left > 0.0)
            };
            if !(beside(1.0) && beside(-1.0)) {
                return wrong("does not cross the panel");
            }
            self.folds.push(*line);
            let turned = |(direction, yarns): (usize, &Vec<Vec<u32>>)| {
                let spacing = self.spacing[1 - direction];
                let curvatures = self.folded((yarns, direction));
                curvatures.iter().any(|k| (k * spacing).abs() > Fold::ANGLE_MAX * (1.0 + EXACT))
            };
            if self.yarns().iter().enumerate().any(turned) {
                return wrong(
                    "is so near to another that a yarn turns by more than 140° at a node",
                );
            }
        }
        Ok(self)
    }

    /// What folds add to the rest curvatures of the triples of one direction, at their middles, in 1/m; none without folds.
    pub(crate) fn folded(&self, (yarns, direction): (&[Vec<u32>], usize)) -> Vec<f64> {
        let nodes = if self.folds.is_empty() { 0 } else { self.coordinates.len() };
        let mut curvatures = vec![0.0; nodes];
        for fold in &self.folds {
            self.add_fold(fold, (yarns, direction), &mut curvatures);
        }
        curvatures
    }

    fn add_fold(
        &self,
        fold: &Fold,
        (yarns, direction): (&[Vec<u32>], usize),
        curvatures: &mut [f64],
    ) {
        let square = self.spacing[1 - direction] * self.spacing[1 - direction];
        let along = (direction, self.spacing);
        for triple in yarns.iter().flat_map(|yarn| yarn.windows(3)) {
            let place = |k: usize| self.coordinates[triple[k] as usize];
            let parts = [(place(0), 1.0), (place(1), -2.0), (place(2), 1.0)];
            let parts = parts.map(|(place, weight)| (place, weight / square));
            let curvature = fold.curvature(parts.into_iter(), place(1), along);
            curvatures[triple[1] as usize] += curvature;
        }
    }

    /// Areas of the corners of each cell, for shearing, in m².
    ///
    /// The two yarns of a corner that lie on both sides of a slanting fold through it are at another angle when it is
    /// folded, by up to all of the fold's, and the cloth is not sheared. The two other corners of the cell, whose yarns
    /// lie on one side, stand for all of it then.
    pub(crate) fn sheared(&self) -> Vec<[f64; 4]> {
        let mut areas: Vec<[f64; 4]> = self.cells.iter().map(|cell| cell.quadrants).collect();
        for fold in &self.folds {
            let [u, v] = fold.way().0;
            if (u * v).abs() < SLANTED {
                continue;
            }
            let mut bent = vec![0.0; self.coordinates.len()];
            for (direction, yarns) in self.yarns().iter().enumerate() {
                self.add_fold(fold, (yarns, direction), &mut bent);
            }
            // The line rises with u from the first corner to the third, or falls from the fourth to the second.
            let (clear, parted) = if u * v > 0.0 { ([1, 3], [0, 2]) } else { ([0, 2], [1, 3]) };
            for (cell, areas) in self.cells.iter().zip(&mut areas) {
                if parted.iter().any(|&corner| bent[cell.corners[corner] as usize] != 0.0) {
                    let half = 0.5 * (areas[parted[0]] + areas[parted[1]]);
                    parted.iter().for_each(|&corner| areas[corner] = 0.0);
                    clear.iter().for_each(|&corner| areas[corner] += half);
                }
            }
        }
        areas
    }
}

/// The bending of a connector at a fold.
///
/// The difference of two bows is that of their angles only where these are small, so the curvature is counted about the
/// normal, `$E = E_e(\kappa - \kappa_0) + E_e(|b_\parallel|)$`, and what the yarn bows within the surface apart from it.
pub(crate) struct Crease {
    normal: Vector,
    /// The part of the bow within the surface, its length, and its direction.
    within: Vector,
    size: f64,
    unit: Vector,
    /// Curvature less that at rest, in 1/m, and its derivatives with respect to the bow along the normal.
    excess: f64,
    slopes: (f64, f64),
}

impl Crease {
    /// A bow, in 1/m, and the normal it is measured along, of a connector with segments of a length, in m, and a curvature at
    /// rest, in 1/m.
    pub(crate) fn new((bow, normal): (Vector, Vector), length: f64, rest: f64) -> Self {
        let along = dot(bow, normal);
        let within = subtract(bow, scale(normal, along));
        let size = dot(within, within).sqrt();
        let angle = Angle::of(along * along, length);
        Self {
            normal,
            within,
            size,
            unit: if size > 0.0 { scale(within, 1.0 / size) } else { [0.0; 3] },
            excess: angle.curvature(along) - rest,
            slopes: angle.derivatives(along),
        }
    }

    /// Elastic energy per area, in J/m².
    pub(crate) fn energy(&self, backbone: &BendingBackbone) -> f64 {
        backbone.energy(self.excess) + backbone.energy(self.size)
    }

    /// Derivative of the energy with respect to the bow, with the load of the friction, in N.
    pub(crate) fn moment(&self, backbone: &BendingBackbone, friction: f64) -> Vector {
        let load = (backbone.respond(self.excess).load + friction) * self.slopes.0;
        let secant = self.secant(backbone).0;
        add(scale(self.normal, load), scale(self.within, secant))
    }

    /// Secant and tangent stiffness within the surface.
    fn secant(&self, backbone: &BendingBackbone) -> (f64, f64) {
        let response = backbone.respond(self.size);
        let secant = if self.size > 0.0 { response.load / self.size } else { response.tangent };
        (secant, response.tangent)
    }

    /// Upper half of the second derivative of the energy with respect to the bow, with load and tangent of the
    /// friction; with `definite`, without what makes it indefinite.
    pub(crate) fn block(
        &self,
        backbone: &BendingBackbone,
        friction: [f64; 2],
        definite: bool,
    ) -> [f64; 6] {
        let elastic = backbone.respond(self.excess);
        let (first, second) = self.slopes;
        let [load, tangent] = [elastic.load + friction[0], elastic.tangent + friction[1]];
        let slope = tangent * first * first + load * second;
        let slope = if definite { slope.max(0.0) } else { slope };
        let (secant, tangent) = self.secant(backbone);
        HALF.map(|(row, column)| {
            let one = if row == column { secant } else { 0.0 };
            (slope - secant) * self.normal[row] * self.normal[column]
                + (tangent - secant) * self.unit[row] * self.unit[column]
                + one
        })
    }
}
