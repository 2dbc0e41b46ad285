//! Patterns in DXF: what stands in the file, and what comes back from it.

use drape_pattern::{Curve, Pattern};

use crate::{OWN, read, shipped};

/// Entity of a file: its kind, its layer, and its pairs.
struct Entity<'a> {
    kind: &'a str,
    layer: &'a str,
    pairs: Vec<(i32, &'a str)>,
}

impl<'a> Entity<'a> {
    /// Returns the entities of `text`, which is read pair by pair.
    fn all(text: &'a str) -> Vec<Self> {
        let lines: Vec<&str> = text.lines().collect();
        let mut all: Vec<Self> = Vec::new();
        for pair in lines.chunks_exact(2) {
            let code: i32 = pair[0].parse().expect("a group code");
            match (code, all.last_mut()) {
                (0, _) => all.push(Self { kind: pair[1], layer: "", pairs: Vec::new() }),
                (8, Some(last)) => last.layer = pair[1],
                (code, Some(last)) => last.pairs.push((code, pair[1])),
                _ => panic!("{pair:?} stands before the first entity"),
            }
        }
        all
    }

    /// Returns the number of the group `code`.
    fn number(&self, code: i32) -> f64 {
        let value = self.pairs.iter().find(|pair| pair.0 == code).expect("it has the group");
        value.1.parse().expect("a number")
    }

    /// Returns the points of the entities of `all` with a kind and a layer, in mm.
    fn points(all: &[Self], kind: &str, layer: &str) -> Vec<[f64; 2]> {
        let chosen = all.iter().filter(|entity| entity.kind == kind && entity.layer == layer);
        chosen.map(|entity| [entity.number(10), entity.number(20)]).collect()
    }
}

#[test]
fn a_rectangle_stands_in_the_file_as_the_standard_says() {
    let text = "length = \"cm\"\n[panel.\"Ärmel \\\\ 1\"]\ngrain = 90\nstart = [-10, 5]\nfabric = \"serge\"\n\
                outline = [{ to = [20, 5], notches = [12] }, { to = [20, 45] }, { to = [-10, 45] }, { to = [-10, 5] }]\n\
                [[panel.\"Ärmel \\\\ 1\".fold]]\nfrom = [-10, 20]\nto = [20, 20]\nangle = 90\n";
    let pattern = read("sleeve.toml", text);
    let drawing = pattern.to_dxf("blouse 12");
    assert!(drawing.text.is_ascii());
    let all = Entity::all(&drawing.text);
    let corners = [[-100.0, 50.0], [200.0, 50.0], [200.0, 450.0], [-100.0, 450.0]];
    assert_eq!(Entity::points(&all, "VERTEX", "1"), corners);
    assert_eq!(Entity::points(&all, "POINT", "2"), corners);
    assert_eq!(Entity::points(&all, "POINT", "3"), [[0.0; 2]; 0]);
    assert_eq!(Entity::points(&all, "POINT", "4"), [[20.0, 50.0]]);

    // The grain line lies along x, from right to left: 90° anticlockwise from y.
    let grain = all.iter().find(|e| (e.kind, e.layer) == ("LINE", "7")).expect("a grain line");
    assert_eq!(grain.number(20), grain.number(21));
    assert!(grain.number(11) < grain.number(10), "the second end is the tip");
    let fold = all.iter().find(|e| (e.kind, e.layer) == ("LINE", "8")).expect("a fold");
    assert_eq!([10, 20, 11, 21].map(|code| fold.number(code)), [-100.0, 200.0, 200.0, 200.0]);

    let texts: Vec<&str> = all
        .iter()
        .filter(|entity| entity.kind == "TEXT")
        .filter_map(|entity| entity.pairs.iter().find(|pair| pair.0 == 1))
        .map(|pair| pair.1)
        .collect();
    assert_eq!(
        texts,
        [
            r"PIECE NAME: \U+00C4rmel \U+005C 1",
            "SIZE: ONE",
            "QUANTITY: 1",
            "MATERIAL: serge",
            "STYLE NAME: blouse 12",
            "SAMPLE SIZE: ONE",
            "UNITS: METRIC",
            "CURVE TOLERANCE: 0.1"
        ]
    );
    assert_eq!(drawing.notes.len(), 1, "{:?}", drawing.notes);
    assert!(drawing.notes[0].to_string().contains("the angles of 1 folds"), "{:?}", drawing.notes);

    let again = read("again.dxf", &drawing.text);
    assert_eq!(again.panels()[0].name(), "Ärmel \\ 1");
}

#[test]
fn shipped_patterns_come_back_from_dxf_within_its_tolerance() {
    let files = ["shirt.json", "skirt.json", "trousers.json", "teagan.json", "pencil-skirt.toml"];
    let all = files.map(|name| (name, shipped(name)));
    for (name, text) in all.iter().map(|(n, t)| (*n, t.as_str())).chain([("own.toml", OWN)]) {
        let pattern = read(name, text);
        let drawing = pattern.to_dxf("style");
        let again = read("again.dxf", &drawing.text);
        assert_eq!(pattern.panels().len(), again.panels().len(), "{name}");
        for panel in pattern.panels() {
            let other = again.panels().iter().find(|p| p.name() == panel.name());
            let other = other.unwrap_or_else(|| panic!("{name}: no {}", panel.name()));
            // Every point of an outline is near the other outline. Corners, grain and the number of
            // notches are the same.
            let off = farthest(panel, other).max(farthest(other, panel));
            assert!(off < 2e-4, "{name}, {}: {off} m", panel.name());
            let turned = (panel.grain() - other.grain()).sin().abs();
            assert!(turned < 1e-5, "{name}, {}: {turned}", panel.name());
            let notches = |panel: &drape_pattern::Panel| -> usize {
                panel.outline().iter().map(|edge| edge.notches.len()).sum()
            };
            assert_eq!(notches(panel), notches(other), "{name}, {}", panel.name());
            assert!((panel.area() / other.area() - 1.0).abs() < 1e-3, "{name}, {}", panel.name());
        }
        // A straight edge stays one.
        let straight = |pattern: &Pattern| {
            let edges = pattern.panels().iter().flat_map(drape_pattern::Panel::outline);
            edges.filter(|edge| edge.curve == Curve::Line && edge.length() > 0.01).count()
        };
        assert_eq!(straight(&pattern), straight(&again), "{name}");
    }
}

/// Largest distance of a point of the outline of `panel` from the outline of `other`, in m. The
/// origins of both frames are moved to the low corners of the outlines.
fn farthest(panel: &drape_pattern::Panel, other: &drape_pattern::Panel) -> f64 {
    let sampled = |panel: &drape_pattern::Panel, count: u32| -> Vec<[f64; 2]> {
        let edges = panel.outline().iter();
        let points: Vec<[f64; 2]> = edges
            .flat_map(|edge| (0..count).map(|k| edge.at(f64::from(k) / f64::from(count))))
            .collect();
        let low = [0, 1].map(|axis| points.iter().map(|p| p[axis]).fold(f64::MAX, f64::min));
        points.iter().map(|p| [p[0] - low[0], p[1] - low[1]]).collect()
    };
    let near = sampled(other, 4000);
    let distances = sampled(panel, 40).into_iter().map(|p| {
        let apart = near.iter().map(|q| (p[0] - q[0]).hypot(p[1] - q[1]));
        apart.fold(f64::MAX, f64::min)
    });
    distances.fold(0.0, f64::max)
}

#[test]
fn notes_name_what_the_file_cannot_say() {
    let notes = read("own.toml", OWN).to_dxf("own").notes;
    let notes: Vec<String> = notes.iter().map(ToString::to_string).collect();
    for words in [
        "1 seams, and the names of edges",
        "allowances and hems of up to 30.0 mm",
        "panel front: the angles of 1 folds",
        "the places of panels in space",
    ] {
        assert!(notes.iter().any(|note| note.contains(words)), "{words}: {notes:#?}");
    }
}

#[test]
fn blocks_of_panels_with_like_names_are_apart() {
    let panels: String =
        ["sleeve left", "sleeve-left", "SLEEVE_LEFT", &"long ".repeat(12), &"long_".repeat(12)]
            .iter()
            .map(|name| format!("[panel.\"{name}\"]\ngrain = 0\nrectangle = [200, 300]\n"))
            .collect();
    let pattern = read("many.toml", &format!("length = \"mm\"\n{panels}"));
    let drawing = pattern.to_dxf("many");
    let all = Entity::all(&drawing.text);
    let mut names: Vec<&str> = all
        .iter()
        .filter(|entity| entity.kind == "BLOCK")
        .filter_map(|entity| entity.pairs.iter().find(|pair| pair.0 == 2).map(|pair| pair.1))
        .collect();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), 5, "{names:?}");
    assert!(names.iter().all(|name| name.len() <= 31), "{names:?}");
    assert_eq!(read("again.dxf", &drawing.text).panels().len(), 5);
}
