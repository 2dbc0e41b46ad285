//! Seam between whose sides a corner of another panel is held: where its particles are merged.

use std::f64::consts::SQRT_2;

use drape_dynamics::{Simulation, Status};
use drape_input::Document;
use drape_scene::Scene;

use crate::layers::FABRIC;

/// Two pieces of 60 × 30 mm one below the other, with 8 mm between the edges that are sewn.
const PATTERN: &str = r#"length = "mm"
[panel.upper]
grain = 0
start = [-30, 0]
outline = [
    { name = "sewn", to = [30, 0] },
    { name = "right", to = [30, 30] },
    { name = "top", to = [-30, 30] },
    { name = "left", to = [-30, 0] },
]
origin = [0, 4, 0]
[panel.lower]
grain = 0
start = [-30, -30]
outline = [
    { name = "bottom", to = [30, -30] },
    { name = "right", to = [30, 0] },
    { name = "sewn", to = [-30, 0] },
    { name = "left", to = [-30, -30] },
]
origin = [0, -4, 0]
[seam.middle]
sides = [["upper.sewn"], ["lower.sewn"]]
"#;

/// The pieces, with a level panel that is held between them: its size, in m, its turn about the
/// vertical, in degrees, and the place of its middle in front of the pieces, in m.
fn pieces(size: [f64; 2], turn: f64, front: f64) -> Simulation {
    let text = format!(
        "spacing = 0.01\nfabric.plain.file = \"plain.toml\"\n\
         [[garment]]\npattern = \"pieces.toml\"\nfabric = \"plain\"\n\
         [[panel]]\nname = \"between\"\nfabric = \"plain\"\nrectangle = {size:?}\n\
         turn = [-90, {turn}, 0]\ncenter = [0, 0, {front}]\n\
         [[pin]]\npanel = \"between\"\npoints = [[0.01, 0.01]]\nradius = 1\n\
         [[pin]]\npanel = \"upper\"\nedge = \"top\"\n\
         [time]\nstep = 0.005\nend = 20\n[settle]\n"
    );
    // Rough cloth, which does not slip off.
    let fabric = FABRIC.replace("thickness", "surface_friction = 0.6\nthickness");
    let documents = [Document::new("plain.toml", fabric), Document::new("pieces.toml", PATTERN)];
    let scene = Scene::from_documents(&Document::new("scene.toml", &text), &documents).unwrap();
    Simulation::new(scene).unwrap()
}

#[test]
fn a_seam_that_a_corner_keeps_open_is_merged_beside_it() {
    // A square of 20 mm, whose corner is behind the pieces by 1 to 5 mm.
    for behind in [0.001, 0.002, 0.003, 0.005] {
        let mut simulation = pieces([0.02, 0.02], 45.0, 0.01 * SQRT_2 - behind);
        let summary = simulation.run(&mut ()).unwrap();
        assert_eq!((summary.status, summary.contact.intersections), (Status::Ok, 0), "{behind} m");
        assert!(
            summary.warnings.iter().any(|warning| warning.contains(
                "other cloth is between its sides, so particles there are displaced by up to "
            )),
            "{:?}",
            summary.warnings
        );
    }
}

#[test]
fn a_seam_that_a_whole_panel_keeps_open_ends_the_run() {
    let mut simulation = pieces([0.1, 0.04], 0.0, 0.0);
    let summary = simulation.run(&mut ()).unwrap();
    assert_eq!((summary.status, summary.contact.intersections), (Status::SeamsOpen, 0));
    let reason = summary.reason.unwrap();
    assert!(reason.contains("between its sides"), "{reason}");
}
