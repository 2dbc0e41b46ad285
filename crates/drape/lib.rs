#![doc = include_str!("../../README.md")]

mod scene_fabric;

pub use drape_cloth as cloth;
pub use drape_collide as collide;
pub use drape_dynamics as dynamics;
pub use drape_fabric as fabric;
pub use drape_fit as fit;
pub use drape_hysteresis as hysteresis;
pub use drape_implicit as implicit;
pub use drape_input as input;
pub use drape_kes as kes;
pub use drape_lm as lm;
pub use drape_pattern as pattern;
pub use drape_report as report;
pub use drape_scene as scene;
pub use drape_validate as validate;
pub use drape_verify as verify;

pub use scene_fabric::{read_scene, scene_fabric};
