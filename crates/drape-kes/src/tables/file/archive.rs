//! Members of zip archives, which a path names as if the archive were a folder:
//! `exports.zip/warp/tensile.csv`.

use std::path::{Path, PathBuf};

/// Files of an archive at most: more are no exports of one fabric.
#[cfg(feature = "archives")]
const MOST_MEMBERS: usize = 500;

/// Returns whether a path ends as archives do.
pub(crate) fn is_archive(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("zip"))
}

/// Splits a path into an archive that is there and the name of a member; `None` where it leads to
/// none.
pub(crate) fn split(path: &Path) -> Option<(PathBuf, String)> {
    let archive = path.ancestors().skip(1).find(|place| is_archive(place) && place.is_file())?;
    let member = path.strip_prefix(archive).ok()?;
    let parts: Vec<String> =
        member.components().map(|part| part.as_os_str().to_string_lossy().into_owned()).collect();
    Some((archive.to_owned(), parts.join("/")))
}

/// Returns the names of the files of an archive; `Err` holds the reason why it cannot be read.
#[cfg(feature = "archives")]
pub(crate) fn members(path: &Path) -> Result<Vec<String>, String> {
    let mut archive = open(path)?;
    let mut names = Vec::new();
    for index in 0..archive.len() {
        let member = archive.by_index_raw(index).map_err(|error| error.to_string())?;
        let name = decoded(member.name_raw());
        let hidden =
            |part: &str| part.starts_with('.') || part.starts_with("~$") || part == "__MACOSX";
        if member.is_file() && !name.starts_with('/') && !name.split('/').any(hidden) {
            names.push(name);
        }
        if names.len() > MOST_MEMBERS {
            return Err(format!(
                "it holds more than {MOST_MEMBERS} files: pack the exports of one fabric"
            ));
        }
    }
    names.sort();
    Ok(names)
}

/// Reads a member of an archive of at most some bytes; `Err` holds the reason why it cannot be
/// read.
#[cfg(feature = "archives")]
pub(crate) fn read(path: &Path, name: &str, most: u64) -> Result<Vec<u8>, String> {
    use std::io::Read;

    let mut archive = open(path)?;
    let is_named = |archive: &mut Archive, index: usize| {
        archive.by_index_raw(index).is_ok_and(|member| decoded(member.name_raw()) == name)
    };
    let index = (0..archive.len()).find(|&index| is_named(&mut archive, index));
    let index = index.ok_or_else(|| format!("there is no {name} in it"))?;
    let member = archive.by_index(index).map_err(|error| error.to_string())?;
    let mut bytes = Vec::new();
    // The size that the archive states may be wrong: what comes out of it is counted.
    member.take(most + 1).read_to_end(&mut bytes).map_err(|error| error.to_string())?;
    if bytes.len() as u64 > most {
        return Err(format!("{name} is larger than the {most} bytes that a table may have"));
    }
    Ok(bytes)
}

#[cfg(feature = "archives")]
type Archive = zip::ZipArchive<std::io::BufReader<std::fs::File>>;

#[cfg(feature = "archives")]
fn open(path: &Path) -> Result<Archive, String> {
    let file = std::fs::File::open(path).map_err(|error| error.to_string())?;
    zip::ZipArchive::new(std::io::BufReader::new(file)).map_err(|error| error.to_string())
}

/// Returns a name of the archive as text; older programs write it in the encoding of their country.
#[cfg(feature = "archives")]
fn decoded(name: &[u8]) -> String {
    let text = crate::tables::encoding::decode(name, None);
    let text = text.map_or_else(|_| String::from_utf8_lossy(name).into_owned(), |found| found.text);
    text.replace('\\', "/")
}

/// Reads nothing: the crate was built without its feature `archives`.
#[cfg(not(feature = "archives"))]
pub(crate) fn members(_: &Path) -> Result<Vec<String>, String> {
    Err("this program was built without the feature `archives`".to_owned())
}

/// Reads nothing: the crate was built without its feature `archives`.
#[cfg(not(feature = "archives"))]
pub(crate) fn read(_: &Path, _: &str, _: u64) -> Result<Vec<u8>, String> {
    Err("this program was built without the feature `archives`".to_owned())
}
