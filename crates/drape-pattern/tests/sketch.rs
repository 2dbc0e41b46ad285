//! The drawing of a pattern that is refused: what is wrong is red, the rest is not.

use drape_input::Document;
use drape_pattern::{Cutter, Error, Pattern, Sketch, SketchFault};

/// Colour of what is wrong.
const RED: &str = "#d11a1a";

/// A drawing of a pattern, by what is red in it.
#[derive(Debug)]
struct Red {
    /// Names of the edges.
    names: Vec<String>,
    /// Number of the circles about places, and of lines across gaps.
    places: usize,
    gaps: usize,
}

impl Red {
    fn of(svg: &str) -> Self {
        let document = roxmltree::Document::parse(svg).expect("it is XML");
        let of_class = |class: &str| {
            document.descendants().filter(|n| n.attribute("class") == Some(class)).count()
        };
        // The mistakes below the panels begin at the left.
        let names = document.descendants().filter(|n| {
            n.has_tag_name("text")
                && n.attribute("fill") == Some(RED)
                && !n.text().is_none_or(is_sentence)
        });
        let names = names.filter_map(|n| n.text().map(str::to_owned)).collect();
        Self { names, places: of_class("place"), gaps: of_class("gap") }
    }

    /// Reads a text that is refused, and returns what is red in its drawing.
    fn read(text: &str) -> Self {
        let document = Document::new("a.toml", text);
        let mistakes = Pattern::parse(&document).expect_err("it is wrong");
        let wrong = mistakes.0.iter().filter_map(|one| one.subject.clone());
        let wrong: Vec<SketchFault> =
            wrong.map(|subject| SketchFault { subject, at: None }).collect();
        assert!(!wrong.is_empty(), "{mistakes}");
        let svg = Sketch::parse(&document).figure(&wrong, &mistakes.0);
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{mistakes}");
        assert!(svg.matches(&mistakes.0[0].message[..30]).count() == 1, "{mistakes}");
        Self::of(&svg)
    }
}

/// Returns whether a text is a mistake and not the name of an edge.
fn is_sentence(text: &str) -> bool {
    text.len() > 30
}

const BOX: &str = "length = \"cm\"\n[panel.front]\ngrain = 0\nrectangle = [30, 40]\n\
                   [panel.back]\ngrain = 0\nrectangle = [30, 60]\n";

#[test]
fn edges_that_cross_are_red_with_a_circle_where_they_do() {
    let red = Red::read(
        "length = \"cm\"\n[panel.a]\ngrain = 0\nstart = [0, 0]\noutline = [\n\
         { to = [30, 0], name = \"hem\" }, { to = [0, 40], name = \"across\" },\n\
         { to = [30, 40], name = \"top\" }, { to = [0, 0], name = \"back\" }]\n\
         [panel.b]\ngrain = 0\nrectangle = [10, 10]\n",
    );
    assert_eq!(red.names, ["across", "back"]);
    assert_eq!((red.places, red.gaps), (1, 0));
}

#[test]
fn an_outline_that_does_not_close_has_its_gap_in_red() {
    let red = Red::read(
        "length = \"cm\"\n[panel.a]\ngrain = 0\nstart = [0, 0]\noutline = [\n\
         { to = [30, 0], name = \"hem\" }, { to = [30, 40], name = \"side\" },\n\
         { to = [4, 40], name = \"top\" }, { to = [0, 1], name = \"down\" }]\n",
    );
    assert_eq!((red.places, red.gaps), (1, 1));
    let words = |text: &str| red.names.iter().any(|name| name == text);
    assert!(words("down") || words("hem"), "{red:?}");
    assert!(!words("side") && !words("top"), "{red:?}");
}

#[test]
fn both_sides_of_a_seam_that_do_not_fit_are_red() {
    let red =
        Red::read(&format!("{BOX}[seam.side]\nsides = [[\"front.right\"], [\"back.left\"]]\n"));
    assert_eq!(red.names, ["left", "right"], "back, then front");
    let red = Red::read(&format!(
        "{BOX}[seam.side]\nsides = [[\"front.bottom\"], [\"back.bottom\"]]\n\
         [seam.round]\nsides = [[\"back.top\", \"front.top\"], [\"front.right\"]]\n"
    ));
    assert_eq!(red.names, ["top", "right", "top"], "back, then front");
}

#[test]
fn a_dart_that_leaves_its_panel_is_red_where_it_does() {
    let dart =
        "[[panel.front.dart]]\nname = \"waist\"\nfrom = [4, 20]\nto = [20, 20]\nwidth = 60\n";
    let red = Red::read(&BOX.replace("[panel.back]", &format!("{dart}widest = 10\n[panel.back]")));
    assert_eq!(red.names, ["bottom", "waist right 2"]);
    assert_eq!(red.places, 1);
}

#[test]
fn a_place_that_is_too_narrow_is_red_in_the_pattern_that_is_sound() {
    // A crescent 2 mm wide, whose sides are sampled at other places.
    let text = "length = \"cm\"\n[panel.a]\ngrain = 30\nstart = [0, 0]\noutline = [\n\
                { to = [30, 0], name = \"inner\", quadratic = [15, 20] },\n\
                { to = [21, 8.652], name = \"outer\", quadratic = [25.5, 6.18] },\n\
                { to = [0, 0], name = \"outer 2\", quadratic = [10.5, 14.42] }]\n\
                [panel.b]\ngrain = 0\nrectangle = [30, 30]\n";
    let pattern = Pattern::parse(&Document::new("a.toml", text)).expect("it is sound");
    let Err(Error::Pattern(all)) = Cutter::new(0.1).cut(&pattern) else { panic!("it is narrow") };
    let wrong: Vec<SketchFault> = all.iter().filter_map(SketchFault::from_mistake).collect();
    let red = Red::of(&Sketch::from_pattern(&pattern).figure(&wrong, &[]));
    assert_eq!(red.places, 1, "{all:?}");
    let others = ["left", "right", "top", "bottom"];
    assert!(red.names.iter().all(|name| !others.contains(&name.as_str())), "{red:?}");
}

#[test]
fn drawings_of_other_programs_are_drawn_too() {
    // A bow tie in SVG.
    let svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"40cm\" height=\"40cm\" viewBox=\"0 0 400 400\">\
               <path id=\"bow\" d=\"M10 10 L300 300 L300 10 L10 300 Z\"/></svg>";
    let document = Document::new("bow.svg", svg);
    let mistakes = Pattern::parse(&document).expect_err("it crosses itself");
    let wrong = mistakes.0.iter().filter_map(|one| one.subject.clone());
    let wrong: Vec<SketchFault> = wrong.map(|subject| SketchFault { subject, at: None }).collect();
    let red = Red::of(&Sketch::parse(&document).figure(&wrong, &mistakes.0));
    assert_eq!((red.names.len(), red.places), (2, 1), "{red:?}");
}

#[test]
fn what_lies_beyond_all_measure_is_not_drawn_and_the_rest_is() {
    for far in ["1e300", "4e5", "-1e200"] {
        let text = format!(
            "{BOX}[panel.far]\ngrain = 0\nstart = [0, 0]\noutline = [\n\
             {{ to = [30, 0], name = \"hem\" }}, {{ to = [{far}, 40] }}, {{ to = [0, 0] }}]\n"
        );
        let document = Document::new("a.toml", text);
        let mistakes = Pattern::parse(&document).expect_err("it is too far");
        let svg = Sketch::parse(&document).figure(&[], &mistakes.0);
        assert!(!svg.contains("inf") && !svg.contains("NaN"), "{svg}");
        assert!(
            ["front", "back", "far", "hem"].iter().all(|name| svg.contains(&format!(">{name}<")))
        );
        let parsed = roxmltree::Document::parse(&svg).expect("it is XML");
        let size = parsed.root_element().attribute("viewBox").expect("a size");
        let sides = size.split(' ').map(|side| side.parse::<f64>().expect("a number"));
        assert!(sides.fold(0.0, f64::max) < 5000.0, "{size}");
    }
}
