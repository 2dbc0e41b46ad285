//! Drawing of a pattern in SVG, at true scale in mm.
//!
//! Every panel is a group with its outline as one path, grain line, name, notches and folds. At
//! each edge that is sewn stands a letter with the name of the edge. The sides of a seam have the
//! same letter, a dot at the first stitch, and ticks that meet. The drawing cannot show placements
//! in space and numbers of seams. They are in its `metadata`, in the project's format, so that the
//! drawing can be read again.

use std::fmt::Write;

use drape_input::{figure_in_decimals, toml_key, toml_string, xml_text};

use super::layout::{Extent, Rows, usual_width};
use super::marks::PanelMarks;
use super::number::millimetres;
use super::toml_text::{degrees, write_darts, write_placement};
use crate::edge::{Curve, Edge, distance};
use crate::panel::Panel;
use crate::pattern::Pattern;

/// Namespace of the metadata.
pub(crate) const NAMESPACE: &str = "urn:drape:pattern";

/// Gap between panels, in mm.
const GAP: f64 = 15.0;

/// Panels drawn on one sheet.
pub(crate) struct PatternSheet {
    /// Width and height, in mm.
    pub(crate) size: [f64; 2],
    /// Group of each panel with its bounding box on the sheet, in mm with y down.
    pub(crate) groups: Vec<(Extent, String)>,
}

impl PatternSheet {
    /// Returns the panels of `pattern` on a sheet no wider than `width`, in mm, if every panel
    /// fits.
    pub(crate) fn new(pattern: &Pattern, width: Option<f64>) -> Self {
        let extents: Vec<Extent> = pattern.panels().iter().map(extent).collect();
        let limit = width.map_or_else(|| usual_width(&extents), |width| width - GAP);
        let Rows { size, origins } = Rows::new(&extents, GAP, limit);
        let groups = pattern.panels().iter().zip(extents.iter().zip(&origins));
        let groups = groups.map(|(panel, ([low, high], origin))| {
            let origin = origin.map(|x| x.ceil());
            let extent = [
                [origin[0] + low[0], origin[1] - high[1]],
                [origin[0] + high[0], origin[1] - low[1]],
            ];
            (extent, group(pattern, panel, origin))
        });
        Self { size: size.map(|x| x.ceil() + 1.0), groups: groups.collect() }
    }
}

/// Returns the bounding box of `panel`, in mm with y up.
pub(crate) fn extent(panel: &Panel) -> Extent {
    let points = panel.outline().iter().flat_map(Edge::polyline);
    let start = [[f64::MAX; 2], [f64::MIN; 2]];
    points.fold(start, |[low, high], p| {
        let p = p.map(|x| 1e3 * x);
        [[low[0].min(p[0]), low[1].min(p[1])], [high[0].max(p[0]), high[1].max(p[1])]]
    })
}

impl Pattern {
    /// Returns a drawing of the pattern in SVG, at true scale in mm: for a plotter, or a program
    /// that draws.
    ///
    /// The sheet is no wider than `width`, in mm, if every panel is narrower.
    #[must_use]
    pub fn to_svg(&self, width: Option<f64>) -> String {
        let sheet = PatternSheet::new(self, width);
        let [width, height] = sheet.size;
        let metadata = metadata(self);
        let lines: Vec<String> = metadata.split('\n').map(xml_text).collect();
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}mm\" height=\"{height}mm\" \
             viewBox=\"0 0 {width} {height}\" {STYLE}>\n<metadata><pattern xmlns=\"{NAMESPACE}\">{}\
             </pattern></metadata>\n",
            lines.join("\n")
        );
        sheet.groups.iter().for_each(|(_, group)| svg.push_str(group));
        svg.push_str("</svg>\n");
        svg
    }
}

/// Attributes of all drawings.
pub(crate) const STYLE: &str = "font-family=\"sans-serif\" font-size=\"5\" fill=\"none\" \
                                stroke=\"#000000\" stroke-width=\"0.3\" stroke-linejoin=\"round\"";

/// Returns the group of `panel`. The origin of its frame is at `origin` on the sheet, in mm.
fn group(pattern: &Pattern, panel: &Panel, origin: [f64; 2]) -> String {
    let on_sheet = |[x, y]: [f64; 2]| [origin[0] + 1e3 * x, origin[1] - 1e3 * y];
    let names: Vec<String> = panel.outline().iter().map(|edge| listed(&edge.name)).collect();
    let mut svg = format!(
        "<g class=\"panel\" data-panel=\"{}\" data-origin=\"{} {}\">\n\
         <path class=\"outline\" data-edges=\"{}\" stroke-width=\"0.5\" d=\"{}\"/>\n",
        xml_text(panel.name()),
        origin[0],
        origin[1],
        xml_text(&names.join("|")),
        closed_line(panel.outline(), &on_sheet)
    );
    for hole in panel.loops().skip(1) {
        let data = closed_line(hole, &on_sheet);
        let _ = writeln!(svg, "<path class=\"dart\" stroke-width=\"0.5\" d=\"{data}\"/>");
    }
    PanelMarks { pattern, panel, on_sheet: &on_sheet }.write(&mut svg);
    svg.push_str("</g>\n");
    svg
}

/// Returns the closed line `edges` of a panel as path data. `on_sheet` maps points to the sheet.
fn closed_line(edges: &[Edge], on_sheet: &impl Fn([f64; 2]) -> [f64; 2]) -> String {
    let mut data = format!("M{}", pair(on_sheet(edges[0].start)));
    for edge in edges {
        let end = pair(on_sheet(edge.end));
        let _ = match edge.curve {
            Curve::Line => write!(data, "L{end}"),
            Curve::Quadratic(control) => write!(data, "Q{} {end}", pair(on_sheet(control))),
            Curve::Cubic(controls) => {
                let [first, second] = controls.map(|control| pair(on_sheet(control)));
                write!(data, "C{first} {second} {end}")
            }
            Curve::Arc { sweep } => {
                // The radius belongs to the ends as they are written.
                let [start, end_point] =
                    [edge.start, edge.end].map(|p| on_sheet(p).map(|x| (1e4 * x).round() / 1e4));
                let half = 0.5 * distance(start, end_point);
                let radius = half / (0.5 * sweep.abs()).sin();
                let large = u8::from(sweep.abs() > std::f64::consts::PI);
                // On the sheet, where y is down, a positive angle turns right.
                let right = u8::from(sweep < 0.0);
                write!(data, "A{radius} {radius} 0 {large} {right} {end}")
            }
        };
    }
    data + "Z"
}

/// Returns a point of the sheet as it stands in path data.
fn pair(point: [f64; 2]) -> String {
    let [x, y] = point.map(|x| figure_in_decimals(x, 4));
    format!("{x} {y}")
}

/// Returns the facts about `pattern` that the drawing does not show, in the project's format.
fn metadata(pattern: &Pattern) -> String {
    let mut text = String::from("length = \"mm\"\n");
    for panel in pattern.panels() {
        let key = toml_key(panel.name());
        let _ = writeln!(text, "\n[panel.{key}]\ngrain = {}", degrees(panel.grain()));
        if let Some(fabric) = panel.fabric() {
            let _ = writeln!(text, "fabric = {}", toml_string(fabric));
        }
        write_placement(panel, &mut text);

        let hems: Vec<String> = panel
            .outline()
            .iter()
            .filter(|edge| edge.hem != 0.0)
            .map(|edge| format!("{} = {}", toml_key(&edge.name), millimetres(edge.hem)))
            .collect();
        if !hems.is_empty() {
            let _ = writeln!(text, "hems = {{ {} }}", hems.join(", "));
        }
        write_darts(panel, &mut text);
        for fold in panel.folds() {
            let [from, to] = fold.ends.map(|end| super::number::point(&end));
            let angle = degrees(fold.angle);
            let _ =
                writeln!(text, "[[panel.{key}.fold]]\nfrom = {from}\nto = {to}\nangle = {angle}");
        }
    }

    let seams = pattern.seams().iter().filter(|seam| !pattern.is_dart(seam));
    seams.for_each(|seam| pattern.seam(seam, &mut text));
    text
}

/// Returns `name` as an entry of a list that bars divide.
pub(crate) fn listed(name: &str) -> String {
    name.replace('%', "%25").replace('|', "%7C")
}
