//! Case `cylinder`: the energy of a sheet that is wrapped on a cylinder, and of one that is
//! twisted.
//!
//! The energy per area is `$B/2R^2$` along the yarns and `$(B_1 + B_2)/8R^2$` at 45° to them.

use std::f64::consts::FRAC_1_SQRT_2;

use drape_scene::{PanelSpec, SceneSpec, TimeSpec};

use crate::error::ValidationError;
use crate::findings::{Check, Findings};
use crate::setup::fabrics::{CUPRO, fabric};
use crate::setup::{alone, with_panel};

/// Radius of a cylinder, and the side of the square sheet on it, in m.
const RADIUS: f64 = 0.05;

const SIDE: f64 = 0.1;

/// Returns the energy per area of a sheet of cupro without friction, in J/m². `shape` maps panel
/// coordinates to positions, in m.
fn energy(
    spacing: f64,
    grain: f64,
    shape: impl Fn([f64; 2]) -> [f64; 3],
) -> Result<f64, ValidationError> {
    let fabric = fabric(CUPRO)?.without_friction();
    let panel = PanelSpec {
        name: "sheet".into(),
        fabric: "sheet".into(),
        rectangle: Some([SIDE, SIDE]),
        grain,
        ..PanelSpec::default()
    };
    let time = TimeSpec { step: 0.01, end: 1.0, ..TimeSpec::default() };
    let spec = SceneSpec { spacing, time, ..alone() };
    let scene = with_panel(spec, panel, &fabric).build()?;
    let places = scene.panels[0].lattice.panel_coordinates();
    let state = scene.cloth.state(places.into_iter().flat_map(shape).collect());
    let energy = state.and_then(|state| scene.cloth.stored(&state));
    Ok(energy.expect("a scene's panels place every particle") / (SIDE * SIDE))
}

/// Sheets wrapped on a cylinder, and one that is twisted.
///
/// On a cylinder of radius `$R$` yarns at an angle `$\vartheta$` to its axis are helices with the
/// curvature `$\sin^2\vartheta/R$`, so the energy per area is `$B/2R^2$` along the yarns and
/// `$(B_1 + B_2)/8R^2$` at 45°. Rows of particles are wrapped as a sheet that does not stretch:
/// their chords keep their length. A saddle `$z = tuv$` along the yarns twists them by `$t$` and
/// bends none; it stretches and shears by the order of `$t^2$`, which is nothing beside `$t$` where
/// that is small: the twisting stiffness is none.
pub(crate) fn cylinder() -> Result<Findings, ValidationError> {
    let fabric = fabric(CUPRO)?;
    let [warp, weft] =
        [fabric.warp, fabric.weft].map(|laws| laws.bending.backbone.respond(0.0).tangent);
    let mut checks = Vec::new();
    for (name, grain, rigidity) in
        [("warp", 90.0, warp), ("weft", 0.0, weft), ("45°", 45.0, 0.25 * (warp + weft))]
    {
        let exact = 0.5 * rigidity / (RADIUS * RADIUS);
        let mut errors = Vec::new();
        for spacing in [0.01, 0.005, 0.0025] {
            let row = if grain == 45.0 { spacing * FRAC_1_SQRT_2 } else { spacing };
            let turn = 2.0 * (0.5 * row / RADIUS).asin();
            let found = energy(spacing, grain, |[x, y]| {
                let (sin, cos) = (x / row * turn).sin_cos();
                [RADIUS * sin, y, RADIUS * (1.0 - cos)]
            })?;
            errors.push(found / exact - 1.0);
            if spacing == 0.005 {
                let what = format!("energy of a sheet bent along its {name}, R = 5 cm, mJ/m²");
                checks.push(Check::within(what, 1e3 * found, 1e3 * exact, 0.02));
            }
        }
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).abs().log2();
            let what = format!("order of convergence, {name}, to an error of {:.1e}", pair[1]);
            checks.push(Check::at_least(what, order, 1.8));
        }
    }

    // A saddle twists the yarns and bends none of them.
    let twist = 0.001;
    let found = energy(0.005, 0.0, |[x, y]| [x, y, twist * (x - 0.5 * SIDE) * (y - 0.5 * SIDE)])?;
    let what = "energy of a twisted sheet over that of one bent as much along its weft";
    checks.push(Check::at_most(what, found / (0.5 * weft * twist * twist), 1e-3));
    Ok(checks.into())
}
