//! SVG: the panels of a garment, flat on the pattern, with a field in colours.
//!
//! Colours come in bands. The field is linear in each triangle, and so are the bounds of a band. A
//! band is one path round all points that are not below its lower bound, and lies on the band
//! below. No light shows between two bands, and the file has outlines in place of triangles.

mod panel_layout;
mod region;

use std::fmt::Write as _;
use std::io::{self, Write};

use drape_frames::{Frame, Recording, SurfacePart};
use drape_input::{significant, xml_text};

use self::panel_layout::{Extent, PanelLayout};
use self::region::{FlatField, Node};
use crate::field::Field;
use crate::mesh;
use crate::name;
use crate::scale;

/// Number of bands of colour. An eye cannot distinguish more of them beside each other. The number
/// is odd, so that values near zero have one colour.
const BANDS: usize = 25;

/// Least length of the longer side of the drawing, in units of the paths. Finer units make a longer
/// file.
const UNITS_MIN: f64 = 5000.0;

/// Largest number of letters of a panel's name that are written.
const LETTERS_MAX: usize = 40;

/// Width of a letter over the height of the text, on average.
const LETTER: f64 = 0.56;

/// Field of a frame, to be drawn on the flat pattern.
#[derive(Debug, Clone, Copy)]
pub struct PatternMap<'a> {
    /// The run.
    pub recording: &'a Recording,
    /// The frame.
    pub frame: &'a Frame,
    /// The field.
    pub field: Field,
    /// Values of the field, one for each vertex of the cloth.
    pub values: &'a [f64],
}

/// Writes the panels of the garment of `map` to `to` as SVG, flat on the pattern, with a field in
/// colours.
///
/// Lengths are in mm, and a scale bar shows a length. A legend has the range of the colours with
/// its unit. Values beyond the range have the colour of its end. An arrow beside the name of a
/// panel points along the warp.
///
/// # Errors
/// `to` fails.
pub fn write_svg(map: &PatternMap, mut to: impl Write) -> io::Result<()> {
    let panels = flat_panels(map);
    let area: f64 = panels.iter().map(|panel| panel.size[0] * panel.size[1]).sum();
    let text = (0.022 * area.sqrt()).max(1e-6);

    // A panel needs room for its name, which may be wider.
    let extents: Vec<Extent> = panels
        .iter()
        .map(|panel| Extent {
            width: panel.size[0].max(text * (2.0 + LETTER * panel.name.chars().count() as f64)),
            height: panel.size[1],
        })
        .collect();
    let layout = PanelLayout::new(&extents, 1.5 * text, 1.7 * text);
    let page = Page::new(map, layout.size, text);

    page.head(&mut to)?;
    for (panel, [x, y]) in panels.iter().zip(&layout.corners) {
        let corner = [page.margin + x, page.margin + page.title_height() + y];
        page.panel(panel, corner, &mut to)?;
    }
    page.legend(&mut to)?;
    page.scale_bar(&mut to)?;
    writeln!(to, "</svg>")
}

/// Flat panel with its values.
struct FlatPanel<'a> {
    part: &'a SurfacePart,
    name: String,
    identifier: String,
    /// Positions of its vertices, in mm from its lower left corner.
    points: Vec<[f64; 2]>,
    /// Width and height, in mm.
    size: [f64; 2],
    /// Triangles, by vertices of the panel from 0, all anticlockwise.
    triangles: Vec<[u32; 3]>,
    values: &'a [f64],
}

/// Returns the panels of the run of `map`, flat.
fn flat_panels<'a>(map: &PatternMap<'a>) -> Vec<FlatPanel<'a>> {
    let panels = &map.recording.manifest().panels;
    let names = name::unique(panels);
    let identifiers = name::identifiers(names.iter().map(String::as_str));
    let (pattern, mut triangles) =
        (mesh::pattern(map.recording), map.recording.topology().cloth.iter());
    let mut first = 0;
    let mut flat = Vec::new();
    for ((part, name), identifier) in panels.iter().zip(&names).zip(identifiers) {
        let vertices = first..first + part.vertices;
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for point in &pattern[vertices.clone()] {
            low = [0, 1].map(|k| low[k].min(point[k]));
            high = [0, 1].map(|k| high[k].max(point[k]));
        }
        let points: Vec<[f64; 2]> = pattern[vertices.clone()]
            .iter()
            .map(|point| [0, 1].map(|k| 1e3 * (point[k] - low[k])))
            .collect();
        let size = [0, 1].map(|k| (1e3 * (high[k] - low[k])).max(0.0));

        // SVG may fill anticlockwise outlines only if all triangles run in one direction.
        let corners = triangles.by_ref().take(part.triangles);
        let corners = corners.map(|corners| corners.map(|corner| corner - first as u32));
        let triangles = corners.map(|corners| anticlockwise(corners, &points)).collect();
        let name: String = if name.chars().count() > LETTERS_MAX {
            name.chars().take(LETTERS_MAX - 1).chain(['…']).collect()
        } else {
            name.clone()
        };
        let values = &map.values[vertices.clone()];
        flat.push(FlatPanel { part, name, identifier, points, size, triangles, values });
        first = vertices.end;
    }
    flat
}

/// Returns the triangle `a b c` so that it runs anticlockwise. `points` are the points of all
/// vertices.
fn anticlockwise([a, b, c]: [u32; 3], points: &[[f64; 2]]) -> [u32; 3] {
    let [p, q, r] = [a, b, c].map(|corner| points[corner as usize]);
    let twice = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    if twice < 0.0 { [a, c, b] } else { [a, b, c] }
}

/// Returns `steps` without steps of no length. Steps in one direction that follow each other become
/// one step.
fn merged(steps: impl Iterator<Item = [i64; 2]>) -> Vec<[i64; 2]> {
    let mut merged: Vec<[i64; 2]> = Vec::new();
    for step in steps.filter(|step| *step != [0, 0]) {
        match merged.last_mut() {
            Some([x, y]) if *x * step[1] == *y * step[0] && *x * step[0] + *y * step[1] > 0 => {
                (*x, *y) = (*x + step[0], *y + step[1]);
            }
            _ => merged.push(step),
        }
    }
    merged
}

/// Page with its dimensions, in mm.
struct Page {
    title: String,
    /// Name of the field, with its unit.
    label: String,
    range: [f64; 2],
    is_signed: bool,
    /// Height of the text.
    text: f64,
    margin: f64,
    width: f64,
    height: f64,
    /// Unit of the whole numbers in paths, in mm.
    unit: f64,
}

impl Page {
    /// Returns the page of `map`. `sheet` is the size of all panels and `text` the height of the
    /// text, in mm.
    fn new(map: &PatternMap, sheet: [f64; 2], text: f64) -> Page {
        let margin = 1.5 * text;
        let label = format!("{}, {}", map.field.label(), map.field.unit());
        let (number, time) = (map.frame.number, map.frame.time);
        let longest = sheet[0].max(sheet[1]).max(1e-3);
        Page {
            title: format!("{label}: frame {number}, {time:.3} s"),
            label,
            range: scale::range(map.values.iter().copied(), map.field.is_signed()),
            is_signed: map.field.is_signed(),
            text,
            margin,
            width: sheet[0].max(38.0 * text) + 2.0 * margin,
            height: sheet[1] + 8.0 * text + 2.0 * margin,
            unit: 10.0_f64.powf((longest / UNITS_MIN).log10().floor()),
        }
    }

    /// Height of the title, in mm.
    fn title_height(&self) -> f64 {
        2.0 * self.text
    }

    /// Writes the beginning of the file, with the title.
    fn head(&self, to: &mut impl Write) -> io::Result<()> {
        let Page { width, height, title, text, margin, .. } = self;
        let title = xml_text(title);
        writeln!(
            to,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.3} {height:.3}\" \
             font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\" font-size=\"{text:.3}\" fill=\"#24292f\">\n\
             <title>{title}</title>\n<desc>Lengths are in mm.</desc>\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n\
             <text x=\"{margin:.3}\" y=\"{:.3}\" font-size=\"{:.3}\">{title}</text>",
            margin + 1.2 * text,
            1.25 * text
        )
    }

    /// Draws `panel` with its name. Its upper left corner is at a point of the page, in mm.
    fn panel(&self, panel: &FlatPanel, [x, y]: [f64; 2], to: &mut impl Write) -> io::Result<()> {
        let Page { text, unit, range: [low, high], .. } = *self;
        let name = xml_text(&panel.name);
        writeln!(to, "<g id=\"{}\"><title>{name}</title>", panel.identifier)?;
        // The arrow along the warp. In SVG y points down, and angles turn clockwise.
        let [weft, warp] = panel.part.pattern_point([0.0, 1.0]);
        let angle = -warp.atan2(weft).to_degrees();
        let half = 0.55 * text;
        writeln!(
            to,
            "<path transform=\"translate({:.3} {:.3}) rotate({angle:.1})\" fill=\"none\" stroke=\"#24292f\" stroke-width=\"{:.3}\" \
             d=\"M{:.3} 0H{half:.3}m{:.3} {:.3}l{:.3} {:.3} {:.3} {:.3}\"/>",
            x + 0.6 * text,
            y - 0.85 * text,
            0.1 * text,
            -half,
            -0.4 * half,
            -0.4 * half,
            0.4 * half,
            0.4 * half,
            -0.4 * half,
            0.4 * half
        )?;
        let name_x = x + 1.6 * text;
        writeln!(to, "<text x=\"{name_x:.3}\" y=\"{:.3}\">{name}</text>", y - 0.5 * text)?;

        // Each band lies on the band below it.
        writeln!(
            to,
            "<g transform=\"translate({x:.3} {:.3}) scale({unit} -{unit})\">",
            y + panel.size[1]
        )?;
        let field = FlatField { triangles: &panel.triangles, values: panel.values };
        for band in 0..BANDS {
            let level = low + (high - low) * band as f64 / BANDS as f64;
            let level = if band == 0 { f64::NEG_INFINITY } else { level };
            let path = self.path(panel, &field.outlines(level), level);
            if !path.is_empty() {
                writeln!(to, "<path fill=\"{}\" d=\"{path}\"/>", self.band_colour(band))?;
            }
        }

        let outline = self.path(panel, &field.outlines(f64::NEG_INFINITY), f64::NEG_INFINITY);
        let width = 0.06 * text / unit;
        writeln!(
            to,
            "<path fill=\"none\" stroke=\"#24292f\" stroke-width=\"{width:.3}\" d=\"{outline}\"/>\n</g></g>"
        )
    }

    /// Returns `outlines` of the region of `panel` above `level` as the data of a path, in whole
    /// numbers.
    fn path(&self, panel: &FlatPanel, outlines: &[Vec<Node>], level: f64) -> String {
        let mut path = String::new();
        for outline in outlines {
            let points: Vec<[i64; 2]> =
                outline.iter().map(|node| self.grid_point(panel, *node, level)).collect();
            let steps =
                merged(points.windows(2).map(|pair| [0, 1].map(|k| pair[1][k] - pair[0][k])));
            let Some([x, y]) = points.first().filter(|_| !steps.is_empty()) else { continue };
            let _ = write!(path, "M{x} {y}l");
            for [x, y] in steps {
                let _ = write!(path, "{x} {y} ");
            }
            path.pop();
            path.push('z');
        }
        path
    }

    /// Returns `node` of the region of `panel` above `level`, in units of the paths.
    fn grid_point(&self, panel: &FlatPanel, node: Node, level: f64) -> [i64; 2] {
        let [a, b] = node.map(|vertex| panel.points[vertex as usize]);
        let [low, high] = node.map(|vertex| panel.values[vertex as usize]);
        let part = if node[0] == node[1] { 0.0 } else { (level - low) / (high - low) };
        [0, 1].map(|k| ((a[k] + part * (b[k] - a[k])) / self.unit).round() as i64)
    }

    /// Returns the colour of the band with the number `band`.
    fn band_colour(&self, band: usize) -> String {
        scale::colour((band as f64 + 0.5) / BANDS as f64, self.is_signed)
    }

    /// Draws the bands with the range of the field.
    fn legend(&self, to: &mut impl Write) -> io::Result<()> {
        let Page { text, margin, height, range: [low, high], .. } = *self;
        let (band_width, top) = (0.8 * text, height - margin - 2.4 * text);
        let label = xml_text(&self.label);
        writeln!(
            to,
            "<g id=\"legend\"><text x=\"{margin:.3}\" y=\"{:.3}\">{label}</text>",
            top - 0.5 * text
        )?;
        for band in 0..BANDS {
            writeln!(
                to,
                "<rect x=\"{:.3}\" y=\"{top:.3}\" width=\"{:.3}\" height=\"{text:.3}\" fill=\"{}\"/>",
                margin + band_width * band as f64,
                band_width * 1.02,
                self.band_colour(band)
            )?;
        }

        let ends = [("start", low), ("middle", 0.5 * (low + high)), ("end", high)];
        for (k, (anchor, value)) in ends.into_iter().enumerate() {
            let x = margin + 0.5 * k as f64 * band_width * BANDS as f64;
            writeln!(
                to,
                "<text x=\"{x:.3}\" y=\"{:.3}\" text-anchor=\"{anchor}\">{}</text>",
                top + 2.1 * text,
                significant(value, 3)
            )?;
        }
        writeln!(to, "</g>")
    }

    /// Draws a bar with a round length.
    fn scale_bar(&self, to: &mut impl Write) -> io::Result<()> {
        let Page { text, margin, width, height, .. } = *self;
        // A round number that is not above a third of the width to the right of the legend.
        let most = 12.0 * text;
        let length = 1.0 / scale::rounded_up(1.0 / most);
        let (x, y) = (width - margin - length, height - margin - 1.4 * text);
        writeln!(
            to,
            "<g id=\"scale\"><path fill=\"none\" stroke=\"#24292f\" stroke-width=\"{:.3}\" d=\"M{x:.3} {:.3}v{:.3}h{length:.3}v{:.3}\"/>\
             <text x=\"{:.3}\" y=\"{:.3}\" text-anchor=\"middle\">{} mm</text></g>",
            0.12 * text,
            y - 0.4 * text,
            0.4 * text,
            -0.4 * text,
            x + 0.5 * length,
            y + 1.1 * text,
            significant(length, 3)
        )
    }
}

#[cfg(test)]
mod tests {
    use roxmltree::{Document, Node};

    use super::*;
    use crate::example;

    /// Returns a recording of a square panel of so many vertices along a side, 10 mm apart.
    fn lattice(side: usize) -> (tempfile::TempDir, Recording) {
        let places: Vec<[usize; 2]> = (0..side * side).map(|k| [k % side, k / side]).collect();
        let material: Vec<[f64; 2]> =
            places.iter().map(|place| place.map(|k| 0.01 * k as f64)).collect();
        let cell = |[x, y]: &[usize; 2]| {
            let corner = |dx: usize, dy: usize| ((y + dy) * side + x + dx) as u32;
            let is_cell = x + 1 < side && y + 1 < side;
            let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1)];
            is_cell.then_some([[a, b, c], [c, b, d]])
        };
        let triangles: Vec<[u32; 3]> = places.iter().filter_map(cell).flatten().collect();
        let folder = example::folder_of_panel(&material, &triangles);
        let recording = Recording::open(folder.path()).unwrap();
        (folder, recording)
    }

    fn written(recording: &Recording, field: Field, values: &[f64]) -> String {
        let frame = recording.frame(0).unwrap();
        let mut text = Vec::new();
        write_svg(&PatternMap { recording, frame: &frame, field, values }, &mut text).unwrap();
        String::from_utf8(text).unwrap()
    }

    /// Returns the drawing of two panels.
    fn two_panels() -> String {
        let folder = example::folder(&[0.3]);
        let recording = Recording::open(folder.path()).unwrap();
        written(&recording, Field::Shear, &[0.5, 1.0, 1.5, 2.0, -2.5, 3.0, 3.5])
    }

    #[test]
    fn a_drawing_has_every_panel_by_name_and_says_range_and_length() {
        let text = two_panels();
        let document = Document::parse(&text).unwrap();
        let words: Vec<&str> = document.descendants().filter_map(|node| node.text()).collect();
        for word in ["front", example::HOSTILE, "shear angle, °", "-5.00", "5.00", "100 mm"] {
            assert!(words.contains(&word), "{word}: {words:?}");
        }
        assert!(words.iter().any(|word| word.contains("frame 0, 0.300 s")), "{words:?}");
    }

    /// Returns the numbers of an attribute.
    fn numbers(node: Node<'_, '_>, attribute: &str) -> Vec<f64> {
        let text = node.attribute(attribute).unwrap();
        let words = text.split(|c: char| !"-.0123456789".contains(c));
        words.filter_map(|word| word.parse().ok()).collect()
    }

    /// Returns the first element of a name in another one.
    fn child<'a, 'b>(of: Node<'a, 'b>, name: &str) -> Node<'a, 'b> {
        of.children().find(|node| node.has_tag_name(name)).unwrap()
    }

    /// Returns the group of an identifier.
    fn group<'a, 'b>(document: &'a Document<'b>, identifier: &str) -> Node<'a, 'b> {
        document.descendants().find(|node| node.attribute("id") == Some(identifier)).unwrap()
    }

    /// Returns the width and the height of a page and the height of its text, in mm.
    fn measures(document: &Document<'_>) -> [f64; 3] {
        let page = document.root_element();
        let size = numbers(page, "viewBox");
        [size[2], size[3], numbers(page, "font-size")[0]]
    }

    #[test]
    fn panels_and_their_names_are_on_the_page_and_not_on_each_other() {
        let drawing = two_panels();
        let document = Document::parse(&drawing).unwrap();
        let [width, height, text] = measures(&document);
        let panels = document
            .descendants()
            .filter(|node| node.has_tag_name("g") && node.attribute("transform").is_some());
        let mut boxes = Vec::new();
        for (panel, size) in panels.zip([[100.0, 200.0], [250.0, 500.0]]) {
            let place = numbers(panel, "transform");
            let (x, bottom) = (place[0], place[1]);
            let top = bottom - size[1];
            let whole = panel.parent().unwrap();
            let name = child(whole, "text");
            let [name_x, name_y] = ["x", "y"].map(|key| numbers(name, key)[0]);
            assert!((x..x + 2.0 * text).contains(&name_x), "{name_x} is not at {x}");
            assert!((top - text..top).contains(&name_y), "{name_y} is not above {top}");
            let arrow = numbers(child(whole, "path"), "transform");
            assert!(arrow[0] + 0.5 * text < name_x && (x..name_x).contains(&arrow[0]), "{arrow:?}");
            boxes.push([x, top - text, x + size[0], bottom]);
        }
        let inside = |[left, top, right, bottom]: [f64; 4]| {
            0.0 < left && 2.0 * text < top && right < width && bottom < height - 3.0 * text
        };
        assert!(boxes.iter().all(|own| inside(*own)), "{boxes:?} on {width} × {height}");
        let [a, b] = boxes[..] else { panic!("{boxes:?}") };
        let between = (0..2).map(|k| (b[k] - a[k + 2]).max(a[k] - b[k + 2])).fold(0.0, f64::max);
        assert!(between > 0.5 * text, "{boxes:?}");
    }

    #[test]
    fn narrow_panels_have_room_for_their_names() {
        let names = ["sleeve, left, upper half", "sleeve, right, upper half"];
        let strip = [[3.0, 2.0], [3.005, 2.0], [3.0, 2.1]];
        let folder = example::folder_of_panel(&[strip, strip].concat(), &[[0, 1, 2], [3, 4, 5]]);
        let panels =
            names.map(|name| serde_json::json!({ "name": name, "vertices": 3, "triangles": 1 }));
        let manifest =
            serde_json::json!({ "format": 2, "guarded": false, "panels": panels, "bodies": [] });
        std::fs::write(folder.path().join("surfaces.json"), format!("{manifest}\n")).unwrap();
        let recording = Recording::open(folder.path()).unwrap();
        let drawing = written(&recording, Field::Shear, &[0.0; 6]);
        let document = Document::parse(&drawing).unwrap();
        let [width, height, text] = measures(&document);
        assert!(width < 400.0 && height < 400.0, "{width} × {height}");
        let place = |name: &str| {
            let named =
                |node: &Node<'_, '_>| node.has_tag_name("text") && node.text() == Some(name);
            let node = document.descendants().find(named).unwrap();
            ["x", "y"].map(|key| numbers(node, key)[0])
        };
        let [a, b] = names.map(place);
        let width = LETTER * text * names[0].chars().count() as f64;
        assert!(b[1] - a[1] > 100.0 || b[0] - a[0] > width, "{a:?}, {b:?}: {width} mm");
        // The strips lie at 3 m on their pattern, and beside the margin on the page.
        let page = document.root_element();
        let strip = page
            .descendants()
            .find(|node| node.attribute("transform").is_some_and(|own| own.contains("scale")));
        assert!(numbers(strip.unwrap(), "transform")[0] < 2.0 * text);
    }

    #[test]
    fn the_scale_bar_is_as_long_as_it_says_and_right_of_the_legend_of_all_bands() {
        let drawing = two_panels();
        let document = Document::parse(&drawing).unwrap();
        let [width, height, text] = measures(&document);
        let scale = group(&document, "scale");
        let [x, y, down, length, up] = numbers(child(scale, "path"), "d")[..] else { panic!() };
        let said = scale.descendants().find_map(|node| node.text()).unwrap();
        assert_eq!((said, down + up), (&format!("{length} mm")[..], 0.0));
        assert!(x > 0.5 * width && x + length < width && x + length > width - 2.0 * text);
        assert!((height - 4.0 * text..height - text).contains(&y), "{y} of {height}");
        let word = numbers(child(scale, "text"), "y")[0];
        assert!(word > y + 0.7 * text && word < height - text, "{word} is not below {y}");
        let legend = group(&document, "legend");
        let bands: Vec<_> = legend.children().filter(|node| node.has_tag_name("rect")).collect();
        let colours: Vec<&str> = bands.iter().filter_map(|band| band.attribute("fill")).collect();
        let middle = |band: usize| scale::colour((band as f64 + 0.5) / BANDS as f64, true);
        assert_eq!(colours, (0..BANDS).map(middle).collect::<Vec<_>>());
        let lefts: Vec<f64> = bands.iter().map(|band| numbers(*band, "x")[0]).collect();
        assert!(lefts.is_sorted_by(|a, b| a < b), "{lefts:?}");
        assert!(lefts[BANDS - 1] + numbers(bands[BANDS - 1], "width")[0] < x);
        assert!(lefts[BANDS - 1] - lefts[0] > 15.0 * text, "{lefts:?}");
        let top = numbers(bands[0], "y")[0];
        let words: Vec<f64> = legend
            .children()
            .filter(|node| node.has_tag_name("text"))
            .map(|node| numbers(node, "y")[0])
            .collect();
        assert!(words[0] < top && words[0] > height - 6.0 * text, "{words:?}, {top}");
        assert!(words[1] > top + 1.5 * text && words[1] < height, "{words:?}, {top}");
    }

    #[test]
    fn triangles_are_anticlockwise() {
        for turn in 0..24 {
            let corner = |k: u32| {
                let (sine, cosine) = (0.26 * f64::from(turn) + 2.1 * f64::from(k)).sin_cos();
                [cosine - 3.0, 1.5 * sine + 2.0]
            };
            let points = [0, 1, 2].map(corner);
            assert_eq!(anticlockwise([0, 1, 2], &points), [0, 1, 2]);
            assert_eq!(anticlockwise([0, 2, 1], &points), [0, 1, 2]);
            assert_eq!(anticlockwise([1, 0, 2], &points), [1, 2, 0]);
        }
    }

    #[test]
    fn steps_in_one_direction_are_one() {
        let of = |steps: &[[i64; 2]]| merged(steps.iter().copied());
        assert_eq!(of(&[[1, 2], [0, 0], [2, 4], [3, 6]]), [[6, 12]]);
        assert_eq!(of(&[[1, 2], [-1, -2]]), [[1, 2], [-1, -2]], "it goes back");
        assert_eq!(of(&[[1, 0], [1, 1], [0, 1]]), [[1, 0], [1, 1], [0, 1]]);
    }

    #[test]
    fn a_linear_field_has_straight_bands_of_few_points() {
        let (_folder, recording) = lattice(41);
        let values: Vec<f64> = recording.topology().material.iter().map(|[u, _]| 2.5 * u).collect();
        let text = written(&recording, Field::Speed, &values);
        let document = Document::parse(&text).unwrap();
        let bands: Vec<&str> = document
            .descendants()
            .filter(|node| node.has_tag_name("path") && node.attribute("stroke").is_none())
            .filter_map(|node| node.attribute("d"))
            .collect();
        assert_eq!(bands.len(), BANDS);
        // The range ends at 1 m/s, so that the bound of the sixth band is at 80 mm.
        assert_eq!(bands[5], "M8000 0l32000 0 0 40000 -32000 0 0 -40000z");
    }

    #[test]
    fn the_largest_file_has_10_megabytes() {
        // Values that jump from vertex to vertex over the whole range, the worst there is.
        let (_folder, recording) = lattice(200);
        let jump = |k: usize| (k.wrapping_mul(2_654_435_761) % 1009) as f64 / 1009.0;
        let values: Vec<f64> = (0..40_000).map(jump).collect();
        let text = written(&recording, Field::Speed, &values);
        assert!(text.len() < 10_000_000, "{} bytes", text.len());
    }
}
