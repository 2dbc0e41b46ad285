//! Reader of DXF as pattern makers' programs write it: AAMA-292 and ASTM D6673.
//!
//! Every piece is a block. The layer says what a line is: 1 the cut line, 14 the sewing line, 2
//! corners, 3 points of curves, 4 and 80 to 83 notches, 6 a fold, 7 the grain line, 8 lines inside,
//! 11 cut-outs, 13 drill holes. Texts name the piece, its size, and the unit. `pairs` splits the
//! file, `entities` collects its blocks, `piece` makes a panel of a block, `slit` makes notches of
//! slits in a line. The reader is written here because the `dxf` crate brings a tree of packages
//! for whole drawings, and keeps no line numbers for diagnostics.

mod entities;
mod pairs;
mod piece;
mod slit;

use std::collections::{BTreeMap, BTreeSet};

use drape_input::{Diagnostic, Diagnostics, Document, Remedy, closest};

use self::entities::{Block, Contents, Form, contents, field, layer};
use self::pairs::pairs;
use self::piece::Reader;
use super::fit::CHORDS;
use super::request::Request;
use super::size::Doubt;
use super::unit::{DXF_UNITS, Unit};
use crate::edge::control_extent;
use crate::note::PatternNote;
use crate::pattern::Pattern;
use crate::sketch::Sketch;

/// Distances within which programs let chords follow a curve, in m. Other numbers are another
/// quantity.
const TOLERANCES: std::ops::RangeInclusive<f64> = 1e-5..=1e-3;

/// Returns the pattern of `document`, and adds its lines to `sketch`. `request` may state the unit
/// and the size.
pub(crate) fn read(
    document: &Document,
    request: &Request,
    sketch: &mut Sketch,
) -> Result<Pattern, Diagnostics> {
    let contents = contents(document, &pairs(document)?)?;
    let mut pieces: Vec<&Block> = contents.blocks.iter().filter(|block| is_piece(block)).collect();
    if pieces.is_empty() && is_piece(&contents.loose) {
        pieces.push(&contents.loose);
    }
    if pieces.is_empty() {
        return Err(no_piece(document, &contents));
    }

    let (unit, taken) = unit(document, &contents, request, &pieces)?;
    let mut notes = vec![taken];
    let (pieces, taken) = pieces_of_size(document, &contents, request, pieces)?;
    notes.extend(taken);

    let tolerance = tolerance(&contents, unit);
    let mut reader = Reader { document, sketch, unit, tolerance, mistakes: Vec::new(), notes };
    let mut panels = Vec::new();
    for piece in pieces {
        panels.extend(reader.panel(piece));
    }
    let Reader { mistakes, mut notes, .. } = reader;
    Diagnostics::check(mistakes)?;

    if let Some(doubt) = Doubt::for_drawing(&panels, unit.metres()) {
        match request.unit {
            Some(_) => notes.push(doubt.note()),
            None => return Err(doubt.question(document, request, unit.word()).into()),
        }
    }

    notes.push(PatternNote::NoSeams { format: "DXF" });
    match Pattern::new(panels, Vec::new()) {
        Ok(pattern) => Ok(pattern.with_notes(notes)),
        Err(all) => Err(Diagnostics(
            all.iter().map(|m| super::diagnostic::diagnostic(document, m)).collect(),
        )),
    }
}

/// Returns whether `block` has an outline of a piece.
fn is_piece(block: &Block) -> bool {
    block.entities.iter().any(|entity| {
        matches!(layer(&entity.layer), Some(1 | 14))
            && matches!(&entity.form, Form::Chain(edges) if !edges.is_empty())
    })
}

/// Returns the mistake that `document` with `contents` has no piece.
fn no_piece(document: &Document, contents: &Contents) -> Diagnostics {
    let all = contents.blocks.iter().chain([&contents.loose]).flat_map(|block| &block.entities);
    let layers: BTreeSet<&str> = all.map(|entity| entity.layer.as_str()).collect();
    let layers: Vec<&str> = layers.into_iter().take(20).collect();
    let message = if layers.is_empty() {
        "the file has no lines".to_owned()
    } else {
        format!(
            "no line is on layer 1 (cut line) or 14 (sewing line); the layers are: {}",
            layers.join(", ")
        )
    };
    let help = "export the pattern as DXF-AAMA or DXF-ASTM, or put outlines on layer 1";
    Diagnostic::new(document.path(), message).help(help).into()
}

/// Returns the value of the text `key` anywhere in a file.
fn field_of_file(contents: &Contents, key: &str) -> Option<String> {
    let blocks = [&contents.loose].into_iter().chain(&contents.blocks);
    blocks.into_iter().find_map(|block| field(block, key))
}

/// Returns the distance within which the chords of a file follow its curves, in m: the distance
/// that the file states, or a usual distance.
fn tolerance(contents: &Contents, unit: Unit) -> f64 {
    let text = ["curve tolerance", "tolerance"].iter();
    let text = text.filter_map(|key| field_of_file(contents, key)).next();
    let number = text.and_then(|text| text.replace(',', ".").parse::<f64>().ok());
    let metres = number.map(|number| number * unit.metres());
    metres.filter(|metres| TOLERANCES.contains(metres)).unwrap_or(CHORDS)
}

/// Returns the unit of a file with the pieces `pieces`, with a note on the reason.
fn unit(
    document: &Document,
    contents: &Contents,
    request: &Request,
    pieces: &[&Block],
) -> Result<(Unit, PatternNote), Diagnostics> {
    if let Some(unit) = request.unit {
        return Ok((unit, unit_note(unit, "it is asked for".into())));
    }

    // The text of a piece is more reliable than the header, which many programs leave as it is.
    let text = field_of_file(contents, "units");
    let word = text.clone().unwrap_or_default().to_ascii_uppercase();
    let by_text = match word.as_str() {
        "METRIC" | "MM" | "MILLIMETERS" => Some(Unit::MM),
        "ENGLISH" | "IMPERIAL" | "INCH" | "INCHES" => Some(Unit::INCH),
        "CM" | "CENTIMETERS" => Unit::parse("cm"),
        _ => None,
    };
    if let Some(unit) = by_text {
        let reason = format!("its text says \"Units: {}\"", text.unwrap_or_default());
        return Ok((unit, unit_note(unit, reason)));
    }

    let by_header = match contents.insunits {
        Some(1) => Some(Unit::INCH),
        Some(4) => Some(Unit::MM),
        Some(5) => Unit::parse("cm"),
        Some(6) => Unit::parse("m"),
        _ => None,
    };
    if let (Some(unit), Some(number)) = (by_header, contents.insunits) {
        let reason = format!("its header says $INSUNITS {number}");
        return Ok((unit, unit_note(unit, reason)));
    }

    Err(unknown_unit(document, pieces))
}

/// Returns the note that lengths are in `unit`, for `reason`.
fn unit_note(unit: Unit, reason: String) -> PatternNote {
    PatternNote::Taken { taken: format!("lengths are in {}", unit.word()), reason }
}

/// Returns the question for the unit of `document`, with the size of the largest of `pieces` in
/// each.
fn unknown_unit(document: &Document, pieces: &[&Block]) -> Diagnostics {
    let largest = pieces.iter().map(|block| (extent(block), block.name.as_str()));
    let (size, name) = largest.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((0.0, ""));
    let message = format!(
        "the file does not say its unit: its largest piece, \"{name}\", is {size:.1} units, which are {:.0} mm if a \
         unit is 1 mm, {:.0} mm if it is 1 cm, {:.0} mm if it is 1 inch",
        size,
        10.0 * size,
        25.4 * size
    );
    let remedy = Remedy::StateUnit { file: document.path().to_owned(), units: DXF_UNITS };
    Diagnostic::new(document.path(), message).help(remedy).into()
}

/// Larger side of the bounding box of `block`, in the unit of the file.
fn extent(block: &Block) -> f64 {
    let chains = block.entities.iter().filter_map(|entity| match &entity.form {
        Form::Chain(edges) => Some(edges),
        _ => None,
    });
    control_extent(chains.flatten())
}

/// Returns the members of `pieces` with one size: the size that `request` asks for, or the sample
/// size, or the only size. A choice comes with a note.
fn pieces_of_size<'a>(
    document: &Document,
    contents: &Contents,
    request: &Request,
    pieces: Vec<&'a Block>,
) -> Result<(Vec<&'a Block>, Option<PatternNote>), Diagnostics> {
    let sizes: BTreeSet<String> = pieces.iter().filter_map(|block| field(block, "size")).collect();
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    for piece in &pieces {
        *counts.entry(piece::name(piece)).or_default() += 1;
    }
    let is_graded = sizes.len() > 1 && counts.values().any(|count| *count > 1);

    let sample = field_of_file(contents, "sample size");
    let list = sizes.iter().cloned().collect::<Vec<_>>().join(", ");
    let mut note = None;
    let wanted = match (&request.size, sample) {
        (Some(wanted), _) => {
            if !sizes.contains(wanted) {
                let message = format!("there is no size \"{wanted}\"");
                let help = match closest(wanted, sizes.iter().map(String::as_str)) {
                    Some(similar) => format!("did you mean \"{similar}\"?"),
                    None if sizes.is_empty() => "the file has one size: leave it out".into(),
                    None => format!("the sizes are: {list}"),
                };
                return Err(Diagnostic::new(document.path(), message).help(help).into());
            }
            wanted.clone()
        }
        (None, _) if !is_graded => return Ok((pieces, None)),
        (None, Some(sample)) if sizes.contains(&sample) => {
            let taken = format!("the size is {sample} of {list}");
            note = Some(PatternNote::Taken { taken, reason: "it is the sample size".into() });
            sample
        }
        (None, _) => {
            let message = format!("the pieces are in several sizes: {list}");
            let size = sizes.first().cloned().unwrap_or_default();
            let remedy = Remedy::ChooseSize { file: document.path().to_owned(), size };
            return Err(Diagnostic::new(document.path(), message).help(remedy).into());
        }
    };

    // Pieces without a size belong to every size.
    let chosen =
        pieces.into_iter().filter(|block| field(block, "size").is_none_or(|size| size == wanted));
    Ok((chosen.collect(), note))
}
