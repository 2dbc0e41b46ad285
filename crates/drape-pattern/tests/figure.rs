//! The picture of a cut pattern is sound SVG that shows all panels, seams and names.

use drape_pattern::{Cutter, Pattern, figure};

#[test]
fn the_picture_shows_every_panel_seam_and_name() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/patterns/pencil-skirt.toml");
    let pattern = Pattern::read(path).expect("it is sound");
    let cut = Cutter::new(0.02).cut(&pattern).expect("it can be cut");
    let svg = figure(&pattern, &cut);
    let document = roxmltree::Document::parse(&svg).expect("it is XML");
    let texts: Vec<&str> = document.descendants().filter_map(|n| n.text()).collect();
    for panel in pattern.panels() {
        assert!(texts.contains(&panel.name()));
        assert!(panel.outline().iter().all(|e| texts.contains(&e.name.as_str())));
    }
    // Side seams are drawn in two panels, the waist's in three, each dart and the end of the band in one.
    let colours: Vec<&str> = document.descendants().filter_map(|n| n.attribute("stroke")).collect();
    let mut own: Vec<&str> = colours
        .iter()
        .copied()
        .filter(|c| !["#ffffff", "#222222", "#9aa5b1", "#c9a27a"].contains(c))
        .collect();
    assert_eq!(own.len(), 2 * 2 + 3 + 5);
    own.sort_unstable();
    own.dedup();
    assert_eq!(own.len(), 8, "every stitch has its colour");
    assert!(!svg.contains("NaN") && !svg.contains("inf "));
}

#[test]
fn names_are_escaped() {
    let text = "length = \"cm\"\n[panel.\"a<b&c\"]\ngrain = 0\nrectangle = [30, 30]\n";
    let document = drape_input::Document::new("a.toml", text);
    let pattern = Pattern::parse(&document).expect("it is sound");
    let cut = Cutter::new(0.02).cut(&pattern).expect("it can be cut");
    let svg = figure(&pattern, &cut);
    let document = roxmltree::Document::parse(&svg).expect("it is XML");
    assert!(document.descendants().any(|n| n.text() == Some("a<b&c")));
}
