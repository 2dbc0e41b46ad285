//! Lets a curtain swing for a fifth of a second and checks the balance of its energy.

use drape_dynamics::{Simulation, Status};
use drape_fabric::samples;
use drape_input::Document;
use drape_scene::Scene;

/// Half a metre of cloth, horizontal at the start, held at two corners.
const SCENE: &str = r#"
spacing = 0.02
fabric.plain.file = "heavy.toml"
[[panel]]
name = "curtain"
fabric = "plain"
rectangle = [0.5, 0.5]
turn = [-90, 0, 0]
noise = { amplitude = 1e-4, seed = 1 }
[[pin]]
panel = "curtain"
points = [[0, 0.5], [0.5, 0.5]]
[time]
step = 0.004
end = 0.2
"#;

#[expect(clippy::print_stdout, reason = "an example shows its result")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let fabric = Document::new("heavy.toml", samples::HEAVY_WEAVE);
    let scene = Scene::from_documents(&Document::new("curtain.toml", SCENE), &[fabric])?;
    let summary = Simulation::new(scene)?.run(&mut ())?;
    assert_eq!(summary.status, Status::Ok);

    let energy = summary.energy.expect("the scene does not switch it off");
    println!(
        "{} steps: the fall gave {:.4} J; {:.4} J are kinetic, {:.4} J elastic, the air took {:.4} J; {:.0e} J are \
         unaccounted for",
        summary.steps,
        -energy.gravity,
        energy.kinetic,
        energy.elastic,
        energy.air_dissipated,
        energy.residual
    );
    assert!(-energy.gravity > 0.05, "it falls");
    assert!(energy.residual.abs() < 1e-9 * energy.kinetic, "every joule is accounted for");
    Ok(())
}
