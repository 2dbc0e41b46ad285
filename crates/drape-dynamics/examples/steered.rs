//! Steers a sheet for 30 frames of 1/60 s, as a game does: a pin is led, the wind blows, gravity
//! changes, a body is led, and a particle is held and released. No file is written.

use drape_dynamics::{BodyTarget, Displacement, PinTarget, Simulation};
use drape_fabric::samples;
use drape_input::Document;
use drape_scene::Scene;

/// Flag of 40 cm × 40 cm that hangs by two corners beside a ball. A frame of 1/60 s has two steps.
const SCENE: &str = r#"
spacing = 0.02
fabric.plain.file = "heavy.toml"
panel = [{ name = "flag", fabric = "plain", rectangle = [0.4, 0.4] }]
contact.top_speed = 2
[[pin]]
panel = "flag"
points = [[0, 0.4]]
[[pin]]
panel = "flag"
points = [[0.4, 0.4]]
[[collider.sphere]]
name = "ball"
radius = 0.08
center = [0, 0, -0.14]
friction = 0.3
[time]
step = 0.008333333333333333
end = 1000
"#;

/// Number of frames.
const FRAMES: usize = 30;

/// Length of a frame, in s.
const FRAME: f64 = 1.0 / 60.0;

#[expect(clippy::print_stdout, reason = "an example shows its result")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let fabric = Document::new("heavy.toml", samples::HEAVY_WEAVE);
    let scene = Scene::from_documents(&Document::new("flag.toml", SCENE), &[fabric])?;
    let mut simulation = Simulation::new(scene)?;
    let start = simulation.saved();
    let coordinates = 3 * simulation.coordinates().len();
    let (mut positions, mut normals) = (vec![0.0_f32; coordinates], vec![0.0_f32; coordinates]);
    let corner = simulation.pin_particles(0)?[0];

    let mut hashes = Vec::new();
    for run in 0..2 {
        let mut held = None;
        for frame in 0..FRAMES {
            // The left corner moves out by 4 mm in each frame.
            let [x, y, z] = place(&simulation, corner);
            let target = [x - 0.004, y, z];
            simulation.lead_pin(0, &PinTarget::Place(target), FRAME)?;
            match frame {
                5 => simulation.set_air_velocity([0.0, 0.0, 3.0])?,
                12 => simulation.set_gravity([0.0, -3.7, 0.0])?,
                15 => {
                    let shift = [0.0, 0.0, 0.06];
                    let target =
                        BodyTarget::Rigid(Displacement { shift, ..Displacement::default() });
                    simulation.lead_body("ball", &target, 3.0 * FRAME)?;
                }
                18 => {
                    simulation.hold(&[0])?;
                    held = Some(place(&simulation, 0));
                }
                24 => {
                    assert_eq!(held, Some(place(&simulation, 0)), "it stays where it is held");
                    simulation.release(&[0])?;
                }
                _ => {}
            }
            simulation.step()?;
            simulation.step()?;
            simulation.write_vertices(&mut positions, &mut normals)?;

            let arrived = place(&simulation, corner);
            let miss = (0..3).map(|k| (arrived[k] - target[k]).abs()).fold(0.0, f64::max);
            assert!(miss < 1e-12, "the pin arrives in frame {frame}: {miss} m");
            let now = place(&simulation, 0);
            if run == 0 && frame % 6 == 5 {
                println!(
                    "frame {:2}: pin at x = {:.4} m, lower corner at ({:.4}, {:.4}, {:.4}) m",
                    frame + 1,
                    arrived[0],
                    now[0],
                    now[1],
                    now[2]
                );
            }
        }
        let energy = simulation.energy().expect("the scene keeps a balance");
        assert!(energy.residual.abs() < 1e-6 * energy.work_in.abs(), "{energy:?}");
        assert_eq!(simulation.summary().contact.intersections, 0);
        assert!(Some(place(&simulation, 0)) != held, "it moves after its release");
        hashes.push(simulation.state_hash());
        simulation.resume(start.clone())?;
    }
    assert_eq!(hashes[0], hashes[1], "a reset run repeats its bytes");
    println!("{FRAMES} frames twice, reset in memory: both end with the same bytes");
    Ok(())
}

/// Returns the position of `particle`, in m.
fn place(simulation: &Simulation, particle: usize) -> [f64; 3] {
    std::array::from_fn(|axis| simulation.positions()[3 * particle + axis])
}
