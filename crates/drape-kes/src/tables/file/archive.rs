//! Members of zip archives, on disk or in memory. A path names a member as if the archive were a
//! folder: `exports.zip/warp/tensile.csv`.

use std::path::{Path, PathBuf};

use drape_input::FileAccess;

/// Largest number of files of an archive. More files are no exports of one fabric.
#[cfg(feature = "archives")]
const MOST_MEMBERS: usize = 500;

/// Returns whether `path` has the ending of an archive.
pub(crate) fn is_archive(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("zip"))
}

/// Member of an archive.
pub(crate) struct Member {
    /// Path of the archive.
    pub(crate) archive: PathBuf,
    /// Name of the member in the archive.
    pub(crate) name: String,
}

/// Splits `path` into an existing archive and the name of a member. Returns `None` if `path` leads
/// into no archive.
pub(crate) fn split_member(path: &Path, access: &FileAccess) -> Option<Member> {
    let mut places = path.ancestors().skip(1);
    let archive = places.find(|place| is_archive(place) && access.has_file(place))?;
    let member = path.strip_prefix(archive).ok()?;
    let parts: Vec<String> =
        member.components().map(|part| part.as_os_str().to_string_lossy().into_owned()).collect();
    Some(Member { archive: archive.to_owned(), name: parts.join("/") })
}

/// Returns the names of the files of the archive `path`. `Err` holds the reason why the archive
/// cannot be read.
#[cfg(feature = "archives")]
pub(crate) fn members(path: &Path, access: &FileAccess) -> Result<Vec<String>, String> {
    let mut archive = open(path, access)?;
    let mut names = Vec::new();
    for index in 0..archive.len() {
        let member = archive.by_index_raw(index).map_err(|error| error.to_string())?;
        let name = decode_name(member.name_raw());
        let is_hidden = name
            .split('/')
            .any(|part| part.starts_with('.') || part.starts_with("~$") || part == "__MACOSX");
        if member.is_file() && !name.starts_with('/') && !is_hidden {
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

/// Reads the `member` of an archive, of at most `most` bytes. `Err` holds the reason why the member
/// cannot be read.
#[cfg(feature = "archives")]
pub(crate) fn read(member: &Member, most: u64, access: &FileAccess) -> Result<Vec<u8>, String> {
    use std::io::Read;

    let Member { archive: path, name } = member;
    let mut archive = open(path, access)?;
    let index = (0..archive.len()).find(|&index| {
        archive.by_index_raw(index).is_ok_and(|member| decode_name(member.name_raw()) == *name)
    });
    let index = index.ok_or_else(|| format!("there is no {name} in it"))?;

    let member = archive.by_index(index).map_err(|error| error.to_string())?;
    let mut bytes = Vec::new();
    // The size that the archive states may be wrong, so the extracted bytes are counted.
    member.take(most + 1).read_to_end(&mut bytes).map_err(|error| error.to_string())?;
    if bytes.len() as u64 > most {
        return Err(format!("{name} is larger than the {most} bytes that a table may have"));
    }
    Ok(bytes)
}

#[cfg(feature = "archives")]
type Archive<'a> = zip::ZipArchive<Box<dyn Content + 'a>>;

/// Content of an archive, on disk or in memory.
#[cfg(feature = "archives")]
trait Content: std::io::Read + std::io::Seek {}

#[cfg(feature = "archives")]
impl<T: std::io::Read + std::io::Seek> Content for T {}

/// Opens the archive `path`.
#[cfg(feature = "archives")]
fn open<'a>(path: &Path, access: &'a FileAccess) -> Result<Archive<'a>, String> {
    let content: Box<dyn Content + 'a> = match access.held(path) {
        Some(bytes) => Box::new(std::io::Cursor::new(bytes)),
        None => {
            let file = std::fs::File::open(path).map_err(|error| error.to_string())?;
            Box::new(std::io::BufReader::new(file))
        }
    };
    zip::ZipArchive::new(content).map_err(|error| error.to_string())
}

/// Returns a `name` of the archive as text. Older programs write names in the encoding of their
/// country.
#[cfg(feature = "archives")]
fn decode_name(name: &[u8]) -> String {
    let text = crate::tables::encoding::decode(name, None);
    let text = text.map_or_else(|_| String::from_utf8_lossy(name).into_owned(), |name| name.text);
    text.replace('\\', "/")
}

/// Reads nothing: the crate was built without its feature `archives`.
#[cfg(not(feature = "archives"))]
pub(crate) fn members(_: &Path, _: &FileAccess) -> Result<Vec<String>, String> {
    Err("this program was built without the feature `archives`".to_owned())
}

/// Reads nothing: the crate was built without its feature `archives`.
#[cfg(not(feature = "archives"))]
pub(crate) fn read(_: &Member, _: u64, _: &FileAccess) -> Result<Vec<u8>, String> {
    Err("this program was built without the feature `archives`".to_owned())
}
