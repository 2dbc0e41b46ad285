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

/// State of a computation: an identity and named sections.
#[derive(Debug, Clone, PartialEq)]
pub struct Checkpoint {
    identity: Identity,
    sections: Vec<Section>,
}

/// Section: the name of a value and its encoded bytes.
#[derive(Debug, Clone, PartialEq)]
struct Section {
    name: String,
    content: Vec<u8>,
}

/// Bytes that are left of a file.
struct Rest<'a>(&'a [u8]);

impl<'a> Rest<'a> {
    /// Takes a number of bytes.
    fn take(&mut self, count: usize) -> Result<&'a [u8], Damage> {
        let (taken, rest) = self.0.split_at_checked(count).ok_or(Damage::Length)?;
        self.0 = rest;
        Ok(taken)
    }

    /// Takes a number of bytes that is known to the compiler.
    fn array<const N: usize>(&mut self) -> Result<[u8; N], Damage> {
        self.take(N)?.try_into().map_err(|_| Damage::Length)
    }
}

impl Checkpoint {
    /// Makes a checkpoint without sections.
    #[must_use]
    pub fn new(identity: Identity) -> Self {
        Self { identity, sections: Vec::new() }
    }

    /// Identity of what wrote it.
    #[must_use]
    pub fn identity(&self) -> &Identity {
        &self.identity
    }

    /// Adds a section, or replaces that of the same name.
    ///
    /// # Errors
    /// A value that serde cannot write, or a name of more than 65 535 bytes.
    pub fn put<T: Serialize + ?Sized>(&mut self, name: &str, value: &T) -> Result<(), Error> {
        let fail = |reason: String| Error::Encode { section: name.into(), reason };
        u16::try_from(name.len()).map_err(|error| fail(error.to_string()))?;
        let content = postcard::to_stdvec(value).map_err(|error| fail(error.to_string()))?;
        self.sections.retain(|section| section.name != name);
        self.sections.push(Section { name: name.into(), content });
        Ok(())
    }

    /// Returns the value of a section.
    ///
    /// # Errors
    /// The section is missing, or is no value of this type and nothing else.
    pub fn get<T: DeserializeOwned>(&self, name: &str) -> Result<T, Error> {
        let fail = |reason: &str| Error::Section { section: name.into(), reason: reason.into() };
        let section = self.sections.iter().find(|section| section.name == name);
        let section = section.ok_or_else(|| fail("it is missing"))?;
        section.value().map_err(|reason| fail(&reason))
    }

    /// Writes the bytes of a file.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn encode(&self, to: &mut dyn Write) -> io::Result<()> {
        let identity = postcard::to_stdvec(&self.identity).map_err(io::Error::other)?;
        let mut whole = blake3::Hasher::new();
        let mut put = |bytes: &[u8]| {
            whole.update(bytes);
            to.write_all(bytes)
        };
        let count = u32::try_from(self.sections.len() + 1).map_err(io::Error::other)?;
        put(MAGIC)?;
        put(&VERSION.to_le_bytes())?;
        put(&count.to_le_bytes())?;
        let own = self.sections.iter().map(|own| (own.name.as_str(), own.content.as_slice()));
        for (name, content) in [(IDENTITY, identity.as_slice())].into_iter().chain(own) {
            let length = u16::try_from(name.len()).map_err(io::Error::other)?.to_le_bytes();
            let content_length = (content.len() as u64).to_le_bytes();
            let mut checksum = blake3::Hasher::new();
            for bytes in [&length[..], name.as_bytes(), &content_length, content] {
                checksum.update(bytes);
                put(bytes)?;
            }
            put(checksum.finalize().as_bytes())?;
        }
        to.write_all(whole.finalize().as_bytes())
    }

    /// Returns the checkpoint of the bytes of a file.
    ///
    /// # Errors
    /// What is wrong with them: nothing is returned unless every byte is as it was written.
    pub fn decode(bytes: &[u8]) -> Result<Self, Damage> {
        let mut rest = Rest(bytes);
        if rest.take(MAGIC.len()).is_ok_and(|magic| magic != MAGIC) {
            return Err(Damage::Magic);
        }
        let version = u32::from_le_bytes(rest.array()?);
        if version != VERSION {
            return Err(Damage::Version { found: version, known: VERSION });
        }
        let count = u32::from_le_bytes(rest.array()?);
        let mut sections = Vec::new();
        for number in 0..count as usize {
            sections.push(take_section(&mut rest, number)?);
        }
        let covered = bytes.len() - rest.0.len();
        let whole = rest.take(CHECKSUM)?;
        if !rest.0.is_empty() {
            return Err(Damage::Length);
        }
        if blake3::hash(&bytes[..covered]).as_bytes() != whole {
            return Err(Damage::Whole);
        }
        let first = (!sections.is_empty()).then(|| sections.remove(0));
        let header = first.filter(|first| first.name == IDENTITY).ok_or(Damage::Whole)?;
        let identity = header.value();
        Ok(Self { identity: identity.map_err(|_| Damage::Whole)?, sections })
    }
}

impl Section {
    /// Value of the section, or why its content is no value of this type and nothing else.
    fn value<T: DeserializeOwned>(&self) -> Result<T, String> {
        let (value, rest) =
            postcard::take_from_bytes(&self.content).map_err(|error| error.to_string())?;
        if rest.is_empty() { Ok(value) } else { Err("it is longer than its value".into()) }
    }
}

/// Reads the next section and verifies its checksum.
fn take_section(rest: &mut Rest<'_>, number: usize) -> Result<Section, Damage> {
    let start = rest.0;
    let length = u16::from_le_bytes(rest.array()?);
    let name = rest.take(length.into())?;
    let length = u64::from_le_bytes(rest.array()?);
    let content = rest.take(usize::try_from(length).map_err(|_| Damage::Length)?)?;
    let covered = start.len() - rest.0.len();
    let checksum = rest.take(CHECKSUM)?;
    let fault = || Damage::Section { number };
    if blake3::hash(&start[..covered]).as_bytes() != checksum {
        return Err(fault());
    }
    let name = String::from_utf8(name.to_vec()).map_err(|_| fault())?;
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
        // So many sections are said to follow.
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
