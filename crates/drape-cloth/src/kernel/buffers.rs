#![allow(clippy::needless_range_loop, reason = "a lane is a place in many arrays")]

use std::ops::Range;

use drape_fabric::{LANES, Lanes};

use crate::bend::{Bend, Bows};
use crate::field::{Columns, Field, add, dot, lanes, put, scale, set, some_lanes, subtract};
use crate::panel::{Panel, Strip, Yarns};
use crate::state::History;
use crate::{Cloth, State};

/// Length below which an edge counts as this long, in m: it has no direction, its forces are huge
/// but finite, and so are their derivatives.
pub(crate) const EDGE_MIN: f64 = 1e-100;

/// What the evaluation of a strip computes on the way, at its points and a margin around them.
///
/// The place of a point here is its place in the panel's columns less the strip's first point.
/// Every edge's length and direction is computed once and serves traction and shear alike.
#[derive(Debug, Clone)]
pub(crate) struct Scratch {
    pub(crate) positions: Field,
    /// Along the warp and the weft, kept at their first point.
    pub(crate) edges: [Edges; 2],
    /// Tensions of the edges, in N.
    pub(crate) tensions: [Vec<f64>; 2],
    /// Loads of the cells' corners times their areas, in J.
    pub(crate) corners: [Vec<f64>; 4],
    /// Moments at the points over the segments' lengths squared, in N.
    pub(crate) moments: [Field; 2],
    /// Derivatives of the potential with respect to the edges as vectors, in N.
    pub(crate) pulls: [Field; 2],
    /// Slopes of the corners' loads times their areas, in J.
    pub(crate) slopes: [Vec<f64>; 4],
    /// Second derivatives of the potential with respect to the warp and the weft edge of a corner.
    pub(crate) turns: [Columns<9>; 4],
    /// Second derivatives with respect to the bow at a point, over the length to the fourth.
    pub(crate) rigidities: [Columns<6>; 2],
    /// Blocks of each point with the next along the warp and the weft, and with the one across its
    /// cell, and of the two other points of its cell.
    pub(crate) blocks: [Columns<9>; 4],
}

/// Edges from each point to the next in one direction.
#[derive(Debug, Clone)]
pub(crate) struct Edges {
    pub(crate) length: Vec<f64>,
    pub(crate) inverse: Vec<f64>,
    pub(crate) unit: Field,
}

/// A strip of a panel, its state, and the trial that is evaluated.
#[derive(Clone, Copy)]
pub(crate) struct StripTrial<'a> {
    pub(crate) panel: &'a Panel,
    pub(crate) history: &'a History,
    pub(crate) strip: &'a Strip,
    pub(crate) positions: &'a [f64],
}

impl<'a> StripTrial<'a> {
    pub(crate) fn new(
        cloth: &'a Cloth,
        state: &'a State,
        (strip, positions): (&'a Strip, &'a [f64]),
    ) -> Self {
        Self { panel: &cloth.panels[strip.panel], history: &state.history, strip, positions }
    }
}

impl Edges {
    fn new(length: usize) -> Self {
        Self { length: vec![0.0; length], inverse: vec![0.0; length], unit: Field::new(length) }
    }

    #[inline(always)]
    fn measure(&mut self, positions: &Field, step: usize, places: Range<usize>) {
        for start in places.step_by(LANES) {
            let (here, next) = (positions.from(start), positions.from(start + step));
            let mut length = [0.0; LANES];
            let mut inverse = [0.0; LANES];
            let mut unit = [[0.0; LANES]; 3];
            for lane in 0..LANES {
                let span = subtract(next.at(lane), here.at(lane));
                let size = dot(span, span).sqrt();
                // Written so that NaN stays NaN.
                let size = if size < EDGE_MIN { EDGE_MIN } else { size };
                length[lane] = size;
                inverse[lane] = 1.0 / size;
                set(&mut unit, lane, scale(span, 1.0 / size));
            }
            put(&mut self.length, start, &length);
            put(&mut self.inverse, start, &inverse);
            self.unit.put(start, &unit);
        }
    }
}

impl Scratch {
    pub(crate) fn new(reach: usize) -> Self {
        let column = || vec![0.0; reach];
        let field = || Field::new(reach);
        let blocks = || Columns::new(reach);
        Self {
            positions: field(),
            edges: [Edges::new(reach), Edges::new(reach)],
            tensions: [column(), column()],
            corners: [column(), column(), column(), column()],
            moments: [field(), field()],
            pulls: [field(), field()],
            slopes: [column(), column(), column(), column()],
            turns: [blocks(), blocks(), blocks(), blocks()],
            rigidities: [Columns::new(reach), Columns::new(reach)],
            blocks: [blocks(), blocks(), blocks(), blocks()],
        }
    }

    /// Lays out the positions of a strip and measures its edges.
    #[inline(always)]
    pub(crate) fn lay(&mut self, (panel, strip): (&Panel, &Strip), positions: &[f64]) {
        let count = strip.points.len();
        let reach = count + 2 * panel.margin + LANES;
        let particles = &panel.particles[strip.points.start..][..reach];
        let [x, y, z] = &mut self.positions.0;
        let places = x[..reach].iter_mut().zip(&mut y[..reach]).zip(&mut z[..reach]);
        for (((x, y), z), &particle) in places.zip(particles) {
            let position = &positions[3 * particle as usize..][..3];
            (*x, *y, *z) = (position[0], position[1], position[2]);
        }
        let (from, to) = (panel.margin - panel.stride - 1, panel.margin + count);
        let [warp, weft] = &mut self.edges;
        warp.measure(&self.positions, panel.stride, from..to + 1);
        weft.measure(&self.positions, 1, from..to + panel.stride);
    }

    /// Strains of the segments from a place on; of those that do not exist, zero.
    #[inline(always)]
    pub(crate) fn strains(
        &self,
        yarns: &Yarns,
        direction: usize,
        (start, strip): (usize, &Strip),
    ) -> Lanes {
        let length = lanes(&self.edges[direction].length, start);
        let areas = lanes(&yarns.segment_areas, strip.points.start + start);
        let inverse = 1.0 / yarns.length;
        let mut strains = [0.0; LANES];
        for lane in 0..LANES {
            strains[lane] = if areas[lane] == 0.0 { 0.0 } else { length[lane] * inverse - 1.0 };
        }
        strains
    }

    /// Bows `$(x_a - 2x_c + x_b)/h^2$` at the points from a place on.
    #[inline(always)]
    fn bows(&self, yarns: &Yarns, start: usize) -> Bows {
        let [before, here, after] =
            [start - yarns.step, start, start + yarns.step].map(|place| self.positions.from(place));
        let inverse_square = 1.0 / (yarns.length * yarns.length);
        let mut bows = [[0.0; LANES]; 3];
        for lane in 0..LANES {
            let ends = add(before.at(lane), after.at(lane));
            let bow = subtract(ends, scale(here.at(lane), 2.0));
            set(&mut bows, lane, scale(bow, inverse_square));
        }
        Bows(bows)
    }

    /// The triples at the points from a place on.
    #[inline(always)]
    pub(crate) fn bend<'a>(
        &self,
        yarns: &'a Yarns,
        normals: &'a Field,
        (start, strip): (usize, &Strip),
    ) -> Bend<'a> {
        Bend {
            yarns,
            bows: self.bows(yarns, start),
            normals: normals.from(strip.offset + start),
            areas: lanes(&yarns.triple_areas, strip.points.start + start),
            folds: some_lanes(&yarns.folds, strip.points.start + start),
        }
    }

    /// Sines at one of the four corners of the cells from a place on; of those that do not exist,
    /// zero.
    #[inline(always)]
    pub(crate) fn sines(
        &self,
        panel: &Panel,
        corner: usize,
        (start, strip): (usize, &Strip),
    ) -> Lanes {
        let (warp, weft) = panel.corner_edges(corner);
        let warp = self.edges[0].unit.from(start + warp);
        let weft = self.edges[1].unit.from(start + weft);
        let areas = lanes(&panel.corners[corner], strip.points.start + start);
        let mut sines = [0.0; LANES];
        for lane in 0..LANES {
            let sine = dot(warp.at(lane), weft.at(lane));
            sines[lane] = if areas[lane] == 0.0 { 0.0 } else { sine };
        }
        sines
    }
}
