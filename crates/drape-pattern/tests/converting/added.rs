//! Files that add to patterns of other formats.

use drape_input::Document;
use drape_pattern::{EdgeId, Pattern, PatternNote};

use crate::noted;

/// A file that adds to the draft of the T-shirt, in its folder.
fn added(text: &str) -> Result<Pattern, String> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/patterns");
    let text = format!("length = \"mm\"\n[from]\nfile = \"teagan.json\"\n{text}");
    Pattern::parse(&Document::new(format!("{folder}/teagan-sewn.toml"), text))
        .map_err(|all| all.to_string())
}

#[test]
fn a_file_beside_a_draft_sews_it() {
    let text = r#"
[panel."teagan.front"]
grain = 45
fabric = "jersey"
origin = [0, 900, 200]
hems = { cbHem-hem = 20 }
[panel."teagan.sleeve"]
split = { hemRight-bicepsRight = [20] }
shift = [5, 0]
origin = [300, 1200, 0]
[panel.sleeve_l]
copy_of = "teagan.sleeve"
mirrored = true
[seam.side]
sides = [["teagan.front.hem-armhole"], ["teagan.back.hem-armhole mirrored"]]
max_ease = 1.05
allowance = 10
[seam.under]
sides = [["sleeve_l.hemRight-bicepsRight 2"], ["teagan.sleeve.hemRight-bicepsRight 2"]]
reversed = true
"#;
    let pattern = added(text).expect("it is right");
    let names: Vec<&str> = pattern.panels().iter().map(|p| p.name()).collect();
    assert_eq!(names, ["teagan.back", "teagan.front", "teagan.sleeve", "sleeve_l"]);
    let [_, front, sleeve, left] = pattern.panels() else { panic!("four panels") };
    assert!((front.grain().to_degrees() - 45.0).abs() < 1e-9 && front.fabric() == Some("jersey"));
    assert!((front.outline()[0].hem - 0.02).abs() < 1e-12);
    assert!((sleeve.area() - left.area()).abs() < 1e-12);
    let places =
        [sleeve, left].map(|panel| panel.placement().expect("it has one").point([0.0, 0.1]));
    assert!((places[0][0] + places[1][0]).abs() < 1e-12, "{places:?}");
    assert_eq!(pattern.seams().len(), 2);
    assert!(!noted(&pattern, "no seams") && noted(&pattern, "unfolded"));
    // A file that states its unit or has no sizes is not asked for them; and left out is left out.
    let less = added("[panel.\"teagan.sleeve\"]\nomit = true\n").expect("it is right");
    assert_eq!(less.panels().len(), 2);
    let said = |text: &str| added(text).expect_err("it is wrong");
    for (text, words) in [
        (
            "[panel.\"teagan.frnt\"]\ngrain = 3\n",
            vec!["no such panel", "\"teagan.front\"", "teagan-sewn.toml:4"],
        ),
        (
            "[seam.a]\nsides = [[\"teagan.front.hem-armhol\"], [\"teagan.back.hem-armhole\"]]\n",
            vec!["no edge", "teagan.front.hem-armhole"],
        ),
        ("[panel.\"teagan.front\"]\nhems = { x = 3 }\n", vec!["no edge \"x\"", "its edges are"]),
        (
            "[panel.\"teagan.front\"]\nsplit = { cbHem-hem = [900] }\n",
            vec!["is [900] mm", "between 0 and 297 mm"],
        ),
        (
            "[panel.x]\ncopy_of = \"teagan.slevee\"\n",
            vec!["no panel \"teagan.slevee\"", "\"teagan.sleeve\""],
        ),
        ("[panel.x]\nmirrored = true\nrectangle = [100, 100]\n", vec!["belongs to copy_of"]),
        (
            "[panel.x]\ncopy_of = \"teagan.back\"\nrectangle = [100, 100]\n",
            vec!["the panel has a shape"],
        ),
        ("[panel.\"teagan.front\"]\nshift = [nan, 0]\n", vec!["shift"]),
    ] {
        let said = said(text);
        assert!(words.iter().all(|word| said.contains(word)), "{words:?} are not in: {said}");
    }
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/patterns");
    let other = |text: &str| {
        let all = Pattern::parse(&Document::new(
            format!("{folder}/x.toml"),
            format!("length = \"mm\"\n{text}"),
        ));
        all.expect_err("it is wrong").to_string()
    };
    assert!(other("[from]\nfile = \"taegan.json\"\n").contains("there is no file"));
    assert!(other("[from]\nfile = \"x.toml\"\n").contains("other formats"));
    assert!(other("[from]\nfile = \"teagan.json\"\nunit = \"ell\"\n").contains("a unit is \"mm\""));
    assert!(
        other("[from]\nfile = \"teagan.json\"\nunit = \"mm\"\n").contains("leave the unit out")
    );
    assert!(other("[from]\nfile = \"teagan.json\"\nsize = \"M\"\n").contains("leave the size out"));
}

#[test]
fn a_seam_takes_the_place_of_that_of_its_name() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/patterns");
    let read = |text: &str| {
        let text = format!("length = \"mm\"\n[from]\nfile = \"skirt.json\"\n{text}");
        Pattern::parse(&Document::new(format!("{folder}/x.toml"), text))
            .map_err(|all| all.to_string())
    };
    let plain = read("").expect("it is right");
    let name = |id: EdgeId| {
        let panel = &plain.panels()[id.panel];
        format!("{}.{}", panel.name(), panel.outline()[id.edge].name)
    };
    let first = &plain.seams()[0];
    let (a, b) = (name(first.sides[0][0]), name(first.sides[1][0]));
    let sides = format!("sides = [[\"{a}\"], [\"{b}\"]]\nmax_ease = 1.5\nallowance = 12\n");
    let replaced = read(&format!("[seam.{}]\n{sides}", first.name)).expect("it is right");
    assert_eq!(replaced.seams().len(), plain.seams().len());
    let again = replaced.seams().iter().find(|s| s.name == first.name).expect("it is there");
    assert!(again.max_ease == 1.5 && (again.allowance - 0.012).abs() < 1e-12);
    let said = read(&format!("[seam.mine]\n{sides}")).expect_err("it is sewn twice");
    assert!(
        said.contains("is sewn twice") && said.contains(&format!("[seam.{}]", first.name)),
        "{said}"
    );
    let less =
        read(&format!("[panel.{}]\nomit = true\n", plain.panels()[0].name())).expect("it is right");
    assert!(
        less.notes()
            .iter()
            .any(|n| matches!(n, PatternNote::SeamsLeftOut { seams } if !seams.is_empty()))
    );
}
