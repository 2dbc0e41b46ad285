#![doc = include_str!("../README.md")]
//!
//! # Tour
//!
//! A [`Checkpoint`] has an [`Identity`] and sections. A [`Store`] writes checkpoints to a folder.
//! [`Store::read`] returns the newest intact checkpoint, as [`StoredCheckpoints`].
//!
//! Layers, lowest first: `error`, `identity`, `checkpoint` (sections and their bytes), `store`
//! (files).

mod checkpoint;
mod error;
mod identity;
mod store;

pub use checkpoint::Checkpoint;
pub use error::{Damage, Error};
pub use identity::{Digest, Identity};
pub use store::{DamagedCheckpoint, Store, StoredCheckpoints};
