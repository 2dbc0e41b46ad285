//! Keys of sheets in other spellings: what is there twice, and mistakes with the keys as written.

use self::sheet::{GOOD_CURVE, finding, help, mistakes, read};

#[path = "support/sheet.rs"]
mod sheet;

#[test]
fn a_value_that_is_there_twice_is_refused_wherever_it_stands() {
    let twice = [
        ("[warp]\nEM = 4\nEMT = 5\n", 4, "warp.EMT: means warp.EM, which is there too"),
        ("emt = 4\nE_M = 5\n", 3, "E_M: means EM, as emt does"),
        ("B_warp = 0.1\n[Kette]\nb = 0.1\n", 2, "B_warp: means warp.B, as Kette.b does"),
        ("B-1 = 0.1\nB_wp = 0.1\n", 3, "B_wp: means warp.B, as B-1 does"),
        ("B = 0.1\n[mean]\nB = 0.2\n", 4, "mean.B: means B, which is there too"),
    ];
    for (text, line, message) in twice {
        let found = finding(&format!("name = \"a\"\n{text}"), GOOD_CURVE);
        assert_eq!((found.line, found.message.as_str()), (Some(line), message), "{text}");
        assert_eq!(help(&found), "keep one of them");
    }
    let found = finding("name = \"a\"\n[warp]\nB = 0.1\n[chaine]\nG = 1\n", GOOD_CURVE);
    assert_eq!(found.message, "chaine: means warp, which is there too");
    assert_eq!(help(&found), "put the values into one table");
}

#[test]
fn mistakes_and_their_edits_have_the_keys_as_they_are_written() {
    let text = "name = \"a\"\n\"2HB (weft)\" = 1\n\"2HB weft\" = -1\nW = \"150 g/m\"\n[Kette]\nemt = \"0.04 m/mm\"\n\
                2hbb = 0.1\n";
    let found = mistakes(read(text, GOOD_CURVE));
    let messages: Vec<_> = found.iter().map(|mistake| mistake.message.as_str()).collect();
    let expected = [
        "\"2HB (weft)\": there is no such key",
        "\"2HB weft\": -1 is negative",
        "W: \"g/m\" is not a unit of mass per area",
        "Kette.emt: \"m/mm\" is not a unit of ratio",
        "Kette.2hbb: there is no such key",
    ];
    assert_eq!(messages, expected);
    let keys: Vec<_> = found.iter().map(|mistake| mistake.key.clone().expect("a key")).collect();
    assert_eq!(keys[3].to_string(), "Kette.emt");

    // The edits change the text as it is written, and the sheet is right then.
    let mended = text.replace("\"2HB (weft)\" = 1\n", "").replace("-1", "1");
    let edits: Vec<_> = found.iter().flat_map(|mistake| mistake.edits.clone()).collect();
    let mended = drape_input::apply_edits(&mended, &edits).expect("the edits fit");
    assert!(mended.contains("W = \"150 g/m2\"") && mended.contains("2HB = 0.1"), "{mended}");
    let sheet = read(&mended, GOOD_CURVE).expect(&mended);
    assert_eq!((sheet.w, sheet.warp.two_hb, sheet.warp.em), (Some(15.0), Some(0.1), Some(4.0)));
}
