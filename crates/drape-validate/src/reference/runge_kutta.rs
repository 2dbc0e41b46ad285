//! Runge–Kutta formula of the fourth order, for equations `$y' = f(s, y)$` in even steps.
//!
//! ```math
//! y_{n+1} = y_n + \tfrac h6\,(k_1 + 2k_2 + 2k_3 + k_4)
//! ```

/// Marches `$y' = f(s, y)$` from 0 to an end in even steps of the classical Runge–Kutta formula.
pub(crate) fn march<const N: usize>(
    slope: impl Fn(f64, [f64; N]) -> [f64; N],
    start: [f64; N],
    end: f64,
    steps: usize,
) -> [f64; N] {
    trajectory(slope, start, end, steps).last().unwrap_or(start)
}

/// The same, step by step from the first one's end on.
pub(crate) fn trajectory<const N: usize>(
    slope: impl Fn(f64, [f64; N]) -> [f64; N],
    start: [f64; N],
    end: f64,
    steps: usize,
) -> impl Iterator<Item = [f64; N]> {
    let h = end / steps as f64;
    let along = move |y: [f64; N], k: [f64; N], part: f64| {
        let mut out = y;
        out.iter_mut().zip(k).for_each(|(y, k)| *y += part * h * k);
        out
    };
    let mut y = start;
    (0..steps).map(move |step| {
        let s = step as f64 * h;
        let a = slope(s, y);
        let b = slope(s + 0.5 * h, along(y, a, 0.5));
        let c = slope(s + 0.5 * h, along(y, b, 0.5));
        let d = slope(s + h, along(y, c, 1.0));
        for (i, y) in y.iter_mut().enumerate() {
            *y += h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]);
        }
        y
    })
}
