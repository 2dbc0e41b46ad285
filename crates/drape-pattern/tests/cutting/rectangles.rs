//! Rectangles, along the grain and at an angle to it.

use drape_pattern::{Cutter, Edge, EdgeId, MAX_EASE, NodeId, Panel, Pattern, Quality, Seam};

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
    let seam = Seam {
        name: "seam".into(),
        sides,
        reversed: false,
        max_ease: 1.2,
        angle: 0.0,
        allowance: 0.0,
    };
    let pattern = Pattern::new(panels, vec![seam]).expect("it is sound");
    let cut = Cutter::new(0.01).cut(&pattern).expect("it can be cut");
    invariants::check(&pattern, &cut);
    assert!(cut.panels.iter().all(|p| p.triangles.is_empty()));
    assert_eq!(cut.seams[0].pairs.len(), 37);
    // The top of the first, from its right end, meets the bottom of the second, from its right end.
    let [top, bottom] = cut.seams[0].pairs[0];
    assert_eq!(cut.panels[0].positions[top.node as usize], [0.3, 0.2]);
    assert_eq!(cut.panels[1].positions[bottom.node as usize], [0.36, 0.0]);
}

#[test]
fn the_longer_side_of_a_gather_has_a_whole_number_of_arcs_for_each_of_the_shorter() {
    // Up to a ratio of 1.5 the longer side is counted. Then √(30 · 46/2) = 26.3, √(30 · 60/2) = 30,
    // √(30 · 78/3) = 27.9, √(30 · 120/4) = 30.
    let cases =
        [(0.42, 42, 1), (0.45, 45, 1), (0.46, 26, 2), (0.6, 30, 2), (0.78, 28, 3), (1.2, 30, 4)];
    for (long, arcs, fullness) in cases {
        let panels = vec![rectangle("band", [0.3, 0.1], 0.0), rectangle("full", [long, 0.2], 0.0)];
        let edge = |panel, edge| vec![EdgeId { panel, edge }];
        let (sides, name) = ([edge(0, 0), edge(1, 2)], "gather".into());
        let seam =
            Seam { name, sides, reversed: false, max_ease: MAX_EASE, angle: 0.0, allowance: 0.0 };
        let pattern = Pattern::new(panels, vec![seam]).expect("it is sound");
        let cut = Cutter::new(0.01).cut(&pattern).expect("it can be cut");
        invariants::check(&pattern, &cut);
        let seam = &cut.seams[0];
        assert_eq!(seam.pairs.len(), arcs + 1, "{long}");
        assert_eq!(seam.ties.len(), arcs * (fullness - 1), "{long}");
        assert_eq!([0, 1].map(|side| seam.side(side).count()), [arcs + 1, arcs * fullness + 1]);
        // Each is as far along its side as the place that it is sewn to.
        let along = |id: NodeId| cut.panels[id.panel].positions[id.node as usize][0];
        for tie in &seam.ties {
            assert_eq!(tie.side, 1);
            let [from, to] = [tie.after, tie.after + 1].map(|k| along(seam.pairs[k][0]));
            let place = from + tie.fraction * (to - from);
            assert!((along(tie.node) / long - place / 0.3).abs() < 1e-12, "{long}: {tie:?}");
        }
        assert_eq!(cut.notes, []);
        let nodes: usize = cut.panels.iter().map(|cut| cut.positions.len()).sum();
        assert_eq!(cut.particle_count(), nodes - (arcs * fullness + 1), "{long}");
        // Whole ratios keep the spacing on both sides, and with it the lattice.
        let grid = [0.42, 0.45, 0.6, 1.2].contains(&long);
        let gather = fullness > 1;
        for (panel, (cut, width)) in pattern.panels().iter().zip(cut.panels.iter().zip([0.3, long]))
        {
            // The free side of a gather keeps the spacing.
            let free = cut.edges[if panel.name() == "band" { 2 } else { 0 }].len() - 1;
            let expected = if gather { (width / 0.01_f64).round() as usize } else { arcs };
            assert_eq!(free, expected, "{long}: {}", panel.name());
            assert_eq!(cut.triangles.is_empty(), grid, "{long}: {}", panel.name());
            let quality = Quality::new(panel, cut, 0.01);
            assert!(
                quality.shortest_edge >= 0.6 && quality.longest_edge < 1.9,
                "{long}: {quality:?}"
            );
            assert!(quality.smallest_angle.to_degrees() >= 22.0, "{long}: {quality:?}");
            println!("{long}: {} {quality:?}", panel.name());
        }
    }
}

/// A rectangle with a point on its top and one on its bottom, at distances from its left side.
fn parted(name: &str, [x, y]: [f64; 2], [below, above]: [f64; 2]) -> Panel {
    let corners = [[0.0, 0.0], [below, 0.0], [x, 0.0], [x, y], [above, y], [0.0, y]];
    let names = ["bottom 1", "bottom 2", "right", "top 1", "top 2", "left"];
    let edge = |k: usize| Edge::line(names[k], corners[k], corners[(k + 1) % 6]);
    Panel::new(name, (0..6).map(edge).collect()).expect("it is sound")
}

fn sewn(name: &str, sides: [&[(usize, usize)]; 2]) -> Seam {
    let ids = |side: &[(usize, usize)]| {
        side.iter().map(|&(panel, edge)| EdgeId { panel, edge }).collect::<Vec<EdgeId>>()
    };
    let sides = sides.map(ids);
    let (name, max_ease) = (name.to_owned(), MAX_EASE);
    Seam { name, sides, reversed: false, max_ease, angle: 0.0, allowance: 0.0 }
}

#[test]
fn short_edges_are_joined_whichever_panel_a_seam_names_first() {
    // The top of the first meets the bottom of the second; of both the last 4 mm are an edge.
    let upper: &[(usize, usize)] = &[(1, 0), (1, 1)];
    let lower: &[(usize, usize)] = &[(0, 4), (0, 3)];
    let back = |side: &[(usize, usize)]| side.iter().rev().copied().collect::<Vec<_>>();
    let (from_upper, from_lower) = ([upper, lower], [&back(lower)[..], &back(upper)[..]]);
    for sides in [from_upper, from_lower] {
        let panels =
            ["lower", "upper"].map(|name| parted(name, [0.2, 0.1], [0.196, 0.196])).to_vec();
        let pattern = Pattern::new(panels, vec![sewn("seam", sides)]).expect("it is sound");
        let cut = Cutter::new(0.01).cut(&pattern).expect("it can be cut");
        invariants::check(&pattern, &cut);
        // Free sides have the spacing as well: 20 by 10 cells.
        let cells = |k: usize| (cut.panels[k].quads.len(), cut.panels[k].triangles.len());
        assert_eq!([cells(0), cells(1)], [(200, 0); 2]);
        let pairs = &cut.seams[0].pairs;
        assert_eq!(pairs.len(), 21);
        for (k, pair) in pairs.iter().enumerate() {
            let steps = if pair[0].panel == 1 { k } else { 20 - k };
            for id in pair {
                let [x, y] = cut.panels[id.panel].positions[id.node as usize];
                let height = if id.panel == 1 { 0.0 } else { 0.1 };
                assert!(
                    (x - 0.01 * steps as f64).abs() < 1e-12 && y == height,
                    "{x} {y}: {pair:?}"
                );
            }
        }
    }
}

#[test]
fn a_short_edge_at_the_meeting_of_three_panels_is_not_joined_across_their_seams() {
    // Each is sewn to both others along its top, and the seams meet in a point on each top. The
    // first and the second meet over 4 mm only.
    let panels = vec![
        parted("a", [0.2, 0.1], [0.1, 0.196]),
        parted("b", [0.2, 0.1], [0.1, 0.004]),
        parted("c", [0.392, 0.1], [0.2, 0.196]),
    ];
    let seams = vec![
        sewn("short", [&[(0, 3)], &[(1, 4)]]),
        sewn("one", [&[(0, 4)], &[(2, 3)]]),
        sewn("two", [&[(1, 3)], &[(2, 4)]]),
    ];
    let pattern = Pattern::new(panels, seams).expect("it is sound");
    let cut = Cutter::new(0.01).cut(&pattern).expect("it can be cut");
    invariants::check(&pattern, &cut);
    for (seam, (panels, pairs)) in cut.seams.iter().zip([([0, 1], 1), ([0, 2], 21), ([1, 2], 21)]) {
        assert_eq!(seam.pairs.len(), pairs);
        assert!(
            seam.pairs.iter().all(|pair| pair.map(|id| id.panel) == panels),
            "{:?}",
            seam.pairs
        );
    }
    let notes: Vec<String> = cut.notes.iter().map(ToString::to_string).collect();
    assert!(notes.len() == 1 && notes[0].contains("its ends are one particle"), "{notes:?}");
}
