//! Picture of a garment at its start: the panels around the body, and the seams that are to close.
//!
//! Both sides of a seam have the seam's colour in the drawing of the pattern, with a ball at the
//! first stitch and an arrowhead in the direction of the seam. Thin straight lines are the
//! stitches, along which the sides are drawn together. If the start has faults, only the faults are
//! marked, in red.

use drape::dynamics::Snapshot;
use drape::pattern::seam_colour;
use drape::render::{Colour, Picture, Surface};
use drape::report::plot::{SeamKey, seams_svg};
use drape::scene::Seam;

use super::picture::SnapshotPictures;
use crate::failure::Failure;

/// Radius of the sides of a seam, in spacings.
const SIDE_RADIUS: f64 = 0.16;

/// Radius of a stitch, in spacings.
const STITCH_RADIUS: f64 = 0.05;

/// Radius of the ball at the first stitch, in spacings.
const BALL_RADIUS: f64 = 0.5;

/// Length and radius of an arrowhead, in spacings.
const ARROWHEAD: [f64; 2] = [1.6, 0.6];

/// Upper limit of the spacing that scales the marks, in m, so that marks stay small beside the
/// garment.
const SPACING_MAX: f64 = 0.012;

/// Number of sides of a rod's cross-section.
const ROD_SIDES: usize = 6;

/// Largest distance of two neighbouring particles on a side of a seam, in spacings. Across a larger
/// distance the side is interrupted.
const GAP_MAX: f64 = 2.5;

/// Radius of the lines that mark a fault, in spacings.
const FAULT_RADIUS: f64 = 0.3;

/// Colour of faults.
const RED: Colour = [209, 26, 26];

/// Faults of a start.
#[derive(Debug, Clone, Default)]
pub(crate) struct StartFaults {
    /// Names of the faulty seams.
    pub(crate) seams: Vec<String>,
    /// Faulty sides of triangles, by their particles.
    pub(crate) sides: Vec<[u32; 2]>,
    /// Corners of triangles that cross others, in m.
    pub(crate) triangles: Vec<[[f64; 3]; 3]>,
}

impl StartFaults {
    fn is_empty(&self) -> bool {
        self.seams.is_empty() && self.sides.is_empty() && self.triangles.is_empty()
    }
}

/// Picture of a garment at its start, with its seams and its `faults`.
pub(crate) struct StartPicture<'a> {
    pub(crate) snapshot: &'a Snapshot,
    pub(crate) seams: &'a [Seam],
    pub(crate) faults: &'a StartFaults,
}

impl StartPicture<'_> {
    /// Draws the garment from the front, the side and the back, as one [`Picture`].
    pub(crate) fn draw(&self) -> Result<Picture, Failure> {
        let Self { snapshot, seams, faults } = self;
        let mut marks = Marks::default();
        let size = snapshot.spacing.min(SPACING_MAX);
        for (number, seam) in seams.iter().enumerate() {
            marks.colour = self.colour(number);
            // If the start has faults, only faulty seams are drawn.
            if faults.is_empty() || faults.seams.contains(&seam.name) {
                marks.seam(snapshot, seam, size);
            }
        }

        marks.colour = RED;
        for side in &faults.sides {
            let ends = side.map(|particle| position(snapshot, particle));
            marks.rod(&Rod { ends, radii: [FAULT_RADIUS * size; 2] });
        }
        for corners in &faults.triangles {
            for k in 0..3 {
                let ends = [corners[k], corners[(k + 1) % 3]];
                marks.rod(&Rod { ends, radii: [FAULT_RADIUS * size; 2] });
            }
        }

        let Marks { positions, triangles, tints, .. } = &marks;
        let marks = Surface::cloth(positions, triangles).with_tints(tints);
        let marks = (!triangles.is_empty()).then_some(marks);
        SnapshotPictures::with_marks(snapshot, marks)?.draw_garment()
    }

    /// Draws the picture of [`Self::draw`] as SVG, with the names of the seams.
    pub(crate) fn svg(&self) -> Result<String, Failure> {
        let keys: Vec<SeamKey> = self
            .seams
            .iter()
            .enumerate()
            .filter(|(_, seam)| self.faults.is_empty() || self.faults.seams.contains(&seam.name))
            .map(|(number, seam)| SeamKey { name: seam.name.clone(), colour: self.colour(number) })
            .collect();
        seams_svg(&self.draw()?, &keys).map_err(|error| Failure::Output(error.to_string()))
    }

    /// Returns the colour of seam `number`.
    fn colour(&self, number: usize) -> Colour {
        let is_faulty = self.faults.seams.contains(&self.seams[number].name);
        if is_faulty { RED } else { seam_colour(number) }
    }
}

/// Marks in space: triangles with a colour per vertex.
#[derive(Debug, Default)]
struct Marks {
    colour: Colour,
    positions: Vec<f64>,
    triangles: Vec<[u32; 3]>,
    tints: Vec<Colour>,
}

/// Rod between two points, in m, with a radius at each end, in m.
struct Rod {
    ends: [[f64; 3]; 2],
    radii: [f64; 2],
}

impl Marks {
    /// Adds the marks of `seam`. `size` is the spacing that scales them, in m.
    fn seam(&mut self, snapshot: &Snapshot, seam: &Seam, size: f64) {
        let stitches: Vec<[[f64; 3]; 2]> = seam
            .pairs
            .pairs
            .iter()
            .map(|pair| pair.map(|particle| position(snapshot, particle)))
            .collect();
        for stitch in &stitches {
            self.rod(&Rod { ends: *stitch, radii: [STITCH_RADIUS * size; 2] });
        }

        for side in 0..2 {
            let points: Vec<[f64; 3]> = stitches.iter().map(|stitch| stitch[side]).collect();
            for ends in points.windows(2) {
                if length(difference(ends[1], ends[0])) < GAP_MAX * snapshot.spacing {
                    self.rod(&Rod { ends: [ends[0], ends[1]], radii: [SIDE_RADIUS * size; 2] });
                }
            }

            if let Some(first) = points.first() {
                self.ball(*first, BALL_RADIUS * size);
            }
            let half = points.len() / 2;
            if half > 0 {
                self.arrowhead([points[half - 1], points[half]], size);
            }
        }
    }

    /// Adds an arrowhead with its tip at `to` and the direction from `from` to `to`, in m.
    fn arrowhead(&mut self, [from, to]: [[f64; 3]; 2], size: f64) {
        let along = difference(to, from);
        let fraction = ARROWHEAD[0] * size / length(along).max(f64::MIN_POSITIVE);
        let back = [0, 1, 2].map(|k| to[k] - fraction * along[k]);
        self.rod(&Rod { ends: [back, to], radii: [ARROWHEAD[1] * size, 0.02 * size] });
    }

    /// Adds a ball of `radius` around the point `middle`, in m, as two cones.
    fn ball(&mut self, middle: [f64; 3], radius: f64) {
        for sign in [-1.0, 1.0] {
            let tip = [middle[0], middle[1] + sign * radius, middle[2]];
            self.rod(&Rod { ends: [middle, tip], radii: [radius, 0.02 * radius] });
        }
    }

    /// Adds the lateral surface of `rod`. A rod without length adds nothing.
    fn rod(&mut self, rod: &Rod) {
        let along = difference(rod.ends[1], rod.ends[0]);
        if length(along) == 0.0 {
            return;
        }

        // `first` and `second` span the cross-section. The axis least aligned with the rod keeps
        // the cross product well conditioned.
        let smallest = (0..3).min_by(|&a, &b| along[a].abs().total_cmp(&along[b].abs()));
        let axis = [0, 1, 2].map(|k| f64::from(u8::from(Some(k) == smallest)));
        let first = unit(cross(along, axis));
        let second = unit(cross(along, first));
        let base = self.positions.len() as u32 / 3;
        for (end, radius) in rod.ends.iter().zip(rod.radii) {
            for side in 0..ROD_SIDES {
                let (sin, cos) = (side as f64 / ROD_SIDES as f64 * std::f64::consts::TAU).sin_cos();
                self.positions.extend(
                    [0, 1, 2].map(|k| end[k] + radius * (cos * first[k] + sin * second[k])),
                );
                self.tints.push(self.colour);
            }
        }

        let count = ROD_SIDES as u32;
        for side in 0..count {
            let next = (side + 1) % count;
            let [a, b, c, d] = [side, next, next + count, side + count].map(|corner| base + corner);
            self.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
}

/// Returns the position of `particle`, in m.
fn position(snapshot: &Snapshot, particle: u32) -> [f64; 3] {
    [0, 1, 2].map(|axis| snapshot.positions[3 * particle as usize + axis])
}

fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn length(a: [f64; 3]) -> f64 {
    a.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3])
}

fn unit(a: [f64; 3]) -> [f64; 3] {
    let length = length(a).max(f64::MIN_POSITIVE);
    a.map(|x| x / length)
}
