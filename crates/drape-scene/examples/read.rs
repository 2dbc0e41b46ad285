//! Reads a scene from a TOML string and prints what it understood, in SI units.

use drape_fabric::samples;
use drape_input::Document;
use drape_scene::{Error, Scene};

const SCENE: &str = r#"
name = "cloth on a ball"
length = "cm"
spacing = 1
fabric.plain.file = "plain.toml"
[[panel]]
name = "cloth"
fabric = "plain"
rectangle = [30, 20]
center = [0, 12, 0]
turn = [-90, 0, 0]
[[collider.sphere]]
name = "ball"
radius = 10
[time]
step = 0.005
end = 5
[settle]
"#;

#[expect(clippy::print_stdout, reason = "an example shows its result")]
fn main() -> Result<(), Error> {
    let fabric = Document::new("plain.toml", samples::PLAIN_WEAVE);
    let scene =
        Scene::from_documents(&Document::new("ball.toml", SCENE), std::slice::from_ref(&fabric))?;

    let mass: f64 = scene.cloth.masses().iter().sum();
    let relaxation = scene.schedule.relaxation.expect("the scene has [settle]");
    println!(
        "\"{}\": {} particles of {mass:.4} kg on {} body; at rest below {} m/s and {} g",
        scene.name,
        scene.cloth.particle_count(),
        scene.bodies.len(),
        relaxation.speed,
        relaxation.residual,
    );
    assert_eq!(scene.cloth.particle_count(), 31 * 21);
    assert!((mass - 0.3 * 0.2 * 0.12).abs() < 1e-12, "area times mass per area");

    // A mistake is answered with the file, the line, the value and a remedy.
    let wrong = SCENE.replace("fabric = \"plain\"", "fabric = \"plane\"");
    let error = Scene::from_documents(&Document::new("ball.toml", wrong), &[fabric]);
    let message = error.expect_err("there is no such fabric").to_string();
    println!("{message}");
    assert!(message.contains("ball.toml:8") && message.contains("plain"));
    Ok(())
}
