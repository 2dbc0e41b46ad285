//! Blocks and entities of DXF, as far as patterns use them.

use drape_input::{Diagnostic, Diagnostics, Document};

use super::pairs::Pair;
use crate::edge::{Curve, Edge};
use crate::write::decoded;

/// Largest coordinate, in the unit of the file; beyond it the file is damaged.
const FARTHEST: f64 = 1e9;

/// Drawn entity on a layer.
#[derive(Debug, Clone)]
pub(crate) struct Entity {
    pub(crate) layer: String,
    pub(crate) form: Form,
}

/// Form of an entity, in the unit of the file.
#[derive(Debug, Clone)]
pub(crate) enum Form {
    /// Chain of edges: a line, an arc or a polyline.
    Chain(Vec<Edge>),
    Point([f64; 2]),
    Text(String),
    /// Entity of a kind that is not read.
    Other(String),
}

/// Block: in a pattern, a piece in a size.
#[derive(Debug, Clone, Default)]
pub(crate) struct Block {
    pub(crate) name: String,
    /// Line of the file where it begins.
    pub(crate) line: usize,
    pub(crate) entities: Vec<Entity>,
}

/// Contents of a file.
#[derive(Debug, Default)]
pub(crate) struct Contents {
    pub(crate) blocks: Vec<Block>,
    /// Entities outside of blocks.
    pub(crate) loose: Block,
    /// Number of the unit in the header.
    pub(crate) insunits: Option<i32>,
}

/// Entity whose pairs are being collected.
struct OpenEntity<'a> {
    kind: &'a str,
    pairs: Vec<Pair<'a>>,
    vertices: Vec<Vec<Pair<'a>>>,
}

/// Returns the contents of `document`, whose pairs are `pairs`.
///
/// # Errors
/// A number that no piece can have.
pub(crate) fn contents(document: &Document, pairs: &[Pair<'_>]) -> Result<Contents, Diagnostics> {
    let mut contents = Contents::default();
    let mut block: Option<Block> = None;
    let mut open: Option<OpenEntity<'_>> = None;
    // Section that is being read, and variable of the header whose value comes next.
    let mut section = "";
    let mut variable = "";
    for (index, pair) in pairs.iter().enumerate() {
        match (pair.code, pair.value) {
            (9, name) => variable = name,
            (70, number) if variable == "$INSUNITS" => {
                contents.insunits = number.parse().ok();
                variable = "";
            }
            (0, "VERTEX") if open.as_ref().is_some_and(|o| o.kind == "POLYLINE") => {
                if let Some(open) = &mut open {
                    open.vertices.push(Vec::new());
                }
            }
            (0, kind) => {
                if let Some(done) = open.take() {
                    let into = block.as_mut().unwrap_or(&mut contents.loose);
                    into.entities.push(entity(document, &done)?);
                }
                match kind {
                    "SECTION" => {
                        section = pairs.get(index + 1).map_or("", |next| next.value);
                    }
                    "BLOCK" => block = Some(Block { line: pair.line, ..Block::default() }),
                    "ENDBLK" => contents.blocks.extend(block.take()),
                    "ENDSEC" | "EOF" | "SEQEND" => {}
                    _ if matches!(section, "BLOCKS" | "ENTITIES") => {
                        open = Some(OpenEntity { kind, pairs: Vec::new(), vertices: Vec::new() });
                    }
                    _ => {}
                }
            }
            (2, name) if open.is_none() && block.as_ref().is_some_and(|b| b.name.is_empty()) => {
                if let Some(block) = &mut block {
                    block.name = name.into();
                }
            }
            _ => {
                if let Some(open) = &mut open {
                    open.vertices.last_mut().unwrap_or(&mut open.pairs).push(*pair);
                }
            }
        }
    }
    contents.blocks.extend(block);
    Ok(contents)
}

/// Returns the number that `pair` has as its value.
fn number(document: &Document, pair: &Pair<'_>) -> Result<f64, Diagnostics> {
    match pair.value.replace(',', ".").parse::<f64>() {
        Ok(value) if value.abs() < FARTHEST => Ok(value),
        _ => {
            let message = format!(
                "\"{}\" of group {} is no number that a piece can have",
                pair.value, pair.code
            );
            let help = "export the file again; numbers are such as 120.5";
            Err(Diagnostic::new(document.path(), message).on_line(pair.line).help(help).into())
        }
    }
}

/// Returns the value of the first of `pairs` with the group code `code`, as a number; 0 if there is
/// none.
fn number_of(document: &Document, pairs: &[Pair<'_>], code: i32) -> Result<f64, Diagnostics> {
    let pair = pairs.iter().find(|pair| pair.code == code);
    pair.map_or(Ok(0.0), |pair| number(document, pair))
}

/// Returns the entity of the pairs of `open`.
fn entity(document: &Document, open: &OpenEntity<'_>) -> Result<Entity, Diagnostics> {
    let value = |code: i32| open.pairs.iter().find(|pair| pair.code == code);
    let get = |code: i32| number_of(document, &open.pairs, code);
    let flag = value(70).and_then(|pair| pair.value.parse::<i32>().ok()).unwrap_or(0);
    let layer = value(8).map(|pair| pair.value.to_owned()).unwrap_or_default();

    // Group codes: 10, 20 and 11, 21 are points, 40 a radius, 50 and 51 angles, 42 a bulge.
    let form = match open.kind {
        "LINE" => {
            let (start, end) = ([get(10)?, get(20)?], [get(11)?, get(21)?]);
            let edges = if start == end { Vec::new() } else { vec![Edge::line("", start, end)] };
            Form::Chain(edges)
        }
        "POINT" => Form::Point([get(10)?, get(20)?]),
        "TEXT" | "MTEXT" => {
            Form::Text(value(1).map(|pair| decoded(pair.value)).unwrap_or_default())
        }
        "ARC" => {
            let (centre, radius) = ([get(10)?, get(20)?], get(40)?);
            let (from, to) = (get(50)?.to_radians(), get(51)?.to_radians());
            let [start, end] = [from, to]
                .map(|angle| [centre[0] + radius * angle.cos(), centre[1] + radius * angle.sin()]);
            let sweep = (to - from).rem_euclid(std::f64::consts::TAU);
            let arc = Edge::line("", start, end).curved(Curve::Arc { sweep });
            let edges = if arc.start == arc.end { Vec::new() } else { vec![arc] };
            Form::Chain(edges)
        }
        "POLYLINE" => {
            let mut corners = Vec::new();
            for vertex in &open.vertices {
                let [x, y, bulge] = [10, 20, 42].map(|code| number_of(document, vertex, code));
                corners.push(Corner { at: [x?, y?], bulge: bulge? });
            }
            chain(&corners, flag & 1 == 1)
        }
        "LWPOLYLINE" => {
            let mut corners: Vec<Corner> = Vec::new();
            for pair in &open.pairs {
                match (pair.code, corners.last_mut()) {
                    (10, _) => {
                        corners.push(Corner { at: [number(document, pair)?, 0.0], bulge: 0.0 });
                    }
                    (20, Some(last)) => last.at[1] = number(document, pair)?,
                    (42, Some(last)) => last.bulge = number(document, pair)?,
                    _ => {}
                }
            }
            chain(&corners, flag & 1 == 1)
        }
        kind => Form::Other(kind.into()),
    };
    Ok(Entity { layer, form })
}

/// Corner of a polyline. `bulge` is the tangent of a quarter of the angle of the arc that begins
/// there.
struct Corner {
    at: [f64; 2],
    bulge: f64,
}

/// Returns the chain of a polyline with `corners`.
fn chain(corners: &[Corner], closed: bool) -> Form {
    let mut edges = Vec::new();
    let next = corners.iter().cycle().skip(1);
    let count = if closed { corners.len() } else { corners.len().saturating_sub(1) };
    for (from, to) in corners.iter().zip(next).take(count) {
        if from.at == to.at {
            continue;
        }
        let line = Edge::line("", from.at, to.at);
        edges.push(match from.bulge {
            0.0 => line,
            bulge => line.curved(Curve::Arc { sweep: 4.0 * bulge.atan() }),
        });
    }
    Form::Chain(edges)
}

/// Returns the number of the layer `name`.
pub(crate) fn layer(name: &str) -> Option<u32> {
    let digits = name.trim_start_matches(|letter: char| !letter.is_ascii_digit());
    digits.parse().ok()
}

/// Returns the texts of `block`.
pub(crate) fn texts(block: &Block) -> impl Iterator<Item = &str> {
    block.entities.iter().filter_map(|entity| match &entity.form {
        Form::Text(text) => Some(text.as_str()),
        _ => None,
    })
}

/// Returns the value of the text `key` among the entities of `block`. Such a text is `Piece Name:
/// FRONT`.
pub(crate) fn field(block: &Block, key: &str) -> Option<String> {
    let mut values = texts(block).filter_map(|text| {
        let (name, value) = text.split_once(':')?;
        let name = name.split_whitespace().collect::<Vec<_>>().join(" ");
        name.eq_ignore_ascii_case(key).then(|| value.trim().to_owned())
    });
    values.find(|value| !value.is_empty())
}
