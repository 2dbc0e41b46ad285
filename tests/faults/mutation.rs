//! Mutations of bytes, from seeds.

/// Words that readers of numbers and counts stumble over.
const WORDS: [&[u8]; 22] = [
    b"nan",
    b"inf",
    b"-inf",
    b"-0",
    b"-1",
    b"0",
    b"1e308",
    b"1e-300",
    b"5e-324",
    b"1e999",
    b"4294967295",
    b"18446744073709551615",
    b"9223372036854775807",
    b"99999999999999999999",
    b"\0",
    b"\xff\xff\xff\xff",
    b"\xff\xff\xff\x7f",
    b"\"",
    b"[",
    b"]]",
    b"\n",
    b"\xef\xbb\xbf",
];

/// Random numbers: splitmix64.
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Returns a number below another, which is above 0.
    pub fn below(&mut self, end: usize) -> usize {
        (self.next() % end.max(1) as u64) as usize
    }
}

/// Returns bytes with one to four mutations.
pub fn mutated(bytes: &[u8], seed: u64) -> Vec<u8> {
    let mut random = Random(seed);
    let mut bytes = bytes.to_vec();
    for _ in 0..=random.below(4) {
        let at = random.below(bytes.len());
        let end = (at + 1 + random.below(12)).min(bytes.len());
        match random.below(6) {
            0 if !bytes.is_empty() => bytes[at] ^= 1 << random.below(8),
            1 if !bytes.is_empty() => bytes[at] = random.next() as u8,
            2 => drop(bytes.drain(at.min(end)..end)),
            3 => {
                let copied = bytes[at.min(end)..end].to_vec();
                let to = random.below(bytes.len());
                bytes.splice(to..to, copied);
            }
            4 => {
                let word = WORDS[random.below(WORDS.len())];
                let end = (at + word.len()).min(bytes.len());
                bytes.splice(at.min(end)..end, word.iter().copied());
            }
            _ => number(&mut bytes, at, &mut random),
        }
    }
    bytes
}

/// Replaces the next number of a text by a word.
fn number(bytes: &mut Vec<u8>, at: usize, random: &mut Random) {
    let is_part = |byte: &u8| byte.is_ascii_digit() || matches!(byte, b'.' | b'-' | b'+' | b'e');
    let Some(start) = bytes[at.min(bytes.len())..].iter().position(u8::is_ascii_digit) else {
        return;
    };
    let start = at + start;
    let length = bytes[start..].iter().take_while(|byte| is_part(byte)).count();
    let word = WORDS[random.below(14)];
    bytes.splice(start..start + length, word.iter().copied());
}

/// Returns the lengths at which a file is cut off: all below 4 kB, and so many above.
pub fn cuts(bytes: usize, above: usize) -> Vec<usize> {
    let small = bytes.min(4096);
    let step = ((bytes - small) / above.max(1)).max(1);
    (0..small).chain((small..bytes).step_by(step)).collect()
}
