//! Seams whose edges are listed along their outlines, and the same seams listed backwards.

use drape_input::Document;
use drape_pattern::{CutPattern, Cutter, NodeId, Pattern};

use crate::invariants;

/// Two panels side by side, whose facing sides are divided in places that differ.
const SIDES: &str = r#"length = "mm"
[panel.a]
grain = 0
start = [0, 0]
outline = [
  { name = "bottom", to = [300, 0] },
  { name = "r1", to = [300, 100] },
  { name = "r2", to = [300, 160] },
  { name = "r3", to = [300, 300] },
  { name = "top", to = [0, 300] },
  { name = "left", to = [0, 0] },
]
[panel.b]
grain = 0
start = [0, 0]
outline = [
  { name = "bottom", to = [300, 0] },
  { name = "right", to = [300, 310] },
  { name = "top", to = [0, 310] },
  { name = "l2", to = [0, 150] },
  { name = "l1", to = [0, 0] },
]
"#;

/// A bodice of two panels above a skirt of two, with darts that meet at the waist. The side seams
/// join the panels of each. In path data y points down.
const WAIST: &str = r#"length = "mm"
[panel.bodice]
grain = 0
path = "M0 0 L100 0 L110 -80 L120 0 L220 0 L220 -200 L0 -200 Z"
edges = ["waist_l", "dart_l", "dart_r", "waist_r", "right", "top", "left"]
[panel.bodice_back]
grain = 0
path = "M0 0 L200 0 L200 -200 L0 -200 Z"
edges = ["waist", "right", "top", "left"]
[panel.skirt]
grain = 0
path = "M0 0 L230 0 L230 -300 L130 -300 L115 -180 L100 -300 L0 -300 Z"
edges = ["hem", "right", "waist_r", "dart_r", "dart_l", "waist_l", "left"]
[panel.skirt_back]
grain = 0
path = "M0 0 L200 0 L200 -300 L0 -300 Z"
edges = ["hem", "right", "waist", "left"]
[seam.bodice_dart]
sides = [["bodice.dart_l"], ["bodice.dart_r"]]
[seam.skirt_dart]
sides = [["skirt.dart_r"], ["skirt.dart_l"]]
[seam.bodice_side]
sides = [["bodice.right"], ["bodice_back.left"]]
[seam.skirt_side]
sides = [["skirt.right"], ["skirt_back.left"]]
"#;

fn cut(text: &str, seam: &str) -> (Pattern, CutPattern) {
    let text = format!("{text}[seam.join]\n{seam}\n");
    let pattern = Pattern::parse(&Document::new("pattern.toml", text));
    let pattern = pattern.unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let cut = Cutter::new(0.01).cut(&pattern).unwrap_or_else(|error| panic!("{error}"));
    invariants::check(&pattern, &cut);
    (pattern, cut)
}

/// Number of the seam that is listed in two ways.
fn joining(pattern: &Pattern) -> usize {
    pattern.seams().iter().position(|seam| seam.name == "join").expect("it is there")
}

/// Pairs of that seam, in any order.
fn pairs((pattern, cut): &(Pattern, CutPattern)) -> Vec<[NodeId; 2]> {
    let mut pairs = cut.seams[joining(pattern)].pairs.clone();
    pairs.sort();
    pairs
}

#[test]
fn a_seam_that_is_listed_backwards_is_sewn_as_the_seam_that_is_not() {
    for (crossed, along, against) in [
        (
            false,
            r#"sides = [["a.r1", "a.r2", "a.r3"], ["b.l1", "b.l2"]]"#,
            r#"sides = [["a.r3", "a.r2", "a.r1"], ["b.l2", "b.l1"]]"#,
        ),
        (
            false,
            r#"sides = [["b.l2", "b.l1"], ["a.r3", "a.r2", "a.r1"]]"#,
            r#"sides = [["b.l1", "b.l2"], ["a.r1", "a.r2", "a.r3"]]"#,
        ),
        // One edge has no order. On the other side of the panel, and right side on wrong side, the
        // lower end of one side is sewn to the upper end of the other.
        (
            true,
            r#"sides = [["a.r1", "a.r2", "a.r3"], ["b.right"]]"#,
            r#"sides = [["a.r3", "a.r2", "a.r1"], ["b.right"]]"#,
        ),
        (
            true,
            "reversed = true\nsides = [[\"a.r1\", \"a.r2\", \"a.r3\"], [\"b.l2\", \"b.l1\"]]",
            "reversed = true\nsides = [[\"a.r3\", \"a.r2\", \"a.r1\"], [\"b.l1\", \"b.l2\"]]",
        ),
    ] {
        let (one, other) = (cut(SIDES, along), cut(SIDES, against));
        assert_eq!(pairs(&one), pairs(&other), "{against}");
        let (one, other) = (one.1, other.1);
        assert!(one.seams[0].breaks.is_empty() && other.seams[0].breaks.is_empty(), "{against}");
        // Each pair is at one share of both sides: 300 mm and 310 mm.
        for pair in &one.seams[0].pairs {
            let height = |id: &NodeId| one.panels[id.panel].positions[id.node as usize][1];
            let [a, b] = pair.each_ref().map(height);
            let (a, b) = if pair[0].panel == 0 { (a, b) } else { (b, a) };
            let share = if crossed { 1.0 - b / 0.31 } else { b / 0.31 };
            assert!((a / 0.3 - share).abs() < 0.02, "{a} m on {b} m: {along}");
        }
    }
}

#[test]
fn a_waist_over_darts_that_meet_is_sewn_in_either_order_of_listing() {
    let along = r#"sides = [
        ["bodice.waist_l", "bodice.waist_r", "bodice_back.waist"],
        ["skirt.waist_l", "skirt.waist_r", "skirt_back.waist"]]"#;
    let against = r#"sides = [
        ["bodice_back.waist", "bodice.waist_r", "bodice.waist_l"],
        ["skirt_back.waist", "skirt.waist_r", "skirt.waist_l"]]"#;
    let (one, other) = (cut(WAIST, along), cut(WAIST, against));
    assert_eq!(pairs(&one), pairs(&other));
    // Both sides jump where the darts meet, and where the side seams do.
    let number = joining(&one.0);
    let ((_, one), (pattern, _)) = (one, other);
    let seam = &one.seams[number];
    assert_eq!(seam.breaks.len(), 2, "{:?}", seam.breaks);
    let place = |id: NodeId| one.panels[id.panel].positions[id.node as usize];
    let ends: Vec<_> = seam.breaks.iter().map(|&k| [k, k + 1].map(|k| seam.pairs[k])).collect();
    let mouths = ends[0].map(|pair| pair.map(|id| place(id)[0]));
    for (mouth, expected) in mouths.iter().flatten().zip([0.1, 0.1, 0.12, 0.13]) {
        assert!((mouth - expected).abs() < 1e-9, "{mouths:?}");
    }
    assert_eq!(ends[1].map(|pair| pair.map(|id| id.panel)), [[0, 2], [1, 3]]);
    let first = pattern.seams()[number].sides[0][0];
    assert_eq!((first.panel, first.edge), (0, 0), "it begins where the first outline does");
}

#[test]
fn what_is_listed_partly_backwards_is_sewn_as_it_is_listed() {
    // The sides contradict each other: the scene asks, when the panels have their places.
    let (pattern, _) = cut(SIDES, r#"sides = [["a.r3", "a.r2", "a.r1"], ["b.l1", "b.l2"]]"#);
    let [one, other] = &pattern.seams()[0].sides;
    assert_eq!([one[0].edge, other[0].edge], [3, 4]);
}
