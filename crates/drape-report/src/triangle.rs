/// How far outside a cell centre may lie and still be covered, as a share of the triangle.
///
/// Far above rounding, so that no centre on a common edge falls between two neighbours, and far
/// below what could be seen.
const EDGE: f64 = 1e-9;

/// A triangle in a plane of pixels or texels.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Flat {
    pub(crate) corners: [[f64; 2]; 3],
    /// Twice the area, with the sign of the winding.
    area: f64,
}

impl Flat {
    /// None for a triangle without area or with corners that are not finite.
    pub(crate) fn new(corners: [[f64; 2]; 3]) -> Option<Flat> {
        let [a, b, c] = corners;
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        (area.is_finite() && area != 0.0).then_some(Flat { corners, area })
    }

    /// Shares of the corners at a point; all within 0 and 1 inside.
    pub(crate) fn shares(&self, x: f64, y: f64) -> [f64; 3] {
        let [a, b, c] = self.corners;
        let over = |p: [f64; 2], q: [f64; 2]| {
            ((q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])) / self.area
        };
        [over(b, c), over(c, a), over(a, b)]
    }

    /// The first and the last row that the triangle can cover, of those below `rows`.
    pub(crate) fn rows(&self, rows: usize) -> (usize, usize) {
        span(self.corners.map(|c| c[1]), rows)
    }

    /// Visits every cell of a `[columns, rows]` grid whose centre is inside.
    pub(crate) fn cover(&self, size: [usize; 2], visit: impl FnMut(usize, usize, [f64; 3])) {
        self.cover_rows(size[0], self.rows(size[1]), visit);
    }

    /// Visits the cells of some rows only, from the first to before the last.
    pub(crate) fn cover_rows(
        &self,
        columns: usize,
        (first, last): (usize, usize),
        mut visit: impl FnMut(usize, usize, [f64; 3]),
    ) {
        let (left, right) = span(self.corners.map(|c| c[0]), columns);
        // The shares are linear along a row.
        let step = {
            let (here, next) = (self.shares(0.0, 0.0), self.shares(1.0, 0.0));
            [0, 1, 2].map(|k| next[k] - here[k])
        };
        for row in first..last {
            let start = self.shares(left as f64 + 0.5, row as f64 + 0.5);
            // Columns, counted from the left, in which no share is below zero.
            let (mut from, mut to) = (0.0f64, (right - left) as f64 - 1.0);
            for k in 0..3 {
                let zero = -(start[k] + EDGE) / step[k];
                if step[k] > 0.0 {
                    from = from.max(zero);
                } else if step[k] < 0.0 {
                    to = to.min(zero);
                } else if start[k] < -EDGE {
                    to = -1.0;
                }
            }
            // A cast takes care of what is below 0.
            for way in from.ceil() as usize..(to + 1.0).floor() as usize {
                let shares = [0, 1, 2].map(|k| start[k] + way as f64 * step[k]);
                visit(left + way, row, shares);
            }
        }
    }
}

/// Cells whose centres are within three values, as a half-open range below `count`.
fn span(values: [f64; 3], count: usize) -> (usize, usize) {
    let low = values.iter().fold(f64::MAX, |low, v| low.min(*v));
    let high = values.iter().fold(f64::MIN, |high, v| high.max(*v));
    // A cast takes care of what is below 0 or too large.
    let first = (low - 0.5).ceil().max(0.0) as usize;
    let last = (high + 0.5).floor().max(0.0) as usize;
    (first.min(count), last.min(count))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_halves_of_a_square_cover_each_cell_once() {
        let corners = [[0.7, 0.2], [19.3, 1.1], [18.4, 17.9], [1.4, 16.6]];
        let mut count = vec![0; 400];
        let mut centers = 0.0;
        for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
            let flat = Flat::new([corners[a], corners[b], corners[c]]).unwrap();
            flat.cover([20, 20], |x, y, shares| {
                count[20 * y + x] += 1;
                centers += shares.iter().sum::<f64>();
            });
        }
        assert!(count.iter().all(|n| *n <= 1), "a cell is covered twice");
        let covered = count.iter().sum::<i32>();
        // The shoelace formula gives 295.59 cells; the border cuts some 70 of them.
        assert!((288..=303).contains(&covered), "{covered} cells");
        assert!((centers - f64::from(covered)).abs() < 1e-9, "{centers}");
    }

    #[test]
    fn a_triangle_without_area_covers_nothing() {
        assert!(Flat::new([[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]).is_none());
        assert!(Flat::new([[0.0, 0.0], [f64::NAN, 1.0], [2.0, 0.0]]).is_none());
    }
}
