//! The connectors of cloth: on grids, and on panels of garments with a rim of triangles that meets
//! the outline.

mod bias;
mod consistency;
mod grid;
mod panels;
mod patch;
mod reference;
mod roll;
mod seams;
mod shaken;
