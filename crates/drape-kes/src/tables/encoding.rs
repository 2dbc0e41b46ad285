//! Encoding of a text file: declared, or detected from its bytes.

use chardetng::{EncodingDetector, Iso2022JpDetection, Utf8Detection};
use encoding_rs::{
    BIG5, EUC_JP, EUC_KR, Encoding, GB18030, GBK, SHIFT_JIS, UTF_8, UTF_16BE, UTF_16LE,
    WINDOWS_1250, WINDOWS_1251, WINDOWS_1252, WINDOWS_1253, WINDOWS_1254,
};

use crate::tables::heading;

/// Encodings that are not Unicode. The encoding is taken in which the text has most letters of
/// known words.
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

/// Share of zero bytes at even or odd places above which a text without a mark is UTF-16.
///
/// Tables are mostly digits, whose high bytes are zero. Other encodings have no zero byte.
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

/// Returns the encoding with `label`, such as `Shift_JIS`.
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

/// Decodes the `bytes` of a file. `Err` holds the place of the first byte that the `declared`
/// encoding does not have.
pub(crate) fn decode(bytes: &[u8], declared: Option<&'static Encoding>) -> Result<Decoded, usize> {
    if let Some(encoding) = declared {
        // A byte-order mark is removed only if it belongs to the declared encoding.
        let (marked, mark) = Encoding::for_bom(bytes).unwrap_or((encoding, 0));
        let rest = if marked == encoding { &bytes[mark..] } else { bytes };
        return decode_strictly(encoding, rest)
            .map(|text| Decoded {
                text,
                reading: format!("{} as declared", encoding.name()),
                encoding: Some(encoding),
            })
            .ok_or_else(|| first_error(encoding, rest));
    }
    if let Some((encoding, mark)) = Encoding::for_bom(bytes) {
        return Ok(decode_as(encoding, &bytes[mark..], "by its byte-order mark"));
    }
    if let Some(encoding) = unmarked_utf_16(bytes) {
        return Ok(decode_as(encoding, bytes, "every other byte is zero"));
    }
    if bytes.is_ascii() {
        return Ok(decode_as(UTF_8, bytes, ""));
    }
    if std::str::from_utf8(bytes).is_ok() {
        return Ok(decode_as(UTF_8, bytes, "valid as such"));
    }

    // Other encodings are told by the words of tables, then by the letters of East Asia.
    let sample = lines_beyond_ascii(bytes);
    if let Some(encoding) = encoding_by_words(&sample) {
        let why = "not UTF-8, and its characters are words of tables";
        return Ok(decode_as(encoding, bytes, why));
    }
    if is_japanese(&sample) {
        let why = "not UTF-8, and its characters are Japanese words";
        return Ok(decode_as(SHIFT_JIS, bytes, why));
    }
    let mut detector = EncodingDetector::new(Iso2022JpDetection::Deny);
    detector.feed(&sample, true);
    let guess = detector.guess(None, Utf8Detection::Deny);
    let is_wide = [GBK, GB18030, BIG5, EUC_JP, EUC_KR].contains(&guess);
    if is_wide && decode_strictly(guess, &sample).is_some_and(|text| has_joined_letters(&text)) {
        let why = "not UTF-8, and its characters are East Asian words";
        return Ok(decode_as(guess, bytes, why));
    }
    Ok(decode_as(WINDOWS_1252, bytes, "not UTF-8, no East Asian words"))
}

/// Decodes `bytes` as `encoding`, for the reason `why`. The reason is empty for plain ASCII.
fn decode_as(encoding: &'static Encoding, bytes: &[u8], why: &str) -> Decoded {
    let (text, _) = encoding.decode_without_bom_handling(bytes);
    if why.is_empty() {
        return Decoded { text: text.into_owned(), reading: String::new(), encoding: None };
    }
    let reading = format!("{} ({why})", encoding.name());
    Decoded { text: text.into_owned(), reading, encoding: Some(encoding) }
}

/// Returns the first lines of `bytes` that have characters beyond ASCII. No encoding has the end of
/// a line within a character.
fn lines_beyond_ascii(bytes: &[u8]) -> Vec<u8> {
    /// Largest number of bytes of the sample: few words of a table tell its encoding.
    const SAMPLE_MAX: usize = 1 << 16;

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

/// Returns the encoding in which `bytes` have most letters beyond ASCII of known words; `None` if
/// they have none in any encoding.
fn encoding_by_words(bytes: &[u8]) -> Option<&'static Encoding> {
    let scores = CANDIDATES.map(|encoding| {
        decode_strictly(encoding, bytes).map_or(0, |text| heading::known_letters(&text))
    });
    let best_score = *scores.iter().max()?;
    let first = scores.iter().position(|score| *score == best_score)?;
    (best_score > 0).then_some(CANDIDATES[first])
}

/// Decodes `bytes` as `encoding`; `None` if a byte is not of the encoding.
fn decode_strictly(encoding: &'static Encoding, bytes: &[u8]) -> Option<String> {
    encoding
        .decode_without_bom_handling_and_without_replacement(bytes)
        .map(|text| text.into_owned())
}

/// Returns the place of the first byte that `encoding` does not have.
fn first_error(encoding: &'static Encoding, bytes: &[u8]) -> usize {
    // The longest valid start is found by bisection. A start that ends within a character is wrong
    // by a few bytes only, which does not matter for a line number.
    let (mut good, mut bad) = (0, bytes.len());
    while bad - good > 1 {
        let middle = good.midpoint(bad);
        let whole = (0..4).any(|cut| {
            middle >= cut + good && decode_strictly(encoding, &bytes[..middle - cut]).is_some()
        });
        if whole { good = middle } else { bad = middle }
    }
    good
}

/// Returns the UTF-16 encoding of `bytes` without a byte-order mark; `None` for another encoding.
fn unmarked_utf_16(bytes: &[u8]) -> Option<&'static Encoding> {
    let [even, odd] = [0, 1].map(|first| {
        let zeros = bytes.iter().skip(first).step_by(2).filter(|&&byte| byte == 0).count();
        zeros as f64 / (bytes.len() / 2).max(1) as f64
    });
    if odd > ZEROS_OF_UTF_16 && even == 0.0 {
        Some(UTF_16LE)
    } else if even > ZEROS_OF_UTF_16 && odd == 0.0 {
        Some(UTF_16BE)
    } else {
        None
    }
}

/// Returns whether `bytes` are Shift_JIS: characters of two bytes that stand side by side.
///
/// A Western letter with its successor is a valid character of two bytes too, but stands alone
/// among the letters of its word.
fn is_japanese(bytes: &[u8]) -> bool {
    decode_strictly(SHIFT_JIS, bytes).is_some_and(|text| has_joined_letters(&text))
}

/// Returns whether most East Asian letters of `text` stand side by side.
fn has_joined_letters(text: &str) -> bool {
    let letters: Vec<char> = text.chars().collect();
    let (mut together, mut alone) = (0, 0);
    for run in letters.split(|&letter| !is_wide(letter)).filter(|run| !run.is_empty()) {
        if run.len() > 1 { together += run.len() } else { alone += 1 }
    }
    together > alone
}

/// Returns whether `letter` is an East Asian letter of full width.
fn is_wide(letter: char) -> bool {
    matches!(letter, '\u{3000}'..='\u{30ff}' | '\u{4e00}'..='\u{9fff}' | '\u{ff01}'..='\u{ff5e}')
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
