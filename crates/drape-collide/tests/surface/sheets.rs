//! Meshes that the tests share.

use crate::support::Dice;
use drape_collide::{
    Body, ContactDistances, PinchPolicy, PinchedVertices, Pose, Shape, Surface, SurfaceContact,
    SurfaceParts, SurfaceSettings, SurfaceStart,
};

pub const DISTANCES: ContactDistances =
    ContactDistances { activation_distance: 3e-4, min_separation: 5e-5 };

/// Parts of sheets of `side` × `side` vertices at a spacing, one group each, alike at rest.
pub fn sheets(layers: usize, side: usize, spacing: f64) -> SurfaceParts {
    let mut parts = SurfaceParts {
        rest_positions: Vec::new(),
        triangles: Vec::new(),
        areas: vec![spacing * spacing; layers * side * side],
        groups: Vec::new(),
        distances: vec![DISTANCES; layers],
        free_vertices: layers * side * side,
        seam_pairs: Vec::new(),
        ties: Vec::new(),
    };
    for layer in 0..layers {
        let first = (layer * side * side) as u32;
        for row in 0..side {
            for column in 0..side {
                parts.rest_positions.extend([column as f64 * spacing, row as f64 * spacing, 0.0]);
                parts.groups.push(layer as u32);
            }
        }
        for row in 0..side - 1 {
            for column in 0..side - 1 {
                let a = first + (row * side + column) as u32;
                let (b, c, d) = (a + 1, a + side as u32 + 1, a + side as u32);
                // The diagonals alternate like the squares of a chessboard.
                let halves = if (row + column) % 2 == 0 {
                    [[a, b, c], [a, c, d]]
                } else {
                    [[a, b, d], [b, c, d]]
                };
                parts.triangles.extend(halves);
            }
        }
    }
    parts
}

/// Separate triangles of random shape and place, every fifth of them a body.
pub fn soup(dice: &mut Dice, triangles: usize, size: f64) -> SurfaceParts {
    let bodies = triangles / 5;
    let free = 3 * (triangles - bodies);
    let mut rest = Vec::new();
    for _ in 0..triangles {
        let place = dice.point(1.0);
        for _ in 0..3 {
            let corner = dice.point(size);
            rest.extend((0..3).map(|k| place[k] + corner[k]));
        }
    }
    SurfaceParts {
        rest_positions: rest,
        triangles: (0..triangles as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect(),
        areas: vec![1e-4; 3 * triangles],
        groups: (0..3 * triangles).map(|v| u32::from(v >= free)).collect(),
        distances: vec![DISTANCES; 2],
        free_vertices: free,
        seam_pairs: Vec::new(),
        ties: Vec::new(),
    }
}

pub fn surface(parts: &SurfaceParts) -> Surface {
    Surface::new(parts.clone()).unwrap()
}

/// Vertices along a side of the sheet, and their distance, in m.
pub const SIDE: usize = 5;
pub const SPACING: f64 = 0.01;

/// Distance that a sheet keeps from a plate, and that at which a plate begins to repel it, in m.
pub const KEPT: f64 = 2e-4;
pub const REACH: f64 = 6e-4;

/// Thickness of a plate, in m.
const THICKNESS: f64 = 2e-3;

/// Level sheet between two plates, its vertices and the plates' at some heights.
pub struct Between {
    pub contact: SurfaceContact,
    /// Heights of the upper face of the lower plate, and of the lower face of the upper one, in m.
    faces: [f64; 2],
    /// Half of the sides of the plates, in m.
    half: f64,
}

impl Between {
    /// Sheet between plates of some half sides, in m, whose faces are at some heights, in m.
    pub fn new(pinch: PinchPolicy, half: f64, faces: [f64; 2]) -> Self {
        let plates = plates(half, faces);
        let free = SIDE * SIDE;
        let row = SIDE as u32;
        let cells = (0..row * (row - 1)).filter(|k| k % row < row - 1);
        let mut triangles: Vec<[u32; 3]> =
            cells.flat_map(|a| [[a, a + row, a + 1], [a + 1, a + row, a + row + 1]]).collect();
        let mut groups = vec![0; free];
        for (group, (corners, own)) in plates.iter().enumerate() {
            let first = groups.len() as u32;
            triangles.extend(own.iter().map(|t| t.map(|corner| corner + first)));
            groups.resize(groups.len() + corners.len() / 3, group as u32 + 1);
        }
        let bodies = [&plates[0].0[..], &plates[1].0].concat();
        let own = ContactDistances { activation_distance: 0.5 * REACH, min_separation: 0.5 * KEPT };
        let surface = Surface::new(SurfaceParts {
            rest_positions: [level(0.0), bodies.clone()].concat(),
            triangles,
            areas: vec![SPACING * SPACING; groups.len()],
            groups,
            distances: vec![own; 3],
            free_vertices: free,
            seam_pairs: Vec::new(),
            ties: Vec::new(),
        });
        let settings = SurfaceSettings { pinch, ..SurfaceSettings::new(1e8, vec![0.0; 9]) };
        let contact = SurfaceContact::new(surface.unwrap(), settings, bodies).unwrap();
        Self { contact, faces, half }
    }

    /// Makes a step in which the faces move by some ways, in m, and the sheet from a height to
    /// another one, in m; returns who is pinched since.
    pub fn step(&mut self, ways: [f64; 2], [from, to]: [f64; 2]) -> PinchedVertices {
        self.faces = [0, 1].map(|k| self.faces[k] + ways[k]);
        let [lower, upper] = plates(self.half, self.faces);
        let bodies = [lower.0, upper.0].concat();
        self.contact
            .begin(SurfaceStart::new(&level(from), &bodies))
            .unwrap()
            .commit(&level(to))
            .unwrap();
        self.contact.state().pinched_vertices()
    }

    /// Smallest distance of the sheet at a height, in m, over what is kept.
    pub fn ratio(&mut self, height: f64) -> f64 {
        self.contact.detect(&level(height)).unwrap().summary().min_ratio
    }
}

/// Vertices and triangles of two plates with some half sides, in m, whose faces are at some
/// heights, in m.
pub fn plates(half: f64, faces: [f64; 2]) -> [(Vec<f64>, Vec<[u32; 3]>); 2] {
    let half_extents = [half, 0.5 * THICKNESS, half];
    let middles = [faces[0] - 0.5 * THICKNESS, faces[1] + 0.5 * THICKNESS];
    middles.map(|y| {
        let shape = Shape::Box { half_extents, edge_radius: 0.0 };
        let plate = Body::new("plate", shape, Pose::new([0.0, y, 0.0])).triangulate().unwrap();
        (plate.vertices.as_flattened().to_vec(), plate.triangles)
    })
}

/// Level sheet at a height, in m.
pub fn level(height: f64) -> Vec<f64> {
    let place = |k: usize| SPACING * (k as f64 - 0.5 * (SIDE - 1) as f64);
    (0..SIDE * SIDE).flat_map(|v| [place(v % SIDE), height, place(v / SIDE)]).collect()
}

/// Half the side length of plates that are wider than the sheet, in m.
pub const WIDE: f64 = 0.03;

/// All vertices of the sheet.
pub const ALL: usize = SIDE * SIDE;
