//! Faults that are planted in frames: each is found, and the same frame without it holds.

#![allow(clippy::unwrap_used)]

use std::path::Path;

use drape_frames::samples::{SampleFrame, SampleRun};
use drape_verify::{Verdict, Verifier};

type Point = [f64; 3];

/// Mesh of a part: vertices, in m, and triangles.
#[derive(Clone)]
struct Shape {
    vertices: Vec<Point>,
    triangles: Vec<[usize; 3]>,
}

impl Shape {
    fn triangle(corners: [Point; 3]) -> Shape {
        Shape { vertices: corners.to_vec(), triangles: vec![[0, 1, 2]] }
    }

    /// Ball about the origin: an octahedron whose triangles are divided, with vertices on the
    /// sphere.
    fn ball(radius: f64) -> Shape {
        let axis = |k: usize, sign: f64| [0, 1, 2].map(|j| if j == k { sign } else { 0.0 });
        let mut faces: Vec<[Point; 3]> = Vec::new();
        for [x, y, z] in [[1.0, 1.0, 1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0], [1.0, -1.0, -1.0]]
        {
            faces.push([axis(0, x), axis(1, y), axis(2, z)]);
            faces.push([axis(0, -x), axis(2, -z), axis(1, -y)]);
        }
        for _ in 0..3 {
            let middle = |a: Point, b: Point| [0, 1, 2].map(|k| a[k] + b[k]);
            faces = faces
                .into_iter()
                .flat_map(|[a, b, c]| {
                    let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
                    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
                })
                .collect();
            for corner in faces.iter_mut().flatten() {
                let length = corner.iter().map(|x| x * x).sum::<f64>().sqrt();
                *corner = corner.map(|x| x / length);
            }
        }
        let mut ball = Shape { vertices: Vec::new(), triangles: Vec::new() };
        for face in faces {
            let numbers = face.map(|corner| {
                let place = corner.map(|x| radius * x);
                ball.vertices.iter().position(|other| *other == place).unwrap_or_else(|| {
                    ball.vertices.push(place);
                    ball.vertices.len() - 1
                })
            });
            ball.triangles.push(numbers);
        }
        ball
    }

    /// Square of two triangles at a height, whose front looks up.
    fn square(half: f64, height: f64) -> Shape {
        let corner = |x: f64, z: f64| [half * x, height, half * z];
        let vertices =
            vec![corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0)];
        Shape { vertices, triangles: vec![[0, 1, 2], [0, 2, 3]] }
    }
}

/// Frame with planted faults.
#[derive(Default)]
struct Planted {
    panels: Vec<Shape>,
    body: Option<Shape>,
    twins: &'static str,
    ties: &'static str,
    /// Half of the minimum separation, in m.
    separation: f64,
    /// Material coordinates, in m; metres apart if empty.
    material: Vec<[f64; 2]>,
}

impl Planted {
    /// Writes the frame as a run writes it, and verifies it.
    fn verify(&self) -> Verdict {
        let folder = tempfile::tempdir().unwrap();
        self.write(folder.path());
        Verifier::open(folder.path()).unwrap().verify(0).unwrap()
    }

    fn write(&self, folder: &Path) {
        let part = |shape: &Shape| {
            let (vertices, triangles) = (shape.vertices.len(), shape.triangles.len());
            let (reach, separation) = (4.0 * self.separation, self.separation);
            format!(
                r#"{{ "name": "part", "vertices": {vertices}, "triangles": {triangles}, "reach": {reach}, "separation": {separation} }}"#
            )
        };
        let panels: Vec<String> = self.panels.iter().map(part).collect();
        let bodies: Vec<String> = self.body.iter().map(part).collect();
        let (panels, bodies) = (panels.join(", "), bodies.join(", "));
        let Planted { twins, ties, .. } = self;
        let manifest = format!(
            r#"{{ "format": 2, "guarded": true, "panels": [{panels}], "bodies": [{bodies}], "twins": [{twins}], "ties": [{ties}] }}"#
        );
        let mut all = Shape { vertices: Vec::new(), triangles: Vec::new() };
        for panel in &self.panels {
            let first = all.vertices.len();
            all.vertices.extend(&panel.vertices);
            let shifted = panel.triangles.iter().map(|corners| corners.map(|k| k + first));
            all.triangles.extend(shifted);
        }
        let apart = |k: usize| [k as f64, (k * k) as f64];
        let material = if self.material.is_empty() {
            (0..all.vertices.len()).map(apart).collect()
        } else {
            self.material.clone()
        };

        let numbers = |shape: &Shape| -> Vec<[u32; 3]> {
            shape.triangles.iter().map(|corners| corners.map(|k| k as u32)).collect()
        };
        let bodies = self.body.as_ref().map_or(Vec::new(), |body| body.vertices.clone());
        let run = SampleRun {
            manifest,
            material,
            triangles: numbers(&all),
            body_triangles: self.body.as_ref().map_or(Vec::new(), numbers),
            frames: vec![SampleFrame { time: 0.0, cloth: all.vertices, bodies }],
        };
        run.write(folder).unwrap();
    }
}

#[test]
fn a_vertex_is_found_a_millimetre_a_micrometre_and_a_rounding_inside() {
    let height = 0.1_f64;
    let with_corner_at = |y: f64| {
        let corners = [[0.02, y, 0.03], [0.04, 0.2, 0.03], [0.02, 0.2, 0.05]];
        let body = Some(Shape::square(0.5, height));
        Planted { panels: vec![Shape::triangle(corners)], body, ..Planted::default() }.verify()
    };
    for inside in [height - 1e-3, height - 1e-6, height.next_down(), height] {
        let verdict = with_corner_at(inside);
        assert!(verdict.intersections > 0 && !verdict.holds(), "{verdict:?}");
    }
    for outside in [height.next_up(), height + 1e-6] {
        let verdict = with_corner_at(outside);
        assert!(verdict.holds() && verdict.intersections == 0, "{verdict:?}");
    }
}

#[test]
fn a_sheet_inside_a_ball_or_under_a_floor_is_found() {
    let sheet = |half: f64, height: f64| Shape::square(half, height);
    let inside = |shape: &Shape, body: &Shape| {
        let panels = vec![sheet(0.6, 3.0), shape.clone()];
        Planted { panels, body: Some(body.clone()), ..Planted::default() }.verify()
    };
    let ball = Shape::ball(0.2);
    for (half, height) in [(0.05, 0.0), (0.01, 0.19), (0.1, -0.1)] {
        let verdict = inside(&sheet(half, height), &ball);
        assert_eq!((verdict.intersections, verdict.enclosed.len()), (0, 1), "{verdict:?}");
        assert_eq!((verdict.enclosed[0].panel, verdict.enclosed[0].body), (1, 0));
        assert!(!verdict.holds());
    }
    for (half, height) in [(0.05, 0.21), (0.6, -0.21), (0.01, 0.2001)] {
        let verdict = inside(&sheet(half, height), &ball);
        assert!(verdict.holds(), "{verdict:?}");
    }
    let floor = Shape::square(50.0, 0.0);
    assert_eq!(inside(&sheet(0.1, -0.5), &floor).enclosed.len(), 1);
    assert!(inside(&sheet(0.1, 0.5), &floor).holds());
    // An open bowl has no inside.
    let mut bowl = ball.clone();
    let upper = |corners: &[usize; 3]| corners.iter().all(|&k| bowl.vertices[k][1] >= 0.0);
    let lower: Vec<_> = ball.triangles.iter().filter(|corners| !upper(corners)).copied().collect();
    bowl.triangles = lower;
    assert!(inside(&sheet(0.05, 0.0), &bowl).holds());
}

#[test]
fn triangles_on_each_other_in_one_plane_are_found() {
    let at = |x: f64| [[x, 0.1, 0.0], [x, 0.1, 0.1], [x + 0.1, 0.1, 0.0]];
    let with = |x: f64| {
        let panels = vec![Shape::triangle(at(0.0)), Shape::triangle(at(x))];
        Planted { panels, ..Planted::default() }.verify()
    };
    for over in [0.0, 0.05, 0.1] {
        assert_eq!(with(over).intersections, 1, "{over}");
    }
    assert!(with(0.1_f64.next_up()).holds());
}

#[test]
fn a_frame_is_verified_without_a_line_break_at_the_end_of_the_manifest() {
    let panels =
        [0.0, 0.05].map(|x| Shape::triangle([[x, 0.1, 0.0], [x, 0.1, 0.1], [x + 0.1, 0.1, 0.0]]));
    let planted = Planted { panels: panels.into(), ..Planted::default() };
    let folder = tempfile::tempdir().unwrap();
    planted.write(folder.path());
    let path = folder.path().join("surfaces.json");
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, text.trim_end()).unwrap();
    let verdict = Verifier::open(folder.path()).unwrap().verify(0).unwrap();
    let expected = planted.verify();
    assert_eq!((verdict.intersections, verdict.worst), (1, expected.worst));
}

#[test]
fn a_flat_fold_is_found() {
    let folded = |apex: Point| {
        let vertices = vec![[0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [0.05, 0.0, 0.1], apex];
        let panel = Shape { vertices, triangles: vec![[0, 1, 2], [1, 0, 3]] };
        Planted { panels: vec![panel], ..Planted::default() }.verify()
    };
    for flat in [[0.05, 0.0, 0.1], [0.03, 0.0, 0.05], [0.2, 0.0, 0.3]] {
        assert_eq!(folded(flat).intersections, 1, "{flat:?}");
    }
    for open in [[0.05, f64::MIN_POSITIVE, 0.1], [0.05, 0.0, -0.1], [0.05, 1e-3, 0.1]] {
        assert!(folded(open).holds(), "{open:?}");
    }
}

#[test]
fn sides_of_an_open_seam_that_cross_are_found() {
    // The lower edge of the second panel is sewn to the upper edge of the first.
    let first = [[0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [0.05, -0.1, 0.0]];
    let sewn = |edge: [Point; 2], apex: Point| {
        let second = [edge[0], edge[1], apex];
        let panels = vec![Shape::triangle(first), Shape::triangle(second)];
        Planted { panels, twins: "[0, 3], [1, 4]", separation: 1e-3, ..Planted::default() }.verify()
    };
    let apart = |y: f64, z: f64| [[0.0, y, z], [0.1, y, z]];
    // Closed, and open by 8 mm or by a hundredth of the separation.
    assert!(sewn(apart(0.0, 0.0), [0.05, 0.1, 0.0]).holds());
    for gap in [8e-3, 2e-5] {
        assert!(sewn(apart(gap, 0.0), [0.05, 0.1, 0.0]).holds(), "{gap}");
    }
    // The second panel goes through the first, 8 mm or one rounding beyond.
    for depth in [8e-3, 1e-6, f64::MIN_POSITIVE] {
        let verdict = sewn(apart(-0.05, -depth), [0.05, -0.05, 0.1]);
        assert_eq!(verdict.intersections, 1, "{depth}: {verdict:?}");
    }
    // Within the gap of a seam that counts as closed its sides may intersect, which is counted, and
    // beyond it not.
    let across =
        |gap: f64| sewn([[0.0, -gap, -0.1 * gap], [0.1, -gap, 0.1 * gap]], [0.05, 0.1, 0.0]);
    let within = across(5e-5);
    assert!(within.holds() && (within.intersections, within.exempt) == (0, 1), "{within:?}");
    // The edge rises by a tenth of the gap on both sides of the face.
    assert!((0.09..0.1001).contains(&(within.exempt_penetration / 5e-5)), "{within:?}");
    let beyond = across(2e-4);
    assert_eq!((beyond.intersections, beyond.exempt, beyond.exempt_penetration), (1, 0, 0.0));
    assert_eq!(across(0.0).exempt, 0, "its sides are joined");
    // One pair of twins has met, and the other side goes through.
    let verdict = sewn([[0.0, 0.0, 0.0], [0.06, -0.05, -0.01]], [0.05, -0.04, 0.1]);
    assert_eq!(verdict.intersections, 1, "{verdict:?}");
}

#[test]
fn a_tied_vertex_beyond_its_edge_is_counted_with_the_depth_of_its_triangle() {
    // The first corner of the second panel comes to lie on the upper edge of the first.
    let first = [[0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [0.05, -0.1, 0.0]];
    let tied = |y: f64, z: f64| {
        let second = [[0.05, y, z], [0.05, 0.1, 0.05], [0.06, 0.1, 0.05]];
        let panels = vec![Shape::triangle(first), Shape::triangle(second)];
        Planted { panels, ties: "[3, 0, 1]", separation: 1e-3, ..Planted::default() }.verify()
    };
    let behind = tied(-4e-5, -1e-5);
    assert!(behind.holds() && (behind.intersections, behind.exempt) == (0, 1), "{behind:?}");
    // The plane of the second rises along (y, z) behind the edge, and passes it at this distance.
    let [y, z] = [0.1 + 4e-5, 0.05 + 1e-5_f64];
    let depth = (1e-5 * y - 4e-5 * z).abs() / y.hypot(z);
    assert!((behind.exempt_penetration - depth).abs() < 1e-9 * depth, "{behind:?}");
    for [y, z] in [[-4e-5, 1e-5], [0.0, 0.0]] {
        assert_eq!((tied(y, z).intersections, tied(y, z).exempt), (0, 0), "{y} {z}");
    }
    assert_eq!(tied(-1.2e-4, -1e-5).intersections, 1);
}

#[test]
fn parts_of_a_panel_that_are_close_at_rest_keep_a_quarter_of_their_rest_distance() {
    // Two triangles with a slit of 1 mm between them at rest, where 2 mm are promised elsewhere.
    let material: Vec<[f64; 2]> =
        vec![[0.0, 0.0], [0.1, 0.0], [0.05, 0.1], [0.0, -1e-3], [0.05, -0.1], [0.1, -1e-3]];
    let at = |gap: f64| {
        let place = |&[u, v]: &[f64; 2]| [u, 0.0, if v == -1e-3 { -gap } else { v }];
        let vertices = material.iter().map(place);
        let panel = Shape { vertices: vertices.collect(), triangles: vec![[0, 1, 2], [3, 4, 5]] };
        let material = material.clone();
        Planted { panels: vec![panel], separation: 1e-3, material, ..Planted::default() }.verify()
    };
    assert!(at(3e-4).holds() && at(2.6e-4).holds(), "{:?}", at(3e-4));
    assert!(!at(2.4e-4).holds(), "{:?}", at(2.4e-4));
}

#[test]
fn seams_that_meet_in_a_corner_are_joined_there_in_whatever_order_they_are_listed() {
    // Three panels with their first corners at one point; the first and the last are not sewn
    // directly.
    let fan = |k: f64| Shape::triangle([[0.0; 3], [0.1, 0.05 * k, 0.1], [0.1, 0.05 * k, -0.1]]);
    let with = |twins| {
        let panels = [-1.0, 0.0, 1.0].map(fan).to_vec();
        Planted { panels, twins, ..Planted::default() }.verify()
    };
    for twins in ["[3, 6], [0, 3]", "[0, 3], [3, 6]", "[6, 3], [3, 0]"] {
        assert!(with(twins).holds(), "{twins}: {:?}", with(twins));
    }
    assert_eq!(with("[3, 6]").intersections, 2);
}

#[test]
fn a_frame_with_faults_of_several_kinds_does_not_hold() {
    let corner = |x: f64, y: f64| [[x, y, 0.0], [x + 0.1, y, 0.0], [x, y, 0.1]];
    let through = [[0.02, -0.05, 0.02], [0.02, 0.05, 0.02], [0.03, 0.05, 0.03]];
    let crossing = [corner(0.0, 0.0), through];
    let near = [corner(5.0, 0.0), corner(5.0, 1e-3)];
    let without_area = [[9.0, 0.0, 0.0], [9.1, 0.0, 0.0], [9.2, 0.0, 0.0]];
    let faults = |triangles: &[[Point; 3]]| {
        let panels = triangles.iter().copied().map(Shape::triangle).collect();
        let verdict = Planted { panels, separation: 1e-3, ..Planted::default() }.verify();
        assert!(!verdict.holds(), "{verdict:?}");
        [verdict.intersections, verdict.degenerate, verdict.too_near]
    };
    assert_eq!(faults(&[crossing, near].concat()), [1, 0, 1]);
    assert_eq!(faults(&[&near[..], &[without_area]].concat()), [0, 1, 1]);
    assert_eq!(faults(&[&crossing[..], &near[..], &[without_area]].concat()), [1, 1, 1]);
}

#[test]
fn the_place_of_a_pair_is_midway_between_its_closest_points() {
    let below = [[-1.0, 0.1, -1.0], [-1.0, 0.1, 2.0], [2.0, 0.1, -1.0]];
    let above = [[0.2, 0.101, 0.3], [0.3, 0.5, 0.3], [0.2, 0.5, 0.4]];
    let panels = [below, above].map(Shape::triangle).to_vec();
    let verdict = Planted { panels, separation: 1e-3, ..Planted::default() }.verify();
    let [pair] = &verdict.worst[..] else { panic!("{verdict:?}") };
    assert!((pair.distance - 1e-3).abs() < 1e-12, "{pair:?}");
    for (found, exact) in pair.point.into_iter().zip([0.2, 0.1005, 0.3]) {
        assert!((found - exact).abs() < 1e-12, "{pair:?}");
    }
}

#[test]
fn the_pair_with_the_smallest_part_of_its_separation_is_listed_first() {
    // Two triangles with a slit of 1 mm at rest keep 0.25 mm, and are 0.3 mm apart. A second panel
    // lies 1 mm over one of them, where 2 mm are promised.
    let slit = [[0.0, 0.0], [0.1, 0.0], [0.05, 0.1], [0.0, -1e-3], [0.05, -0.1], [0.1, -1e-3]];
    let at = |&[u, v]: &[f64; 2]| [u, 0.0, if v == -1e-3 { -3e-4 } else { v }];
    let vertices = slit.iter().map(at).collect();
    let first = Shape { vertices, triangles: vec![[0, 1, 2], [3, 4, 5]] };
    let over = [[0.04, 1e-3, 0.05], [0.05, 1e-3, 0.06], [0.06, 1e-3, 0.05]];
    let panels = vec![first, Shape::triangle(over)];
    let material = [&slit[..], &[[5.0, 5.0], [5.1, 5.0], [5.0, 5.1]]].concat();
    let verdict = Planted { panels, separation: 1e-3, material, ..Planted::default() }.verify();
    let parts: Vec<f64> =
        verdict.worst.iter().map(|pair| pair.distance / pair.min_separation).collect();
    let exact = [0.5, 1.2];
    assert!(parts.len() == 2 && verdict.too_near == 1, "{verdict:?}");
    assert!(parts.iter().zip(exact).all(|(a, b)| (a - b).abs() < 1e-9), "{parts:?}");
}

#[test]
fn of_pairs_without_a_promise_the_closest_is_listed_first() {
    // Two open seams, of which the first is wider.
    let below = |x: f64| [[x, 0.0, 0.0], [x + 0.1, 0.0, 0.0], [x + 0.05, -0.1, 0.0]];
    let above = |x: f64, gap: f64| [[x, gap, 0.0], [x + 0.1, gap, 0.0], [x + 0.05, 0.1, 0.0]];
    let panels = [below(0.0), above(0.0, 4e-3), below(1.0), above(1.0, 2e-3)];
    let panels = panels.map(Shape::triangle).to_vec();
    let twins = "[0, 3], [1, 4], [6, 9], [7, 10]";
    let verdict = Planted { panels, twins, separation: 1e-3, ..Planted::default() }.verify();
    assert!(verdict.holds(), "{verdict:?}");
    let found = verdict.worst.iter().map(|pair| [pair.distance, pair.min_separation]);
    assert_eq!(found.collect::<Vec<_>>(), [[2e-3, 0.0], [4e-3, 0.0]]);
}
