//! Builder of the connectors of seams from the triangles beside them.

use std::collections::{BTreeMap, BTreeSet};

use drape_fabric::{BendingBackbone, BendingLaw, BlimanSorine, Dahl, Fabric, Piecewise};

use crate::measure::vector::WeightedNode;
use crate::panel::lattice::Lattice;
use crate::panel::triangle::twice_area;
use crate::seam::connector::{Face, SeamConnector};
use crate::seam::description::Seam;

/// Least fraction of a curvature that bends a yarn. Below it the yarn is nearly at a right angle.
const FRACTION_MIN: f64 = 1e-3;

/// Reason why a seam cannot be built, and the number of the pair at fault.
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

/// Connector of a seam before it has laws. Along each yarn it takes a fraction of the curvature.
struct ConnectorDraft<'a> {
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
    /// Returns the builder for seams between `panels`.
    pub(crate) fn new(panels: &[(&Lattice, &Fabric)]) -> Self {
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
            // A side with one triangle is on the outline.
            let outer = faces.into_iter().filter(|(_, faces)| faces.len() == 1);
            builder.sides.extend(outer.map(|(side, faces)| (side, faces[0])));
            builder.coordinates.extend(&lattice.coordinates);
            let laws = [fabric.warp.bending, fabric.weft.bending];
            builder.laws.resize(builder.coordinates.len(), laws);
        }
        builder
    }

    /// Returns the number of particles of all panels.
    pub(crate) fn particle_count(&self) -> usize {
        self.coordinates.len()
    }

    /// Returns the material coordinates of `node`, in m.
    fn at(&self, node: u32) -> [f64; 2] {
        self.coordinates[node as usize]
    }

    /// Returns the triangle beside the segment from `from` to `to`, which begins at the pair number
    /// `pair`.
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

    /// Appends the connectors of `seam` to `connectors`.
    pub(crate) fn append(
        &self,
        seam: &Seam,
        connectors: &mut Vec<SeamConnector>,
    ) -> Result<(), SeamProblem> {
        self.check(seam)?;
        // Triangles on both sides of each segment, `None` where nothing bends.
        let breaks: BTreeSet<usize> = seam.breaks.iter().copied().collect();
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
            let is_broken = stays || breaks.contains(&pair);
            segments.push(if is_broken {
                None
            } else {
                Some([self.side_triangles(pair, &sides[0])?, self.side_triangles(pair, &sides[1])?])
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
            let means = here.iter().chain(there).map(|side| {
                side.iter().map(|triangle| triangle.height).sum::<f64>() / side.len() as f64
            });
            let width = 0.25 * means.sum::<f64>();
            for (side, next_side) in here.iter().zip(there) {
                if let ([triangle], [next]) = (&side[..], &next_side[..]) {
                    self.append_along(seam, [triangle, next], width, connectors);
                }
            }
        }
        Ok(())
    }

    /// Returns the triangles beside a line of `particles` from the pair number `pair` to the next.
    fn side_triangles(
        &self,
        pair: usize,
        particles: &[u32],
    ) -> Result<Vec<SideTriangle>, SeamProblem> {
        particles.windows(2).map(|ends| self.side_triangle(pair, ends[0], ends[1])).collect()
    }

    /// Checks the numbers of `seam` and that its particles exist.
    fn check(&self, seam: &Seam) -> Result<(), SeamProblem> {
        if seam.pairs.len() < 2 {
            return Err(SeamProblem { pair: 0, what: "a seam has two pairs at least" });
        }
        if !(seam.stiffness >= 0.0 && seam.stiffness.is_finite()) {
            let what = "the stiffness is not a number of at least 0";
            return Err(SeamProblem { pair: 0, what });
        }
        if seam.rest_angle.is_nan() || seam.rest_angle.abs() > Seam::REST_ANGLE_MAX {
            return Err(SeamProblem { pair: 0, what: "the angle at rest is beyond 140°" });
        }
        let missing = seam
            .pairs
            .iter()
            .position(|pair| pair.iter().any(|&node| node as usize >= self.coordinates.len()));
        match missing {
            Some(pair) => Err(SeamProblem { pair, what: "a particle of it does not exist" }),
            None => Ok(()),
        }
    }

    /// Appends the connectors between the triangles of both `sides` from one pair to the next.
    fn append_across(
        &self,
        seam: &Seam,
        sides: &[Vec<SideTriangle>; 2],
        connectors: &mut Vec<SeamConnector>,
    ) {
        let [first, second] = sides;
        let arcs = first.len().max(second.len());
        for k in 0..arcs {
            // A side with one triangle has it opposite all triangles of the other side.
            let triangles = [first, second].map(|side| &side[k.min(side.len() - 1)]);
            let [length, second_length] =
                [0, 1].map(|side| triangles[side].length * sides[side].len() as f64 / arcs as f64);
            self.append_between(seam, triangles, length + second_length, connectors);
        }
    }

    /// Appends the connectors of a segment between two `triangles`. `lengths` is the sum of the
    /// lengths of their sides there, in m.
    fn append_between(
        &self,
        seam: &Seam,
        triangles: [&SideTriangle; 2],
        lengths: f64,
        connectors: &mut Vec<SeamConnector>,
    ) {
        let [first, second] = triangles;
        let width = 0.5 * (first.height + second.height);
        let area = 0.25 * lengths * width * seam.stiffness;

        // Each triangle adds the direction in which its third corner leaves the segment.
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
        let sign = if first.along == second.along { -1.0 } else { 1.0 };
        let faces = [first.face(1.0), second.face(sign)];
        for triangle in triangles {
            let [a, b, _] = triangle.corners.map(|node| self.at(node));
            let direction = [(b[0] - a[0]) / triangle.length, (b[1] - a[1]) / triangle.length];
            let draft = ConnectorDraft {
                node: triangle.corners[0],
                // Across the segment: the warp takes most where the segment is along the weft.
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

    /// Appends the connectors of one side of `seam` along two segments, with a strip of `width`, in
    /// m.
    fn append_along(
        &self,
        seam: &Seam,
        [triangle, next]: [&SideTriangle; 2],
        width: f64,
        connectors: &mut Vec<SeamConnector>,
    ) {
        let higher = if triangle.height < next.height { next } else { triangle };
        let nodes = [triangle.corners[0], triangle.corners[1], next.corners[1], higher.corners[2]];
        let [a, b, c, d] = nodes.map(|node| self.at(node));
        // Only this combination of four points is zero on linear functions.
        let weights = [
            twice_area([b, c, d]),
            -twice_area([a, c, d]),
            twice_area([a, b, d]),
            -twice_area([a, b, c]),
        ];
        // Its scale makes it one on half of the squared length along the seam.
        let span = (c[0] - a[0]).hypot(c[1] - a[1]);
        let direction = [(c[0] - a[0]) / span, (c[1] - a[1]) / span];
        let terms = weights.iter().zip([a, b, c, d]).map(|(weight, point)| {
            let along = (point[0] - b[0]) * direction[0] + (point[1] - b[1]) * direction[1];
            weight * (0.5 * along * along)
        });
        let scale: f64 = terms.sum();
        let weighted: Vec<WeightedNode> = nodes
            .into_iter()
            .zip(weights)
            .map(|(node, weight)| WeightedNode { node, weight: weight / scale })
            .collect();
        let length = 0.5 * (triangle.length + next.length);
        let draft = ConnectorDraft {
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

    /// Appends the connectors of both yarns of a particle's panel, each with its fraction of the
    /// curvature of `draft`.
    fn append_yarns(&self, draft: &ConnectorDraft<'_>, connectors: &mut Vec<SeamConnector>) {
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

/// Returns `law`, the law of a yarn that takes the fraction `$c$` of a curvature, as a law of the
/// whole curvature: `$M'(\kappa) = c\,M(c\,\kappa)$`.
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

    // Friction turns with the yarn, over a longer path of the whole curvature.
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
