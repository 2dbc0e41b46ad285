//! A file, or a member of an archive, read into grids: spreadsheet or text, with its encoding and
//! separator.

pub(crate) mod archive;

use std::path::Path;

use drape_input::{Diagnostic, Diagnostics, FileAccess, SizeLimit};
use encoding_rs::Encoding;

use crate::tables::channel_rows;
use crate::tables::encoding;
use crate::tables::grid::{CELLS_MAX, Grid, Separator, separator};
use crate::tables::layout::Layout;
use crate::tables::spreadsheet;

/// Limit of the size of tables: half a million points, where a usual curve has some hundred.
const LIMIT: SizeLimit = SizeLimit::new("tables", 32 << 20);

/// Grids of a file, with the encoding and separator that were found.
#[derive(Clone, Debug)]
pub(crate) struct TableFile {
    pub(crate) grids: Vec<Grid>,
    /// Encoding and separator, in words; empty for ASCII with commas.
    pub(crate) reading: Vec<String>,
    /// Encoding of a text file that is not plain ASCII.
    pub(crate) encoding: Option<&'static Encoding>,
}

/// Returns whether `path` is a file, or a member of an archive.
pub(crate) fn is_there(path: &Path, access: &FileAccess) -> bool {
    access.has_file(path)
        || archive::split_member(path, access).is_some_and(|member| {
            archive::members(&member.archive, access)
                .is_ok_and(|members| members.contains(&member.name))
        })
}

/// Reads the file, or the member of an archive, at `path`, on disk or in memory. The limit on its
/// size is raised by the factor in `access`.
pub(crate) fn read(
    path: &Path,
    layout: &Layout,
    access: &FileAccess,
) -> Result<TableFile, Diagnostics> {
    let member = archive::split_member(path, access).filter(|_| access.held(path).is_none());
    if let Some(member) = member {
        let bytes = archive::read(&member, LIMIT.bytes(access), access).map_err(|reason| {
            Diagnostic::new(&member.archive, format!("the archive cannot be read: {reason}"))
                .help("pack it again as .zip without a password, or name the folder of its files")
        })?;
        return parse(path, &bytes, layout);
    }
    parse(path, &LIMIT.read(path, access)?, layout)
}

/// Parses the `bytes` of a file. The `path` is used in messages, and for the ending of its name.
pub(crate) fn parse(path: &Path, bytes: &[u8], layout: &Layout) -> Result<TableFile, Diagnostics> {
    let mut file = parse_rows(path, bytes, layout)?;
    // A sheet that declares a header has names in a row.
    if layout.lines.header.is_none() {
        let lines: Vec<usize> =
            file.grids.iter_mut().flat_map(channel_rows::turn_channels).collect();
        if let (Some(first), Some(last)) = (lines.first(), lines.last()) {
            file.reading.push(format!("channels as rows, on lines {first} to {last}"));
        }
    }
    Ok(file)
}

/// Parses the `bytes` of a file into rows.
fn parse_rows(path: &Path, bytes: &[u8], layout: &Layout) -> Result<TableFile, Diagnostics> {
    if spreadsheet::is_spreadsheet(path, bytes) {
        let grids = spreadsheet::read(bytes).map_err(|reason| {
            Diagnostic::new(path, format!("not a spreadsheet that can be read: {reason}"))
                .help("save it again as .xlsx, or each sheet as .csv")
        })?;
        return Ok(TableFile { grids, reading: Vec::new(), encoding: None });
    }

    let decoded = encoding::decode(bytes, layout.encoding).map_err(|place| {
        let line = bytes[..place].iter().filter(|&&byte| byte == b'\n').count() + 1;
        let name = layout.encoding.map_or("UTF-8", |encoding| encoding.name());
        Diagnostic::new(path, format!("the file is not {name}"))
            .on_line(line)
            .help("remove `encoding`, so that it is detected, or name the right one")
    })?;
    let text = decoded.text.strip_prefix('\u{feff}').unwrap_or(&decoded.text);
    let text = text.replace("\r\n", "\n").replace('\r', "\n");
    let mut reading = Vec::new();
    if !decoded.reading.is_empty() {
        reading.push(decoded.reading);
    }

    let text = match declared_by_file(&text) {
        // The first line that Excel writes names the separator, and is made a comment.
        Some(_) => text.replacen("sep=", "# sep=", 1),
        None => text,
    };

    if Separator::may_exceed_cells(&text) {
        let message = format!("it has more than {CELLS_MAX} cells");
        return Err(Diagnostic::new(path, message).help("save the results alone").into());
    }
    let taken = layout.separator.unwrap_or_else(|| separator(&text));
    if layout.separator.is_none() && taken != Separator::Comma {
        let words = match taken {
            Separator::Tab => "tabs",
            Separator::Semicolon => "semicolons",
            Separator::Bar => "bars",
            _ => "blanks",
        };
        reading.push(format!("{words} between the cells"));
    }

    let rows = taken.split(&text).map_err(|broken| {
        Diagnostic::new(path, format!("not a table: {}", broken.reason))
            .on_line(broken.line)
            .help("save the file as .csv or .xlsx again")
    })?;
    let grid = Grid {
        sheet: String::new(),
        rows,
        breaks_off: !text.is_empty() && !text.ends_with('\n'),
        separator: Some(taken),
    };
    Ok(TableFile { grids: vec![grid], reading, encoding: decoded.encoding })
}

/// Returns the separator that the first line of `text` declares in the form of Excel: `sep=;`.
fn declared_by_file(text: &str) -> Option<&str> {
    text.strip_prefix("sep=")?.lines().next()
}
