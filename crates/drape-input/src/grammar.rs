//! Mistakes of grammar in a TOML text, in the words of this program.
//!
//! A parser that goes on after a mistake takes what follows for mistakes too. Here each line with a
//! mistake is blanked and the text parsed anew, a few times, until it is right or a mistake follows
//! on the one before.

use std::ops::Range;

use toml::de::DeTable;

use crate::figure::excerpt;

/// Largest number of mistakes of grammar that are looked for.
const MISTAKES_MAX: usize = 20;

/// Mistake of grammar.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct GrammarMistake {
    pub(crate) span: Option<Range<usize>>,
    pub(crate) message: String,
    pub(crate) help: String,
}

/// Returns the mistakes of grammar of a text.
pub(crate) fn grammar_mistakes(text: &str) -> Vec<GrammarMistake> {
    let mut text = text.to_owned();
    let mut mistakes: Vec<GrammarMistake> = Vec::new();
    let mut blanked = 0..0;
    while mistakes.len() < MISTAKES_MAX {
        let Err(error) = DeTable::parse(&text) else { break };
        let Some(span) = error.span() else {
            mistakes.push(told(&text, None, error.message()));
            break;
        };
        let line = line_at(&text, span.start);
        // The next line, or one that was blanked: it follows from a mistake that was told. The parser
        // does not find mistakes in the order of the text.
        let next = (blanked.start..=blanked.end + 1).contains(&line.start);
        let follows = !mistakes.is_empty() && next;
        if follows || text[line.clone()].trim().is_empty() {
            if mistakes.is_empty() {
                mistakes.push(told(&text, Some(span), error.message()));
            }
            break;
        }
        mistakes.push(told(&text, Some(span), error.message()));
        let blank: String = text[line.clone()].bytes().map(|_| ' ').collect();
        text.replace_range(line.clone(), &blank);
        blanked = line;
    }
    mistakes
}

/// Returns the line of a byte, without its end.
fn line_at(text: &str, byte: usize) -> Range<usize> {
    let byte = byte.min(text.len());
    let start = text[..byte].rfind('\n').map_or(0, |end| end + 1);
    let end = text[byte..].find('\n').map_or(text.len(), |end| byte + end);
    start..end
}

/// Returns a mistake in other words than the parser's.
fn told(text: &str, span: Option<Range<usize>>, parser: &str) -> GrammarMistake {
    let headline = parser.split(", expected").next().unwrap_or(parser);
    let start = span.as_ref().map_or(0, |span| span.start.min(text.len()));
    if let Some(list) = open_list(text, start) {
        let help = "close it with ]".to_owned();
        return GrammarMistake { span: Some(list), message: "the list is not closed".into(), help };
    }
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

/// Returns whether a comma between digits is at a byte of a text.
fn is_decimal_comma(text: &str, at: usize) -> bool {
    let bytes = text.as_bytes();
    let digit = |index: Option<usize>| {
        index.and_then(|index| bytes.get(index)).is_some_and(u8::is_ascii_digit)
    };
    bytes.get(at) == Some(&b',') && digit(at.checked_sub(1)) && digit(Some(at + 1))
}

/// Returns the number about a comma at a byte of a text, with a point.
fn decimal(text: &str, comma: usize) -> String {
    let is_part = |letter: char| letter.is_ascii_digit() || matches!(letter, '+' | '-' | '_');
    let before = text[..comma].trim_end_matches(is_part).len();
    let after =
        text[comma + 1..].trim_start_matches(|c: char| is_part(c) || c.eq_ignore_ascii_case(&'e'));
    format!("{}.{}", &text[before..comma], &text[comma + 1..text.len() - after.len()])
}

/// Returns the place of a list that began in the line before a byte and was not closed.
fn open_list(text: &str, at: usize) -> Option<Range<usize>> {
    let line = line_at(text, at);
    let is_first = text[line.start..at].trim().is_empty();
    let before = text[..line.start].trim_end();
    let last = line_at(text, before.len());
    let open = text[last.start..before.len()].find('[')?;
    let rest = &text[last.start + open..before.len()];
    let value = text[last.start..last.start + open].trim_end().ends_with('=');
    let is_open = rest.matches('[').count() > rest.matches(']').count();
    (is_first && value && is_open).then(|| last.start + open..before.len())
}
