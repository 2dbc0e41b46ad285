//! Drawing of a pattern on pages of paper, at true scale. The pages overlap, to be glued together.

use drape_input::{figure_in_decimals, xml_text};
use std::fmt::Write;

use super::number::letters;
use super::svg::{PatternSheet, STYLE};
use crate::pattern::Pattern;

/// Border of a page that printers leave white, in mm.
const MARGIN: f64 = 10.0;

/// Width of the strip that neighbouring pages both show, in mm.
const OVERLAP: f64 = 15.0;

/// Paper of a printer: width and height of a page, in mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Paper {
    /// Width and height, in mm.
    pub size: [f64; 2],
}

impl Paper {
    /// Returns the paper with the name `word`: a4, a3, a2, a1, a0, letter, legal, tabloid, or a
    /// size such as 210x297 in mm.
    #[must_use]
    pub fn parse(word: &str) -> Option<Self> {
        let size = match word.to_ascii_lowercase().as_str() {
            "a4" => [210.0, 297.0],
            "a3" => [297.0, 420.0],
            "a2" => [420.0, 594.0],
            "a1" => [594.0, 841.0],
            "a0" => [841.0, 1189.0],
            "letter" => [215.9, 279.4],
            "legal" => [215.9, 355.6],
            "tabloid" => [279.4, 431.8],
            size => {
                let (width, height) = size.split_once('x')?;
                [width.parse().ok()?, height.parse().ok()?]
            }
        };
        let is_paper = size.iter().all(|side| (100.0..=10_000.0).contains(side));
        is_paper.then_some(Self { size })
    }
}

/// Page of a drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct Page {
    /// Letter of the row and number of the column, such as `B3`.
    pub name: String,
    /// The page in SVG.
    pub svg: String,
}

impl Pattern {
    /// Returns a drawing of the pattern on pages of `paper`, row by row. Empty pages are left out.
    ///
    /// Neighbouring pages show the same drawing in a strip of 15 mm, with crosses that come to lie
    /// on each other. Each page has its position, and a line of 50 mm by which the scale of the
    /// print is checked.
    #[must_use]
    pub fn to_pages(&self, paper: Paper) -> Vec<Page> {
        let room = paper.size.map(|x| x - 2.0 * MARGIN);
        let step = room.map(|x| x - OVERLAP);
        // Rows of panels end where columns of pages do.
        let sheet = PatternSheet::new(self, Some(step[0] * 5.0 + OVERLAP));
        let count = [0, 1].map(|k| ((sheet.size[k] - OVERLAP) / step[k]).ceil().max(1.0) as usize);
        let mut pages = Vec::new();
        for row in 0..count[1] {
            for column in 0..count[0] {
                let corner = [column as f64 * step[0], row as f64 * step[1]];
                let shown: Vec<&str> = sheet
                    .groups
                    .iter()
                    .filter(|([low, high], _)| {
                        (0..2).all(|k| low[k] < corner[k] + room[k] && high[k] > corner[k])
                    })
                    .map(|(_, group)| group.as_str())
                    .collect();
                if shown.is_empty() {
                    continue;
                }
                let name = format!("{}{}", letters(row), column + 1);
                let window = PageWindow { name: &name, corner, room, count };
                pages.push(Page { svg: page(paper, &window, &shown), name });
            }
        }
        pages
    }
}

/// Part of the sheet that a page shows. Lengths are in mm.
struct PageWindow<'a> {
    name: &'a str,
    /// Upper left corner on the sheet.
    corner: [f64; 2],
    /// Width and height.
    room: [f64; 2],
    /// Number of columns and of rows.
    count: [usize; 2],
}

/// Returns the page of `paper` that shows `groups`, groups of panels, within `window`.
fn page(paper: Paper, window: &PageWindow<'_>, groups: &[&str]) -> String {
    let [width, height] = paper.size;
    let PageWindow { name, corner, room, count } = window;
    // The clip is in the frame of the sheet, as the group is.
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}mm\" height=\"{height}mm\" \
         viewBox=\"0 0 {width} {height}\" data-page=\"{name}\" {STYLE}>\n\
         <clipPath id=\"room\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>\n\
         <g clip-path=\"url(#room)\" transform=\"translate({} {})\">\n",
        corner[0],
        corner[1],
        room[0],
        room[1],
        figure_in_decimals(MARGIN - corner[0], 4),
        figure_in_decimals(MARGIN - corner[1], 4)
    );
    groups.iter().for_each(|group| svg.push_str(group));
    svg.push_str("</g>\n");
    let _ = writeln!(
        svg,
        "<rect class=\"frame\" x=\"{MARGIN}\" y=\"{MARGIN}\" width=\"{}\" height=\"{}\" \
         stroke=\"#888888\" stroke-width=\"0.15\" stroke-dasharray=\"2 2\"/>",
        room[0], room[1]
    );
    for x in [MARGIN + 0.5 * OVERLAP, MARGIN + room[0] - 0.5 * OVERLAP] {
        for y in [MARGIN + 0.5 * OVERLAP, MARGIN + room[1] - 0.5 * OVERLAP] {
            let _ = writeln!(
                svg,
                "<path class=\"cross\" stroke-width=\"0.2\" d=\"M{} {y}h8M{x} {}v8\"/>",
                x - 4.0,
                y - 4.0
            );
        }
    }
    let words = format!(
        "page {name} of {} rows and {} columns; print at 100 %; this line is 50 mm long:",
        count[1], count[0]
    );
    let _ = writeln!(
        svg,
        "<text x=\"{MARGIN}\" y=\"7\" font-size=\"3.2\" fill=\"#000000\" stroke=\"none\">{}</text>\n\
         <path class=\"scale\" d=\"M{} 6h50m-50 -1.5v3m50 -3v3\"/>\n</svg>",
        xml_text(&words),
        width - MARGIN - 50.0
    );
    svg
}
