//! Draws a round table cloth over a table, coloured by its height, with a scale below the picture.
//!
//! `cargo run --release -p drape-render --example draped_surface -- cloth.png` writes the picture
//! to a file. Without an argument the file is in the temporary folder.

#![allow(clippy::print_stdout)]

use std::path::PathBuf;

use drape_render::{
    Colour, ColourScale, Error, Ground, Legend, Picture, Scene, Surface, View, render,
};

/// Radius of the table, in m.
const TABLE: f64 = 0.3;

/// Radius of the cloth, in m.
const CLOTH: f64 = 0.55;

/// Number of folds of the hem.
const FOLDS: f64 = 7.0;

/// Number of rings of the mesh, and number of corners of each ring.
const RINGS: u32 = 60;
const CORNERS: u32 = 256;

fn main() -> Result<(), Error> {
    let default = || std::env::temp_dir().join("draped_surface.png");
    let path = std::env::args().nth(1).map_or_else(default, PathBuf::from);
    picture()?.save(&path)?;
    println!("{}", path.display());
    Ok(())
}

/// Draws the cloth on grey, with the scale of its heights below it.
fn picture() -> Result<Picture, Error> {
    let (positions, triangles) = cloth();
    let lowest = -100.0 * (CLOTH - TABLE);
    let scale = ColourScale::new([lowest, 0.0], false)?;
    let heights = positions.chunks_exact(3).map(|point| 100.0 * point[1]);
    let tints: Vec<Colour> = heights.map(|height| scale.colour(height)).collect();

    let scene = Scene {
        cloths: vec![Surface::cloth(&positions, &triangles).with_tints(&tints)],
        floor: Some(-0.35),
        ground: Ground::GREY,
        ..Scene::default()
    };
    let view = View { width: 800, height: 600, ..View::default() };
    let labels = [lowest, 0.5 * lowest, 0.0].map(|height| format!("{height:.1}"));
    let legend = Legend { name: "height".to_owned(), unit: "cm".to_owned(), scale, labels };
    Ok(legend.below(&render(&scene, &view)?, Ground::GREY.bottom))
}

/// Returns the positions, in m, and the triangles of the cloth. The cloth is level on the table,
/// and hangs down around it in folds that widen towards the hem.
fn cloth() -> (Vec<f64>, Vec<[u32; 3]>) {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for ring in 0..=RINGS {
        let along = CLOTH * f64::from(ring) / f64::from(RINGS);
        let hanging = (along - TABLE).max(0.0);
        for corner in 0..CORNERS {
            let angle = std::f64::consts::TAU * f64::from(corner) / f64::from(CORNERS);
            let fold = 0.15 * hanging * (FOLDS * angle).cos();
            let radius = along.min(TABLE) + 0.2 * hanging + fold;
            positions.extend([radius * angle.sin(), -0.97 * hanging, radius * angle.cos()]);

            if ring < RINGS {
                let [this, next] = [corner, (corner + 1) % CORNERS].map(|k| ring * CORNERS + k);
                triangles.push([this, this + CORNERS, next + CORNERS]);
                triangles.push([this, next + CORNERS, next]);
            }
        }
    }
    (positions, triangles)
}
