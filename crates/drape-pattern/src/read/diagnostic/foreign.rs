//! Files of pattern makers' programs that only these programs read, and how to export a drawing
//! from them.

use std::path::Path;

use drape_input::Diagnostic;

/// Format of another program.
struct ForeignFormat {
    /// Endings, in small letters.
    endings: &'static [&'static str],
    /// Content of the file, in words.
    content: &'static str,
    /// How to export DXF or SVG from it.
    help: &'static str,
}

/// Foreign formats, which are known by their endings.
const FOREIGN: [ForeignFormat; 11] = [
    ForeignFormat {
        endings: &["val", "sm2d"],
        content: "a pattern of Valentina or Seamly2D",
        help: "open it there, lay out its pieces (Layout > New print layout, or detail mode), and export the layout as \
               SVG or DXF (AAMA or ASTM)",
    },
    ForeignFormat {
        endings: &["vit", "vst", "smis", "smms"],
        content: "a table of measurements of Valentina or Seamly2D, without a pattern",
        help: "open the pattern (*.val, *.sm2d) there, lay out its pieces, and export the layout as SVG or DXF",
    },
    ForeignFormat {
        endings: &["zpac", "zprj"],
        content: "a garment of CLO or Marvelous Designer",
        help: "open it there, and choose File > Export > DXF (AAMA or ASTM)",
    },
    ForeignFormat {
        endings: &["mrk"],
        content: "a marker, the layout of pieces for the cutter",
        help: "open its pieces or its model in the program that made it (Gerber AccuMark, OptiTex, Lectra), and export \
               them as DXF (AAMA or ASTM)",
    },
    ForeignFormat {
        endings: &["pds", "pdsx"],
        content: "a style of OptiTex PDS",
        help: "open it there, and choose File > Export > AAMA or ASTM, which is DXF",
    },
    ForeignFormat {
        endings: &["mdl", "iba", "vet"],
        content: "a model of Lectra Modaris",
        help: "open it there, and choose File > Export > AAMA or ASTM, which is DXF",
    },
    ForeignFormat {
        endings: &["rul"],
        content: "the grade rules that belong to a DXF file, without its pieces",
        help: "name the *.dxf file beside it, which has the pieces in all sizes",
    },
    ForeignFormat {
        endings: &["plt", "hpg", "hpgl"],
        content: "a file for a plotter or a cutter: lines without pieces",
        help: "export the pattern from the program that made it as DXF (AAMA or ASTM), or import the file in Inkscape and \
               save it as SVG",
    },
    ForeignFormat {
        endings: &["dwg"],
        content: "a drawing of AutoCAD, in its binary format",
        help: "save it as DXF (ASCII), with each piece as a block and its outline on layer 1",
    },
    ForeignFormat {
        endings: &["ai", "eps", "cdr", "pdf"],
        content: "a drawing for print",
        help: "open it in the program that made it, or in Inkscape, and save it as SVG",
    },
    ForeignFormat {
        endings: &["blend", "max", "c4d", "ma", "mb"],
        content: "a scene of a program for three dimensions, without a flat pattern",
        help: "patterns are *.toml, *.json of GarmentCode or FreeSewing, *.svg and *.dxf; a body is exported as OBJ",
    },
];

/// Returns a diagnostic if only another program reads the file `path`; `None` for other files.
pub(crate) fn foreign_file(path: &Path) -> Option<Diagnostic> {
    let ending = path.extension()?.to_str()?.to_ascii_lowercase();
    let format = FOREIGN.iter().find(|format| format.endings.contains(&ending.as_str()))?;
    let message = format!("files *.{ending} are not read: this is {}", format.content);
    Some(Diagnostic::new(path, message).help(format.help))
}
