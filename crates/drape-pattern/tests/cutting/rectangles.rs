use drape_pattern::{Cutter, Edge, EdgeId, MAX_EASE, Panel, Pattern, Quality, Stitch};

use crate::invariants;

fn rectangle(name: &str, [x, y]: [f64; 2], grain: f64) -> Panel {
    let corners = [[0.0, 0.0], [x, 0.0], [x, y], [0.0, y]];
    let edges = (0..4).map(|k| {
        Edge::line(["bottom", "right", "top", "left"][k], corners[k], corners[(k + 1) % 4])
    });
    let panel = Panel::new(name, edges.collect()).expect("it is sound");
    panel.with_grain(grain.to_radians()).expect("it is finite")
}

#[test]
fn a_rectangle_along_the_grain_is_all_lattice() {
    for (grain, columns, rows) in [(0.0, 20, 50), (90.0, 50, 20), (180.0, 20, 50)] {
        let panels = vec![rectangle("strip", [0.2, 0.5], grain)];
        let pattern = Pattern::new(panels, vec![]).expect("it is sound");
        let cut = Cutter::new(0.0101).cut(&pattern).expect("it can be cut");
        invariants::check(&pattern, &cut);
        let strip = &cut.panels[0];
        assert!(strip.triangles.is_empty());
        assert_eq!(strip.quads.len(), columns * rows);
        assert_eq!(strip.positions.len(), (columns + 1) * (rows + 1));
        // Row by row from the lowest along weft and warp.
        assert_eq!(strip.lattice[columns + 1], Some([0, 1]));
        let spacing = [0.2 / 20.0, 0.5 / 50.0];
        assert!((strip.spacing[0] - spacing[0]).abs() < 1e-12, "{:?}", strip.spacing);
        assert_eq!(strip.edges.iter().map(Vec::len).collect::<Vec<_>>(), [21, 51, 21, 51]);
        assert_eq!(strip.hard.iter().filter(|h| **h).count(), 4);
    }
}

#[test]
fn a_rectangle_on_the_bias_has_a_rim() {
    let panels = vec![rectangle("strip", [0.05, 0.2], 45.0)];
    let pattern = Pattern::new(panels, vec![]).expect("it is sound");
    let cut = Cutter::new(0.01).cut(&pattern).expect("it can be cut");
    invariants::check(&pattern, &cut);
    assert!(!cut.panels[0].triangles.is_empty() && !cut.panels[0].quads.is_empty());
}

#[test]
fn rectangles_sewn_with_fullness_stay_lattices_with_equal_counts() {
    let panels = vec![rectangle("a", [0.3, 0.2], 0.0), rectangle("b", [0.36, 0.1], 0.0)];
    let edge = |panel, edge| vec![EdgeId { panel, edge }];
    let sides = [edge(0, 2), edge(1, 0)];
    let stitch = Stitch {
        name: "seam".into(),
        sides,
        reversed: false,
        max_ease: 1.2,
        angle: 0.0,
        allowance: 0.0,
    };
    let pattern = Pattern::new(panels, vec![stitch]).expect("it is sound");
    let cut = Cutter::new(0.01).cut(&pattern).expect("it can be cut");
    invariants::check(&pattern, &cut);
    assert!(cut.panels.iter().all(|p| p.triangles.is_empty()));
    assert_eq!(cut.seams[0].len(), 37);
    // The top of the first, from its right end, meets the bottom of the second, from its right end.
    let [top, bottom] = cut.seams[0][0];
    assert_eq!(cut.panels[0].positions[top.node as usize], [0.3, 0.2]);
    assert_eq!(cut.panels[1].positions[bottom.node as usize], [0.36, 0.0]);
}

#[test]
fn both_sides_of_a_gather_have_the_nodes_of_their_geometric_mean() {
    let long = [0.42, 0.45, 0.46, 0.6, 0.75];
    // Up to a ratio of 1.5 the longer side is counted: 42 and 45 arcs. Then √(30 · 46) = 37.1, 42.4, 47.4.
    for (long, arcs) in long.into_iter().zip([42, 45, 37, 42, 47]) {
        let panels = vec![rectangle("band", [0.3, 0.1], 0.0), rectangle("full", [long, 0.2], 0.0)];
        let edge = |panel, edge| vec![EdgeId { panel, edge }];
        let (sides, name) = ([edge(0, 0), edge(1, 2)], "gather".into());
        let stitch =
            Stitch { name, sides, reversed: false, max_ease: MAX_EASE, angle: 0.0, allowance: 0.0 };
        let pattern = Pattern::new(panels, vec![stitch]).expect("it is sound");
        let cut = Cutter::new(0.01).cut(&pattern).expect("it can be cut");
        invariants::check(&pattern, &cut);
        assert_eq!(cut.seams[0].len(), arcs + 1, "{long}");
        assert_eq!(cut.notes, []);
        let gather = long > 0.45;
        for (panel, (cut, width)) in pattern.panels().iter().zip(cut.panels.iter().zip([0.3, long]))
        {
            // The free side of a gather keeps the spacing, and the lattice with it.
            let free = cut.edges[if panel.name() == "band" { 2 } else { 0 }].len() - 1;
            let expected = if gather { (width / 0.01_f64).round() as usize } else { arcs };
            assert_eq!(free, expected, "{long}: {}", panel.name());
            assert_eq!(cut.triangles.is_empty(), !gather, "{long}: {}", panel.name());
            let quality = Quality::new(panel, cut, 0.01);
            assert!(quality.shortest >= 0.6 && quality.longest < 2.0, "{long}: {quality:?}");
            assert!(quality.sharpest.to_degrees() >= 22.0, "{long}: {quality:?}");
            println!("{long}: {} {quality:?}", panel.name());
        }
    }
}
