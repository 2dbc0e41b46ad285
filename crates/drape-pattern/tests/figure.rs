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
    // Side seams are drawn in two panels, the waist's in three, each dart and the end of the band
    // in one.
    let colours: Vec<&str> = document.descendants().filter_map(|n| n.attribute("stroke")).collect();
    let mut own: Vec<&str> = colours
        .iter()
        .copied()
        .filter(|c| !["#ffffff", "#222222", "#9aa5b1", "#c9a27a"].contains(c))
        .collect();
    assert_eq!(own.len(), 2 * 2 + 3 + 5);
    own.sort_unstable();
    own.dedup();
    assert_eq!(own.len(), 8, "every seam has its colour");
    assert!(!svg.contains("NaN") && !svg.contains("inf "));
}

#[test]
fn folds_are_dashed_within_their_panel_and_have_their_angle() {
    // A panel with an arm on either side; one line leaves it between the arms, one ends inside, one
    // lies outside.
    let text = "length = \"cm\"\n[panel.u]\ngrain = 0\nstart = [0, 0]\noutline = [\n\
                { to = [30, 0] }, { to = [30, 40] }, { to = [20, 40] }, { to = [20, 20] },\n\
                { to = [10, 20] }, { to = [10, 40] }, { to = [0, 40] }, { to = [0, 0] },\n]\n\
                [[panel.u.fold]]\nfrom = [-10, 30]\nto = [90, 30]\nangle = 90\n\
                [[panel.u.fold]]\nfrom = [5, -20]\nto = [5, 10]\nangle = -22.5\n\
                [[panel.u.fold]]\nfrom = [-5, -20]\nto = [-5, 10]\nangle = 30\n";
    let pattern = Pattern::parse(&drape_input::Document::new("a.toml", text)).expect("it is sound");
    let cut = Cutter::new(0.02).cut(&pattern).expect("it can be cut");
    let svg = figure(&pattern, &cut);
    let document = roxmltree::Document::parse(&svg).expect("it is XML");
    let dashed = document.descendants().filter(|n| n.attribute("stroke-dasharray").is_some());
    let lines: Vec<Vec<f64>> = dashed
        .map(|node| {
            let path = node.attribute("d").expect("a path").replace(['M', 'L'], " ");
            path.split_whitespace().map(|x| x.parse().expect("a number")).collect()
        })
        .collect();
    let [across, up] = &lines[..] else { panic!("{} folds", lines.len()) };
    // In mm, from the left side of the panel, and downwards from its upper one.
    let left = across[0];
    let expected = [left, across[1], left + 100.0, across[1], left + 200.0, across[1]];
    assert!(across[..6].iter().zip(expected).all(|(x, e)| (x - e).abs() < 0.11), "{across:?}");
    assert!(across.len() == 8 && (across[6] - left - 300.0).abs() < 0.11, "{across:?}");
    let top = across[1] - 100.0;
    let mut ends = [up[1] - top, up[3] - top];
    ends.sort_by(f64::total_cmp);
    assert!((ends[0] - 300.0).abs() < 0.11 && (ends[1] - 400.0).abs() < 0.11, "{up:?}");
    assert!(up.len() == 4 && (up[0] - left - 50.0).abs() < 0.11, "{up:?}");
    let texts: Vec<&str> = document.descendants().filter_map(|n| n.text()).collect();
    assert!(texts.contains(&"90°") && texts.contains(&"-22.5°") && !texts.contains(&"30°"));
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
