//! Words and signs of Rust source: no comments, no literals, nothing that is compiled for tests
//! only; and its strings.

/// Splits source into words, `::` and single signs; comments, strings, characters and lifetimes are
/// left out.
pub fn tokens(text: &str) -> Vec<String> {
    split(text).0
}

/// Returns the strings of source between their quotes, each with the line on which it begins. What
/// a backslash escapes is left as it is written.
pub fn strings(text: &str) -> Vec<(usize, String)> {
    split(text).1
}

/// Splits source into [`tokens`] and [`strings`].
fn split(text: &str) -> (Vec<String>, Vec<(usize, String)>) {
    let chars: Vec<char> = text.chars().collect();
    let at = |i: usize| chars.get(i).copied().unwrap_or('\0');
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let string = |from: usize, to: usize| {
        let line = 1 + chars[..from].iter().filter(|c| **c == '\n').count();
        (line, chars[from..to.min(chars.len())].iter().collect())
    };
    let (mut tokens, mut strings) = (Vec::new(), Vec::new());
    let mut i = 0;
    while i < chars.len() {
        match (at(i), at(i + 1)) {
            ('/', '/') => i = skip_to(&chars, i, |c| c == '\n'),
            ('/', '*') => i = skip_comment(&chars, i),
            ('"', _) => {
                let end = skip_string(&chars, i);
                strings.push(string(i + 1, end - 1));
                i = end;
            }
            ('\'', '\\') => i = skip_to(&chars, i + 3, |c| c == '\'') + 1,
            ('\'', _) if at(i + 2) == '\'' => i += 3,
            ('\'', _) => i = skip_to(&chars, i + 1, |c| !is_word(c)),
            (':', ':') => {
                tokens.push("::".to_owned());
                i += 2;
            }
            (c, _) if is_word(c) => {
                let end = skip_to(&chars, i, |c| !is_word(c));
                let word: String = chars[i..end].iter().collect();
                let hashes = chars[end..].iter().take_while(|c| **c == '#').count();
                let is_prefix = ["r", "b", "br", "c", "cr"].contains(&word.as_str());
                i = match at(end + hashes) {
                    '"' if is_prefix && word.contains('r') => {
                        let behind = skip_raw(&chars, end, hashes);
                        strings.push(string(end + hashes + 1, behind - hashes - 1));
                        behind
                    }
                    // The string or the character after the prefix is skipped in turn.
                    '"' | '\'' if is_prefix && hashes == 0 => end,
                    // A raw identifier.
                    _ if word == "r" && hashes == 1 => end + 1,
                    _ => {
                        tokens.push(word);
                        end
                    }
                };
            }
            (c, _) => {
                if !c.is_whitespace() {
                    tokens.push(c.to_string());
                }
                i += 1;
            }
        }
    }
    (tokens, strings)
}

/// Returns the index of the first character from `from` on that ends something.
fn skip_to(chars: &[char], from: usize, ends: impl Fn(char) -> bool) -> usize {
    let from = from.min(chars.len());
    chars[from..].iter().position(|c| ends(*c)).map_or(chars.len(), |length| from + length)
}

/// Returns the index behind a block comment, which may hold others.
fn skip_comment(chars: &[char], from: usize) -> usize {
    let mut depth = 0;
    let mut i = from;
    while i + 1 < chars.len() {
        match (chars[i], chars[i + 1]) {
            ('/', '*') => depth += 1,
            ('*', '/') => depth -= 1,
            _ => {
                i += 1;
                continue;
            }
        }
        i += 2;
        if depth == 0 {
            return i;
        }
    }
    chars.len()
}

/// Returns the index behind a string.
fn skip_string(chars: &[char], from: usize) -> usize {
    let mut i = from + 1;
    while i < chars.len() && chars[i] != '"' {
        i += if chars[i] == '\\' { 2 } else { 1 };
    }
    i + 1
}

/// Returns the index behind a raw string, whose hashes begin at `from`.
fn skip_raw(chars: &[char], from: usize, hashes: usize) -> usize {
    let mut i = from + hashes + 1;
    while i < chars.len() {
        let closing = chars[i] == '"';
        i += 1;
        if closing && chars[i..].iter().take_while(|c| **c == '#').count() >= hashes {
            return i + hashes;
        }
    }
    i
}

/// Leaves out every item behind an attribute `#[cfg(test)]`.
pub fn without_tests(tokens: &[String]) -> Vec<String> {
    let mut kept = Vec::new();
    let mut i = 0;
    while i < tokens.len() {
        match attribute(tokens, i) {
            Some(end) if is_test(&tokens[i..end]) => {
                i = end;
                while let Some(end) = attribute(tokens, i) {
                    i = end;
                }
                i = item(tokens, i);
            }
            _ => {
                kept.push(tokens[i].clone());
                i += 1;
            }
        }
    }
    kept
}

/// Returns the end of the attribute that begins at a token, if one does.
fn attribute(tokens: &[String], from: usize) -> Option<usize> {
    (tokens.get(from)? == "#" && tokens.get(from + 1)? == "[").then(|| group(tokens, from + 1))
}

fn is_test(attribute: &[String]) -> bool {
    let has = |word: &str| attribute.iter().any(|token| token == word);
    has("cfg") && has("test") && !has("not")
}

/// Returns the index behind the group that opens at a token.
fn group(tokens: &[String], from: usize) -> usize {
    let mut depth = 0;
    for (i, token) in tokens.iter().enumerate().skip(from) {
        match token.as_str() {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return i + 1;
        }
    }
    tokens.len()
}

/// Returns the index behind the item, the statement or the field that begins at a token.
fn item(tokens: &[String], from: usize) -> usize {
    let mut first = from;
    if tokens.get(first).is_some_and(|token| token == "pub") {
        first += 1;
        if tokens.get(first).is_some_and(|token| token == "(") {
            first = group(tokens, first);
        }
    }
    let word = tokens.get(first).map_or("", String::as_str);
    let has_semicolon = ["use", "const", "static", "type", "let"].contains(&word);
    let has_body =
        ["fn", "impl", "struct", "enum", "union", "trait", "mod", "unsafe", "macro_rules"]
            .contains(&word);
    let mut i = first;
    while i < tokens.len() {
        match tokens[i].as_str() {
            ";" => return i + 1,
            "," if !has_semicolon && !has_body => return i + 1,
            "}" | ")" | "]" => return i,
            "{" if !has_semicolon => return group(tokens, i),
            "(" | "[" | "{" => i = group(tokens, i),
            _ => i += 1,
        }
    }
    i
}
