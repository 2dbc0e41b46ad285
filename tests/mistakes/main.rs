//! The mistakes that a newcomer makes most: `page.md` has them with their messages, word
//! for word, and the remedies that these advise. Here each is made, read and remedied.

mod bounds;
mod page;
mod schema;

use std::path::Path;
use std::time::{Duration, Instant};

use drape::fabric::Fabric;
use drape::input::Diagnostics;
use drape::kes::Sheet;
use page::{Files, Page};

/// Reads a file as the program does, and returns its mistakes.
fn read(path: &Path) -> Result<(), Diagnostics> {
    let name = path.file_name().and_then(|name| name.to_str()).expect("it has a name");
    match name {
        "plain.toml" => Fabric::read(path).map(|_| ()),
        "sheet.toml" => Sheet::read(path).map(|_| ()).map_err(|error| match error {
            drape::kes::Error::Input(mistakes) => mistakes,
            other => panic!("{other}"),
        }),
        _ => drape::run::read_scene(path).map(|_| ()).map_err(|error| match error {
            drape::scene::Error::Input(mistakes) => mistakes,
            drape::scene::Error::Tangled(tangle) => tangle.mistakes,
            other => panic!("{other}"),
        }),
    }
}

/// Reads a file among others in a folder, and returns its mistakes, with paths seen from there.
fn mistakes(files: &Files, checked: &str) -> Option<Diagnostics> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, text) in files.iter() {
        std::fs::write(folder.path().join(name), text).expect("writes");
    }
    let mut mistakes = read(&folder.path().join(checked)).err()?;
    let prefix = format!("{}/", folder.path().display());
    for mistake in &mut mistakes.0 {
        mistake.message = mistake.message.replace(&prefix, "");
        mistake.help = mistake.help.take().map(|help| help.replace(&prefix, ""));
        let edited = mistake.edits.iter_mut().map(|edit| &mut edit.file);
        for file in edited.chain([&mut mistake.file]) {
            *file = file.strip_prefix(folder.path()).expect("it is in the folder").into();
        }
    }
    Some(mistakes)
}

/// Reads a file among others in a folder, and returns its mistakes as they are told.
fn answer(files: &Files, checked: &str) -> Option<String> {
    mistakes(files, checked).map(|mistakes| mistakes.to_string())
}

#[test]
fn every_mistake_has_its_answer_and_every_remedy_works() {
    let page = Page::parse(include_str!("page.md"));
    for checked in ["scene.toml", "plain.toml", "garment.toml", "sheet.toml"] {
        assert_eq!(answer(&page.files, checked), None, "{checked} is right as it is");
    }
    assert!(page.mistakes.len() >= 40, "{} mistakes", page.mistakes.len());
    let (mut wrong, mut longest) = (Vec::new(), Duration::ZERO);
    for mistake in &page.mistakes {
        let files = page.files.with(&mistake.change);
        let start = Instant::now();
        let told = answer(&files, &mistake.checked).unwrap_or_default();
        longest = longest.max(start.elapsed());
        if told != mistake.message {
            wrong.push(format!("{}\nis answered by\n{told}", mistake.title));
        }
        if let Some(still) = answer(&files.with(&mistake.remedy), &mistake.checked) {
            wrong.push(format!("{}\nremedied is answered by\n{still}", mistake.title));
        }
    }
    println!("{} mistakes, the longest answer took {longest:?}", page.mistakes.len());
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

#[test]
fn every_edit_takes_its_mistake_away() {
    let page = Page::parse(include_str!("page.md"));
    let (mut count, mut wrong) = (0, Vec::new());
    for mistake in &page.mistakes {
        let files = page.files.with(&mistake.change);
        let told = mistakes(&files, &mistake.checked).expect("it is a mistake").0;
        for one in told.iter().filter(|one| !one.edits.is_empty()) {
            count += 1;
            let mended = files.edited(&one.edits);
            let after = mended.map(|files| mistakes(&files, &mistake.checked));
            let gone = after.as_ref().is_ok_and(|after| {
                after.iter().flat_map(|after| &after.0).all(|left| left.message != one.message)
            });
            if !gone || told.len() == 1 && !matches!(after, Ok(None)) {
                wrong.push(format!("{}: {:?}\nlead to\n{after:?}", mistake.title, one.edits));
            }
        }
    }
    println!("{count} remedies of {} mistakes are edits", page.mistakes.len());
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
    assert!(count >= 19, "{count} remedies are edits");
}
