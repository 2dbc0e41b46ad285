//! Layout of panels in rows on a sheet.

/// Ratio of the width of a sheet to its height if no width is given.
const SHAPE: f64 = 1.5;

/// Corners of the bounding box of a panel, low and high, with y up.
pub(crate) type Extent = [[f64; 2]; 2];

/// Panels in rows, the tall ones first so that rows are full.
pub(crate) struct Rows {
    /// Width and height of the sheet.
    pub(crate) size: [f64; 2],
    /// Position of the origin of each panel's frame, with y down.
    pub(crate) origins: Vec<[f64; 2]>,
}

/// Returns the width of a sheet of the usual shape that has the area of the boxes `extents`.
pub(crate) fn usual_width(extents: &[Extent]) -> f64 {
    let areas = extents.iter().map(|[low, high]| (high[0] - low[0]) * (high[1] - low[1]));
    (SHAPE * areas.sum::<f64>()).sqrt()
}

impl Rows {
    /// Returns the layout of panels with the bounding boxes `extents`, with `gap` between them and
    /// around them. A row ends before it is wider than `limit`, if it has a panel.
    pub(crate) fn new(extents: &[Extent], gap: f64, limit: f64) -> Self {
        let heights: Vec<f64> = extents.iter().map(|[low, high]| high[1] - low[1]).collect();
        let mut order: Vec<usize> = (0..extents.len()).collect();
        order.sort_by(|&a, &b| heights[b].total_cmp(&heights[a]).then(a.cmp(&b)));

        let (mut x, mut y, mut tallest, mut width) = (gap, gap, 0.0_f64, 0.0_f64);
        let mut origins = vec![[0.0; 2]; extents.len()];
        for k in order {
            let [low, high] = extents[k];
            let across = high[0] - low[0];
            if x > gap && x + across > limit {
                (x, y, tallest) = (gap, y + tallest + gap, 0.0);
            }
            origins[k] = [x - low[0], y + high[1]];
            x += across + gap;
            tallest = tallest.max(heights[k]);
            width = width.max(x);
        }
        Self { size: [width, y + tallest + gap], origins }
    }
}
