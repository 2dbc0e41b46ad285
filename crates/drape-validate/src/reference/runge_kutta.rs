//! Runge–Kutta formula of the fourth order, for equations `$y' = f(s, y)$` in even steps.
//!
//! ```math
//! y_{n+1} = y_n + \tfrac h6\,(k_1 + 2k_2 + 2k_3 + k_4)
//! ```

/// Integrates `$y' = f(s, y)$` with the classical Runge–Kutta formula, and returns `$y$` at `end`.
///
/// `slope` is `$f$`, and `start` is `$y$` at 0. All `steps` are equally long.
pub(crate) fn march<const N: usize>(
    slope: impl Fn(f64, [f64; N]) -> [f64; N],
    start: [f64; N],
    end: f64,
    steps: usize,
) -> [f64; N] {
    trajectory(slope, start, end, steps).last().unwrap_or(start)
}

/// Integrates as [`march`] does, and returns `$y$` at the end of each step.
pub(crate) fn trajectory<const N: usize>(
    slope: impl Fn(f64, [f64; N]) -> [f64; N],
    start: [f64; N],
    end: f64,
    steps: usize,
) -> impl Iterator<Item = [f64; N]> {
    let h = end / steps as f64;
    let mut y = start;
    (0..steps).map(move |step| {
        let s = step as f64 * h;
        let a = slope(s, y);
        let b = slope(s + 0.5 * h, moved(y, a, 0.5 * h));
        let c = slope(s + 0.5 * h, moved(y, b, 0.5 * h));
        let d = slope(s + h, moved(y, c, 1.0 * h));

        for (i, y) in y.iter_mut().enumerate() {
            *y += h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]);
        }
        y
    })
}

/// Returns `y` moved along `slope` by `step`.
fn moved<const N: usize>(mut y: [f64; N], slope: [f64; N], step: f64) -> [f64; N] {
    y.iter_mut().zip(slope).for_each(|(y, k)| *y += step * k);
    y
}
