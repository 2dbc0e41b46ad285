#![doc = include_str!("../README.md")]
#![cfg_attr(docsrs, feature(doc_cfg))]

pub mod file;
pub mod reports;

// A folder has locks and limits of the operating system, which a browser does not have.
#[cfg(not(target_family = "wasm"))]
mod folder;
mod scene_fabric;

#[cfg(not(target_family = "wasm"))]
pub use folder::{
    EndedRun, Error, FolderRun, Goal, Limits, LostProcess, ReachedLimit, ResumableRun, RunOptions,
    RunRequest, RunVerdict, Watcher, describe_needs, end_at, lost_process, scene_document,
};
pub use scene_fabric::{
    NamedCurve, PlacedSpec, fabric_of, fit_mistake, read_scene, scene_fabric, scene_of,
    scene_of_spec, scene_or_refused,
};
