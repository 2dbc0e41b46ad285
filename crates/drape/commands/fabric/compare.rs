//! `drape fabric compare`: fabrics side by side.

use std::path::{Path, PathBuf};

use drape::file;
use drape::reports::compare_page;

use super::read::read;
use crate::commands::sheets;
use crate::failure::Failure;
use crate::say::{say, say_json, say_written};

pub(super) fn compare(
    paths: [&PathBuf; 2],
    report: Option<&Path>,
    json: bool,
) -> Result<(), Failure> {
    let page = compare_page([&read(paths[0])?, &read(paths[1])?]);
    if json {
        say_json(&page)?;
    } else {
        say(page.to_text()?.trim_end())?;
    }
    if let Some(folder) = report {
        let [first, second] = paths.map(|path| sheets::stem(path));
        let path = folder.join(format!("{first}-and-{second}.html"));
        file::write(&path, &page.to_html()?)?;
        if !json {
            say_written(format_args!("page written to {}", path.display()))?;
        }
    }
    Ok(())
}
