#![doc = include_str!("../README.md")]

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
pub use drape_render as render;
pub use drape_report as report;
pub use drape_run as run;
pub use drape_sweep as sweep;
pub use drape_validate as validate;
pub use drape_verify as verify;
