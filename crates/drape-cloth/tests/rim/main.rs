//! Panels of garments: full cells, and a rim of triangles that meets the outline.

mod bias;
mod consistency;
mod panels;
mod patch;
mod roll;
mod seams;
