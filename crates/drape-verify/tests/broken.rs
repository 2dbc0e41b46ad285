//! Files that were cut off, or changed in a byte.

use std::path::Path;

use drape_verify::{Error, Recording, Verdict};

const SURFACES: &str = r#"{ "format": 1, "guarded": true, "panels": [
{ "name": "a", "vertices": 3, "triangles": 1, "reach": 1.5e-4, "separation": 5e-5 } ], "bodies": [
{ "name": "b", "vertices": 3, "triangles": 1, "reach": 1.5e-4, "separation": 5e-5 } ] }
"#;
const FRAME: &str = "# metres, y up; t = 0.5 s\n# bodies: bodies-00000.obj\nv 0 2e-4 0\nv 0 2e-4 1\n\
                     v 1 2e-4 0\nvt 0 0\nvt 0 1\nvt 1 0\nf 1/1 2/2 3/3\n";
const BODIES: &str = "v 0 0 0\nv 0 0 1\nv 1 0 0\no b\nf 1 2 3\n";

fn write(folder: &Path, name: &str, content: &[u8]) {
    std::fs::write(folder.join(name), content).expect("writes");
}

fn verify(folder: &Path) -> Result<Verdict, Error> {
    Recording::open(folder)?.verify(0)
}

#[test]
fn a_file_cut_at_any_byte_is_an_error_that_names_it() {
    let folder = tempfile::tempdir().unwrap();
    let files =
        [("surfaces.json", SURFACES), ("frame-00000.obj", FRAME), ("bodies-00000.obj", BODIES)];
    files.iter().for_each(|(name, text)| write(folder.path(), name, text.as_bytes()));
    let whole = verify(folder.path()).unwrap();
    assert!(whole.holds() && whole.time == Some(0.5), "{whole:?}");
    for (name, text) in files {
        for end in 0..text.len() {
            write(folder.path(), name, &text.as_bytes()[..end]);
            let error = verify(folder.path()).unwrap_err().to_string();
            assert!(error.contains(name), "{name} cut at {end}: {error}");
        }
        write(folder.path(), name, text.as_bytes());
    }
}

#[test]
fn a_changed_byte_is_an_error_or_another_state_and_never_a_panic() {
    let folder = tempfile::tempdir().unwrap();
    let files =
        [("surfaces.json", SURFACES), ("frame-00000.obj", FRAME), ("bodies-00000.obj", BODIES)];
    files.iter().for_each(|(name, text)| write(folder.path(), name, text.as_bytes()));
    let (mut errors, mut verdicts) = (0, 0);
    for (name, text) in files {
        for at in 0..text.len() {
            for byte in [b'-', b'9', b'\n', 0xff] {
                let mut bytes = text.as_bytes().to_vec();
                bytes[at] = byte;
                write(folder.path(), name, &bytes);
                match verify(folder.path()) {
                    Ok(_) => verdicts += 1,
                    Err(_) => errors += 1,
                }
            }
        }
        write(folder.path(), name, text.as_bytes());
    }
    assert!(errors > verdicts && verdicts > 100, "{errors} errors, {verdicts} verdicts");
}
