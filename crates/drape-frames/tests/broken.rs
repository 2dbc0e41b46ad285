//! Files that were cut off, or changed in a byte.

use std::path::Path;

use drape_frames::{EnergyTable, Error, Frame, Recording};
use npyz::WriterBuilder;
use npyz::half::f16;
use tempfile::TempDir;

const ENERGY: &str = "number,time,kinetic,gravity\n0,0.5,0.25,-0.125\n";

fn manifest(format: u8) -> String {
    format!(
        r#"{{ "format": {format}, "guarded": true, "panels": [
{{ "name": "a", "vertices": 3, "triangles": 1, "reach": 1.5e-4, "separation": 5e-5 }} ], "bodies": [
{{ "name": "b", "vertices": 3, "triangles": 1, "reach": 1.5e-4, "separation": 5e-5 }} ] }}
"#
    )
}

fn array<T: npyz::AutoSerialize + Copy>(rows: u64, numbers: &[T]) -> Vec<u8> {
    let mut file = Vec::new();
    let shape = [rows, numbers.len() as u64 / rows];
    let options = npyz::WriteOptions::new().default_dtype().shape(&shape);
    let mut writer = options.writer(&mut file).begin_nd().expect("an array");
    writer.extend(numbers.iter().copied()).expect("an array");
    writer.finish().expect("an array");
    file
}

/// Files of a folder by their names.
type Files = Vec<(&'static str, Vec<u8>)>;

fn files() -> Files {
    let corners = [0_u32, 1, 2];
    vec![
        ("surfaces.json", manifest(2).into()),
        ("frames.csv", b"number,time,growth,bodies,touched\n0,0.5,1.0,0,1\n".to_vec()),
        ("pressure-00000.npy", array(3, &[0.0, 4.5, 0.0].map(f16::from_f64))),
        ("material.npy", array(3, &[0.0, 0.0, 0.0, 1.0, 1.0, 0.0])),
        ("triangles.npy", array(1, &corners)),
        ("body-triangles.npy", array(1, &corners)),
        ("frame-00000.npy", array(3, &[0.0, 2e-4, 0.0, 0.0, 2e-4, 1.0, 1.0, 2e-4, 0.0])),
        ("bodies-00000.npy", array(3, &[0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0])),
    ]
}

fn folder(files: &Files) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    files.iter().for_each(|(name, content)| write(folder.path(), name, content));
    folder
}

fn write(folder: &Path, name: &str, content: &[u8]) {
    std::fs::write(folder.join(name), content).expect("writes");
}

/// Reads everything that a folder of one frame has.
fn read(folder: &Path) -> Result<Frame, Error> {
    let recording = Recording::open(folder)?;
    recording.energy()?;
    recording.frame(0)
}

#[test]
fn a_folder_gives_the_frame_that_its_files_hold() {
    let folder = folder(&files());
    let frame = read(folder.path()).unwrap();
    assert_eq!(frame.cloth, [[0.0, 2e-4, 0.0], [0.0, 2e-4, 1.0], [1.0, 2e-4, 0.0]]);
    assert_eq!(frame.bodies, [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]);
    assert_eq!((frame.time, frame.growth_fraction), (0.5, 1.0));
}

#[test]
fn a_folder_of_another_format_is_refused_with_the_remedy() {
    for format in [0, 1, 3] {
        let folder = folder(&files());
        write(folder.path(), "surfaces.json", manifest(format).as_bytes());
        let error = Recording::open(folder.path()).unwrap_err();
        assert!(matches!(error, Error::UnknownFormat { known: 2, .. }), "{error}");
        let error = error.to_string();
        assert!(error.contains(&format!("is of format {format}, ")), "{error}");
        assert!(
            error.contains("surfaces.json") && error.contains("run the scene again"),
            "{error}"
        );
    }
}

#[test]
fn a_file_cut_at_any_byte_is_an_error_that_names_it() {
    let files = files();
    let folder = folder(&files);
    for (name, content) in &files {
        for end in 0..content.len() {
            write(folder.path(), name, &content[..end]);
            // JSON is whole without the line break at its end.
            if name.ends_with(".json") && content[end..] == *b"\n" {
                assert!(read(folder.path()).is_ok());
                continue;
            }
            let error = read(folder.path()).unwrap_err().to_string();
            // The list of frames may end after any line; then its frames are missing.
            let named = error.contains(name) || *name == "frames.csv";
            assert!(named, "{name} cut at {end}: {error}");
        }
        write(folder.path(), name, content);
    }
    assert!(read(folder.path()).is_ok());
}

#[test]
fn a_manifest_is_whole_without_a_line_break_at_its_end_and_with_several() {
    let folder = folder(&files());
    let expected = read(folder.path()).unwrap();
    let whole = manifest(2);
    for ending in ["", "\n", "\r\n", "\n\n  \n"] {
        let text = format!("{}{ending}", whole.trim_end());
        write(folder.path(), "surfaces.json", text.as_bytes());
        assert_eq!(read(folder.path()).as_ref(), Ok(&expected), "{ending:?}");
    }
}

#[test]
fn a_changed_byte_is_an_error_or_another_state_and_never_a_panic() {
    let files = files();
    let folder = folder(&files);
    let (mut errors, mut states) = (0, 0);
    for (name, content) in &files {
        for at in 0..content.len() {
            for byte in [b'-', b'9', b'\n', 0xff] {
                let mut bytes = content.clone();
                bytes[at] = byte;
                write(folder.path(), name, &bytes);
                match read(folder.path()) {
                    Ok(_) => states += 1,
                    Err(_) => errors += 1,
                }
            }
        }
        write(folder.path(), name, content);
    }
    assert!(errors > 100 && states > 100, "{errors} errors, {states} states");
}

#[test]
fn pressures_and_energy_are_those_of_their_frame() {
    let folder = folder(&files());
    write(folder.path(), "energy.csv", ENERGY.as_bytes());
    let recording = Recording::open(folder.path()).unwrap();
    assert!(recording.has_pressures());
    assert_eq!(recording.frame(0).unwrap().pressures, Some(vec![0.0, 4.5, 0.0]));
    let EnergyTable { names, rows } = recording.energy().unwrap().unwrap();
    assert_eq!(
        (&names[..], &rows[..]),
        (&["kinetic", "gravity"].map(str::to_owned)[..], &[Some(vec![0.25, -0.125])][..])
    );
    // The balance begins later, and a killed run leaves a row cut.
    write(folder.path(), "energy.csv", b"number,time,kinetic\n1,0.5,0.25\n2,0.");
    assert_eq!(recording.energy().unwrap().unwrap().rows, [None]);
    let lists = [
        ("0", Some(vec![0.0; 3]), true, "nothing touches, and no file is needed"),
        ("", None, false, "surfaces are not kept apart"),
    ];
    std::fs::remove_file(folder.path().join("pressure-00000.npy")).unwrap();
    for (touched, pressures, is_known, case) in lists {
        let list = format!("number,time,growth,bodies,touched\n0,0.5,1.0,0,{touched}\n");
        write(folder.path(), "frames.csv", list.as_bytes());
        let recording = Recording::open(folder.path()).unwrap();
        assert_eq!(recording.frame(0).unwrap().pressures, pressures, "{case}");
        assert_eq!(recording.has_pressures(), is_known, "{case}");
    }
}

#[test]
fn a_folder_of_an_older_version_has_the_pressures_of_its_last_frame() {
    let files = files();
    let folder = folder(&files);
    write(folder.path(), "pressure.npy", &array(3, &[0.0, 0.1, 0.0]));
    let list = "number,time,growth,bodies\n0,0.4,1.0,0\n1,0.5,1.0,0\n";
    write(folder.path(), "frames.csv", list.as_bytes());
    write(folder.path(), "frame-00001.npy", &array(3, &[0.0; 9]));
    let recording = Recording::open(folder.path()).unwrap();
    let pressures = |number: usize| recording.frame(number).unwrap().pressures;
    assert!(recording.has_pressures());
    assert_eq!([pressures(0), pressures(1)], [None, Some(vec![0.0, 0.1, 0.0])]);
}

#[test]
fn what_a_killed_run_listed_is_read() {
    let folder = folder(&files());
    let list = "number,time,growth,bodies\n0,0.5,1.0,0\n1,0.6,1.";
    write(folder.path(), "frames.csv", list.as_bytes());
    write(folder.path(), "frame-00001.npy", b"half");
    let recording = Recording::open(folder.path()).unwrap();
    assert_eq!(
        (recording.frame_count(), recording.ended(), recording.time(0)),
        (1, false, Ok(0.5))
    );
    assert!(matches!(recording.frame(1), Err(Error::NoFrame { last: 0, .. })));
    write(folder.path(), "summary.json", b"{ \"frames\": 2 }\n");
    let error = Recording::open(folder.path()).unwrap_err().to_string();
    assert!(error.contains("1 of 2 frames, and frame-00001.npy"), "{error}");
}

#[test]
fn arrays_of_another_kind_are_refused_with_what_they_are() {
    let cases: [(&str, Vec<u8>, &str); 13] = [
        ("frame-00000.npy", array(3, &[0.0_f32; 9]), "no table of numbers <f8"),
        ("frame-00000.npy", array(3, &[0.0; 6]), "2 columns, and needs 3"),
        ("frame-00000.npy", array(4, &[0.0; 12]), "4 vertices, and surfaces.json says 3"),
        ("frame-00000.npy", array(3, &[f64::NAN; 9]), "row 0 (from 0) is [NaN"),
        ("frame-00000.npy", array(3, &[1e7; 9]), "at most 1000000 m"),
        ("triangles.npy", array(1, &[0_u32, 1, 1]), "two are the same"),
        ("triangles.npy", array(1, &[0_u32, 1, 3]), "not all are vertices of its part"),
        ("body-triangles.npy", array(1, &[0_i64, 1, 2]), "no table of numbers <u4"),
        ("pressure-00000.npy", array(3, &[0.0; 3]), "no table of numbers <f2"),
        (
            "pressure-00000.npy",
            array(3, &[0.0, -1.0, 0.0].map(f16::from_f64)),
            "row 1 (from 0) is -1",
        ),
        ("energy.csv", b"number,time,kinetic\n0,0.5,inf\n".to_vec(), "line 2: it is no row"),
        ("energy.csv", b"number,time,kinetic\nx,0.5,0.0\n".to_vec(), "line 2: \"x\" is no number"),
        ("energy.csv", b"time,kinetic\n0.5,0.0\n".to_vec(), "other columns than number, time"),
    ];
    for (name, content, words) in cases {
        let folder = folder(&files());
        write(folder.path(), name, &content);
        let error = read(folder.path()).unwrap_err().to_string();
        assert!(error.contains(name) && error.contains(words), "{error}");
    }
    for (list, words) in [
        ("0,0.5,1.0,0\n2,0.6,1.0,0\n", "line 3: the frames are not numbered"),
        ("0,0.5,1.0,1\n", "line 2: the frames are not numbered"),
        ("0,0.5,1.0,\n", "line 2: frame 0 names no frame that has its bodies"),
        ("0,0.5,2.0,0\n", "line 2: 2 is no fraction"),
        ("0,inf,1.0,0\n", "line 2: inf s is no time"),
        ("0,soon,1.0,0\n", "line 2"),
        ("", "has 0 of 1 frames"),
    ] {
        let folder = folder(&files());
        write(folder.path(), "frames.csv", format!("number,time,growth,bodies\n{list}").as_bytes());
        let error = read(folder.path()).unwrap_err().to_string();
        assert!(error.contains(words), "{list}: {error}");
    }
}

#[test]
fn a_folder_without_a_manifest_is_no_run() {
    let files = files();
    let folder = folder(&files);
    assert!(Recording::exists(folder.path()));
    std::fs::remove_file(folder.path().join("surfaces.json")).unwrap();
    assert!(!Recording::exists(folder.path()));
    assert!(matches!(Recording::open(folder.path()), Err(Error::NotARun { .. })));
}

#[test]
fn a_frame_gives_the_fraction_to_which_its_separation_has_grown() {
    let folder = folder(&files());
    let with = |growth: &str| {
        let list = format!("number,time,growth,bodies\n0,0.5,{growth},0\n");
        write(folder.path(), "frames.csv", list.as_bytes());
        read(folder.path()).map(|frame| frame.growth_fraction)
    };
    assert_eq!(
        [with("0.25").unwrap(), with("1e-3").unwrap(), with("1").unwrap()],
        [0.25, 1e-3, 1.0]
    );
    for wrong in ["0", "-0.25", "1.5", "NaN", "half"] {
        let error = with(wrong).unwrap_err().to_string();
        assert!(error.contains("frames.csv, line 2"), "{wrong}: {error}");
        assert!(error.contains("no fraction") || wrong == "half", "{wrong}: {error}");
    }
}

#[test]
fn a_header_may_be_padded_up_to_its_largest_length() {
    let folder = folder(&files());
    let exact = read(folder.path()).unwrap();
    let (name, content) = files().into_iter().find(|(name, _)| *name == "frame-00000.npy").unwrap();
    let numbers = content.len() - 9 * size_of::<f64>();
    let text = String::from_utf8(content[10..numbers].to_vec()).unwrap();
    // A header is the magic string and the version, in 8 bytes, its length in 2, and its text.
    let padded = |length: usize| {
        let text = format!("{:<width$}\n", text.trim_end(), width = length - 11);
        let start = [&content[..8], &((length - 10) as u16).to_le_bytes()].concat();
        [&start[..], text.as_bytes(), &content[numbers..]].concat()
    };
    for length in [512, 1024] {
        write(folder.path(), name, &padded(length));
        assert_eq!(read(folder.path()).unwrap(), exact, "{length}");
    }
    write(folder.path(), name, &padded(1025));
    assert!(matches!(read(folder.path()), Err(Error::TooLarge { .. })));
}
