//! Builder of the connectors of seams from the triangles beside them.

use std::collections::BTreeMap;

use drape_fabric::{BendingBackbone, BendingLaw, BlimanSorine, Dahl, Fabric, Piecewise};

use crate::measure::vector::WeightedNode;
use crate::panel::lattice::Lattice;
use crate::panel::triangle::twice_area;
use crate::seam::connector::{Face, SeamConnector};
use crate::seam::description::Seam;

/// Least fraction of a curvature that bends a yarn; below, the yarn is at a right angle, or nearly.
const FRACTION_MIN: f64 = 1e-3;

/// Reason why a seam cannot be built, and the pair at which.
pub(crate) struct SeamProblem {
    pub(crate) pair: usize,
    pub(crate) what: &'static str,
}

/// Panels of a cloth with their outlines, to be sewn.
pub(crate) struct SeamBuilder {
    /// Material coordinates, in m.
    coordinates: Vec<[f64; 2]>,
    /// Bending laws of warp and weft at each particle.
    laws: Vec<[BendingLaw; 2]>,
    /// Triangle at each side of an outline.
    sides: BTreeMap<[u32; 2], OuterSide>,
}

/// Triangle at a side of an outline.
#[derive(Debug, Clone, Copy)]
struct OuterSide {
    /// Third corner of the triangle.
    third: u32,
    /// Whether the side runs from the lower particle to the higher, anticlockwise.
    rising: bool,
}

/// Triangle at one side of a segment of a seam.
struct SideTriangle {
    /// Ends of the segment, in the order of the seam, and the third corner.
    corners: [u32; 3],
    /// Length of the segment, in m.
    length: f64,
    /// Height of the triangle over the segment, in m.
    height: f64,
    /// Whether the seam runs anticlockwise along the outline.
    along: bool,
}

/// Connector of a seam before its laws: along each yarn it takes a fraction of the curvature.
struct Draft<'a> {
    /// Particle whose panel gives the laws.
    node: u32,
    /// Fractions of the curvature along warp and weft.
    fractions: [f64; 2],
    /// Rest curvature, in 1/m.
    rest_curvature: f64,
    /// Particles with their weights in the second difference, in 1/m².
    nodes: &'a [WeightedNode],
    faces: &'a [Face],
    /// Length over which the angle is measured, in m.
    length: f64,
    /// Area times relative stiffness, in m².
    area: f64,
}

impl SeamBuilder {
    pub(crate) fn of(panels: &[(&Lattice, &Fabric)]) -> Self {
        let mut builder =
            Self { coordinates: Vec::new(), laws: Vec::new(), sides: BTreeMap::new() };
        for (lattice, fabric) in panels {
            let first = builder.coordinates.len() as u32;
            let mut faces: BTreeMap<[u32; 2], Vec<OuterSide>> = BTreeMap::new();
            for triangle in lattice.triangles() {
                for k in 0..3 {
                    let [a, b, c] = [0, 1, 2].map(|step| first + triangle[(k + step) % 3]);
                    let side = OuterSide { third: c, rising: a < b };
                    faces.entry([a.min(b), a.max(b)]).or_default().push(side);
                }
            }
            let outer = faces.into_iter().filter(|(_, faces)| faces.len() == 1);
            builder.sides.extend(outer.map(|(side, faces)| (side, faces[0])));
            builder.coordinates.extend(&lattice.coordinates);
            let laws = [fabric.warp.bending, fabric.weft.bending];
            builder.laws.resize(builder.coordinates.len(), laws);
        }
        builder
    }

    pub(crate) fn particles(&self) -> usize {
        self.coordinates.len()
    }

    fn at(&self, node: u32) -> [f64; 2] {
        self.coordinates[node as usize]
    }

    /// Returns the triangle beside a segment of a pair and the next.
    fn side_triangle(&self, pair: usize, from: u32, to: u32) -> Result<SideTriangle, SeamProblem> {
        let Some(side) = self.sides.get(&[from.min(to), from.max(to)]) else {
            let what = "the particles of one side and the next are not neighbours on an outline";
            return Err(SeamProblem { pair, what });
        };
        let corners = [from, to, side.third];
        let [a, b, _] = corners.map(|node| self.at(node));
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let height = twice_area(corners.map(|node| self.at(node))).abs() / length;
        Ok(SideTriangle { corners, length, height, along: side.rising == (from < to) })
    }

    /// Appends the connectors of a seam.
    pub(crate) fn append(
        &self,
        seam: &Seam,
        connectors: &mut Vec<SeamConnector>,
    ) -> Result<(), SeamProblem> {
        self.check(seam)?;
        let mut ties = seam.ties.iter().peekable();
        let mut segments = Vec::new();
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
            // Over the mouth of a dart one side has one particle at both pairs, and the other
            // jumps. Where darts meet, and between edges that are apart, both sides jump.
            let stays = [0, 1].iter().any(|&side| ends[0][side] == ends[1][side]);
            let is_broken = stays || seam.breaks.contains(&pair);
            let triangles = |side: &Vec<u32>| -> Result<Vec<SideTriangle>, SeamProblem> {
                side.windows(2).map(|two| self.side_triangle(pair, two[0], two[1])).collect()
            };
            segments.push(if is_broken {
                None
            } else {
                Some([triangles(&sides[0])?, triangles(&sides[1])?])
            });
        }
        if ties.next().is_some() {
            let what = "a particle is tied to others than those of the other side, in their order";
            return Err(SeamProblem { pair: 0, what });
        }
        for sides in segments.iter().flatten() {
            self.append_across(seam, sides, connectors);
        }
        for pair in segments.windows(2) {
            let [Some(here), Some(there)] = pair else { continue };
            let mean = |side: &Vec<SideTriangle>| {
                side.iter().map(|triangle| triangle.height).sum::<f64>() / side.len() as f64
            };
            let width = 0.25 * here.iter().chain(there).map(mean).sum::<f64>();
            for (one, next) in here.iter().zip(there) {
                if let ([one], [next]) = (&one[..], &next[..]) {
                    self.append_along(seam, [one, next], width, connectors);
                }
            }
        }
        Ok(())
    }

    fn check(&self, seam: &Seam) -> Result<(), SeamProblem> {
        let wrong = |pair, what| Err(SeamProblem { pair, what });
        if seam.pairs.len() < 2 {
            return wrong(0, "a seam has two pairs at least");
        }
        if !(seam.stiffness >= 0.0 && seam.stiffness.is_finite()) {
            return wrong(0, "the stiffness is not a number of at least 0");
        }
        if seam.rest_angle.is_nan() || seam.rest_angle.abs() > Seam::REST_ANGLE_MAX {
            return wrong(0, "the angle at rest is beyond 140°");
        }
        let lost =
            |pair: &[u32; 2]| pair.iter().any(|&node| node as usize >= self.coordinates.len());
        match seam.pairs.iter().position(lost) {
            Some(pair) => wrong(pair, "a particle of it does not exist"),
            None => Ok(()),
        }
    }

    /// Appends the connectors between the triangles of both sides from one pair to the next.
    fn append_across(
        &self,
        seam: &Seam,
        sides: &[Vec<SideTriangle>; 2],
        connectors: &mut Vec<SeamConnector>,
    ) {
        let [first, second] = sides;
        let arcs = first.len().max(second.len());
        for k in 0..arcs {
            // A side with one triangle has the same one for all of the other side's.
            let [one, other] =
                [first, second].map(|side| (&side[k.min(side.len() - 1)], side.len()));
            let length = |(triangle, own): (&SideTriangle, usize)| {
                triangle.length * own as f64 / arcs as f64
            };
            let lengths = length(one) + length(other);
            self.append_between(seam, [one.0, other.0], lengths, connectors);
        }
    }

    /// Appends the connectors of a segment between two triangles, whose sides there have the given
    /// sum of lengths, in m.
    fn append_between(
        &self,
        seam: &Seam,
        triangles: [&SideTriangle; 2],
        lengths: f64,
        connectors: &mut Vec<SeamConnector>,
    ) {
        let [one, other] = triangles;
        let width = 0.5 * (one.height + other.height);
        let area = 0.25 * lengths * width * seam.stiffness;
        let mut nodes = Vec::new();
        for triangle in triangles {
            let [a, b, c] = triangle.corners.map(|node| self.at(node));
            // Foot of the third corner on the segment.
            let dot = (b[0] - a[0]) * (c[0] - a[0]) + (b[1] - a[1]) * (c[1] - a[1]);
            let foot = dot / (triangle.length * triangle.length);
            let size = 1.0 / (triangle.height * width);
            for (node, weight) in triangle.corners.into_iter().zip([foot - 1.0, -foot, 1.0]) {
                nodes.push(WeightedNode { node, weight: size * weight });
            }
        }
        // The wrong side of the second panel is up if the seam runs anticlockwise along both
        // outlines, or clockwise along both.
        let sign = if one.along == other.along { -1.0 } else { 1.0 };
        let faces = [one.face(1.0), other.face(sign)];
        for triangle in triangles {
            let [a, b, _] = triangle.corners.map(|node| self.at(node));
            let direction = [(b[0] - a[0]) / triangle.length, (b[1] - a[1]) / triangle.length];
            let draft = Draft {
                node: triangle.corners[0],
                // Across the segment: the warp where the segment is along the weft.
                fractions: direction.map(|part| part * part),
                rest_curvature: seam.rest_angle / width,
                nodes: &nodes,
                faces: &faces,
                length: width,
                area,
            };
            self.append_yarns(&draft, connectors);
        }
    }

    /// Appends the connectors of one side along two segments.
    fn append_along(
        &self,
        seam: &Seam,
        [one, next]: [&SideTriangle; 2],
        width: f64,
        connectors: &mut Vec<SeamConnector>,
    ) {
        let higher = if one.height < next.height { next } else { one };
        let nodes = [one.corners[0], one.corners[1], next.corners[1], higher.corners[2]];
        let [a, b, c, d] = nodes.map(|node| self.at(node));
        // The one combination of four points that is zero on linear functions.
        let weights = [
            twice_area([b, c, d]),
            -twice_area([a, c, d]),
            twice_area([a, b, d]),
            -twice_area([a, b, c]),
        ];
        let span = (c[0] - a[0]).hypot(c[1] - a[1]);
        let direction = [(c[0] - a[0]) / span, (c[1] - a[1]) / span];
        let square = |p: [f64; 2]| {
            let along = (p[0] - b[0]) * direction[0] + (p[1] - b[1]) * direction[1];
            0.5 * along * along
        };
        let scale: f64 = weights.iter().zip([a, b, c, d]).map(|(w, p)| w * square(p)).sum();
        let weighted = nodes.into_iter().zip(weights);
        let weighted = weighted.map(|(node, weight)| WeightedNode { node, weight: weight / scale });
        let weighted: Vec<WeightedNode> = weighted.collect();
        let length = 0.5 * (one.length + next.length);
        let draft = Draft {
            node: nodes[1],
            fractions: [direction[1] * direction[1], direction[0] * direction[0]],
            rest_curvature: 0.0,
            nodes: &weighted,
            faces: &[higher.face(1.0)],
            length,
            area: 0.5 * length * width * seam.stiffness,
        };
        self.append_yarns(&draft, connectors);
    }

    /// Appends the connectors of both yarns of a particle's panel, each with its fraction of a
    /// curvature.
    fn append_yarns(&self, draft: &Draft<'_>, connectors: &mut Vec<SeamConnector>) {
        let mut sums: BTreeMap<u32, f64> = BTreeMap::new();
        for &WeightedNode { node, weight } in draft.nodes {
            *sums.entry(node).or_insert(0.0) += weight;
        }
        for (law, fraction) in self.laws[draft.node as usize].into_iter().zip(draft.fractions) {
            if fraction > FRACTION_MIN {
                let law = law_of_fraction(law, fraction);
                connectors.push(SeamConnector {
                    law: BendingLaw { rest_curvature: draft.rest_curvature, ..law },
                    nodes: sums
                        .iter()
                        .map(|(&node, &weight)| WeightedNode { node, weight })
                        .collect(),
                    length: draft.length,
                    area: draft.area,
                    faces: draft.faces.to_vec(),
                });
            }
        }
    }
}

/// Returns the law of a yarn that takes a fraction `$c$` of a curvature as a law of the whole
/// curvature: `$M'(\kappa) = c\,M(c\,\kappa)$`.
fn law_of_fraction(law: BendingLaw, fraction: f64) -> BendingLaw {
    let backbone = match law.backbone {
        BendingBackbone::Linear { rigidity } => {
            BendingBackbone::Linear { rigidity: fraction * fraction * rigidity }
        }
        BendingBackbone::Varying(varying) => {
            BendingBackbone::Varying(varying.of_fraction(fraction))
        }
        BendingBackbone::Piecewise(Piecewise { slope, intercept, knot }) => {
            BendingBackbone::Piecewise(Piecewise {
                slope: fraction * fraction * slope,
                intercept: fraction * intercept,
                knot: knot / fraction,
            })
        }
    };
    let elements = law.friction.elements.map(|element| Dahl {
        plateau: fraction * element.plateau,
        length: element.length / fraction,
    });
    BendingLaw { backbone, friction: BlimanSorine { elements }, ..law }
}

impl SideTriangle {
    fn face(&self, sign: f64) -> Face {
        let [a, b, c] = self.corners;
        Face { corners: if self.along { [a, b, c] } else { [b, a, c] }, sign }
    }
}
