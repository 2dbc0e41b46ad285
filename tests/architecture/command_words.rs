//! Words of the command line in the texts of a library: a program that uses the library alone
//! cannot act on them.

use crate::tokens::strings;

/// Commands of the program.
const COMMANDS: [&str; 19] = [
    "bench",
    "check",
    "completions",
    "converge",
    "convert",
    "export",
    "fabric",
    "fit",
    "man",
    "new",
    "picture",
    "report",
    "resume",
    "run",
    "schema",
    "sweep",
    "test",
    "validate",
    "view",
];

/// Returns the commands and options in the strings of the source `text`, each with its line.
/// Comments are left out, and so is the module of tests at the end.
pub fn command_words(text: &str) -> Vec<String> {
    let source = text.split("#[cfg(test)]\nmod ").next().unwrap_or_default();
    let mut found = Vec::new();
    for (line, text) in strings(source) {
        let words: Vec<&str> = text.split_whitespace().filter(|word| *word != "\\").collect();
        let calls = words.windows(2).filter(|pair| is_call(pair[0], pair[1]));
        found.extend(calls.map(|pair| format!("line {line}: {} {}", pair[0], pair[1])));
        let options = words.iter().filter(|word| is_option(word));
        found.extend(options.map(|word| format!("line {line}: {word}")));
    }
    found
}

/// Returns whether two words call the program, such as `drape run`.
fn is_call(program: &str, command: &str) -> bool {
    let [program, command] =
        [program, command].map(|word| word.trim_matches(|sign: char| !sign.is_alphanumeric()));
    program == "drape" && COMMANDS.contains(&command)
}

/// Returns whether `word` is an option, such as `--force` or `-o`.
fn is_option(word: &str) -> bool {
    let word = word.trim_start_matches(['`', '(', '\'', '"', '[']);
    let Some(name) = word.strip_prefix('-') else { return false };
    match name.strip_prefix('-') {
        Some(long) => long.starts_with(|letter: char| letter.is_ascii_lowercase()),
        None => name.trim_end_matches(|sign: char| !sign.is_alphanumeric()) == "o",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_and_options_are_found_in_strings_only() {
        let source = "// `drape run --force`\nlet a = \"go on with `drape resume {place}`\";\n\
                      let b = \"give (--unit mm),\\\n drape \\\n fit, -o.\"; let c = x --y;\n\
                      let d = ('\"', r#\"a \"quoted\" --force\"#);\n";
        let found = command_words(source);
        let expected =
            ["line 2: `drape resume", "line 3: drape fit,", "line 3: (--unit", "line 3: -o."];
        assert_eq!(found[..4], expected, "{found:?}");
        assert_eq!(found[4..], ["line 6: --force"], "{found:?}");
    }

    #[test]
    fn other_words_and_signs_are_no_words_of_the_command() {
        for text in ["the drape of a test", "from -1 to 1", "a -- b", "2 - o", "--- DATE"] {
            assert_eq!(command_words(&format!("let a = \"{text}\";")), [""; 0], "{text}");
        }
    }
}
