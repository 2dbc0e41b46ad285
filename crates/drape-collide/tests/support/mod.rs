//! What the tests fraction: numbers that look random, and derivatives by differences.

#![allow(dead_code)]

use drape_collide::{Body, Mesh, Pose, Shape};

/// Linear congruential generator of Knuth's MMIX: the same numbers on every machine.
pub struct Dice(u64);

impl Dice {
    pub fn new(seed: u64) -> Dice {
        Dice(seed)
    }

    /// Uniform between -1 and 1.
    pub fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// Uniform in the cube of half the side `size`.
    pub fn point(&mut self, size: f64) -> [f64; 3] {
        [0; 3].map(|_| size * self.roll())
    }

    /// Uniform on the unit sphere.
    pub fn direction(&mut self) -> [f64; 3] {
        loop {
            let point = self.point(1.0);
            let length = norm(point);
            if length > 0.1 && length < 1.0 {
                return point.map(|p| p / length);
            }
        }
    }
}

pub fn norm(a: [f64; 3]) -> f64 {
    a.iter().map(|v| v * v).sum::<f64>().sqrt()
}

pub fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Fourth-order central difference of a vector-valued function along one coordinate.
pub fn derivative<const N: usize>(
    x: &[f64],
    coordinate: usize,
    step: f64,
    f: &mut dyn FnMut(&[f64]) -> [f64; N],
) -> [f64; N] {
    let mut at = |shift: f64| {
        let mut x = x.to_vec();
        x[coordinate] += shift * step;
        f(&x)
    };
    let (far, near) = ([at(2.0), at(-2.0)], [at(1.0), at(-1.0)]);
    std::array::from_fn(|k| {
        (8.0 * (near[0][k] - near[1][k]) - (far[0][k] - far[1][k])) / (12.0 * step)
    })
}

/// One body of each primitive form, some with rounded edges, all at a skew pose.
pub fn primitives() -> Vec<Body> {
    let pose = Pose::new([0.1, -0.2, 0.3]).rotated([1.0, 2.0, -0.5], 0.7);
    let half_extents = [0.2, 0.3, 0.25];
    let shapes = [
        ("ball", Shape::Sphere { radius: 0.3 }),
        ("box", Shape::Box { half_extents, edge_radius: 0.0 }),
        ("rounded box", Shape::Box { half_extents, edge_radius: 0.05 }),
        ("cylinder", Shape::Cylinder { radius: 0.2, half_height: 0.3, edge_radius: 0.0 }),
        ("rounded cylinder", Shape::Cylinder { radius: 0.2, half_height: 0.3, edge_radius: 0.04 }),
        ("floor", Shape::Plane),
    ];
    shapes
        .into_iter()
        .map(|(name, shape)| Body::new(name, shape, pose).with_friction(0.4))
        .collect()
}

/// The mesh of a primitive, in its own frame.
pub fn meshed(shape: Shape) -> Mesh {
    let outline = Body::new("outline", shape, Pose::default()).triangulate().unwrap();
    Mesh::new(&outline.vertices, &outline.triangles).unwrap()
}
