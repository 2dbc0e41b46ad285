#![doc = include_str!("../README.md")]
//!
//! # Tour
//!
//! [`Material::from_fabric`] reads the numbers off the laws of a [`Fabric`](drape_fabric::Fabric)
//! by virtual tests, and lists the properties that such numbers lose. One method per format writes
//! a file: [`Material::to_blender`], [`Material::to_ppf`], [`Material::to_browzwear`],
//! [`Material::to_u3m`] and [`Material::to_u3ma`].
//!
//! Layers, lowest first: `error` and `number`; `stretch`, a virtual test; `loss`, the properties
//! that the numbers lose; `material` with all numbers; the formats.

mod error;
mod number;

// The numbers, and the properties that they lose.
mod loss;
mod material;
mod stretch;

// The formats.
mod blender;
mod browzwear;
mod ppf;
mod u3m;

pub use error::Error;
pub use material::Material;
pub use stretch::Stretch;
