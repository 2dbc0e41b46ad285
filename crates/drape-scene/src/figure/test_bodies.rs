//! Bodies of elliptic rings, whose girths are known, for tests.

use std::f64::consts::TAU;

use drape_collide::Triangulation;

/// Number of points of a ring.
const COUNT: usize = 120;

/// Returns the length round an ellipse of two radii.
pub(super) fn ellipse_perimeter([a, b]: [f64; 2]) -> f64 {
    let count = 100_000_u32;
    let at = |k: u32| {
        let (sin, cos) = (TAU * f64::from(k) / f64::from(count)).sin_cos();
        [a * cos, b * sin]
    };
    let chord = |k: u32| {
        let ([a, b], [c, d]) = (at(k), at(k + 1));
        (c - a).hypot(d - b)
    };
    (0..count).map(chord).sum()
}

/// Height of a ring, its middle in x and z, and its radii.
pub(super) type Ring = (f64, [f64; 2], [f64; 2]);

/// Returns the closed surface through some rings.
pub(super) fn rings(rings: &[Ring]) -> Triangulation {
    let mut mesh = Triangulation { vertices: Vec::new(), triangles: Vec::new() };
    for (height, [x, z], [a, b]) in rings {
        mesh.vertices.extend((0..COUNT).map(|k| {
            let (sin, cos) = (TAU * k as f64 / COUNT as f64).sin_cos();
            [x + a * cos, *height, z + b * sin]
        }));
    }
    let corner = |ring: usize, k: usize| (ring * COUNT + k % COUNT) as u32;
    for ring in 1..rings.len() {
        for k in 0..COUNT {
            let [a, b] = [k, k + 1].map(|k| corner(ring - 1, k));
            let [c, d] = [k, k + 1].map(|k| corner(ring, k));
            mesh.triangles.extend([[a, c, b], [b, c, d]]);
        }
    }
    for (ring, is_top) in [(0, false), (rings.len() - 1, true)] {
        for k in 1..COUNT - 1 {
            let [a, b, c] = [0, k, k + 1].map(|k| corner(ring, k));
            mesh.triangles.push(if is_top { [a, c, b] } else { [a, b, c] });
        }
    }
    mesh
}

/// Returns an elliptic column between two heights.
pub(super) fn column(middle: [f64; 2], radii: [f64; 2], ends: [f64; 2]) -> Triangulation {
    rings(&ends.map(|height| (height, middle, radii)))
}

/// Returns the parts of a person of 1 m who looks towards +z: bust at 0.725, waist at 0.64, hip at
/// 0.52, with legs, feet, head and hanging arms.
pub(super) fn person() -> Vec<Triangulation> {
    let trunk = rings(&[
        (0.47, [0.0, 0.0], [0.112, 0.06]),
        (0.52, [0.0, -0.01], [0.110, 0.075]),
        (0.58, [0.0, 0.0], [0.096, 0.06]),
        (0.64, [0.0, 0.0], [0.08, 0.055]),
        (0.68, [0.0, 0.0], [0.086, 0.06]),
        (0.725, [0.0, 0.01], [0.1, 0.07]),
        (0.78, [0.0, 0.0], [0.105, 0.05]),
        (0.83, [0.0, 0.0], [0.06, 0.045]),
        (0.85, [0.0, 0.0], [0.032, 0.034]),
        (0.88, [0.0, 0.0], [0.035, 0.04]),
        (0.93, [0.0, 0.0], [0.046, 0.058]),
        (1.0, [0.0, 0.0], [0.02, 0.02]),
    ]);
    let mut parts = vec![trunk];
    for side in [-1.0, 1.0] {
        parts.push(rings(&[
            (0.0, [0.06 * side, 0.03], [0.025, 0.07]),
            (0.03, [0.06 * side, 0.02], [0.025, 0.06]),
            (0.06, [0.06 * side, 0.0], [0.025, 0.025]),
            (0.469, [0.055 * side, 0.0], [0.05, 0.055]),
        ]));
        parts.push(column([0.15 * side, 0.0], [0.022, 0.022], [0.4, 0.76]));
    }
    parts
}

/// Returns bodies turned about y by an angle, in a scale, and shifted.
pub(super) fn placed(
    parts: &[Triangulation],
    (turn, scale, shift): (f64, f64, [f64; 3]),
) -> Vec<Triangulation> {
    let (sin, cos) = turn.sin_cos();
    let place = |[x, y, z]: &[f64; 3]| {
        let turned = [cos * x + sin * z, *y, cos * z - sin * x];
        [0, 1, 2].map(|axis| scale * turned[axis] + shift[axis])
    };
    let moved = |part: &Triangulation| Triangulation {
        vertices: part.vertices.iter().map(place).collect(),
        triangles: part.triangles.clone(),
    };
    parts.iter().map(moved).collect()
}
