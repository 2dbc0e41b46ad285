//! Picture of a garment at its start: its panels about the body, and the seams that are to close.
//!
//! Both sides of a seam have the colour that they have in the drawing of the pattern, with a ball at
//! the first stitch and an arrowhead in the direction of the seam. Thin lines are its stitches: the
//! straight ways along which its sides are drawn together. Where something is wrong, it alone is
//! marked, in red.

use drape::dynamics::Snapshot;
use drape::pattern::seam_colour;
use drape::report::plot::{SeamKey, seams_svg};
use drape::report::{Colour, Picture, Surface};
use drape::scene::Seam;

use super::picture::Pictures;
use crate::failure::Failure;

/// Radii of the sides of a seam, of a stitch and of the ball at the first one, and the length and
/// radius of an arrowhead, in spacings.
const SIDE: f64 = 0.16;
const STITCH: f64 = 0.05;
const BALL: f64 = 0.5;
const HEAD: [f64; 2] = [1.6, 0.6];

/// Largest size of a spacing in these marks, in m, so that they stay small beside the garment.
const SPACING_MAX: f64 = 0.012;

/// Number of sides of a rod.
const SIDES: usize = 6;

/// Distance of two particles on a side, in spacings, beyond which the side goes on elsewhere.
const GAP: f64 = 2.5;

/// Radius of lines that are wrong, in spacings.
const LINE: f64 = 0.3;

/// Colour of what is wrong.
const RED: Colour = [209, 26, 26];

/// What is wrong at a start.
#[derive(Debug, Clone, Default)]
pub(crate) struct Wrong {
    /// Names of seams.
    pub(crate) seams: Vec<String>,
    /// Sides of triangles, by their particles.
    pub(crate) sides: Vec<[u32; 2]>,
    /// Corners of triangles that cross others, in m.
    pub(crate) triangles: Vec<[[f64; 3]; 3]>,
}

impl Wrong {
    fn is_empty(&self) -> bool {
        self.seams.is_empty() && self.sides.is_empty() && self.triangles.is_empty()
    }
}

/// Picture of a garment at its start with its seams, and with what is wrong in red.
pub(crate) struct StartPicture<'a> {
    pub(crate) snapshot: &'a Snapshot,
    pub(crate) seams: &'a [Seam],
    pub(crate) wrong: &'a Wrong,
}

impl StartPicture<'_> {
    /// Draws it from the front, the side and the back.
    pub(crate) fn draw(&self) -> Result<Picture, Failure> {
        let Self { snapshot, seams, wrong } = self;
        let mut marks = Marks::default();
        let size = snapshot.spacing.min(SPACING_MAX);
        for (number, seam) in seams.iter().enumerate() {
            marks.colour = self.colour(number);
            // Where something is wrong, only that has its seams.
            if wrong.is_empty() || wrong.seams.contains(&seam.name) {
                marks.seam(snapshot, seam, size);
            }
        }
        marks.colour = RED;
        let place =
            |particle: u32| [0, 1, 2].map(|axis| snapshot.positions[3 * particle as usize + axis]);
        for side in &wrong.sides {
            marks.rod(&Rod { ends: side.map(place), radii: [LINE * size; 2] });
        }
        for corners in &wrong.triangles {
            for k in 0..3 {
                let ends = [corners[k], corners[(k + 1) % 3]];
                marks.rod(&Rod { ends, radii: [LINE * size; 2] });
            }
        }
        let Marks { positions, triangles, tints, .. } = &marks;
        let marks = Surface::cloth(positions, triangles).with_tints(tints);
        let marks = (!triangles.is_empty()).then_some(marks);
        Pictures::with_marks(snapshot, marks)?.draw_round()
    }

    /// Draws the same as SVG, with the names of the seams.
    pub(crate) fn svg(&self) -> Result<String, Failure> {
        let shown = self
            .seams
            .iter()
            .enumerate()
            .filter(|(_, seam)| self.wrong.is_empty() || self.wrong.seams.contains(&seam.name));
        let key = |(number, seam): (usize, &Seam)| SeamKey {
            name: seam.name.clone(),
            colour: self.colour(number),
        };
        let keys: Vec<SeamKey> = shown.map(key).collect();
        seams_svg(&self.draw()?, &keys).map_err(|error| Failure::Output(error.to_string()))
    }

    /// Returns the colour of a seam.
    fn colour(&self, number: usize) -> Colour {
        match self.wrong.seams.contains(&self.seams[number].name) {
            true => RED,
            false => seam_colour(number),
        }
    }
}

/// Marks in space, as triangles in colours.
#[derive(Debug, Default)]
struct Marks {
    colour: Colour,
    positions: Vec<f64>,
    triangles: Vec<[u32; 3]>,
    tints: Vec<Colour>,
}

/// Line from a point to another, in m, whose radius changes along it, in m.
struct Rod {
    ends: [[f64; 3]; 2],
    radii: [f64; 2],
}

impl Marks {
    /// Adds the marks of a seam, whose size is that of a spacing in m.
    fn seam(&mut self, snapshot: &Snapshot, seam: &Seam, size: f64) {
        let place =
            |particle: u32| [0, 1, 2].map(|axis| snapshot.positions[3 * particle as usize + axis]);
        let stitches: Vec<[[f64; 3]; 2]> =
            seam.pairs.pairs.iter().map(|pair| pair.map(place)).collect();
        for stitch in &stitches {
            self.rod(&Rod { ends: *stitch, radii: [STITCH * size; 2] });
        }
        for side in 0..2 {
            let points: Vec<[f64; 3]> = stitches.iter().map(|stitch| stitch[side]).collect();
            let near =
                |ends: &&[[f64; 3]]| length(difference(ends[1], ends[0])) < GAP * snapshot.spacing;
            for ends in points.windows(2).filter(near) {
                self.rod(&Rod { ends: [ends[0], ends[1]], radii: [SIDE * size; 2] });
            }
            if let Some(first) = points.first() {
                self.ball(*first, BALL * size);
            }
            let half = points.len() / 2;
            if half > 0 {
                self.arrowhead([points[half - 1], points[half]], size);
            }
        }
    }

    /// Adds an arrowhead that ends at the second of two points, in m.
    fn arrowhead(&mut self, [from, to]: [[f64; 3]; 2], size: f64) {
        let along = difference(to, from);
        let part = HEAD[0] * size / length(along).max(f64::MIN_POSITIVE);
        let back = [0, 1, 2].map(|k| to[k] - part * along[k]);
        self.rod(&Rod { ends: [back, to], radii: [HEAD[1] * size, 0.02 * size] });
    }

    /// Adds a ball of a radius about a point, in m, as two cones.
    fn ball(&mut self, middle: [f64; 3], radius: f64) {
        for sign in [-1.0, 1.0] {
            let tip = [middle[0], middle[1] + sign * radius, middle[2]];
            self.rod(&Rod { ends: [middle, tip], radii: [radius, 0.02 * radius] });
        }
    }

    /// Adds the surface of a rod.
    fn rod(&mut self, rod: &Rod) {
        let along = difference(rod.ends[1], rod.ends[0]);
        if length(along) == 0.0 {
            return;
        }
        let thinnest = (0..3).min_by(|&a, &b| along[a].abs().total_cmp(&along[b].abs()));
        let aside = [0, 1, 2].map(|k| f64::from(u8::from(Some(k) == thinnest)));
        let first = unit(cross(along, aside));
        let second = unit(cross(along, first));
        let base = self.positions.len() as u32 / 3;
        for (end, radius) in rod.ends.iter().zip(rod.radii) {
            for side in 0..SIDES {
                let (sin, cos) = (side as f64 / SIDES as f64 * std::f64::consts::TAU).sin_cos();
                let point = |k: usize| end[k] + radius * (cos * first[k] + sin * second[k]);
                self.positions.extend([point(0), point(1), point(2)]);
                self.tints.push(self.colour);
            }
        }
        let count = SIDES as u32;
        for side in 0..count {
            let next = (side + 1) % count;
            let [a, b, c, d] = [side, next, next + count, side + count].map(|corner| base + corner);
            self.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
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
