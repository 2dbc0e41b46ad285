//! Area of a polygon within a cell, for panels at an angle to the yarns.

/// Returns the area of a convex `polygon`, with its corners anticlockwise, within the rectangle
/// from `low` to `high`, in m².
///
/// The polygon is clipped at one side of the rectangle after the other \[SH74\]. Neighbouring
/// rectangles find identical points on their common side, so their areas add up to the area of
/// both.
pub(crate) fn area_within(polygon: &[[f64; 2]], low: [f64; 2], high: [f64; 2]) -> f64 {
    let mut inside = polygon.to_vec();
    for (axis, bound, sign) in
        [(0, low[0], 1.0), (0, high[0], -1.0), (1, low[1], 1.0), (1, high[1], -1.0)]
    {
        inside = clip(&inside, axis, |x| sign * (x - bound));
    }
    // Offsets from one of the corners keep the digits of a small area far from the origin.
    let Some(&[x, y]) = inside.first() else { return 0.0 };
    let doubled = inside.windows(2).map(|pair| {
        let ([a, b], [c, d]) = (pair[0], pair[1]);
        (a - x) * (d - y) - (c - x) * (b - y)
    });
    0.5 * doubled.sum::<f64>()
}

/// Returns the part of a convex `polygon` where `inside`, a function of the coordinate `axis`, is
/// not negative.
fn clip(polygon: &[[f64; 2]], axis: usize, inside: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (index, &from) in polygon.iter().enumerate() {
        let to = polygon[(index + 1) % polygon.len()];
        let [here, there] = [from, to].map(|corner| inside(corner[axis]));
        if here >= 0.0 {
            kept.push(from);
        }
        if here * there < 0.0 {
            let fraction = here / (here - there);
            kept.push([0, 1].map(|k| from[k] + fraction * (to[k] - from[k])));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    const DIAMOND: [[f64; 2]; 4] = [[0.0, -1.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]];

    #[test]
    fn parts_of_a_diamond_have_their_areas() {
        for (low, high, area) in [
            ([-2.0, -2.0], [2.0, 2.0], 2.0),
            ([0.0, 0.0], [1.0, 1.0], 0.5),
            ([0.0, 0.0], [0.5, 0.5], 0.25),
            ([0.5, 0.5], [1.0, 1.0], 0.0),
            ([0.5, 0.0], [3.0, 0.25], 0.25 * 0.375),
            ([1.5, 0.0], [2.0, 1.0], 0.0),
        ] {
            let found = area_within(&DIAMOND, low, high);
            assert!((found - area).abs() < 1e-15, "{found} in {low:?} to {high:?}, not {area}");
        }
    }

    #[test]
    fn the_parts_make_up_the_whole() {
        let turned = DIAMOND.map(|[x, y]| [7.0 + 0.8 * x - 0.3 * y, 0.3 * x + 0.8 * y]);
        let cell = |k: i32| 0.13 * f64::from(k);
        let rows = |i: i32| {
            (-20..20).map(move |j| {
                area_within(&turned, [7.0 + cell(i), cell(j)], [7.0 + cell(i + 1), cell(j + 1)])
            })
        };
        let sum: f64 = (-20..20).flat_map(rows).sum();
        assert!((sum / (2.0 * 0.73) - 1.0).abs() < 1e-13, "{sum}");
    }
}
