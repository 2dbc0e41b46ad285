//! The exact test of crossings against another exact test.

use crate::exact::apart;
use crate::sheets::{SKIN, surface};
use crate::support::Dice;
use drape_collide::{Crossing, SurfaceParts, crossings};
use std::collections::BTreeSet;

/// Triangles on a small lattice, seen from afar: most meet, touch or lie in one plane.
fn lattice(dice: &mut Dice, triangles: usize, cells: i64) -> Vec<[i64; 3]> {
    let mut coordinate = || ((dice.roll() + 1.0) * 0.5 * cells as f64) as i64;
    (0..3 * triangles).map(|_| [coordinate(), coordinate(), coordinate()]).collect()
}

fn compare(places: &[[i64; 3]], scale: f64, shift: f64) -> [usize; 2] {
    let triangles = places.len() / 3;
    // At rest they are all the same, in groups of their own.
    let rest = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let surface = surface(&SurfaceParts {
        rest: rest.iter().copied().cycle().take(3 * places.len()).collect(),
        triangles: (0..triangles as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect(),
        areas: vec![1.0; places.len()],
        group: (0..places.len() as u32).map(|v| v / 3).collect(),
        skins: vec![SKIN; triangles],
        free: places.len(),
        twins: Vec::new(),
    });
    let positions: Vec<f64> =
        places.as_flattened().iter().map(|&x| scale * x as f64 + shift).collect();
    let found = crossings(&surface, &positions).unwrap();
    assert!(found.is_sorted(), "{found:?}");
    let place = |v: u32| places[v as usize].map(i128::from);
    let mut all = BTreeSet::new();
    for (e, ends) in surface.edges().iter().enumerate() {
        for (t, corners) in surface.triangles().iter().enumerate() {
            let own = ends.iter().any(|end| corners.contains(end));
            if !own && !apart(&ends.map(place), &corners.map(place)) {
                all.insert(Crossing { edge: e as u32, triangle: t as u32 });
            }
        }
    }
    let found: BTreeSet<_> = found.into_iter().collect();
    assert_eq!(found, all, "{places:?}");
    [all.len(), surface.edges().len() * (triangles - 1) - all.len()]
}

#[test]
fn crossings_are_those_of_exact_separating_directions() {
    let mut dice = Dice::new(51);
    let (mut meeting, mut apart) = (0, 0);
    for case in 0..600 {
        let cells = [2, 3, 5, 1000][case % 4];
        let places = lattice(&mut dice, 5, cells);
        // All of these are exact in binary, so the doubles are the whole numbers.
        let (scale, shift) = [(1.0, 0.0), (2f64.powi(-30), 512.0), (64.0, -4096.0)][case % 3];
        let [met, missed] = compare(&places, scale, shift);
        (meeting, apart) = (meeting + met, apart + missed);
    }
    assert!(meeting > 5_000 && apart > 5_000, "{meeting} meet, {apart} do not");
}

#[test]
fn a_last_place_decides() {
    // A vertical edge that ends on the plane of a triangle, or one number above or below it.
    let square = [[0.0, 0.0, 0.1], [1.0, 0.0, 0.1], [0.0, 1.0, 0.1]];
    for (end, meets) in [(0.1, true), (0.1f64.next_up(), false), (0.1f64.next_down(), true)] {
        let other = [[0.3, 0.3, end], [0.3, 0.3, 1.0], [5.0, 5.0, 1.0]];
        let positions: Vec<f64> = square.iter().chain(&other).flatten().copied().collect();
        let surface = surface(&SurfaceParts {
            rest: positions.clone(),
            triangles: vec![[0, 1, 2], [3, 4, 5]],
            areas: vec![1.0; 6],
            group: vec![0, 0, 0, 1, 1, 1],
            skins: vec![SKIN; 2],
            free: 3,
            twins: Vec::new(),
        });
        let found = crossings(&surface, &positions).unwrap();
        assert_eq!(!found.is_empty(), meets, "the edge ends at {end}: {found:?}");
    }
}
