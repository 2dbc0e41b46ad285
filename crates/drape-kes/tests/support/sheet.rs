//! Sheets in folders of their own, with one curve file beside them.

use drape_input::{Diagnostic, Diagnostics};
use drape_kes::{Error, Sheet};

/// Creates a folder with a sheet and one curve file.
pub fn folder(sheet: &str, curve: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(folder.path().join("sheet.toml"), sheet).expect("written");
    std::fs::write(folder.path().join("pull.csv"), curve).expect("written");
    folder
}

pub fn read(sheet: &str, curve: &str) -> Result<Sheet, Error> {
    Sheet::read(folder(sheet, curve).path())
}

pub fn mistakes(result: Result<Sheet, Error>) -> Vec<Diagnostic> {
    match result {
        Err(Error::Input(Diagnostics(mistakes))) => mistakes,
        other => panic!("no mistakes of input: {other:?}"),
    }
}

/// Returns the one finding of a bad sheet.
pub fn finding(sheet: &str, curve: &str) -> Diagnostic {
    let findings = mistakes(read(sheet, curve));
    assert_eq!(findings.len(), 1, "{findings:#?}");
    findings.into_iter().next().expect("one finding")
}

pub fn help(finding: &Diagnostic) -> &str {
    finding.help.as_deref().expect("every finding has a remedy")
}

pub const GOOD_CURVE: &str = "strain,force\n0,0\n1,50\n2,200\n";
