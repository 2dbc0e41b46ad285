//! Checkpoint: named sections and their bytes.

use std::io::{self, Write};

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::error::{Damage, Error};
use crate::identity::Identity;

/// First bytes of every checkpoint.
const MAGIC: &[u8; 8] = b"DRAPECKP";

/// Version of the format.
const VERSION: u32 = 1;

/// Name of the section of the identity, which is the first.
const IDENTITY: &str = "identity";

/// Length of a checksum, in bytes.
const CHECKSUM: usize = 32;

/// Saved state of a computation: an identity and named sections.
#[derive(Debug, Clone, PartialEq)]
pub struct Checkpoint {
    identity: Identity,
    sections: Vec<Section>,
}

/// Name of a value and the encoded bytes of the value.
#[derive(Debug, Clone, PartialEq)]
struct Section {
    name: String,
    content: Vec<u8>,
}

/// Bytes of a file that have not been read yet.
struct Unread<'a>(&'a [u8]);

impl<'a> Unread<'a> {
    /// Removes the next `count` bytes and returns them.
    fn take(&mut self, count: usize) -> Result<&'a [u8], Damage> {
        let (taken, remaining) = self.0.split_at_checked(count).ok_or(Damage::Length)?;
        self.0 = remaining;
        Ok(taken)
    }

    /// Removes the next `N` bytes and returns them.
    fn take_array<const N: usize>(&mut self) -> Result<[u8; N], Damage> {
        self.take(N)?.try_into().map_err(|_| Damage::Length)
    }
}

impl Checkpoint {
    /// Creates a checkpoint with the given `identity` and without sections.
    #[must_use]
    pub fn new(identity: Identity) -> Self {
        Self { identity, sections: Vec::new() }
    }

    /// Returns the [`Identity`] of the program that wrote the checkpoint.
    #[must_use]
    pub fn identity(&self) -> &Identity {
        &self.identity
    }

    /// Adds a section with the given `name` and `value`. A section of that name is replaced.
    ///
    /// # Errors
    /// [`Error::Encode`] if serde cannot write `value`, or if `name` has more than 65 535 bytes.
    pub fn put<T: Serialize + ?Sized>(&mut self, name: &str, value: &T) -> Result<(), Error> {
        let content = u16::try_from(name.len())
            .map_err(|error| error.to_string())
            .and_then(|_| postcard::to_stdvec(value).map_err(|error| error.to_string()))
            .map_err(|reason| Error::Encode { section: name.into(), reason })?;
        self.sections.retain(|section| section.name != name);
        self.sections.push(Section { name: name.into(), content });
        Ok(())
    }

    /// Returns the value of the section `name`.
    ///
    /// # Errors
    /// [`Error::Section`] if the section is missing, or if its content is not exactly one value of
    /// type `T`.
    pub fn get<T: DeserializeOwned>(&self, name: &str) -> Result<T, Error> {
        let section = self.sections.iter().find(|section| section.name == name);
        section
            .ok_or_else(|| "it is missing".to_owned())
            .and_then(Section::value)
            .map_err(|reason| Error::Section { section: name.into(), reason })
    }

    /// Writes the bytes of the checkpoint to `writer`.
    ///
    /// # Errors
    /// An error of `writer`, or of the encoding of the identity.
    pub fn encode(&self, writer: &mut dyn Write) -> io::Result<()> {
        let identity = postcard::to_stdvec(&self.identity).map_err(io::Error::other)?;
        let mut file = HashingWriter { writer, hasher: blake3::Hasher::new() };
        let count = u32::try_from(self.sections.len() + 1).map_err(io::Error::other)?;
        file.write(MAGIC)?;
        file.write(&VERSION.to_le_bytes())?;
        file.write(&count.to_le_bytes())?;

        // The identity comes first, so that a reader knows the program before it reads a value.
        file.write_section(IDENTITY, &identity)?;
        for Section { name, content } in &self.sections {
            file.write_section(name, content)?;
        }

        let checksum = file.hasher.finalize();
        file.writer.write_all(checksum.as_bytes())
    }

    /// Returns the checkpoint in `bytes`, the content of a file.
    ///
    /// # Errors
    /// [`Damage`] if any byte differs from the bytes that [`Checkpoint::encode`] wrote.
    pub fn decode(bytes: &[u8]) -> Result<Self, Damage> {
        let mut unread = Unread(bytes);
        if unread.take(MAGIC.len()).is_ok_and(|magic| magic != MAGIC) {
            return Err(Damage::Magic);
        }
        let version = u32::from_le_bytes(unread.take_array()?);
        if version != VERSION {
            return Err(Damage::Version { found: version, known: VERSION });
        }

        let count = u32::from_le_bytes(unread.take_array()?);
        let mut sections = Vec::new();
        for number in 0..count as usize {
            sections.push(take_section(&mut unread, number)?);
        }

        // Checksums of sections do not cover the header, the checksum of the file does.
        let covered = bytes.len() - unread.0.len();
        let checksum = unread.take(CHECKSUM)?;
        if !unread.0.is_empty() {
            return Err(Damage::Length);
        }
        if blake3::hash(&bytes[..covered]).as_bytes() != checksum {
            return Err(Damage::Whole);
        }

        let first = (!sections.is_empty()).then(|| sections.remove(0));
        let header = first.filter(|first| first.name == IDENTITY).ok_or(Damage::Whole)?;
        let identity = header.value().map_err(|_| Damage::Whole)?;
        Ok(Self { identity, sections })
    }
}

impl Section {
    /// Returns the value of the section.
    ///
    /// # Errors
    /// The reason, in words, why the content is not exactly one value of type `T`.
    fn value<T: DeserializeOwned>(&self) -> Result<T, String> {
        let (value, remaining) =
            postcard::take_from_bytes(&self.content).map_err(|error| error.to_string())?;
        if remaining.is_empty() { Ok(value) } else { Err("it is longer than its value".into()) }
    }
}

/// Writer that computes the checksum of a file.
struct HashingWriter<'a> {
    writer: &'a mut dyn Write,
    hasher: blake3::Hasher,
}

impl HashingWriter<'_> {
    /// Writes `bytes` and adds them to the checksum of the file.
    fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.hasher.update(bytes);
        self.writer.write_all(bytes)
    }

    /// Writes the section `name` with the given `content` and the checksum of the section.
    fn write_section(&mut self, name: &str, content: &[u8]) -> io::Result<()> {
        let name_length = u16::try_from(name.len()).map_err(io::Error::other)?.to_le_bytes();
        let content_length = (content.len() as u64).to_le_bytes();
        let mut section_hasher = blake3::Hasher::new();
        for bytes in [&name_length[..], name.as_bytes(), &content_length, content] {
            section_hasher.update(bytes);
            self.write(bytes)?;
        }
        self.write(section_hasher.finalize().as_bytes())
    }
}

/// Removes section `number` from `unread`, verifies its checksum and returns it.
fn take_section(unread: &mut Unread<'_>, number: usize) -> Result<Section, Damage> {
    let start = unread.0;
    let name_length = u16::from_le_bytes(unread.take_array()?);
    let name = unread.take(name_length.into())?;
    let content_length = u64::from_le_bytes(unread.take_array()?);
    let content = unread.take(usize::try_from(content_length).map_err(|_| Damage::Length)?)?;
    let covered = start.len() - unread.0.len();
    let checksum = unread.take(CHECKSUM)?;
    if blake3::hash(&start[..covered]).as_bytes() != checksum {
        return Err(Damage::Section { number });
    }
    let name = String::from_utf8(name.to_vec()).map_err(|_| Damage::Section { number })?;
    Ok(Section { name, content: content.to_vec() })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn example() -> Checkpoint {
        let identity = Identity::new("example 1").with("scene", b"cube");
        let mut checkpoint = Checkpoint::new(identity);
        let numbers = [0.1, f64::NAN, -0.0, f64::INFINITY, 1e-300];
        checkpoint.put("numbers", &numbers[..]).expect("it is encoded");
        checkpoint.put("words", &("a", 7_u64, Some([1_u32, 2]))).expect("it is encoded");
        checkpoint
    }

    fn bytes() -> Vec<u8> {
        let mut bytes = Vec::new();
        example().encode(&mut bytes).expect("memory can be written");
        bytes
    }

    #[test]
    fn what_was_written_is_read_to_the_last_bit() {
        let read = Checkpoint::decode(&bytes()).expect("it is intact");
        assert_eq!(read, example());
        let numbers: Vec<f64> = read.get("numbers").expect("a section");
        let bits: Vec<u64> = numbers.iter().map(|x| x.to_bits()).collect();
        let expected = [0.1, f64::NAN, -0.0, f64::INFINITY, 1e-300].map(f64::to_bits);
        assert_eq!(bits, expected);
        let words: (String, u64, Option<[u32; 2]>) = read.get("words").expect("a section");
        assert_eq!(words, ("a".into(), 7, Some([1, 2])));
        assert!(read.get::<String>("words").is_err(), "the rest of a section is no other value");
    }

    #[test]
    fn every_flipped_bit_and_every_truncation_is_seen() {
        let whole = bytes();
        for bit in 0..8 * whole.len() {
            let mut flipped = whole.clone();
            flipped[bit / 8] ^= 1 << (bit % 8);
            assert!(Checkpoint::decode(&flipped).is_err(), "bit {bit} was not missed");
        }
        for length in 0..whole.len() {
            let cut = Checkpoint::decode(&whole[..length]);
            assert!(cut.is_err(), "{length} bytes of {} pass", whole.len());
        }
        let mut longer = whole;
        longer.push(0);
        assert_eq!(Checkpoint::decode(&longer), Err(Damage::Length));
    }

    #[test]
    fn a_header_tells_what_a_file_is_not() {
        assert_eq!(Checkpoint::decode(b"solid cube\nfacet normal 0 0 1"), Err(Damage::Magic));
        let mut later = bytes();
        later[8] = 2;
        assert_eq!(Checkpoint::decode(&later), Err(Damage::Version { found: 2, known: 1 }));
    }

    #[test]
    fn lengths_that_no_memory_holds_are_refused() {
        // The content of the first section is said to have 2⁶⁴ − 1 bytes.
        let mut huge = bytes();
        let at = 16 + 2 + IDENTITY.len();
        huge[at..at + 8].fill(0xff);
        assert_eq!(Checkpoint::decode(&huge), Err(Damage::Length));
        // More sections than the file has are said to follow.
        let mut many = bytes();
        many[12..16].fill(0xff);
        assert!(Checkpoint::decode(&many).is_err());
    }

    #[test]
    fn a_section_of_another_type_is_refused() {
        let checkpoint = example();
        let missing = checkpoint.get::<f64>("velocities").expect_err("it is missing");
        assert!(missing.to_string().contains("velocities"), "{missing}");
        assert!(checkpoint.get::<(u8, u8)>("numbers").is_err(), "numbers go on");
        assert!(checkpoint.get::<[Vec<f64>; 9]>("words").is_err());
    }
}
