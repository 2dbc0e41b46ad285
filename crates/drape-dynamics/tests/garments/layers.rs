//! Garments over each other: where layers start, and which starts are refused.

use std::f64::consts::PI;

use drape_dynamics::{Simulation, Status};
use drape_fabric::samples;
use drape_input::Document;
use drape_scene::{Error, Scene};

use crate::tube;

pub(crate) const FABRIC: &str = samples::PLAIN_WEAVE;

/// Two tubes round a post on a plate, one of which is called inner and one outer, with more said of
/// each.
fn tubes(inner: &str, outer: &str, more: &str) -> Result<Scene, Error> {
    let garment = |name: &str, more: &str| {
        format!(
            "[[garment]]\nname = \"{name}\"\npattern = \"tube.toml\"\nfabric = \"plain\"\n{more}\n"
        )
    };
    let text = format!(
        "spacing = 0.01\nfabric.plain.file = \"plain.toml\"\n{}{}\
         [[collider.cylinder]]\nname = \"post\"\nradius = 0.03\nheight = 0.2\nfriction = 0.3\n\
         [[collider.cylinder]]\nname = \"plate\"\nradius = 0.15\nheight = 0.02\ncenter = [0, -0.12, 0]\nfriction = 0.3\n\
         [time]\nstep = 0.005\nend = 20\n{more}\n",
        garment("inner", inner),
        garment("outer", outer)
    );
    let documents =
        [Document::new("plain.toml", FABRIC), Document::new("tube.toml", tube(180, 80))];
    Scene::from_documents(&Document::new("scene.toml", &text), &documents)
}

/// Distances of the particles of a panel from the axis of the post, in m.
fn radii(scene: &Scene, name: &str) -> Vec<f64> {
    let panel = scene.panels.iter().find(|panel| panel.name == name).unwrap();
    let own = panel.particles();
    let own = 3 * own.start..3 * own.end;
    scene.start.positions[own].chunks_exact(3).map(|x| x[0].hypot(x[2])).collect()
}

fn refused(scene: Result<Scene, Error>) -> String {
    match scene {
        Err(Error::Tangled(tangle)) => tangle.mistakes.to_string(),
        Err(other) => other.to_string(),
        Ok(_) => panic!("it is accepted"),
    }
}

#[test]
fn a_layer_starts_two_centimetres_outside_of_the_one_below() {
    for (layer, radius) in [("", 0.1), ("[garment.panel.front]\nlayer = 3", 0.14)] {
        let scene = tubes("", &format!("layer = 1\n{layer}"), "").unwrap();
        assert!(radii(&scene, "inner.front").iter().all(|r| (r - 0.08).abs() < 1e-12));
        assert!(radii(&scene, "outer.front").iter().all(|r| (r - radius).abs() < 1e-12));
        assert!(radii(&scene, "outer.back").iter().all(|r| (r - 0.1).abs() < 1e-12));
        assert_eq!(scene.source.note_lines(), [""; 0]);
    }
}

#[test]
fn garments_that_cross_are_told_that_there_are_layers() {
    let message = refused(tubes("", "", ""));
    assert!(message.contains("\"inner.back\" and \"outer.back\""), "{message}");
    assert!(message.contains("higher layer"), "{message}");
}

#[test]
fn a_higher_layer_that_starts_inside_a_lower_one_is_refused() {
    // Of the outer tube the front alone is bent to a radius of 40 mm, 60 mm with its layer.
    let smaller = "layer = 1\n[garment.panel.front]\nwrap = 0.04\ncenter = [0, 0, 0.04]";
    let message = refused(tubes("", smaller, ""));
    assert!(message.contains("\"outer.front\" of layer 1 starts inside \"inner."), "{message}");
    assert!(message.contains("of layer 0") && message.contains("raise its layer"), "{message}");
    assert!(message.contains("scene.toml:12"), "{message}");
    assert!(!message.contains("outer.back"), "{message}");
    // With the layer that it needs it is accepted.
    tubes("", &smaller.replace("layer = 1", "layer = 3"), "").unwrap();
    let message = refused(tubes("layer = 1", &smaller.replace("layer = 1", "layer = 2"), ""));
    assert!(message.contains("\"outer.front\" of layer 2 starts inside \"inner."), "{message}");
}

#[test]
fn a_layer_that_is_none_is_refused_at_its_line() {
    for (outer, more, said) in [
        ("layer = -1", "", ["scene.toml:12", "-1 is not between 0 and 20"]),
        ("layer = 21", "", ["scene.toml:12", "0 is next to the body"]),
        ("[garment.panel.back]\nlayer = 99", "", ["scene.toml:13", "99 is not between"]),
        ("layer = 1", "[contact]\nsurfaces = false", ["scene.toml:12", "does not meet cloth"]),
    ] {
        let message = refused(tubes("", outer, more));
        assert!(said.iter().all(|said| message.contains(said)), "{outer}: {message}");
        assert_eq!(message.matches("garment[1]").count(), 1, "{message}");
    }
}

#[test]
fn two_tubes_are_sewn_round_each_other_and_the_outer_one_stays_outside() {
    let scene = tubes("", "layer = 1", "[settle]\n").unwrap();
    let own = |name: &str| {
        let panel = scene.panels.iter().find(|panel| panel.name == name).unwrap();
        panel.particles()
    };
    let [inner, outer] = ["inner", "outer"]
        .map(|name| ["front", "back"].map(|panel| own(&format!("{name}.{panel}"))));
    let mut simulation = Simulation::new(scene).unwrap();
    let summary = simulation.run(&mut ()).unwrap();
    assert_eq!((summary.status, summary.settled), (Status::Ok, true), "{:?}", summary.reason);
    assert_eq!(summary.contact.intersections, 0);
    // Their girths are the same, so that they press on each other, or the inner one has a dent:
    // every particle of the outer one is farther from the axis than the inner one is beside it,
    // half a centimetre up or down, in the same direction.
    let positions = simulation.positions().to_vec();
    let places = |panels: [std::ops::Range<usize>; 2]| -> Vec<[f64; 3]> {
        let polar = |x: &[f64]| [x[2].atan2(x[0]), x[1], x[0].hypot(x[2])];
        panels
            .into_iter()
            .flatten()
            .map(|particle| polar(&positions[3 * particle..][..3]))
            .collect()
    };
    let [inner, outer] = [inner, outer].map(places);
    for [turn, height, radius] in outer {
        // The nearest on both sides: how far round, and their distances from the axis.
        let mut beside = [(f64::INFINITY, f64::NAN); 2];
        for [other, _, radius] in
            inner.iter().filter(|[_, other, _]| (other - height).abs() < 0.005)
        {
            let gap = (other - turn + PI).rem_euclid(2.0 * PI) - PI;
            let side = &mut beside[usize::from(gap > 0.0)];
            if gap.abs() < side.0 {
                *side = (gap.abs(), *radius);
            }
        }
        let [(before, a), (after, b)] = beside;
        let inside = (a * after + b * before) / (before + after);
        assert!(radius > inside, "{radius} m and {inside} m at {turn} and {height} m");
    }
}
