use std::collections::BTreeMap;

use drape_fabric::{BendingBackbone, BendingLaw, BlimanSorine, Dahl, Fabric, Piecewise};

use super::{Bow, Face, Seam};
use crate::Lattice;
use crate::mesh::twice_area;

/// Part of a curvature that a yarn must take to be bent by it: below, it is at a right angle, or nearly.
const PART_MIN: f64 = 1e-3;

/// What is wrong with a seam, and at which pair.
type Wrong = (usize, &'static str);

/// The sides of a cloth's panels, to be sewn.
pub(super) struct Pieces {
    /// Material coordinates, in m.
    places: Vec<[f64; 2]>,
    /// Bending laws of warp and weft at each particle.
    laws: Vec<[BendingLaw; 2]>,
    /// The third corner of the triangle at each side of an outline, and whether it runs from the lower number to the
    /// higher.
    sides: BTreeMap<[u32; 2], (u32, bool)>,
}

/// The triangle at one side of a segment of a seam.
struct Flap {
    /// Ends of the segment, in the order of the seam, and the third corner.
    corners: [u32; 3],
    /// Length of the segment and height of the triangle above it, in m.
    length: f64,
    height: f64,
    /// Whether the seam runs along the outline.
    along: bool,
}

impl Pieces {
    pub(super) fn of(panels: &[(&Lattice, &Fabric)]) -> Self {
        let mut pieces = Self { places: Vec::new(), laws: Vec::new(), sides: BTreeMap::new() };
        for (lattice, fabric) in panels {
            let first = pieces.places.len() as u32;
            let mut faces: BTreeMap<[u32; 2], Vec<(u32, bool)>> = BTreeMap::new();
            for triangle in lattice.triangles() {
                for k in 0..3 {
                    let [a, b, c] = [0, 1, 2].map(|step| first + triangle[(k + step) % 3]);
                    faces.entry([a.min(b), a.max(b)]).or_default().push((c, a < b));
                }
            }
            let outer = faces.into_iter().filter(|(_, faces)| faces.len() == 1);
            pieces.sides.extend(outer.map(|(side, faces)| (side, faces[0])));
            pieces.places.extend(&lattice.coordinates);
            let laws = [fabric.warp.bending, fabric.weft.bending];
            pieces.laws.resize(pieces.places.len(), laws);
        }
        pieces
    }

    pub(super) fn particles(&self) -> usize {
        self.places.len()
    }

    fn place(&self, node: u32) -> [f64; 2] {
        self.places[node as usize]
    }

    /// The triangle beside a segment.
    fn flap(&self, pair: usize, from: u32, to: u32) -> Result<Flap, Wrong> {
        let side = self.sides.get(&[from.min(to), from.max(to)]);
        let Some(&(third, rising)) = side else {
            return Err((
                pair,
                "the particles of one side and the next are not neighbours on an outline",
            ));
        };
        let corners = [from, to, third];
        let [a, b, _] = corners.map(|node| self.place(node));
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let height = twice_area(corners.map(|node| self.place(node))).abs() / length;
        Ok(Flap { corners, length, height, along: rising == (from < to) })
    }

    /// Adds the bows of a seam.
    pub(super) fn sew(&self, seam: &Seam, bows: &mut Vec<Bow>) -> Result<(), Wrong> {
        if seam.pairs.len() < 2 {
            return Err((0, "a seam has two pairs at least"));
        }
        if !(seam.stiffness >= 0.0 && seam.stiffness.is_finite()) {
            return Err((0, "the stiffness is not a number of at least 0"));
        }
        if seam.rest_angle.is_nan() || seam.rest_angle.abs() > Seam::REST_ANGLE_MAX {
            return Err((0, "the angle at rest is beyond 140°"));
        }
        let lost = |pair: &[u32; 2]| pair.iter().any(|&node| node as usize >= self.places.len());
        if let Some(pair) = seam.pairs.iter().position(lost) {
            return Err((pair, "a particle of it does not exist"));
        }
        let mut ties = seam.ties.iter().peekable();
        let mut flaps = Vec::new();
        for (pair, ends) in seam.pairs.windows(2).enumerate() {
            // For each side the particles from this pair to the next.
            let mut sides = [0, 1].map(|side| vec![ends[0][side]]);
            for side in 0..2 {
                let opposite = [ends[0][1 - side], ends[1][1 - side]];
                while let Some(tie) = ties.next_if(|tie| tie.ends == opposite) {
                    sides[side].push(tie.particle);
                }
                sides[side].push(ends[1][side]);
            }
            // Over the mouth of a dart one side stays where it is, and the other leaps.
            let stays = [0, 1].iter().any(|&side| ends[0][side] == ends[1][side]);
            let flaps_of = |side: &Vec<u32>| -> Result<Vec<Flap>, Wrong> {
                side.windows(2).map(|two| self.flap(pair, two[0], two[1])).collect()
            };
            flaps.push(if stays {
                None
            } else {
                Some([flaps_of(&sides[0])?, flaps_of(&sides[1])?])
            });
        }
        if ties.next().is_some() {
            return Err((
                0,
                "a particle is tied to others than those of the other side, in their order",
            ));
        }
        for flaps in flaps.iter().flatten() {
            self.across(seam, flaps, bows);
        }
        for pair in flaps.windows(2) {
            let [Some(here), Some(there)] = pair else { continue };
            let mean = |flaps: &Vec<Flap>| {
                flaps.iter().map(|flap| flap.height).sum::<f64>() / flaps.len() as f64
            };
            let width = 0.25 * here.iter().chain(there).map(mean).sum::<f64>();
            for (one, next) in here.iter().zip(there) {
                if let ([one], [next]) = (&one[..], &next[..]) {
                    self.along(seam, ([one, next], width), bows);
                }
            }
        }
        Ok(())
    }

    /// Adds the bows between the triangles of both sides from one pair to the next.
    fn across(&self, seam: &Seam, flaps: &[Vec<Flap>; 2], bows: &mut Vec<Bow>) {
        let [first, second] = flaps;
        let arcs = first.len().max(second.len());
        for k in 0..arcs {
            // One side has a triangle for all of the other's.
            let [one, other] =
                [first, second].map(|side| (&side[k.min(side.len() - 1)], side.len()));
            let length = |(flap, own): (&Flap, usize)| flap.length * own as f64 / arcs as f64;
            let lengths = length(one) + length(other);
            self.between(seam, ([one.0, other.0], lengths), bows);
        }
    }

    /// Adds the bows of a segment between two triangles, whose sides there are so long together, in m.
    fn between(&self, seam: &Seam, (flaps, lengths): ([&Flap; 2], f64), bows: &mut Vec<Bow>) {
        let [one, other] = flaps;
        let width = 0.5 * (one.height + other.height);
        let area = 0.25 * lengths * width * seam.stiffness;
        let mut parts = Vec::new();
        for flap in flaps {
            let [a, b, c] = flap.corners.map(|node| self.place(node));
            // Foot of the third corner on the segment.
            let dot = (b[0] - a[0]) * (c[0] - a[0]) + (b[1] - a[1]) * (c[1] - a[1]);
            let foot = dot / (flap.length * flap.length);
            let size = 1.0 / (flap.height * width);
            for (node, part) in flap.corners.into_iter().zip([foot - 1.0, -foot, 1.0]) {
                parts.push((node, size * part));
            }
        }
        // Of the second panel the wrong side is up if the seam runs along both outlines, or against both.
        let flat = if one.along == other.along { -1.0 } else { 1.0 };
        let faces = vec![one.face(1.0), other.face(flat)];
        for flap in flaps {
            let [a, b, _] = flap.corners.map(|node| self.place(node));
            let way = [(b[0] - a[0]) / flap.length, (b[1] - a[1]) / flap.length];
            // Across the segment: the warp where the segment is along the weft.
            let bent = (way.map(|part| part * part), seam.rest_angle / width);
            self.push((flap.corners[0], bent), (&parts, &faces), (width, area), bows);
        }
    }

    /// Adds the bows of one side along two segments.
    fn along(&self, seam: &Seam, ([one, next], width): ([&Flap; 2], f64), bows: &mut Vec<Bow>) {
        let flap = if one.height < next.height { next } else { one };
        let nodes = [one.corners[0], one.corners[1], next.corners[1], flap.corners[2]];
        let [a, b, c, d] = nodes.map(|node| self.place(node));
        // The one combination of four points that gives nothing of linear functions.
        let weights = [
            twice_area([b, c, d]),
            -twice_area([a, c, d]),
            twice_area([a, b, d]),
            -twice_area([a, b, c]),
        ];
        let reach = (c[0] - a[0]).hypot(c[1] - a[1]);
        let way = [(c[0] - a[0]) / reach, (c[1] - a[1]) / reach];
        let square = |p: [f64; 2]| {
            let along = (p[0] - b[0]) * way[0] + (p[1] - b[1]) * way[1];
            0.5 * along * along
        };
        let seen: f64 = weights.iter().zip([a, b, c, d]).map(|(w, p)| w * square(p)).sum();
        let parts: Vec<_> = nodes.into_iter().zip(weights.map(|weight| weight / seen)).collect();
        let length = 0.5 * (one.length + next.length);
        let area = 0.5 * length * width * seam.stiffness;
        let bent = ([way[1] * way[1], way[0] * way[0]], 0.0);
        self.push((nodes[1], bent), (&parts, &[flap.face(1.0)]), (length, area), bows);
    }

    /// Adds the bows of both yarns of a node's panel, each with its part of a curvature.
    fn push(
        &self,
        (node, (shares, rest)): (u32, ([f64; 2], f64)),
        (parts, faces): (&[(u32, f64)], &[Face]),
        (length, area): (f64, f64),
        bows: &mut Vec<Bow>,
    ) {
        let mut sums: BTreeMap<u32, f64> = BTreeMap::new();
        parts.iter().for_each(|&(node, weight)| *sums.entry(node).or_insert(0.0) += weight);
        for (law, share) in self.laws[node as usize].into_iter().zip(shares) {
            if share > PART_MIN {
                bows.push(Bow {
                    law: BendingLaw { rest_curvature: rest, ..part_of(law, share) },
                    parts: sums.iter().map(|(&node, &weight)| (node, weight)).collect(),
                    length,
                    area,
                    faces: faces.to_vec(),
                });
            }
        }
    }
}

/// The law of what a yarn does where it takes a part of a curvature, as one of the whole curvature.
fn part_of(law: BendingLaw, share: f64) -> BendingLaw {
    let backbone = match law.backbone {
        BendingBackbone::Linear { rigidity } => {
            BendingBackbone::Linear { rigidity: share * share * rigidity }
        }
        BendingBackbone::Piecewise(Piecewise { slope, intercept, knot }) => {
            BendingBackbone::Piecewise(Piecewise {
                slope: share * share * slope,
                intercept: share * intercept,
                knot: knot / share,
            })
        }
    };
    let elements = law
        .friction
        .elements
        .map(|element| Dahl { plateau: share * element.plateau, length: element.length / share });
    BendingLaw { backbone, friction: BlimanSorine { elements }, ..law }
}

impl Flap {
    fn face(&self, sign: f64) -> Face {
        let [a, b, c] = self.corners;
        Face { corners: if self.along { [a, b, c] } else { [b, a, c] }, sign }
    }
}
