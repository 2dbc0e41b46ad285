//! View: runs as one page of HTML that needs nothing else.
//!
//! The page contains three.js, the frames of the runs, and the viewer's script. Positions are
//! 16-bit fractions of a box and fields are 8-bit fractions of a range, both deflated. The page
//! shows rounded numbers. The frames of the run have the exact numbers.

mod bits;
mod element;
mod measures;
mod named;
mod quantity;
mod samples;
mod scene;

use drape_frames::Error;
use drape_input::xml_text;
use serde_json::{Value, json};

use self::element::json_element;
pub use self::named::Named;
use self::scene::Scene;
use crate::palette::{FabricPalette, hex};

const PAGE: &str = include_str!("../viewer/viewer.html");
const STYLE: &str = include_str!("../viewer/viewer.css");
const SCRIPT: &str =
    concat!(include_str!("../viewer/energy.js"), include_str!("../viewer/viewer.js"));
const THREE: &str = include_str!("../viewer/three.bundle.js");

/// Page that shows runs.
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    /// The page.
    pub html: String,
    /// Numbers of the frames that it shows, of each run.
    pub frames: Vec<Vec<usize>>,
}

impl View {
    /// Makes the page of some runs, which are shown side by side.
    ///
    /// Frames are left out, evenly but never the first and the last, until the page has at most
    /// `size_max` bytes or each run has two frames.
    ///
    /// # Errors
    /// A file of a run is not as it was written.
    pub fn new(runs: &[Named<'_>], size_max: usize) -> Result<View, Error> {
        // Each run has an equal share of the bytes that the viewer itself leaves.
        let remaining =
            size_max.saturating_sub(PAGE.len() + STYLE.len() + SCRIPT.len() + THREE.len());
        let share = remaining / runs.len().max(1);
        let palette = FabricPalette::of_runs(runs.iter().map(|run| run.recording));
        let scenes: Result<Vec<Scene>, Error> =
            runs.iter().map(|run| Scene::of_size(run, &palette, share)).collect();
        let scenes = scenes?;
        let names: Vec<&str> = runs.iter().map(|run| run.name).collect();
        let fabrics: Vec<Value> = palette
            .legend()
            .map(|(name, colour)| json!({ "name": name, "colour": hex(colour) }))
            .collect();
        let fabrics = json_element("fabrics-data", &Value::from(fabrics));
        let data: String = scenes.iter().enumerate().map(|(k, scene)| scene.elements(k)).collect();
        let parts = [
            ("title", xml_text(&names.join(" | "))),
            ("style", STYLE.to_owned()),
            ("three", THREE.to_owned()),
            ("data", fabrics + &data),
            ("script", SCRIPT.to_owned()),
        ];

        // Each mark of the page, such as `{title}`, is replaced by its content.
        let mut html = String::new();
        let mut rest = PAGE;
        for (name, content) in &parts {
            let mark = format!("{{{{{name}}}}}");
            let (before, after) = rest.split_once(&mark).unwrap_or((rest, ""));
            html += before;
            html += content;
            rest = after;
        }
        html += rest;
        let frames = scenes.into_iter().map(|scene| scene.frames).collect();
        Ok(View { html, frames })
    }
}
