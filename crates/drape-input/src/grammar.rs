//! Mistakes of grammar in a TOML text, with messages that name a remedy.
//!
//! A parser that continues after a mistake often reports correct lines as mistakes too. Here each
//! line with a mistake is replaced by spaces and the text is parsed again. This ends when the text
//! is correct, or when a mistake is probably a consequence of the mistake before it.

use std::ops::Range;

use toml::de::DeTable;

use crate::figure::excerpt;

/// Mistake of grammar.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct GrammarMistake {
    /// Bytes of the text that the mistake covers.
    pub(crate) span: Option<Range<usize>>,
    pub(crate) message: String,
    pub(crate) help: String,
}

/// Returns the mistakes of grammar in `text`, at most 20.
pub(crate) fn grammar_mistakes(text: &str) -> Vec<GrammarMistake> {
    /// Largest number of mistakes that are searched for.
    const MISTAKES_MAX: usize = 20;

    let mut text = text.to_owned();
    let mut mistakes: Vec<GrammarMistake> = Vec::new();
    let mut blanked = 0..0;
    while mistakes.len() < MISTAKES_MAX {
        let Err(error) = DeTable::parse(&text) else { break };
        let Some(span) = error.span() else {
            mistakes.push(describe(&text, None, error.message()));
            break;
        };
        let line = line_at(&text, span.start);

        // A mistake in the blanked line, or in the line after it, is a consequence of the mistake
        // before. The parser does not find mistakes in the order of the text.
        let is_next = (blanked.start..=blanked.end + 1).contains(&line.start);
        let is_consequence = !mistakes.is_empty() && is_next;
        if is_consequence || text[line.clone()].trim().is_empty() {
            if mistakes.is_empty() {
                mistakes.push(describe(&text, Some(span), error.message()));
            }
            break;
        }

        mistakes.push(describe(&text, Some(span), error.message()));
        let blank: String = text[line.clone()].bytes().map(|_| ' ').collect();
        text.replace_range(line.clone(), &blank);
        blanked = line;
    }
    mistakes
}

/// Returns the bytes of the line of `text` that contains `byte`, without the line break.
fn line_at(text: &str, byte: usize) -> Range<usize> {
    let byte = byte.min(text.len());
    let start = text[..byte].rfind('\n').map_or(0, |end| end + 1);
    let end = text[byte..].find('\n').map_or(text.len(), |end| byte + end);
    start..end
}

/// Returns the mistake at `span` in `text`, for which the parser has the message `parser_message`.
fn describe(text: &str, span: Option<Range<usize>>, parser_message: &str) -> GrammarMistake {
    let start = span.as_ref().map_or(0, |span| span.start.min(text.len()));
    if let Some(list) = open_list(text, start) {
        let help = "close it with ]".to_owned();
        return GrammarMistake { span: Some(list), message: "the list is not closed".into(), help };
    }

    // The parser appends a list of expected letters, which confuses more than it helps.
    let headline = parser_message.split(", expected").next().unwrap_or(parser_message);
    let (message, help) = match headline {
        _ if is_decimal_comma(text, start) => {
            let number = excerpt(&decimal(text, start));
            ("a number has a point, not a comma".to_owned(), format!("write {number}"))
        }
        "string values must be quoted" => {
            let line = line_at(text, start);
            let word = text[start..line.end].split([',', ']', '}', '#']).next().unwrap_or("");
            let quoted = format!("write \"{}\"", excerpt(word.trim()));
            ("text has no quotes".to_owned(), quoted)
        }
        "duplicate key" => {
            let key = span.clone().and_then(|span| text.get(span)).unwrap_or_default();
            let message = format!("{} stands twice", excerpt(key));
            (message, "keep one of the two; all keys of a table stand together".to_owned())
        }
        other => {
            let help = "a line is key = value, [table] or [[table of a list]]; text is in quotes";
            (other.to_owned(), help.to_owned())
        }
    };
    GrammarMistake { span, message, help }
}

/// Returns whether byte `at` of `text` is a comma between two digits.
fn is_decimal_comma(text: &str, at: usize) -> bool {
    let bytes = text.as_bytes();
    let before = at.checked_sub(1).and_then(|before| bytes.get(before));
    bytes.get(at) == Some(&b',')
        && before.is_some_and(u8::is_ascii_digit)
        && bytes.get(at + 1).is_some_and(u8::is_ascii_digit)
}

/// Returns whether `letter` may stand in an integer: a digit, a sign or an underscore.
fn is_integer_letter(letter: char) -> bool {
    letter.is_ascii_digit() || matches!(letter, '+' | '-' | '_')
}

/// Returns the number around the comma at byte `comma` of `text`, with a point in place of the
/// comma.
fn decimal(text: &str, comma: usize) -> String {
    let before = text[..comma].trim_end_matches(is_integer_letter).len();
    let after = text[comma + 1..].trim_start_matches(|letter: char| {
        is_integer_letter(letter) || letter.eq_ignore_ascii_case(&'e')
    });
    format!("{}.{}", &text[before..comma], &text[comma + 1..text.len() - after.len()])
}

/// Returns the bytes of a list that begins in the line before byte `at` and is not closed, if byte
/// `at` is the first one in its line that is no space.
fn open_list(text: &str, at: usize) -> Option<Range<usize>> {
    let line = line_at(text, at);
    let is_first = text[line.start..at].trim().is_empty();
    let before = text[..line.start].trim_end();
    let last = line_at(text, before.len());
    let bracket = last.start + text[last.start..before.len()].find('[')?;
    let list = &text[bracket..before.len()];
    let is_value = text[last.start..bracket].trim_end().ends_with('=');
    let is_open = list.matches('[').count() > list.matches(']').count();
    (is_first && is_value && is_open).then_some(bracket..before.len())
}
