#![doc = include_str!("../README.md")]
//!
//! # Tour
//!
//! [`Material::of`] reads the numbers off the laws of a [`Fabric`](drape_fabric::Fabric) by virtual
//! tests, and says what such numbers lose. A function of each format writes it:
//! [`Material::to_blender`], [`Material::to_ppf`], [`Material::to_browzwear`],
//! [`Material::to_u3m`] and [`Material::to_u3ma`].
//!
//! Layers, lowest first: `error`, `number`; `stretch`, a virtual test; `loss`, what the numbers lose;
//! `material` with all numbers; the formats.

mod error;
mod number;

// The numbers, and what they lose.
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
