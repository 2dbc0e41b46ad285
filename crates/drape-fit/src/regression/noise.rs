//! Noise of the load of a curve, from the points of the curve.

use drape_kes::Curve;

/// Median of the absolute value of a normal variate of unit deviation.
const NORMAL_MEDIAN: f64 = 0.6745;

/// Returns the standard deviation of the noise of the load of `curve`, over the range of the load.
///
/// Each point is compared with the line between its neighbours of the same branch. The median of
/// the distances is the noise even where the curve bends at a few points. A curve of few points
/// bends between its points, and the result is then too large.
pub(crate) fn load_noise(curve: &Curve) -> f64 {
    let (q, load) = (curve.deformation(), curve.load());
    let mut distances = Vec::with_capacity(load.len());
    for branch in curve.branches() {
        for i in branch.points.start + 1..branch.points.end.saturating_sub(1) {
            let run = q[i + 1] - q[i - 1];
            let part = if run == 0.0 { 0.5 } else { ((q[i] - q[i - 1]) / run).clamp(0.0, 1.0) };
            let line = (1.0 - part) * load[i - 1] + part * load[i + 1];
            let variance = 1.0 + part * part + (1.0 - part) * (1.0 - part);
            distances.push((load[i] - line).abs() / variance.sqrt());
        }
    }
    if distances.is_empty() {
        return 0.0;
    }
    let middle = distances.len() / 2;
    let (_, median, _) = distances.select_nth_unstable_by(middle, f64::total_cmp);
    *median / NORMAL_MEDIAN / curve.load_range().span()
}

#[cfg(test)]
mod tests {
    use drape_kes::{Direction, Test};

    use super::*;

    #[test]
    fn the_noise_of_a_bent_curve_is_found_through_its_shape() {
        // A parabola of 400 points with noise of 0.5 % of its range.
        let mut state = 1_u64;
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut normal = || (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
        let q: Vec<f64> = (0..400).map(|i| f64::from(i) / 399.0).collect();
        let load = q.iter().map(|q| q * q + 0.005 * normal()).collect();
        let curve = Curve::new(Test::Tensile, Direction::Warp, q, load).expect("a curve");
        let noise = load_noise(&curve);
        assert!((noise / 0.005 - 1.0).abs() < 0.15, "{noise}");
    }
}
