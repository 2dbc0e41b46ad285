//! A skirt without a file: its pattern is two panels in memory, its body a mesh in memory. It is
//! sewn, and then a program leads a pin, lets a wind blow and changes the body for 30 frames.

use std::error::Error;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;
use std::time::Instant;

use drape_collide::Triangulation;
use drape_dynamics::{BodyTarget, Displacement, PhaseName, PinTarget, Simulation};
use drape_fabric::samples;
use drape_pattern::Error::Pattern as Mistakes;
use drape_pattern::{Edge, EdgeId, Panel, Pattern, Placement, Seam};
use drape_scene::{FabricSpec, GarmentSpec, MeshSpec, PinSpec, SceneSpec};

/// Width and height of a panel, and radius of the cylinder on which it starts, in m.
const WIDTH: f64 = 0.36;
const HEIGHT: f64 = 0.3;
const START_RADIUS: f64 = 0.125;

/// Radius of the body in m, and factor by which the radius grows.
const RADIUS: f64 = 0.09;
const GROWTH: f64 = 1.06;

/// Length of a frame, in s, and steps in it.
const FRAME: f64 = 1.0 / 60.0;
const STEPS: usize = 2;

/// Returns the panel `name` of the skirt, turned about the y axis by `angle`, in rad.
fn panel(name: &str, angle: f64) -> Result<Panel, Box<dyn Error>> {
    let half = 0.5 * WIDTH;
    let corners = [[-half, 0.0], [half, 0.0], [half, HEIGHT], [-half, HEIGHT]];
    let names = ["hem", "right", "waist", "left"];
    let edge = |k: usize| Edge::line(names[k], corners[k], corners[(k + 1) % 4]);
    let panel = Panel::new(name, (0..4).map(edge).collect()).map_err(Mistakes)?;
    let origin = [START_RADIUS * angle.sin(), 0.0, START_RADIUS * angle.cos()];
    let placement = Placement::new([0.0, angle, 0.0], origin).with_wrap(Some(START_RADIUS));
    Ok(panel.with_placement(placement)?)
}

/// Returns the seam `name` of the edge `first` of the front and the edge `second` of the back.
fn seam(name: &str, first: usize, second: usize) -> Seam {
    let sides = [vec![EdgeId { panel: 0, edge: first }], vec![EdgeId { panel: 1, edge: second }]];
    Seam { name: name.into(), sides, reversed: false, max_ease: 1.1, angle: 0.0, allowance: 0.0 }
}

/// Returns a closed cylinder of 24 sides about the y axis, as a program has it.
fn body() -> Triangulation {
    const SIDES: u32 = 24;
    let ring = |y: f64| {
        (0..SIDES).map(move |k| {
            let (sine, cosine) = (TAU * f64::from(k) / f64::from(SIDES)).sin_cos();
            [RADIUS * sine, y, RADIUS * cosine]
        })
    };
    let ends = [[0.0, -0.1, 0.0], [0.0, 0.4, 0.0]];
    let vertices = ring(-0.1).chain(ring(0.4)).chain(ends).collect();
    let side = |k: u32| {
        let next = (k + 1) % SIDES;
        let [low, high] = [2 * SIDES, 2 * SIDES + 1];
        [
            [k, next, SIDES + next],
            [k, SIDES + next, SIDES + k],
            [low, next, k],
            [high, SIDES + k, SIDES + next],
        ]
    };
    Triangulation { vertices, triangles: (0..SIDES).flat_map(side).collect() }
}

/// Returns the scene: the skirt hangs by the middles of its waist around the body.
fn scene() -> Result<SceneSpec, Box<dyn Error>> {
    let panels = vec![panel("front", 0.0)?, panel("back", PI)?];
    let seams = vec![seam("right", 1, 3), seam("left", 3, 1)];
    let pattern = Pattern::new(panels, seams).map_err(Mistakes)?;

    let mut spec = SceneSpec { spacing: 0.03, ..SceneSpec::default() };
    let file = Arc::new(samples::plain_weave_with_friction()).into();
    spec.fabric.insert("weave".into(), FabricSpec { file, ..FabricSpec::default() });
    spec.garment.push(GarmentSpec {
        name: Some("skirt".into()),
        pattern: Arc::new(pattern).into(),
        fabric: "weave".into(),
        ..GarmentSpec::default()
    });
    for panel in ["skirt.front", "skirt.back"] {
        spec.pin.push(PinSpec {
            panel: panel.into(),
            points: vec![[0.0, HEIGHT]],
            radius: Some(0.05),
            ..PinSpec::default()
        });
    }
    let file = Arc::new(body()).into();
    spec.collider.mesh.push(MeshSpec { name: Some("body".into()), file, ..MeshSpec::default() });
    spec.sew.seconds = 0.1;
    spec.time.step = FRAME / STEPS as f64;
    spec.time.end = 1000.0;
    spec.contact.top_speed = Some(1.0);
    Ok(spec)
}

fn main() -> Result<(), Box<dyn Error>> {
    let begin = Instant::now();
    let mut simulation = Simulation::new(scene()?.build()?)?;
    while simulation.planned_phases()[0].name == PhaseName::Sew {
        simulation.step()?;
    }
    let sewn = 1e3 * begin.elapsed().as_secs_f64();

    let begin = Instant::now();
    let led = simulation.pin_particles(0)?[0];
    let height = simulation.positions()[3 * led + 1];
    let shift = [0.0, 0.001, 0.0];
    for frame in 0..30 {
        // The front of the waist rises by 1 mm a frame.
        let target = Displacement { shift, ..Default::default() };
        simulation.lead_pin(0, &PinTarget::Rigid(target), FRAME)?;
        if frame == 5 {
            simulation.set_air_velocity([4.0, 0.0, 0.0])?;
        }
        if frame == 10 {
            let mut wider = simulation.bodies().swap_remove(0).1.vertices;
            wider.iter_mut().for_each(|[x, _, z]| (*x, *z) = (GROWTH * *x, GROWTH * *z));
            simulation.lead_body("body", &BodyTarget::Vertices(wider), 10.0 * FRAME)?;
        }
        for _ in 0..STEPS {
            simulation.step()?;
        }
    }
    let milliseconds = 1e3 * begin.elapsed().as_secs_f64() / 30.0;

    // The pin rose by 30 mm, the body has its new size, and the cloth is outside of it.
    let rise = simulation.positions()[3 * led + 1] - height;
    assert!((rise - 0.03).abs() < 1e-12, "the pin rose by {rise} m");
    let wide = |[x, _, z]: &[f64; 3]| x.hypot(*z);
    let body = simulation.bodies().swap_remove(0).1;
    let largest = body.vertices.iter().map(wide).fold(0.0, f64::max);
    assert!((largest / (GROWTH * RADIUS) - 1.0).abs() < 1e-12, "the body is {largest} m wide");
    let summary = simulation.summary();
    assert_eq!(summary.contact.intersections, 0);
    let energy = simulation.energy().ok_or("a balance")?;
    assert!(energy.residual.abs() < 1e-4 * energy.work_in.abs(), "{energy:?}");
    println!(
        "a skirt of {} particles, sewn in {sewn:.0} ms, a frame: {milliseconds:.1} ms",
        summary.particles
    );
    Ok(())
}
