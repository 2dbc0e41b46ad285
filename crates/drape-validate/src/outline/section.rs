//! Section of a draped cloth by a horizontal plane, as a closed polygon.
//!
//! The plane meets each triangle in a segment; segments that share an edge of the mesh are joined.

use std::collections::BTreeMap;

/// An edge of the surface, by its ends in rising order.
type Edge = [u32; 2];

/// The longest closed curve in which a surface meets a horizontal plane: places (x, z) in order, in
/// m. None if there is no closed one.
pub(crate) fn section(
    triangles: &[[u32; 3]],
    positions: &[f64],
    height: f64,
) -> Option<Vec<[f64; 2]>> {
    let up = |corner: u32| positions[3 * corner as usize + 1];
    let mut next: BTreeMap<Edge, Vec<Edge>> = BTreeMap::new();
    for &[a, b, c] in triangles {
        let sides = [[a, b], [b, c], [c, a]].map(|[p, q]| [p.min(q), p.max(q)]);
        let met: Vec<Edge> =
            sides.into_iter().filter(|&[p, q]| (up(p) > height) != (up(q) > height)).collect();
        if let [from, to] = met[..] {
            next.entry(from).or_default().push(to);
            next.entry(to).or_default().push(from);
        }
    }
    let place = |&[p, q]: &Edge| {
        let part = (height - up(p)) / (up(q) - up(p));
        [0, 2].map(|axis| {
            let [a, b] = [p, q].map(|corner| positions[3 * corner as usize + axis]);
            a + part * (b - a)
        })
    };
    let mut longest: Option<Vec<[f64; 2]>> = None;
    while let Some((&start, _)) = next.first_key_value() {
        let mut curve = vec![start];
        let mut at = start;
        let mut closed = false;
        while let Some(ways) = next.remove(&at) {
            closed = curve.len() > 2 && ways.contains(&start);
            match ways.into_iter().find(|way| next.contains_key(way)) {
                Some(way) => {
                    curve.push(way);
                    at = way;
                }
                None => break,
            }
        }
        let curve: Vec<[f64; 2]> = curve.iter().map(place).collect();
        if closed && longest.as_ref().is_none_or(|longest| length(longest) < length(&curve)) {
            longest = Some(curve);
        }
    }
    longest
}

/// Returns the length of a closed curve.
pub(crate) fn length(curve: &[[f64; 2]]) -> f64 {
    let after = curve.iter().cycle().skip(1);
    curve.iter().zip(after).map(|(a, b)| (b[0] - a[0]).hypot(b[1] - a[1])).sum()
}

/// So many places of a closed curve at even distances along it.
pub(crate) fn evenly(curve: &[[f64; 2]], count: usize) -> Vec<[f64; 2]> {
    let step = length(curve) / count as f64;
    let mut places = Vec::with_capacity(count);
    let mut way = 0.0;
    for (a, b) in curve.iter().zip(curve.iter().cycle().skip(1)) {
        let side = (b[0] - a[0]).hypot(b[1] - a[1]);
        while places.len() < count && places.len() as f64 * step <= way + side {
            let part = (places.len() as f64 * step - way) / side;
            places.push([a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])]);
        }
        way += side;
    }
    places
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    /// A cone of some sides around the y axis: its tip, a ring of radius 1 at height 0, and one of
    /// radius 2 at −1.
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
    fn what_is_open_is_no_section() {
        let (mut triangles, positions) = cone(20);
        triangles.retain(|triangle| *triangle != [0, 1, 2]);
        assert_eq!(section(&triangles, &positions, 0.5), None);
        assert!(section(&triangles, &positions, -0.5).is_some());
    }
}
