//! Archive: the subset of zip that U3M requires. Libraries for zip files do not write this subset.
//!
//! Names are marked as UTF-8 even if they are ASCII, times are UTC, and attributes, extra fields
//! and comments are absent \[Viz22\].

use std::io::Write;

use chrono::{DateTime, Datelike, Timelike, Utc};
use flate2::write::DeflateEncoder;
use flate2::{Compression, Crc};

/// Version of the format that a reader must support: 2.0, for deflate.
const VERSION_NEEDED: u16 = 0x14;

/// Version of the writer, 6.3, with file system 0.
const VERSION_MADE_BY: u16 = 0x3f;

/// Flags: names are UTF-8.
const FLAGS: u16 = 1 << 11;

/// Method: deflate.
const DEFLATE: u16 = 8;

/// Returns an archive of `files`, pairs of name and bytes, with the modification time `time`.
pub(super) fn write(files: &[(&str, &[u8])], time: DateTime<Utc>) -> Vec<u8> {
    let (mut archive, mut directory) = (Vec::new(), Vec::new());
    for (name, bytes) in files {
        let offset = archive.len();
        let compressed = deflated(bytes);
        let description = description(name, bytes, &compressed, time);

        // The file, and its entry in the directory.
        archive.extend(b"PK\x03\x04");
        archive.extend(&description);
        archive.extend(name.as_bytes());
        archive.extend(&compressed);
        directory.extend(b"PK\x01\x02");
        directory.extend(VERSION_MADE_BY.to_le_bytes());
        directory.extend(&description);
        // No comment, the first disk, no attributes: 2, 2, 2 and 4 bytes.
        directory.extend([0; 10]);
        directory.extend(length(offset).to_le_bytes());
        directory.extend(name.as_bytes());
    }

    // The end record contains the position of the directory.
    let count = u16::try_from(files.len()).expect("a material has few files").to_le_bytes();
    let (start, size) = (length(archive.len()), length(directory.len()));
    archive.extend(directory);
    archive.extend(b"PK\x05\x06\0\0\0\0");
    archive.extend(count);
    archive.extend(count);
    archive.extend(size.to_le_bytes());
    archive.extend(start.to_le_bytes());
    archive.extend([0; 2]);
    archive
}

/// Returns the fields that the headers of file and directory have in common: version, flags,
/// method, `time`, checksum and sizes of `bytes` and `compressed`, and length of `name`.
fn description(name: &str, bytes: &[u8], compressed: &[u8], time: DateTime<Utc>) -> Vec<u8> {
    let mut crc = Crc::new();
    crc.update(bytes);
    let name = u16::try_from(name.len()).expect("names are short");
    let (clock, day) = dos_time(time);
    let halves = [VERSION_NEEDED, FLAGS, DEFLATE, clock, day].map(u16::to_le_bytes);
    let words = [crc.sum(), length(compressed.len()), length(bytes.len())].map(u32::to_le_bytes);
    let tail = [name, 0].map(u16::to_le_bytes);
    [halves.concat(), words.concat(), tail.concat()].concat()
}

/// Returns the length `bytes` as a field of an archive.
fn length(bytes: usize) -> u32 {
    u32::try_from(bytes).expect("a fabric is far below 4 GiB")
}

/// Returns `bytes` compressed by deflate.
fn deflated(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = DeflateEncoder::new(Vec::new(), Compression::default());
    let result = encoder.write_all(bytes).and_then(|()| encoder.finish());
    result.expect("writing to memory does not fail")
}

/// Returns the clock and the day of `time` in the format of MS-DOS, from 1980 to 2107 in steps of
/// two seconds. Any other time becomes the first day.
fn dos_time(time: DateTime<Utc>) -> (u16, u16) {
    let years = u16::try_from(time.year() - 1980);
    let Ok(years @ 0..=127) = years else {
        let first_day = 1 << 5 | 1;
        return (0, first_day);
    };
    let fields = [time.hour(), time.minute(), time.second() / 2, time.month(), time.day()];
    let [hour, minute, double_second, month, day] =
        fields.map(|field| u16::try_from(field).expect("a field of a date is below 60"));
    (hour << 11 | minute << 5 | double_second, years << 9 | month << 5 | day)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_time_beyond_the_calendar_of_the_format_is_its_first_day() {
        let at = |text: &str| dos_time(text.parse().expect("a time"));
        assert_eq!(at("1970-01-01T00:00:00Z"), (0, 0x21));
        assert_eq!(at("2108-01-01T00:00:00Z"), (0, 0x21));
        // 13:45:58 is 13, 45, 29; 2026-03-09 is 46, 3, 9.
        assert_eq!(at("2026-03-09T13:45:58Z"), (13 << 11 | 45 << 5 | 29, 46 << 9 | 3 << 5 | 9));
    }
}
