//! Folds of an outline: maxima of a closed curve that stand out by a prominence.
//!
//! The prominence of a maximum is its height above the higher of the two minima beside it.

/// Returns the indices of the maxima of the closed `curve` that have at least `prominence`, in the
/// unit of `curve`.
pub(crate) fn maxima(curve: &[f64], prominence: f64) -> Vec<usize> {
    let count = curve.len();
    // The search starts at the lowest value, so that no maximum lies across the end.
    let first = (0..count).min_by(|&a, &b| curve[a].total_cmp(&curve[b])).unwrap_or(0);
    let (mut low, mut high, mut maxima, mut rising) =
        (curve[first % count], first, Vec::new(), true);

    // `low` is the minimum before the highest value, which has the index `high`. A maximum is
    // certain where the curve has fallen by `prominence`.
    for k in first..=first + count {
        let value = curve[k % count];
        if rising {
            high = if value > curve[high % count] { k } else { high };
            if curve[high % count] - value >= prominence {
                if curve[high % count] - low >= prominence {
                    maxima.push(high % count);
                }
                (low, rising) = (value, false);
            }
        } else {
            low = low.min(value);
            if value - low >= prominence {
                (high, rising) = (k, true);
            }
        }
    }
    maxima
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::super::harmonics::Harmonics;
    use super::*;

    const ANGLES: usize = 720;
    const HARMONICS: usize = 20;
    const PROMINENCE: f64 = 3e-3;

    #[test]
    fn waves_are_counted_and_ripples_are_not() {
        let wave = |count: f64, amplitude: f64| {
            let at = |k: usize| {
                let angle = TAU * k as f64 / ANGLES as f64;
                0.1 + amplitude * (count * angle + 0.3).cos() + 1e-3 * (40.0 * angle).cos()
            };
            let smooth = Harmonics::new(&(0..ANGLES).map(at).collect::<Vec<_>>(), HARMONICS);
            maxima(&smooth.curve(ANGLES), PROMINENCE).len()
        };
        assert_eq!([wave(2.0, 0.01), wave(7.0, 0.004), wave(5.0, 0.001)], [2, 7, 0]);
    }

    #[test]
    fn maxima_are_where_they_are() {
        let at = |k: usize| (TAU * 3.0 * (k as f64 - 10.0) / 360.0).cos();
        let curve: Vec<f64> = (0..360).map(at).collect();
        let mut found = maxima(&curve, 0.5);
        found.sort_unstable();
        assert_eq!(found, [10, 130, 250]);
    }
}
