//! Layout of flat panels side by side, in rows.

/// Room that a panel needs, in mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Extent {
    pub(super) width: f64,
    pub(super) height: f64,
}

/// Positions of panels in rows.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PanelLayout {
    /// Upper left corner of each panel, in mm from the upper left corner of the layout; y is down.
    pub(super) corners: Vec<[f64; 2]>,
    /// Width and height, in mm.
    pub(super) size: [f64; 2],
}

/// Width over height of a layout, as on a screen.
const ASPECT: f64 = 1.6;

impl PanelLayout {
    /// Returns a layout of `panels` in their order. `gap` is the distance between them, `above` the
    /// room for the name above each, in mm.
    pub(super) fn new(panels: &[Extent], gap: f64, above: f64) -> PanelLayout {
        let areas = panels.iter().map(|panel| (panel.width + gap) * (panel.height + gap + above));
        let whole: f64 = areas.sum();
        let widest = panels.iter().map(|panel| panel.width).fold(0.0, f64::max);
        let width_max = (ASPECT * whole).sqrt().max(widest);

        let (mut x, mut y, mut row_height, mut width) = (0.0, 0.0, 0.0_f64, 0.0_f64);
        let mut corners = Vec::new();
        for panel in panels {
            if x > 0.0 && x + panel.width > width_max {
                (x, y, row_height) = (0.0, y + row_height + gap, 0.0);
            }
            corners.push([x, y + above]);
            row_height = row_height.max(above + panel.height);
            width = width.max(x + panel.width);
            x += panel.width + gap;
        }
        PanelLayout { corners, size: [width, y + row_height] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panels_with_their_names_are_a_gap_apart() {
        let extent = |k: usize| {
            let [width, height] = [40.0 + 30.0 * (k % 3) as f64, 200.0 - 20.0 * (k % 5) as f64];
            Extent { width, height }
        };
        let panels: Vec<Extent> = (0..11).map(extent).collect();
        let (gap, above) = (10.0, 8.0);
        let PanelLayout { corners, size } = PanelLayout::new(&panels, gap, above);
        let ends = |k: usize| {
            let [x, y] = corners[k];
            [x + panels[k].width, y + panels[k].height]
        };
        for one in 0..11 {
            assert!(ends(one)[0] <= size[0] && ends(one)[1] <= size[1] + 1e-9, "{one}");
            for other in 0..one {
                let right = corners[one][0] - ends(other)[0];
                let below = corners[one][1] - above - ends(other)[1];
                let left = corners[other][0] - ends(one)[0];
                let apart = right.max(below).max(left);
                assert!((apart - gap).abs() < 1e-9 || apart > gap, "{one}, {other}: {apart} mm");
            }
        }
        assert!(size[0] / size[1] > 0.8 && size[0] / size[1] < 3.2, "{size:?}");
    }
}
