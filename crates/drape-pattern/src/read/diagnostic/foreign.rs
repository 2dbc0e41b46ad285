//! Files of pattern makers' programs that only these programs read, and how to get a drawing from
//! them.

use std::path::Path;

use drape_input::Diagnostic;

/// Kind of a file of another program.
struct Foreign {
    /// Endings, in small letters.
    endings: &'static [&'static str],
    /// What the file is.
    what: &'static str,
    /// How to get DXF or SVG from it.
    help: &'static str,
}

/// Kinds of files that are known by their endings.
const FOREIGN: [Foreign; 11] = [
    Foreign {
        endings: &["val", "sm2d"],
        what: "a pattern of Valentina or Seamly2D",
        help: "open it there, lay out its pieces (Layout > New print layout, or detail mode), and export the layout as \
               SVG or DXF (AAMA or ASTM)",
    },
    Foreign {
        endings: &["vit", "vst", "smis", "smms"],
        what: "a table of measurements of Valentina or Seamly2D, without a pattern",
        help: "open the pattern (*.val, *.sm2d) there, lay out its pieces, and export the layout as SVG or DXF",
    },
    Foreign {
        endings: &["zpac", "zprj"],
        what: "a garment of CLO or Marvelous Designer",
        help: "open it there, and choose File > Export > DXF (AAMA or ASTM)",
    },
    Foreign {
        endings: &["mrk"],
        what: "a marker, the layout of pieces for the cutter",
        help: "open its pieces or its model in the program that made it (Gerber AccuMark, OptiTex, Lectra), and export \
               them as DXF (AAMA or ASTM)",
    },
    Foreign {
        endings: &["pds", "pdsx"],
        what: "a style of OptiTex PDS",
        help: "open it there, and choose File > Export > AAMA or ASTM, which is DXF",
    },
    Foreign {
        endings: &["mdl", "iba", "vet"],
        what: "a model of Lectra Modaris",
        help: "open it there, and choose File > Export > AAMA or ASTM, which is DXF",
    },
    Foreign {
        endings: &["rul"],
        what: "the grade rules that belong to a DXF file, without its pieces",
        help: "name the *.dxf file beside it; one size of it is read with --size",
    },
    Foreign {
        endings: &["plt", "hpg", "hpgl"],
        what: "a file for a plotter or a cutter: lines without pieces",
        help: "export the pattern from the program that made it as DXF (AAMA or ASTM), or import the file in Inkscape and \
               save it as SVG",
    },
    Foreign {
        endings: &["dwg"],
        what: "a drawing of AutoCAD, in its binary format",
        help: "save it as DXF (ASCII), with each piece as a block and its outline on layer 1",
    },
    Foreign {
        endings: &["ai", "eps", "cdr", "pdf"],
        what: "a drawing for print",
        help: "open it in the program that made it, or in Inkscape, and save it as SVG",
    },
    Foreign {
        endings: &["blend", "max", "c4d", "ma", "mb"],
        what: "a scene of a program for three dimensions, without a flat pattern",
        help: "patterns are *.toml, *.json of GarmentCode or FreeSewing, *.svg and *.dxf; a body is exported as OBJ",
    },
];

/// Returns the answer to a file that only another program reads; `None` for other files.
pub(crate) fn foreign(path: &Path) -> Option<Diagnostic> {
    let ending = path.extension()?.to_str()?.to_ascii_lowercase();
    let kind = FOREIGN.iter().find(|kind| kind.endings.contains(&ending.as_str()))?;
    let message = format!("files *.{ending} are not read: this is {}", kind.what);
    Some(Diagnostic::new(path, message).help(kind.help))
}
