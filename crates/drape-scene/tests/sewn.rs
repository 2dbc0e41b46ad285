//! Seams, grain and fabrics that a scene gives to the panels of a pattern.

use drape_input::Document;
use drape_scene::Scene;

const PATTERN: &str = "length = \"mm\"\n[panel.\"draft.front\"]\ngrain = 0\nrectangle = [100, 200]\n\
                       origin = [0, 0, 0]\n[panel.back]\ngrain = 0\nfabric = \"heavy\"\n\
                       rectangle = [100, 200]\norigin = [0, 0, -50]\n";

fn read(garment: &str) -> Result<Scene, String> {
    let fabric = |density: f64| {
        let yarn = "traction.primed = { stiffness = 5000, toe_ratio = 0.7, toe_strain = 0.01, \
                    toe_strain_after = 0.01 }\nbending.rigidity = 1e-5\n";
        format!(
            "name = \"plain\"\ndensity = {density}\nthickness = 0.0003\nshear.stiffness = 40\n\
             [warp]\n{yarn}[weft]\n{yarn}"
        )
    };
    let documents = [
        Document::new("heavy.toml", fabric(0.2)),
        Document::new("light.toml", fabric(0.1)),
        Document::new("pattern.toml", PATTERN),
    ];
    let text = format!(
        "length = \"mm\"\nspacing = 10\nfabric.heavy.file = \"heavy.toml\"\n\
         fabric.light.file = \"light.toml\"\n[[garment]]\npattern = \"pattern.toml\"\n\
         fabric = \"light\"\n{garment}\n[time]\nstep = 0.005\nend = 1\n"
    );
    let scene = Document::new("scene.toml", text);
    Scene::from_documents(&scene, &documents).map_err(|error| error.to_string())
}

#[test]
fn a_scene_sews_and_turns_what_its_pattern_does_not() {
    let plain = read("").expect("it is right");
    assert!(plain.sewing.is_none());
    let mass: f64 = plain.cloth.masses().iter().sum();
    assert!((mass - 0.02 * 0.3).abs() < 1e-12, "each panel of its own fabric: {mass} kg");
    let seam = "[garment.seam.side]\nsides = [[\"draft.front.right\"], [\"back.left\"]]\n";
    let sewn = read(seam).expect("it is right");
    assert_eq!(sewn.sewing.expect("it is sewn").seams[0].pairs.pairs.len(), 21);
    let turned = read("panel.\"draft.front\".grain = 45\n").expect("it is right");
    let front = |scene: &Scene| {
        let mut panels = scene.panels.iter();
        panels.find(|p| p.name == "draft.front").expect("there").lattice.coordinates().len()
    };
    assert_ne!(front(&turned), front(&plain), "a bias cut has a rim");
}

#[test]
fn an_edge_of_a_later_panel_is_held_by_its_own_particles() {
    let scene = read("[[pin]]\npanel = \"back\"\nedge = \"top\"\n").expect("it is right");
    let back = scene.panels.iter().find(|panel| panel.name == "back").expect("there");
    let height = |particle: usize| scene.start.positions[3 * particle + 1];
    let top = back.particles().map(height).fold(f64::NEG_INFINITY, f64::max);
    let held = &scene.pins[0].particles;
    assert_eq!(held.len(), 11, "10 mm apart along 100 mm");
    assert!(held.iter().all(|&own| back.particles().contains(&own) && height(own) == top));
}

#[test]
fn mistakes_of_such_seams_are_located_in_the_scene() {
    for (garment, words) in [
        (
            "[garment.seam.a]\nsides = [[\"draft.front.rigt\"], [\"back.left\"]]\n",
            "draft.front.right",
        ),
        ("[garment.seam.a]\nsides = [[\"draft.font.right\"], [\"back.left\"]]\n", "no panel"),
        ("[garment.seam.a]\nsides = [[\"draft.front.right\"], [\"back.top\"]]\n", "max_ease"),
        ("panel.\"draft.front\".grain = 999\n", "anticlockwise"),
    ] {
        let said = read(garment).expect_err("it is wrong");
        assert!(said.contains("scene.toml:") && said.contains(words), "{words:?}: {said}");
    }
}
