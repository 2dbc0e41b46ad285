//! Archive: the subset of zip that U3M requires, which writers of zip files do not write.
//!
//! Names are marked as UTF-8 even where they are ASCII, times are UTC, and attributes, extra fields
//! and comments are left out \[Viz22\].

use std::io::Write;

use chrono::{DateTime, Datelike, Timelike, Utc};
use flate2::write::DeflateEncoder;
use flate2::{Compression, Crc};

/// Version of the format that a reader needs: 2.0, deflate.
const VERSION_NEEDED: u16 = 0x14;

/// Version of the writer, and its file system: 6.3, none.
const VERSION_MADE_BY: u16 = 0x3f;

/// Flags: names are UTF-8.
const FLAGS: u16 = 1 << 11;

/// Method: deflate.
const DEFLATE: u16 = 8;

/// Returns an archive of files, by name and bytes, with one time for all.
pub(super) fn write(files: &[(&str, &[u8])], time: DateTime<Utc>) -> Vec<u8> {
    let (mut archive, mut directory) = (Vec::new(), Vec::new());
    for (name, bytes) in files {
        let offset = archive.len();
        let compressed = deflated(bytes);
        let description = description(name, bytes, &compressed, time);

        // The file, and its place in the directory.
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

    // The end, which says where the directory is.
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

/// Returns what file and directory say alike: version, flags, method, time, sizes, length of the name.
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

/// Returns a length in an archive, of a few kilobytes.
fn length(bytes: usize) -> u32 {
    u32::try_from(bytes).expect("a fabric is far below 4 GiB")
}

fn deflated(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = DeflateEncoder::new(Vec::new(), Compression::default());
    let written = encoder.write_all(bytes).and_then(|()| encoder.finish());
    written.expect("writing to memory does not fail")
}

/// Returns time and date as MS-DOS counts them, from 1980 to 2107 in steps of two seconds.
fn dos_time(time: DateTime<Utc>) -> (u16, u16) {
    let years = u16::try_from(time.year() - 1980);
    let Ok(years @ 0..=127) = years else {
        let first_day = 1 << 5 | 1;
        return (0, first_day);
    };
    let part = |value: u32| u16::try_from(value).expect("a part of a date is below 60");
    let clock = part(time.hour()) << 11 | part(time.minute()) << 5 | part(time.second() / 2);
    (clock, years << 9 | part(time.month()) << 5 | part(time.day()))
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
