//! Section of a draped cloth by a horizontal plane, as a closed polygon.
//!
//! The plane cuts each triangle in a segment. Segments that share an edge of the mesh are joined.

use std::collections::BTreeMap;

/// Edge of the surface, as its two vertices in rising order.
type Edge = [u32; 2];

/// Returns the longest closed curve in which a surface cuts the horizontal plane at `height`, in m:
/// points (x, z) in order, in m. `None` if no curve is closed.
///
/// `triangles` are triples of vertices. `positions` has three coordinates for each vertex, in m.
pub(crate) fn section(
    triangles: &[[u32; 3]],
    positions: &[f64],
    height: f64,
) -> Option<Vec<[f64; 2]>> {
    // Two edges are neighbours if the plane cuts both and they are sides of one triangle.
    let is_above: Vec<bool> = positions.iter().skip(1).step_by(3).map(|y| *y > height).collect();
    let mut neighbours: BTreeMap<Edge, Vec<Edge>> = BTreeMap::new();
    for &[a, b, c] in triangles {
        let sides = [[a, b], [b, c], [c, a]].map(|[p, q]| [p.min(q), p.max(q)]);
        let cut: Vec<Edge> = sides
            .into_iter()
            .filter(|&[p, q]| is_above[p as usize] != is_above[q as usize])
            .collect();
        if let [from, to] = cut[..] {
            neighbours.entry(from).or_default().push(to);
            neighbours.entry(to).or_default().push(from);
        }
    }

    // Each chain of neighbours is followed to its end, and removed on the way.
    let mut longest: Option<Vec<[f64; 2]>> = None;
    while let Some((&start, _)) = neighbours.first_key_value() {
        let mut chain = vec![start];
        let mut edge = start;
        let mut is_closed = false;
        while let Some(beside) = neighbours.remove(&edge) {
            is_closed = chain.len() > 2 && beside.contains(&start);
            match beside.into_iter().find(|next| neighbours.contains_key(next)) {
                Some(next) => {
                    chain.push(next);
                    edge = next;
                }
                None => break,
            }
        }

        let curve: Vec<[f64; 2]> =
            chain.iter().map(|edge| crossing(*edge, positions, height)).collect();
        if is_closed && longest.as_ref().is_none_or(|longest| length(longest) < length(&curve)) {
            longest = Some(curve);
        }
    }
    longest
}

/// Returns the point (x, z) at which `edge` crosses `height`.
fn crossing([p, q]: Edge, positions: &[f64], height: f64) -> [f64; 2] {
    let [low, high] = [p, q].map(|corner| positions[3 * corner as usize + 1]);
    let part = (height - low) / (high - low);
    [0, 2].map(|axis| {
        let [a, b] = [p, q].map(|corner| positions[3 * corner as usize + axis]);
        a + part * (b - a)
    })
}

/// Returns the length of the closed `curve`, in the unit of its points.
pub(crate) fn length(curve: &[[f64; 2]]) -> f64 {
    let after = curve.iter().cycle().skip(1);
    curve.iter().zip(after).map(|(a, b)| (b[0] - a[0]).hypot(b[1] - a[1])).sum()
}

/// Returns `count` points of the closed `curve` at even distances along the curve.
pub(crate) fn evenly(curve: &[[f64; 2]], count: usize) -> Vec<[f64; 2]> {
    let step = length(curve) / count as f64;
    let mut points = Vec::with_capacity(count);
    let mut distance = 0.0;
    for (a, b) in curve.iter().zip(curve.iter().cycle().skip(1)) {
        let side = (b[0] - a[0]).hypot(b[1] - a[1]);
        while points.len() < count && points.len() as f64 * step <= distance + side {
            let part = (points.len() as f64 * step - distance) / side;
            points.push([a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])]);
        }
        distance += side;
    }
    points
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    /// Returns triangles and positions of a cone with `sides` sides around the y axis: its tip, a
    /// ring of radius 1 at height 0, and a ring of radius 2 at height −1.
    fn cone(sides: u32) -> (Vec<[u32; 3]>, Vec<f64>) {
        let ring = |radius: f64, height: f64| {
            (0..sides).flat_map(move |k| {
                let (sin, cos) = (TAU * f64::from(k) / f64::from(sides)).sin_cos();
                [radius * cos, height, radius * sin]
            })
        };
        let positions =
            [0.0, 1.0, 0.0].into_iter().chain(ring(1.0, 0.0)).chain(ring(2.0, -1.0)).collect();
        let triangles = (0..sides).flat_map(|k| {
            let (a, b) = (1 + k, 1 + (k + 1) % sides);
            [[0, a, b], [a, a + sides, b + sides], [a, b + sides, b]]
        });
        (triangles.collect(), positions)
    }

    #[test]
    fn a_cone_is_cut_in_a_circle() {
        let (triangles, positions) = cone(200);
        for (height, radius) in [(0.3, 0.7), (-0.4, 1.4)] {
            let curve = section(&triangles, &positions, height).expect("a curve");
            assert!((length(&curve) / (TAU * radius) - 1.0).abs() < 1e-3, "at {height}");
            assert!(curve.iter().all(|[x, z]| (x.hypot(*z) / radius - 1.0).abs() < 1e-3));
            let even = evenly(&curve, 37);
            assert_eq!(even.len(), 37);
            let step = |k: usize| {
                let (a, b) = (even[k], even[(k + 1) % 37]);
                (b[0] - a[0]).hypot(b[1] - a[1])
            };
            let first = step(0);
            assert!((1..37).all(|k| (step(k) / first - 1.0).abs() < 1e-3), "at {height}");
        }
        assert_eq!(section(&triangles, &positions, 2.0), None);
    }

    #[test]
    fn an_open_curve_is_no_section() {
        let (mut triangles, positions) = cone(20);
        triangles.retain(|triangle| *triangle != [0, 1, 2]);
        assert_eq!(section(&triangles, &positions, 0.5), None);
        assert!(section(&triangles, &positions, -0.5).is_some());
    }
}
