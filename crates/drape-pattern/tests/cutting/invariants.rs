//! Properties of every cut of every pattern.

use std::collections::BTreeMap;

use drape_pattern::{Cut, CutPattern, NodeId, Panel, Pattern};

/// Twice the area of a polygon, from its first corner.
fn twice_area(points: &[[f64; 2]]) -> f64 {
    let arm = |k: usize| [points[k][0] - points[0][0], points[k][1] - points[0][1]];
    let cross = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
    (1..points.len() - 1).map(|k| cross(arm(k), arm(k + 1))).sum()
}

/// Checks the properties of every cut of every pattern.
pub fn check(pattern: &Pattern, cut: &CutPattern) {
    assert_eq!(pattern.panels().len(), cut.panels.len());
    for (panel, cut) in pattern.panels().iter().zip(&cut.panels) {
        assert_eq!(panel.name(), cut.panel);
        tiling(cut);
        clearance(cut);
        frames(cut, panel.grain());
        edges(panel, cut);
    }
    seams(pattern, cut);
}

/// Cells and triangles lie anticlockwise, fill the sampled outline, and meet side to side.
fn tiling(cut: &Cut) {
    let at = |node: &u32| cut.positions[*node as usize];
    let faces: Vec<&[u32]> = cut
        .quads
        .iter()
        .map(|q| q.as_slice())
        .chain(cut.triangles.iter().map(|t| t.as_slice()))
        .collect();
    let whole: f64 =
        cut.lines().map(|line| twice_area(&line.iter().map(at).collect::<Vec<_>>())).sum();
    let mut sum = 0.0;
    let mut sides: BTreeMap<[u32; 2], usize> = BTreeMap::new();
    let mut used = vec![false; cut.positions.len()];
    for face in faces {
        let corners: Vec<[f64; 2]> = face.iter().map(at).collect();
        let area = twice_area(&corners);
        assert!(area > 0.0, "{}: face {face:?} has twice the area {area}", cut.panel);
        sum += area;
        for k in 0..face.len() {
            *sides.entry([face[k], face[(k + 1) % face.len()]]).or_default() += 1;
            used[face[k] as usize] = true;
        }
    }
    assert!((sum / whole - 1.0).abs() < 1e-10, "{}: areas {sum} and {whole}", cut.panel);
    assert!(used.iter().all(|u| *u), "{}: a node is in no face", cut.panel);
    assert!(sides.values().all(|n| *n == 1), "{}: a side is in two faces", cut.panel);
    for line in cut.lines() {
        for (k, (&a, &b)) in line.iter().zip(line.iter().cycle().skip(1)).enumerate() {
            assert_eq!(sides.remove(&[a, b]), Some(1), "{}: side {k} of a line", cut.panel);
        }
    }
    for [a, b] in sides.keys() {
        assert!(sides.contains_key(&[*b, *a]), "{}: {a} {b} has one face", cut.panel);
    }
}

/// Edges at nodes of the lattice are 0.6 spacings long or more.
fn clearance(cut: &Cut) {
    let least = 0.6 * cut.spacing[0] * (1.0 - 1e-9);
    for triangle in &cut.triangles {
        for k in 0..3 {
            let [a, b] = [triangle[k], triangle[(k + 1) % 3]].map(|n| n as usize);
            let [p, q] = [cut.positions[a], cut.positions[b]];
            let length = (p[0] - q[0]).hypot(p[1] - q[1]);
            let inner = cut.lattice[a].is_some() || cut.lattice[b].is_some();
            assert!(!inner || length >= least, "{}: {length} under {least}", cut.panel);
        }
    }
}

/// Both frames hold the same nodes, and cells are rectangles along the yarns.
fn frames(cut: &Cut, grain: f64) {
    let (sine, cosine) = grain.sin_cos();
    let far = cut.positions.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
    let tolerance = 1e-13 * far + 1e-9 * cut.spacing[0].min(cut.spacing[1]);
    for (p, q) in cut.positions.iter().zip(&cut.yarns) {
        let [x, y] = [cosine * q[0] - sine * q[1], sine * q[0] + cosine * q[1]];
        assert!((x - p[0]).abs() < tolerance && (y - p[1]).abs() < tolerance, "{p:?} {q:?}");
    }
    for quad in &cut.quads {
        let [a, b, c, d] = quad.map(|n| cut.yarns[n as usize]);
        let [u, v] = cut.spacing;
        for (p, offset) in [(b, [u, 0.0]), (c, [u, v]), (d, [0.0, v])] {
            let error = [p[0] - a[0] - offset[0], p[1] - a[1] - offset[1]];
            assert!(error.iter().all(|e| e.abs() < tolerance), "{quad:?} {error:?}");
        }
        let [p, q, r, s] = quad.map(|n| cut.lattice[n as usize].expect("it is of the lattice"));
        let [x, y] = p;
        assert_eq!([q, r, s], [[x + 1, y], [x + 1, y + 1], [x, y + 1]]);
    }
}

/// The nodes of edges run along the closed lines, and each edge begins where the one before it
/// ends.
fn edges(panel: &Panel, cut: &Cut) {
    let mut all = cut.edges.as_slice();
    for (line, own) in cut.lines().zip(panel.loops()) {
        let place = |node: u32| line.iter().position(|k| *k == node).expect("it is on the line");
        let (edges, rest) = all.split_at(own.len());
        for (k, edge) in edges.iter().enumerate() {
            let next = &edges[(k + 1) % edges.len()];
            assert_eq!(edge.last(), next.first(), "{}: after edge {k}", cut.panel);
            for pair in edge.windows(2) {
                let after = (place(pair[0]) + 1) % line.len();
                assert_eq!(after, place(pair[1]), "{}: edge {k}", cut.panel);
            }
        }
        let arcs: usize = edges.iter().map(|e| e.len() - 1).sum();
        assert_eq!(arcs, line.len(), "{}: the edges make the line", cut.panel);
        all = rest;
    }
    assert!(all.is_empty(), "{}: each edge is on a line", cut.panel);
}

/// Both sides of seams advance by one node at a time, in their senses, or leave for another panel.
fn seams(pattern: &Pattern, cut: &CutPattern) {
    assert_eq!(cut.seams.len(), pattern.seams().len());
    for (seam, nodes_of_seam) in pattern.seams().iter().zip(&cut.seams) {
        let on_side = |side: usize| -> Vec<(usize, u32)> {
            let ids = seam.sides[side].iter();
            ids.flat_map(|id| cut.panels[id.panel].edges[id.edge].iter().map(|n| (id.panel, *n)))
                .collect()
        };
        let allowed = [on_side(0), on_side(1)];
        for tie in &nodes_of_seam.ties {
            assert!(
                tie.fraction > 0.0
                    && tie.fraction < 1.0
                    && tie.after + 1 < nodes_of_seam.pairs.len()
            );
            let [from, to] =
                [tie.after, tie.after + 1].map(|k| nodes_of_seam.pairs[k][1 - tie.side]);
            assert!(from.panel == to.panel && from != to, "{}: {tie:?}", seam.name);
        }
        for (side, allowed) in allowed.iter().enumerate() {
            let nodes: Vec<NodeId> = nodes_of_seam.side(side).collect();
            for &NodeId { panel, node } in &nodes {
                // An edge that was joined with a neighbour lends its nodes to another seam.
                let joined = cut.notes.iter().any(|n| n.to_string().contains("half the spacing"));
                let own = joined || allowed.contains(&(panel, node));
                assert!(own, "{}: node {node} of {panel}", seam.name);
            }
            for two in nodes.windows(2) {
                let [from, to] = [two[0], two[1]];
                let mut lines = cut.panels[from.panel].lines();
                let outline = lines.find(|line| line.contains(&from.node)).expect("on a line");
                let place = |n: u32| outline.iter().position(|k| *k == n).expect("on the line");
                if from.panel == to.panel && outline.contains(&to.node) {
                    let (a, b) = (place(from.node), place(to.node));
                    let (a, b) = if side == 0 || seam.reversed { (a, b) } else { (b, a) };
                    let step = (b + outline.len() - a) % outline.len();
                    assert!(step <= 1 || seam.sides[side].len() > 1, "{}: {two:?}", seam.name);
                }
            }
        }
    }
}
