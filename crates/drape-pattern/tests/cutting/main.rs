//! Patterns are cut as they should be: shipped garments, the grain at any angle, darts, rectangles,
//! and outlines of any shape.

mod darts;
mod garments;
mod invariants;
mod listing;
mod outlines;
mod rectangles;
