//! Specimen: a panel of a fabric in two clamps, at its true size, in a vacuum and without weight.
//!
//! Clamps are pins. The fixed clamp stays in its place. The moving clamp goes through placements,
//! one in each step, and its load is recorded.

use std::f64::consts::SQRT_2;

use drape_dynamics::{PinLoad, Simulation};
use drape_fabric::Fabric;
use drape_kes::Direction;
use drape_scene::{MotionSpec, PanelSpec, PinSpec, SceneSpec, TimeSpec};

use super::placement::{ClampPlacement, lever_arm, pivot_moment};
use crate::error::ValidationError;
use crate::setup::{alone, with_panel};

/// Width of a specimen: 20 cm.
pub(crate) const WIDTH: f64 = 0.2;

/// Free length in the tensile and the shear test: 5 cm.
pub(crate) const GAUGE: f64 = 0.05;

/// Free length in the bending test: 1 cm.
const BENDING_GAUGE: f64 = 0.01;

/// Specimen, level along x, with the clamp that moves.
pub(crate) struct Specimen {
    /// Angle from the length of the specimen to the weft, in degrees.
    grain: f64,
    /// Distance of the particles along the yarns, in m.
    pub(super) spacing: f64,
    /// Distance of the rows across the specimen, in m.
    pub(super) row: f64,
    /// Whole rows between the lines of the clamps.
    pub(super) cells: usize,
    /// Rows that the fixed and the moving clamp hold.
    rows: [usize; 2],
    /// Length of the panel, in m.
    length: f64,
    /// Middle of the panel along x, in m, from the line of the fixed clamp.
    middle: f64,
    /// Pivot of the moving clamp along x, in m, from the line of the fixed clamp.
    pivot: f64,
}

impl Specimen {
    /// Returns a specimen between two lines of particles that are held. The spacing is the nearest
    /// to `spacing`, in m, that divides the free length.
    pub(super) fn between_lines(spacing: f64) -> Self {
        let cells = (GAUGE / spacing).round().max(1.0) as usize;
        let spacing = GAUGE / cells as f64;
        Self {
            grain: 0.0,
            spacing,
            row: spacing,
            cells,
            rows: [1, 1],
            length: GAUGE,
            middle: 0.5 * GAUGE,
            pivot: GAUGE,
        }
    }

    /// Returns a specimen in clamps that also hold the slope. The spacing is the nearest to
    /// `spacing`, in m, that divides the free length.
    ///
    /// Each clamp holds three rows. The line of a clamp is midway between the second and the third
    /// row, since the third row bends as the first free cell does. A single cell is bent at the
    /// third row of both clamps, which the fixed clamp holds. The moving clamp turns about its
    /// third row.
    pub(super) fn in_clamps(spacing: f64) -> Self {
        let cells = (BENDING_GAUGE / spacing).round().max(1.0) as usize;
        let h = BENDING_GAUGE / cells as f64;
        Self {
            grain: 0.0,
            spacing: h,
            row: h,
            cells,
            rows: [3, if cells == 1 { 2 } else { 3 }],
            length: BENDING_GAUGE + 3.0 * h,
            middle: 0.5 * BENDING_GAUGE,
            pivot: BENDING_GAUGE - 0.5 * h,
        }
    }

    /// Returns a specimen as [`Specimen::in_clamps`] does, cut on the bias.
    ///
    /// The distance of rows across the specimen is the distance of particles along the yarns over
    /// √2. A pin that holds two rows of a straight panel holds three of these rows.
    pub(super) fn on_the_bias(spacing: f64) -> Self {
        let cells = (BENDING_GAUGE * SQRT_2 / spacing).round().max(2.0) as usize;
        let h = BENDING_GAUGE / cells as f64;
        let along = Self::in_clamps(h);
        Self { grain: 45.0, spacing: h * SQRT_2, rows: [2, 2], ..along }
    }

    /// Returns `panel` cut on the bias from a grid with rows at both ends. If the number of rows is
    /// odd, a particle lies in the middle of the panel.
    fn cut_on_the_bias(&self, panel: PanelSpec) -> PanelSpec {
        let has_odd_cells = (self.length / self.row).round() % 2.0 == 1.0;
        let grid = if has_odd_cells { 0.5 * self.spacing } else { 0.0 };
        PanelSpec { grain: self.grain, grid: Some([grid, 0.0]), ..panel }
    }

    /// Moves the clamp through `placements`, one in each step, and returns the load of the clamp
    /// after each step. Moments are about the pivot of the clamp.
    pub(super) fn drive(
        &self,
        fabric: &Fabric,
        direction: Direction,
        placements: &[ClampPlacement],
    ) -> Result<Vec<PinLoad>, ValidationError> {
        /// Time between two points of a curve, in s: as long as an instrument takes, and longer
        /// than any wave.
        const STEP: f64 = 0.1;

        // The panel lies along x whatever its direction: a specimen of the warp is turned.
        let &Self { grain, spacing, length, middle, pivot, rows: [still, moving], .. } = self;
        let (size, turn, edges) = match direction {
            Direction::Weft => ([length, WIDTH], [-90.0, 0.0, 0.0], ["left", "right"]),
            Direction::Warp => ([WIDTH, length], [-90.0, -90.0, 0.0], ["bottom", "top"]),
        };
        let panel = PanelSpec {
            name: "specimen".into(),
            fabric: "specimen".into(),
            rectangle: Some(size),
            center: [middle, 0.0, 0.0],
            turn,
            ..PanelSpec::default()
        };
        let panel = if grain == 0.0 { panel } else { self.cut_on_the_bias(panel) };

        // The motion of the clamp has a key at the start and one at the end of each step.
        let start = ClampPlacement::default();
        let all = || std::iter::once(&start).chain(placements);
        let motion = MotionSpec {
            times: (0..=placements.len()).map(|k| k as f64 * STEP).collect(),
            shift: all().map(|placement| placement.shift).collect(),
            turn: all().map(|placement| [0.0, 0.0, placement.turn.to_degrees()]).collect(),
            center: Some([pivot, 0.0, 0.0]),
        };
        let mut spec = SceneSpec {
            name: Some("specimen".into()),
            spacing,
            gravity: [0.0; 3],
            time: TimeSpec {
                step: STEP,
                end: STEP * placements.len() as f64,
                ..TimeSpec::default()
            },
            ..alone()
        };
        spec.air.density = 0.0;
        let clamp = |edge: &str, rows: usize| PinSpec {
            panel: "specimen".into(),
            edge: Some(edge.into()),
            rows,
            ..PinSpec::default()
        };
        let moving = PinSpec { motion: Some(motion), ..clamp(edges[1], moving) };
        spec.pin = vec![clamp(edges[0], still), moving];

        let scene = with_panel(spec, panel, fabric).build()?;
        let arm = lever_arm(&scene, pivot);

        let mut simulation = Simulation::new(scene)?;
        let mut loads = Vec::with_capacity(placements.len());
        for placement in placements {
            simulation.step()?;
            let load = simulation.pin_loads()[1];
            let [x, y, _] = load.moment;
            let moment = pivot_moment(&load, arm, placement.turn);
            loads.push(PinLoad { moment: [x, y, moment], ..load });
        }
        Ok(loads)
    }
}
