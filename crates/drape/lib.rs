#![doc = include_str!("../../README.md")]
//!
//! # As a library
//!
//! This crate re-exports all others, and adds what joins them: [`read_scene`] reads a scene and
//! fits the sheets that it names, since the crates of the fit and of the scene do not know each
//! other; [`keep`] runs it in a folder, from which an interrupted run goes on; [`reports`] turns
//! results into pages. A run follows the data from the top of this list to its end:
//!
//! * measurements: [`kes`] (sheets, curves, values), [`fit`] by [`lm`] (fabrics from them);
//! * materials: [`fabric`] (laws in SI), [`hysteresis`] (their friction), [`material`] (numbers of
//!   them for other programs), [`pattern`] (garments);
//! * simulation: [`scene`] (TOML to checked values), [`cloth`] (forces and stiffness), [`collide`]
//!   (contact), [`implicit`] (time steps), [`dynamics`] (what joins the four to frames);
//! * results: [`frames`] (stored frames read), [`verify`] (and verified), [`export`] (for other
//!   programs), [`report`] (pictures and pages), [`validate`] (simulated instruments), [`sweep`]
//!   (many runs).
//!
//! ```
//! use drape::fabric::Fabric;
//! use drape::fit::identify;
//! use drape::kes::Sheet;
//!
//! // What a laboratory measured becomes the laws of a fabric, in SI.
//! let sheet = Sheet::read("fabrics/matsudaira-b")?;
//! let wool: Fabric = identify(&sheet)?.fabric;
//! assert_eq!(wool.density, sheet.density().expect("it was weighed"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod file;
pub mod keep;
pub mod reports;

mod scene_fabric;

// Measurements and their fit.
pub use drape_fit as fit;
pub use drape_kes as kes;
pub use drape_lm as lm;

// Materials.
pub use drape_fabric as fabric;
pub use drape_hysteresis as hysteresis;
pub use drape_input as input;
pub use drape_material as material;
pub use drape_pattern as pattern;

// Simulation.
pub use drape_cloth as cloth;
pub use drape_collide as collide;
pub use drape_dynamics as dynamics;
pub use drape_implicit as implicit;
pub use drape_scene as scene;

// Results.
pub use drape_checkpoint as checkpoint;
pub use drape_export as export;
pub use drape_frames as frames;
pub use drape_report as report;
pub use drape_sweep as sweep;
pub use drape_validate as validate;
pub use drape_verify as verify;

pub use scene_fabric::{
    NamedCurve, fabric_of, fit_mistake, read_scene, scene_fabric, scene_of, scene_of_documents,
    scene_or_refused,
};
