//! Characters of a text file: its bytes made into text, by the encoding that they are in.

use chardetng::{EncodingDetector, Iso2022JpDetection, Utf8Detection};
use encoding_rs::{
    BIG5, EUC_JP, EUC_KR, Encoding, GB18030, GBK, SHIFT_JIS, UTF_8, UTF_16BE, UTF_16LE,
    WINDOWS_1250, WINDOWS_1251, WINDOWS_1252, WINDOWS_1253, WINDOWS_1254,
};

use crate::tables::heading;

/// Encodings of files that are not Unicode: those whose characters are letters of the words of
/// tables are taken.
const CANDIDATES: [&Encoding; 10] = [
    WINDOWS_1252,
    SHIFT_JIS,
    GBK,
    BIG5,
    EUC_JP,
    EUC_KR,
    WINDOWS_1254,
    WINDOWS_1250,
    WINDOWS_1251,
    WINDOWS_1253,
];

/// Share of zero bytes at even or odd places from which on a text is UTF-16 without a mark.
///
/// Tables are mostly digits, whose high bytes are zero; in other encodings there is no zero byte.
const ZEROS_OF_UTF_16: f64 = 0.3;

/// Text of a file, with its encoding and the reason why it was taken.
#[derive(Clone, Debug)]
pub(crate) struct Decoded {
    pub(crate) text: String,
    /// Encoding, in words for the reading; empty for plain ASCII.
    pub(crate) reading: String,
    /// Encoding; `None` for plain ASCII.
    pub(crate) encoding: Option<&'static Encoding>,
}

/// Returns the encoding of a label, such as `Shift_JIS`.
pub(crate) fn by_label(label: &str) -> Option<&'static Encoding> {
    let known = match label.trim().to_lowercase().as_str() {
        "cp932" | "windows-932" | "ms932" => "shift_jis",
        "cp1252" | "ansi" => "windows-1252",
        "utf16" | "utf-16" => "utf-16le",
        "utf8" => "utf-8",
        "cp936" | "ms936" | "gb" => "gbk",
        "cp1254" => "windows-1254",
        _ => label.trim(),
    };
    Encoding::for_label(known.as_bytes())
}

/// Decodes the bytes of a file; `Err` holds the place of the first byte that is not of the
/// encoding.
pub(crate) fn decode(bytes: &[u8], declared: Option<&'static Encoding>) -> Result<Decoded, usize> {
    if let Some(encoding) = declared {
        // A byte-order mark stands above a declaration only where both are of one family.
        let (marked, mark) = Encoding::for_bom(bytes).unwrap_or((encoding, 0));
        let rest = if marked == encoding { &bytes[mark..] } else { bytes };
        return strict(encoding, rest)
            .map(|text| Decoded {
                text,
                reading: format!("{} as declared", encoding.name()),
                encoding: Some(encoding),
            })
            .ok_or_else(|| first_error(encoding, rest));
    }
    let taken = |encoding: &'static Encoding, bytes: &[u8], why: &str| {
        let (text, _) = encoding.decode_without_bom_handling(bytes);
        let is_plain = why.is_empty();
        let why = if is_plain { String::new() } else { format!("{} ({why})", encoding.name()) };
        let encoding = (!is_plain).then_some(encoding);
        Ok(Decoded { text: text.into_owned(), reading: why, encoding })
    };
    if let Some((encoding, mark)) = Encoding::for_bom(bytes) {
        return taken(encoding, &bytes[mark..], "by its byte-order mark");
    }
    if let Some(encoding) = unmarked_utf_16(bytes) {
        return taken(encoding, bytes, "every other byte is zero");
    }
    if bytes.is_ascii() {
        return taken(UTF_8, bytes, "");
    }
    if std::str::from_utf8(bytes).is_ok() {
        return taken(UTF_8, bytes, "valid as such");
    }
    let sample = lines_beyond_ascii(bytes);
    if let Some(encoding) = by_words(&sample) {
        return taken(encoding, bytes, "not UTF-8, and its characters are words of tables");
    }
    if is_japanese(&sample) {
        return taken(SHIFT_JIS, bytes, "not UTF-8, and its characters are Japanese words");
    }
    let mut detector = EncodingDetector::new(Iso2022JpDetection::Deny);
    detector.feed(&sample, true);
    let guess = detector.guess(None, Utf8Detection::Deny);
    let is_wide = [GBK, GB18030, BIG5, EUC_JP, EUC_KR].contains(&guess);
    if is_wide && strict(guess, &sample).is_some_and(|text| is_of_words(&text)) {
        return taken(guess, bytes, "not UTF-8, and its characters are East Asian words");
    }
    taken(WINDOWS_1252, bytes, "not UTF-8, no East Asian words")
}

/// Bytes by which an encoding is told, at most: the words of a table are few.
const SAMPLE_MAX: usize = 1 << 16;

/// Returns the first lines that have characters beyond ASCII. No encoding has the end of a line
/// within a character.
fn lines_beyond_ascii(bytes: &[u8]) -> Vec<u8> {
    let lines = bytes.split_inclusive(|&byte| byte == b'\n').filter(|line| !line.is_ascii());
    let mut sample = Vec::new();
    for line in lines {
        if sample.len() + line.len() > SAMPLE_MAX && !sample.is_empty() {
            break;
        }
        sample.extend_from_slice(line);
    }
    sample
}

/// Returns the encoding in which a text has most letters of known words beyond ASCII; `None` where
/// it has none in any.
fn by_words(bytes: &[u8]) -> Option<&'static Encoding> {
    let scores = CANDIDATES
        .map(|encoding| strict(encoding, bytes).map_or(0, |text| heading::known_letters(&text)));
    let most = *scores.iter().max()?;
    let first = scores.iter().position(|score| *score == most)?;
    (most > 0).then_some(CANDIDATES[first])
}

fn strict(encoding: &'static Encoding, bytes: &[u8]) -> Option<String> {
    encoding
        .decode_without_bom_handling_and_without_replacement(bytes)
        .map(|text| text.into_owned())
}

/// Returns the place of the first byte that an encoding does not have.
fn first_error(encoding: &'static Encoding, bytes: &[u8]) -> usize {
    // The longest good start, by halves: a start that ends within a character is bad by a few bytes
    // only, which does not matter for a line number.
    let (mut good, mut bad) = (0, bytes.len());
    while bad - good > 1 {
        let middle = good.midpoint(bad);
        let whole = (0..4)
            .any(|cut| middle >= cut + good && strict(encoding, &bytes[..middle - cut]).is_some());
        if whole { good = middle } else { bad = middle }
    }
    good
}

fn unmarked_utf_16(bytes: &[u8]) -> Option<&'static Encoding> {
    let share = |odd: usize| {
        let zeros = bytes.iter().skip(odd).step_by(2).filter(|&&byte| byte == 0).count();
        zeros as f64 / (bytes.len() / 2).max(1) as f64
    };
    if share(1) > ZEROS_OF_UTF_16 && share(0) == 0.0 {
        Some(UTF_16LE)
    } else if share(0) > ZEROS_OF_UTF_16 && share(1) == 0.0 {
        Some(UTF_16BE)
    } else {
        None
    }
}

/// Returns whether bytes are Shift_JIS: two-byte characters that stand side by side.
///
/// A Western letter followed by another is a valid two-byte character too, but it stands alone
/// among the letters of its word.
fn is_japanese(bytes: &[u8]) -> bool {
    strict(SHIFT_JIS, bytes).is_some_and(|text| is_of_words(&text))
}

/// Returns whether most East Asian letters of a text stand side by side.
fn is_of_words(text: &str) -> bool {
    let wide = |letter: char| matches!(letter, '\u{3000}'..='\u{30ff}' | '\u{4e00}'..='\u{9fff}' | '\u{ff01}'..='\u{ff5e}');
    let letters: Vec<char> = text.chars().collect();
    let (mut together, mut alone) = (0, 0);
    for run in letters.split(|&letter| !wide(letter)).filter(|run| !run.is_empty()) {
        if run.len() > 1 { together += run.len() } else { alone += 1 }
    }
    together > alone
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: &str = "伸び(mm),荷重(N)\n0,0\n1,2\n";

    #[test]
    fn every_encoding_of_the_instruments_gives_the_same_text() {
        let utf_16 = |little: bool, mark: bool| -> Vec<u8> {
            let text = if mark { format!("\u{feff}{HEADER}") } else { HEADER.to_owned() };
            let bytes = |unit: u16| if little { unit.to_le_bytes() } else { unit.to_be_bytes() };
            text.encode_utf16().flat_map(bytes).collect()
        };
        let files = [
            (HEADER.as_bytes().to_vec(), "UTF-8"),
            (format!("\u{feff}{HEADER}").into_bytes(), "UTF-8"),
            (utf_16(true, true), "UTF-16LE"),
            (utf_16(false, true), "UTF-16BE"),
            (utf_16(true, false), "UTF-16LE"),
            (SHIFT_JIS.encode(HEADER).0.into_owned(), "Shift_JIS"),
        ];
        for (bytes, encoding) in files {
            let decoded = decode(&bytes, None).expect("it is detected");
            assert_eq!(decoded.text, HEADER, "{encoding}");
            assert!(decoded.reading.starts_with(encoding), "{}", decoded.reading);
        }
        assert_eq!(decode(b"a,b\n", None).expect("plain").reading, "");
    }

    #[test]
    fn western_words_are_not_taken_for_japanese() {
        for text in ["Déformation;Force (N)", "Prüfzeit;Standardkraft", "Winkel in °", "µm;é"]
        {
            let bytes = WINDOWS_1252.encode(text).0;
            let decoded = decode(&bytes, None).expect("it is detected");
            assert_eq!(decoded.text, text, "{}", decoded.reading);
        }
    }

    #[test]
    fn encodings_of_other_countries_are_known_by_the_words_of_tables() {
        let cases = [
            (GBK, "项目,经向,纬向\n弯曲刚度 B,0.11,0.06\n"),
            (GBK, "样品名称：纯棉府绸\n12,13\n"),
            (BIG5, "項目,經向,緯向\n彎曲剛度,0.11,0.06\n"),
            (WINDOWS_1254, "Özellik;Çözgü;Atkı\nKalınlık;0,5;\n"),
            (WINDOWS_1252, "Propriété;Chaîne;Trame\nÉpaisseur;0,5;\n"),
            (SHIFT_JIS, "項目,たて,よこ\n曲げ剛性,0.11,0.06\n"),
        ];
        for (encoding, text) in cases {
            let bytes = encoding.encode(text).0;
            let decoded = decode(&bytes, None).expect("it is detected");
            assert_eq!(decoded.text, text, "{}", decoded.reading);
        }
    }

    #[test]
    fn a_declared_encoding_is_held_against_the_bytes() {
        let bytes = WINDOWS_1252.encode("a\nWeg;Kräfte\n").0;
        assert!(decode(&bytes, by_label("windows-1252")).is_ok());
        let place = decode(&bytes, by_label("utf-8")).expect_err("it is not UTF-8");
        assert!((8..12).contains(&place), "{place}");
        assert!(by_label("klingon").is_none());
    }
}
