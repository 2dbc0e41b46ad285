//! Specs of scenes, and functions that run them.
//!
//! [`alone`] and [`with_panel`] begin a spec; [`finish`] steps a simulation until it ends.

use std::sync::Arc;

use drape_dynamics::{Simulation, Step};
use drape_fabric::Fabric;
use drape_scene::{
    ContactSpec, FabricSpec, FileOr, OutputSpec, PanelSpec, SceneSpec, SettleSpec, SolverSpec,
};

use crate::error::ValidationError;

/// Returns the spec of a scene in which one piece of cloth touches nothing and no energies are
/// recorded. The references of such scenes know no thickness of the cloth. The proof that the cloth
/// does not touch itself would take three times as long as the simulation.
pub(crate) fn alone() -> SceneSpec {
    SceneSpec {
        contact: ContactSpec { surfaces: Some(false), ..ContactSpec::default() },
        output: OutputSpec { energy: false, ..OutputSpec::default() },
        ..SceneSpec::default()
    }
}

/// Returns `spec` with `panel`, whose fabric is `fabric`.
pub(crate) fn with_panel(mut spec: SceneSpec, panel: PanelSpec, fabric: &Fabric) -> SceneSpec {
    let file = FileOr::Value(Arc::new(fabric.clone()));
    spec.fabric.insert(panel.fabric.clone(), FabricSpec { file, ..FabricSpec::default() });
    spec.panel.push(panel);
    spec
}

/// Returns the settings of a run to rest that ends at the speed `speed`, in m/s, and the imbalance
/// `residual`, over g.
pub(crate) fn settle(speed: f64, residual: f64) -> Option<SettleSpec> {
    Some(SettleSpec { speed, residual, ..SettleSpec::default() })
}

/// Returns the settings of a solver whose steps meet `tolerance`.
pub(crate) fn tolerance(tolerance: f64) -> SolverSpec {
    let error_fraction = Some(0.0);
    SolverSpec { tolerance: Some(tolerance), error_fraction, ..SolverSpec::default() }
}

/// Returns a simulation of the scene that `spec` describes.
///
/// # Errors
/// The scene has mistakes, or cannot be prepared.
pub(crate) fn simulation(spec: &SceneSpec) -> Result<Simulation, ValidationError> {
    Ok(Simulation::new(spec.build()?)?)
}

/// Steps `simulation` to its end.
///
/// # Errors
/// A step cannot be solved, or the cloth does not come to rest although the scene asks for rest.
pub fn finish(simulation: &mut Simulation) -> Result<(), ValidationError> {
    finish_with(simulation, |_, _| ())
}

/// Steps `simulation` to its end as [`finish`] does, and calls `observe` after every step.
pub(crate) fn finish_with(
    simulation: &mut Simulation,
    mut observe: impl FnMut(&Simulation, &Step),
) -> Result<(), ValidationError> {
    loop {
        let step = simulation.step()?;
        observe(simulation, &step);
        if step.finished {
            break;
        }
    }
    let summary = simulation.summary();
    if summary.imbalance.is_nan() || (simulation.settles() && !summary.settled) {
        return Err(ValidationError::NotSettled { seconds: summary.simulated_seconds });
    }
    Ok(())
}
