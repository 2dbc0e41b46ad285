//! Keys of a pattern in the project's format. The comments of fields stand in the schema and the
//! guide.

use std::collections::BTreeMap;

use drape_input::{Angle, Given, Length};
use serde::Deserialize;

use crate::read::seams::SeamKeys;

/// Two lengths, along x and y of a panel.
type Point = [Given<Length>; 2];

#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct PatternKeys {
    /// Unit of all lengths of the file that stand without one.
    #[cfg_attr(feature = "schema", schemars(required, extend("enum" = ["mm", "cm", "m", "in"])))]
    pub(crate) length: Option<String>,
    /// Pattern of another format that the file adds to.
    pub(crate) from: Option<FromKeys>,
    /// Panels by their names.
    #[serde(default)]
    pub(crate) panel: BTreeMap<String, PanelKeys>,
    /// Seams by their names.
    #[serde(default)]
    pub(crate) seam: BTreeMap<String, SeamKeys>,
}

/// Pattern of another format that the file adds to.
#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct FromKeys {
    /// Its file, relative to the folder of this one.
    pub(crate) file: String,
    /// Unit of a drawing that states none; the unit of the drawing if missing.
    #[cfg_attr(feature = "schema", schemars(extend("enum" = ["mm", "cm", "m", "in", "pt", "px"])))]
    pub(crate) unit: Option<String>,
    /// Size of a graded drawing; its only one if missing.
    pub(crate) size: Option<String>,
}

/// Panel: one shape, and how it lies.
#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct PanelKeys {
    /// Point where the first edge of the outline begins; with `outline` only; no outline if
    /// missing.
    pub(crate) start: Option<Point>,
    /// Edges, anticlockwise as seen from the right side of the cloth.
    pub(crate) outline: Option<Vec<EdgeKeys>>,
    /// Width and height of a rectangle, with the edges bottom, right, top and left, in place of an
    /// outline; no rectangle if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) rectangle: Option<Point>,
    /// Outline as path data of SVG, in place of `outline`; none if missing.
    pub(crate) path: Option<String>,
    /// Names of the edges of a path or a rectangle; numbers from 1, of a rectangle `bottom`,
    /// `right`, `top` and `left`, if missing.
    pub(crate) edges: Option<Vec<String>>,
    /// Name of the panel that this one is a copy of; no copy if missing.
    pub(crate) copy_of: Option<String>,
    /// Whether the copy is mirrored.
    #[serde(default)]
    pub(crate) mirrored: bool,
    /// Whether the panel of the other file is left out.
    #[serde(default)]
    pub(crate) omit: bool,
    /// Shift of the outline and the folds in the panel's frame; none if missing.
    pub(crate) shift: Option<Point>,
    /// Edges that are split, each with the ascending distances from its start.
    #[serde(default)]
    pub(crate) split: BTreeMap<String, Vec<Given<Length>>>,
    /// Widths of hems, by the names of edges.
    #[serde(default)]
    pub(crate) hems: BTreeMap<String, Given<Length>>,
    /// Fabric; the fabric of the garment if missing.
    pub(crate) fabric: Option<String>,
    /// Angle from the panel's y axis to its warp, anticlockwise, in degrees; 0, with a note, or
    /// the grain in the other file if missing.
    pub(crate) grain: Option<Given<Angle>>,
    /// Place of the panel's point (0, 0) in the scene; the place in the other file if missing.
    pub(crate) origin: Option<[Given<Length>; 3]>,
    /// Rotations about x, y and z, one after the other, in degrees; the rotations in the
    /// other file, or none, if missing.
    pub(crate) turn: Option<[Given<Angle>; 3]>,
    /// Radius of the cylinder, upright and behind x = 0, that the panel is bent to; in front of it
    /// if negative; flat if missing.
    pub(crate) wrap: Option<Given<Length>>,
    /// Lines along which the panel is folded.
    #[serde(default)]
    pub(crate) fold: Vec<FoldKeys>,
    /// Darts: cloth that is cut out, between two legs that are sewn together.
    #[serde(default)]
    pub(crate) dart: Vec<DartKeys>,
}

impl PanelKeys {
    /// Returns whether the keys give the panel a shape.
    pub(crate) fn has_shape(&self) -> bool {
        self.outline.is_some()
            || self.rectangle.is_some()
            || self.path.is_some()
            || self.start.is_some()
    }
}

/// Line along which a panel is folded.
#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct FoldKeys {
    /// One end of the line.
    pub(crate) from: Point,
    /// The other end.
    pub(crate) to: Point,
    /// Angle towards the right side of the cloth, in degrees; 0 is flat.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::within(-140.0, 140.0)))]
    pub(crate) angle: Given<Angle>,
}

/// Dart: closed, between two tips inside the panel, or open at an edge.
///
/// A closed one has `from` and `to`, with `width` or with `left` and `right`; an open one has
/// `edge`, `at` and `width`, with `to` or `depth`. Its seam is called `PANEL.NAME`. An edge with
/// open darts is named as before in seams, which run on over the mouths; its parts are `EDGE 1`,
/// `EDGE 2` and so on.
#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct DartKeys {
    /// Name; `dart` with its number from 1 if missing.
    pub(crate) name: Option<String>,
    /// One tip of a closed dart; the dart is open if missing.
    pub(crate) from: Option<Point>,
    /// The other tip, or the tip of an open dart; the tip at `depth` if missing.
    pub(crate) to: Option<Point>,
    /// Greatest width of a closed dart with straight legs, or width of the mouth of an open one;
    /// the width of `left` and `right` if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) width: Option<Given<Length>>,
    /// Distance of the greatest width from `from`; the middle if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) widest: Option<Given<Length>>,
    /// Edges of the left leg of a closed dart, from tip to tip; straight by `width` if missing.
    pub(crate) left: Option<Vec<EdgeKeys>>,
    /// Edges of the right leg of a closed dart, from tip to tip; straight by `width` if missing.
    pub(crate) right: Option<Vec<EdgeKeys>>,
    /// Edge at which an open dart begins; the dart is closed if missing.
    pub(crate) edge: Option<String>,
    /// Distance of the middle of the mouth from the start of that edge; no open dart if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) at: Option<Given<Length>>,
    /// Distance of the tip of an open dart from the edge, at a right angle to the edge; the
    /// distance of `to` if missing.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::positive))]
    pub(crate) depth: Option<Given<Length>>,
}

/// Edge of an outline: a line, or one kind of curve.
#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct EdgeKeys {
    /// Name, by which seams and hems know it; its number from 1 if missing.
    pub(crate) name: Option<String>,
    /// Point where it ends.
    pub(crate) to: Point,
    /// Control point of a quadratic Bézier curve; no such curve if missing.
    pub(crate) quadratic: Option<Point>,
    /// Control points of a cubic Bézier curve; no such curve if missing.
    pub(crate) cubic: Option<[Point; 2]>,
    /// Radius of an arc, negative if it turns to the right; no arc if missing.
    pub(crate) radius: Option<Given<Length>>,
    /// Whether the arc is the larger of the two.
    #[serde(default)]
    pub(crate) large: bool,
    /// Width of its hem.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::at_least(0.0)))]
    #[serde(default)]
    pub(crate) hem: Given<Length>,
    /// Distances of notches from its start.
    #[cfg_attr(feature = "schema", schemars(transform = drape_input::at_least(0.0)))]
    #[serde(default)]
    pub(crate) notches: Vec<Given<Length>>,
}

/// Returns the JSON Schema of patterns in the project's format.
#[cfg(feature = "schema")]
#[must_use]
pub fn pattern_schema() -> serde_json::Value {
    let about = "Garment pattern of drape: panels, and the seams between them.";
    drape_input::schema_of::<PatternKeys>("Pattern of drape", about, serde_json::Map::new())
}
