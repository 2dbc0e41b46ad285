//! Decoding that goes on after a mistake: what is told, and what is handed on.

use std::collections::BTreeMap;

use drape_input::{Angle, Document, Faults, Given, Length, TextOr};
use serde::Deserialize;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Cloth {
    name: String,
    spacing: Given<Length>,
    #[serde(default)]
    layers: u8,
    #[serde(default)]
    panel: Vec<Piece>,
    #[serde(default)]
    pin: BTreeMap<String, Pin>,
    motion: Option<TextOr<Vec<f64>>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Piece {
    size: [Given<Length>; 2],
    #[serde(default)]
    grain: Given<Angle>,
    flat: Option<bool>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Pin {
    edge: String,
}

const RIGHT: &str = "name = \"a\"\nspacing = 0.01\n[[panel]]\nsize = [1, \"20 cm\"]\ngrain = 45\n";

fn decoded(text: &str) -> (Cloth, Faults) {
    Document::new("a.toml", text).decode_with_faults().expect("the grammar is right")
}

/// Returns the mistakes of a text, a line each, with their remedies.
fn told(text: &str) -> Vec<String> {
    let mistakes = decoded(text).1.into_mistakes();
    let line = |mistake: drape_input::Diagnostic| {
        let place = [mistake.line, mistake.column].map(Option::unwrap_or_default);
        format!("{place:?} {}; {}", mistake.message, mistake.help.unwrap_or_default())
    };
    mistakes.into_iter().map(line).collect()
}

#[test]
fn a_text_without_mistakes_is_handed_on_as_it_is() {
    let (cloth, faults) = decoded(RIGHT);
    assert!(faults.is_empty());
    assert_eq!((cloth.name.as_str(), cloth.layers, cloth.motion), ("a", 0, None));
    assert_eq!(cloth.panel[0].size.map(|side| side * 1.0), [1.0, 0.2]);
    assert_eq!(cloth.panel[0].grain.value(), 45.0);
}

#[test]
fn every_needed_key_that_is_missing_is_told_with_an_example() {
    let mut lines = told("[[panel]]\n[[panel]]\nflat = true\n[pin.left]\n");
    lines.sort();
    let expected = [
        "[0, 0] name: is missing; add name = …, text in quotes",
        "[0, 0] spacing: is missing; add spacing = …, a length such as 0.01 or \"10 mm\"",
        "[1, 1] panel[0].size: is missing; add size = …, a list such as [1, 2]",
        "[2, 1] panel[1].size: is missing; add size = …, a list such as [1, 2]",
        "[4, 6] pin.left.edge: is missing; add edge = …, text in quotes",
    ];
    assert_eq!(lines, expected);
}

#[test]
fn one_mistake_hides_no_other() {
    let text = "name = 3\nspacing = \"fast\"\nlayers = 300\nmotion = true\ncolour = 1\n\
                [[panel]]\nsize = [1]\ngrain = \"45 mm\"\nflat = \"no\"\n[pin.left]\nedge = [1]\n";
    let lines = told(text);
    let keys: Vec<&str> =
        lines.iter().filter_map(|line| line.split("] ").nth(1)?.split(": ").next()).collect();
    let mut sorted = keys.clone();
    sorted.sort_unstable();
    let expected = [
        "colour",
        "layers",
        "motion",
        "name",
        "panel[0].flat",
        "panel[0].grain",
        "panel[0].size",
        "pin.left.edge",
        "spacing",
    ];
    assert_eq!(sorted, expected, "{lines:?}");
}

#[test]
fn a_table_in_the_wrong_place_is_told_with_what_belongs_there() {
    let name = told(&RIGHT.replace("\"a\"", "{ first = \"a\" }"));
    assert_eq!(
        name,
        ["[1, 1] name: is a table where text in quotes is needed; write text in quotes"]
    );
    let size = told(&RIGHT.replace("[1, \"20 cm\"]", "{ x = 1 }"));
    let expected =
        "[4, 1] panel[0].size: is a table where a list is needed; write a list such as [1, 2]";
    assert_eq!(size, [expected]);
    let panel = told(&RIGHT.replace("[[panel]]", "[panel]"));
    let brackets = "write [[panel]], with two brackets: there may be several";
    assert_eq!(panel, [format!("[3, 2] panel: is a table where a list is needed; {brackets}")]);
}

#[test]
fn a_reader_that_adds_its_words_to_a_mistake_keeps_those_of_the_mistake() {
    #[derive(Debug, Deserialize)]
    struct Scene {
        #[serde(deserialize_with = "corner")]
        #[allow(dead_code)]
        pin: Corner,
    }
    #[derive(Debug, Deserialize)]
    #[allow(dead_code)]
    struct Corner {
        edge: Edge,
    }
    #[derive(Debug)]
    struct Edge;
    impl<'de> Deserialize<'de> for Edge {
        fn deserialize<D: serde::Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
            match String::deserialize(from)?.as_str() {
                "left" => Ok(Self),
                other => Err(serde::de::Error::custom(format!("{other} is no edge"))),
            }
        }
    }
    fn corner<'de, D: serde::Deserializer<'de>>(from: D) -> Result<Corner, D::Error> {
        let in_words = |error: D::Error| serde::de::Error::custom(format!("a corner: {error}"));
        Corner::deserialize(from).map_err(in_words)
    }
    let read = |text: &str| Document::new("a.toml", text).decode::<Scene>();
    assert!(read("pin = { edge = \"left\" }").is_ok());
    for (text, words) in [
        ("pin = { edge = \"top\" }", "a corner: top is no edge"),
        ("[pin]\n", "a corner: edge is missing"),
    ] {
        let mistakes = read(text).expect_err("it is wrong").0;
        let messages: Vec<&str> = mistakes.iter().map(|one| one.message.as_str()).collect();
        assert_eq!(messages, [words]);
    }
}

#[test]
fn wrong_values_are_left_out_and_their_keys_covered() {
    let text =
        RIGHT.replace("grain = 45", "grain = \"steep\"\nflat = 3") + "[pin.left]\nedge = 1\n";
    let (cloth, faults) = decoded(&text);
    assert_eq!(cloth.panel[0].grain, Given::default());
    assert_eq!(cloth.panel[0].flat, None);
    // A needed key has a stand-in.
    assert_eq!(cloth.pin["left"].edge, "");
    for key in ["panel[0].grain", "panel[0].flat", "panel[0]", "pin.left.edge"] {
        assert!(faults.cover(key), "{key}");
    }
    for key in ["panel[0].size", "name", "pin.right"] {
        assert!(!faults.cover(key), "{key}");
    }
}

#[test]
fn a_slip_of_the_pen_counts_as_the_key_that_is_meant() {
    let text = RIGHT.replace("spacing", "spcing");
    let (cloth, faults) = decoded(&text);
    assert_eq!(cloth.spacing * 1.0, 0.01);
    let mistakes = faults.into_mistakes();
    assert_eq!(mistakes.len(), 1, "{mistakes:?}");
    assert_eq!(mistakes[0].help.as_deref(), Some("did you mean `spacing`?"));
    // The value of the slip is read as well, and answered under the key that is meant.
    let both = told(&RIGHT.replace("spacing = 0.01", "spcing = \"0.01\""));
    assert_eq!(both.len(), 2, "{both:?}");
}

#[test]
fn numbers_that_are_infinite_or_none_are_refused_where_they_stand() {
    for (number, word) in [("nan", "nan"), ("inf", "inf"), ("\"inf mm\"", "inf")] {
        let lines = told(&RIGHT.replace("[1, ", &format!("[{number}, ")));
        let expected = format!(
            "[4, 9] panel[0].size[0]: {word} is not a finite number; write a finite number"
        );
        assert_eq!(lines, [expected]);
    }
}

#[test]
fn text_or_something_else_takes_both_and_tells_the_rest() {
    let with = |value: &str| RIGHT.replace("[[panel]]", &format!("motion = {value}\n[[panel]]"));
    assert_eq!(decoded(&with("\"walk.pc2\"")).0.motion, Some(TextOr::Text("walk.pc2".into())));
    assert_eq!(decoded(&with("[1, 2]")).0.motion, Some(TextOr::Other(vec![1.0, 2.0])));
    assert_eq!(told(&with("[1, true]")).len(), 1);
}

#[test]
fn an_unknown_key_in_every_one_of_many_tables_is_told_each_time() {
    let text: String = RIGHT.to_owned()
        + &(0..500).map(|_| "[[panel]]\nsize = [1, 1]\nsise = 2\n").collect::<String>();
    let lines = told(&text);
    assert_eq!(lines.len(), 500);
    assert!(lines[499].contains("panel[500].sise"), "{}", lines[499]);
}

#[test]
fn mistakes_of_grammar_are_all_told_and_nothing_else() {
    let document = Document::new(
        "a.toml",
        "name = a b\nlayers = 1\npin = 2\nspacing = 0,01\nlayers = \"x\"\n",
    );
    let mistakes = document.decode_with_faults::<Cloth>().expect_err("it is no TOML").0;
    let helps: Vec<&str> = mistakes.iter().filter_map(|mistake| mistake.help.as_deref()).collect();
    // The last line, a key that stands twice, is a mistake of grammar too; the type of `pin` is
    // not.
    let twice = "keep one of the two; all keys of a table stand together";
    assert_eq!(helps, ["write \"a b\"", "write 0.01", twice]);
}
