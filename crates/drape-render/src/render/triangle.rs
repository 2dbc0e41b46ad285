//! Triangle in a plane of pixels or texels, and the cells that it covers.

use std::ops::Range;

/// Tolerance of the coverage test: barycentric coordinate of a cell centre outside the triangle
/// that still counts as covered.
///
/// Far above rounding, so that no centre on a common edge falls between two neighbours, and far
/// below what could be seen.
const EDGE: f64 = 1e-9;

/// Triangle in a plane of pixels or texels.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PlaneTriangle {
    pub(crate) corners: [[f64; 2]; 3],
    /// Twice the area, with the sign of the winding.
    area: f64,
}

impl PlaneTriangle {
    /// Returns a triangle with `corners`. Returns `None` if it has no area or corners that are not
    /// finite.
    pub(crate) fn new(corners: [[f64; 2]; 3]) -> Option<PlaneTriangle> {
        let [a, b, c] = corners;
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        (area.is_finite() && area != 0.0).then_some(PlaneTriangle { corners, area })
    }

    /// Returns the barycentric coordinates of the point `x`, `y`. Inside all of them are between 0
    /// and 1.
    pub(crate) fn barycentric(&self, x: f64, y: f64) -> [f64; 3] {
        let [a, b, c] = self.corners;
        let over = |p: [f64; 2], q: [f64; 2]| {
            ((q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])) / self.area
        };
        [over(b, c), over(c, a), over(a, b)]
    }

    /// Returns the rows that the triangle can cover, below `count`.
    pub(crate) fn rows(&self, count: usize) -> Range<usize> {
        span(self.corners.map(|c| c[1]), count)
    }

    /// Returns the change from one column to the next of a quantity that is linear in the triangle
    /// and has `values` at the corners.
    pub(crate) fn slope(&self, values: [f64; 3]) -> f64 {
        let [a, b, c] = self.corners;
        let rise = |p: [f64; 2], q: [f64; 2], value: f64| (p[1] - q[1]) * value;
        (rise(b, c, values[0]) + rise(c, a, values[1]) + rise(a, b, values[2])) / self.area
    }

    /// Visits the cells whose centres are inside the triangle, row by row of `rows`, below
    /// `columns`.
    pub(crate) fn spans(&self, columns: usize, rows: Range<usize>, mut visit: impl FnMut(Span)) {
        let across = span(self.corners.map(|c| c[0]), columns);
        if across.is_empty() || rows.is_empty() {
            return;
        }
        // Barycentric coordinates are linear along a row and from row to row.
        let (left, top) = (across.start as f64 + 0.5, rows.start as f64 + 0.5);
        let start = self.barycentric(left, top);
        let [right, below] = [self.barycentric(left + 1.0, top), self.barycentric(left, top + 1.0)];
        let step = [0, 1, 2].map(|k| right[k] - start[k]);
        let down = [0, 1, 2].map(|k| below[k] - start[k]);
        let run = step.map(|step| -1.0 / step);
        let last = (across.end - across.start) as f64 - 1.0;

        for (number, row) in rows.enumerate() {
            let here = [0, 1, 2].map(|k| start[k] + number as f64 * down[k]);
            // First and last column, counted from the left, in which no coordinate is below zero.
            let (mut from, mut to) = (0.0f64, last);
            for k in 0..3 {
                let zero = (here[k] + EDGE) * run[k];
                if step[k] > 0.0 {
                    from = from.max(zero);
                } else if step[k] < 0.0 {
                    to = to.min(zero);
                } else if here[k] < -EDGE {
                    to = -1.0;
                }
            }
            // The cast rounds down, and maps numbers below 0 to 0.
            let whole = from as usize;
            let from = whole + usize::from(from > whole as f64);
            let to = (to + 1.0) as usize;
            if from < to {
                let first = [0, 1, 2].map(|k| here[k] + from as f64 * step[k]);
                visit(Span { row, columns: across.start + from..across.start + to, first });
            }
        }
    }
}

/// Cells of a row whose centres are in a triangle.
pub(crate) struct Span {
    pub(crate) row: usize,
    pub(crate) columns: Range<usize>,
    /// Barycentric coordinates of the first cell.
    pub(crate) first: [f64; 3],
}

impl Span {
    /// Returns the value at the first cell of a quantity that is linear in the triangle and has
    /// `values` at the corners.
    pub(crate) fn start(&self, values: [f64; 3]) -> f64 {
        (0..3).map(|k| self.first[k] * values[k]).sum()
    }
}

/// Returns the cells below `count` whose centres are between the extremes of `values`.
fn span(values: [f64; 3], count: usize) -> Range<usize> {
    let low = values.iter().fold(f64::MAX, |low, v| low.min(*v));
    let high = values.iter().fold(f64::MIN, |high, v| high.max(*v));
    // The casts round down, and map numbers that are too small or too large to the nearest number.
    let whole = (low - 0.5) as usize;
    let first = whole + usize::from(low - 0.5 > whole as f64);
    let last = (high + 0.5) as usize;
    first.min(count)..last.min(count)
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
            let triangle = PlaneTriangle::new([corners[a], corners[b], corners[c]]).unwrap();
            triangle.spans(20, triangle.rows(20), |span| {
                for (offset, column) in span.columns.clone().enumerate() {
                    count[20 * span.row + column] += 1;
                    centers += span.start([1.0; 3]) + offset as f64 * triangle.slope([1.0; 3]);
                }
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
        assert!(PlaneTriangle::new([[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]).is_none());
        assert!(PlaneTriangle::new([[0.0, 0.0], [f64::NAN, 1.0], [2.0, 0.0]]).is_none());
    }
}
