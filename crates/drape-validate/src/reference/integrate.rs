/// Marches `$y' = f(s, y)$` from 0 to an end in even steps of the classical Runge–Kutta formula.
pub(crate) fn march<const N: usize>(
    slope: impl Fn(f64, [f64; N]) -> [f64; N],
    start: [f64; N],
    end: f64,
    steps: usize,
) -> [f64; N] {
    way(slope, start, end, steps).last().unwrap_or(start)
}

/// The same, step by step from the first one's end on.
pub(crate) fn way<const N: usize>(
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

/// Where a function that changes sign once between two places does, to the last bits.
pub(crate) fn root(f: impl Fn(f64) -> f64, low: f64, high: f64) -> f64 {
    let rising = f(low) < 0.0;
    let (mut low, mut high) = (low, high);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if (f(middle) < 0.0) == rising {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}
