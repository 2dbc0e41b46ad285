//! Faults of input and of machines: no panic, no hang, no exit code without a meaning, no half a
//! file.
//!
//! A sample runs by default; `FAULTS=full cargo test --release --test faults` runs all of them.

#[cfg(target_os = "linux")]
mod command;
mod files;
mod guard;
#[cfg(target_os = "linux")]
mod machine;
mod mutation;
mod numbers;
mod readers;
#[cfg(target_os = "linux")]
mod resources;
