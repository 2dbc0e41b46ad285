//! What a scene says is what is simulated, and what it says wrongly is answered at its place.
#![allow(clippy::unwrap_used)]

use drape_fabric::samples;
use drape_input::Document;
use drape_scene::{Error, Integrator, Method, Scene, View};

/// Returns the text of the fabric.
fn fabric() -> String {
    format!("surface_friction = 0.25\n{}", samples::PLAIN_WEAVE)
}

const LEAST: &str = r#"fabric.plain.file = "plain.toml"
[[panel]]
name = "towel"
fabric = "plain"
rectangle = [0.2, 0.3]
[time]
step = 0.004
end = 0.1
"#;

fn read(text: &str) -> Result<Scene, Error> {
    let fabric = Document::new("plain.toml", fabric());
    Scene::from_documents(&Document::new("towel.toml", text), &[fabric])
}

/// A scene in which one line is replaced, or one is added at the end.
fn with(old: &str, new: &str) -> String {
    assert!(old.is_empty() || LEAST.contains(old), "{old}");
    if old.is_empty() { format!("{LEAST}{new}\n") } else { LEAST.replace(old, new) }
}

#[test]
fn what_is_not_said_has_its_default() {
    let scene = read(LEAST).unwrap();
    assert_eq!(scene.name, "unnamed");
    assert_eq!(scene.cloth.particle_count(), 21 * 31, "10 mm apart");
    assert_eq!(scene.environment.gravity, [0.0, -9.81, 0.0]);
    assert!((scene.environment.air - 0.5 * 1.2 * 1.28).abs() < 1e-15);
    assert_eq!(
        (scene.schedule.clock.step, scene.schedule.clock.tick(), scene.schedule.clock.end_ticks()),
        (0.004, 0.004, 25)
    );
    assert_eq!(
        (
            scene.schedule.clock.ticks_per_frame,
            scene.schedule.clock.ticks_max,
            scene.schedule.clock.error
        ),
        (10, 1, None)
    );
    assert_eq!((scene.schedule.clock.ramp, scene.schedule.relaxation), (0.0, None));
    assert!(scene.solver.energy_balance);
    let solver = scene.solver;
    assert_eq!((solver.integrator, solver.method), (Integrator::Bdf2, Method::Broyden));
    assert_eq!(solver.tolerance, 1e-4);
    assert_eq!(scene.output.folder, None);
    assert!(!scene.held_particles().iter().any(|held| *held));
    // The middle of the panel is at the origin.
    let low = scene.start.positions.chunks(3).map(|p| p[1]).fold(f64::INFINITY, f64::min);
    assert!((low + 0.15).abs() < 1e-12, "{low}");
}

#[test]
fn surfaces_are_kept_apart_wherever_that_can_be() {
    let kept = |more: &str| read(&format!("{more}\n{LEAST}")).unwrap().contact.surfaces;
    assert!(kept(""));
    assert!(!kept("contact.surfaces = false"));
    assert!(!kept("model = \"breen-1994\""));
    assert!(kept("model = \"breen-1994\"\ncontact.surfaces = true"));
}

#[test]
fn every_key_is_heard() {
    let text = r#"name = "all"
length = "cm"
spacing = 2
gravity = [0, 0, -1]
air = { density = 2, drag = 1 }
fabric.plain.file = "plain.toml"
[[panel]]
name = "towel"
fabric = "plain"
rectangle = [20, 30]
center = [0, 100, 0]
turn = [90, 0, 0]
ripple = { amplitude = 0.1, wavelength = 10 }
noise = { amplitude = 0.01, seed = 2 }
[[panel]]
name = "mat"
fabric = "plain"
rectangle = [10, 12]
spacing = 1
[[pin]]
panel = "towel"
points = [[0, 0], [20, 30]]
[[pin]]
panel = "towel"
edge = "left"
[[collider.sphere]]
name = "ball"
radius = 5
center = [0, 50, 0]
friction = 0.7
[[collider.box]]
size = [10, 10, 10]
edge_radius = 1
center = [50, 50, 0]
turn = [0, 45, 0]
[[collider.cylinder]]
radius = 3
height = 10
center = [-50, 50, 0]
[[collider.plane]]
center = [0, -50, 0]
[contact]
offset = 0.3
stiffness = 1e6
slip_speed = 0.002
[time]
step = 0.008
step_min = 0.001
step_max = 0.032
error = 0.01
end = 2
ramp = 0.5
[solver]
integrator = "backward-euler"
method = "newton"
tolerance = 1e-6
[output]
folder = "here"
every = 0.08
azimuth = 10
elevation = 20
energy = false
"#;
    let scene = read(text).unwrap();
    assert_eq!(scene.name, "all");
    assert_eq!((scene.panels.len(), scene.panels[1].first), (2, 11 * 16));
    assert_eq!(scene.environment.gravity, [0.0, 0.0, -1.0]);
    assert!((scene.environment.air - 1.0).abs() < 1e-15);
    assert_eq!(scene.held_particles().iter().filter(|held| **held).count(), 16 + 1);
    let towel = &scene.start.positions[..3 * 176];
    let high = towel.chunks(3).map(|p| (p[1] - 1.0).abs()).fold(0.0, f64::max);
    assert!(high > 5e-4 && high < 1.2e-3, "it lies flat at 1 m but for ripple and noise: {high}");
    let bodies: Vec<_> = scene.bodies.iter().map(|moving| &moving.body).collect();
    let names: Vec<&str> = bodies.iter().map(|body| body.name.as_str()).collect();
    assert_eq!(names, ["ball", "box 1", "cylinder 1", "plane 1"]);
    assert_eq!((bodies[0].friction, bodies[1].friction), (0.7, 0.25), "its own, or the fabric's");
    let contact = scene.contact.particles;
    assert!((contact.activation_distance - 0.003).abs() < 1e-15);
    assert_eq!((contact.stiffness, contact.slip_speed), (1e6, 0.002));
    let clock = scene.schedule.clock;
    assert_eq!((clock.step, clock.ticks_per_step, clock.ticks_max), (0.008, 8, 32));
    assert_eq!((clock.error, clock.ramp, clock.ticks_per_frame), (Some(1e-4), 0.5, 80));
    let solver = scene.solver;
    assert_eq!((solver.integrator, solver.method), (Integrator::BackwardEuler, Method::Newton));
    assert_eq!(solver.tolerance, 1e-6);
    assert!(!solver.energy_balance);
    let view = View { azimuth: Some(10.0), elevation: Some(20.0) };
    assert_eq!((scene.output.folder, scene.output.view), (Some("here".into()), view));
}

#[test]
fn a_panel_is_cut_at_its_angle_to_the_grain() {
    let text = with("rectangle = [0.2, 0.3]", "rectangle = [0.2, 0.3]\ngrain = 30");
    let scene = read(&format!("{text}[[pin]]\npanel = \"towel\"\nedge = \"top\"\n")).unwrap();
    let mass: f64 = scene.cloth.masses().iter().sum();
    assert!((mass / (0.2 * 0.3 * 0.12) - 1.0).abs() < 1e-12, "{mass}");
    let place = |particle: usize| {
        [scene.start.positions[3 * particle], scene.start.positions[3 * particle + 1]]
    };
    // The warp leans to the left by 30°, the weft to the right end upwards, and the middle is at
    // the origin.
    let (sin, cos) = 30_f64.to_radians().sin_cos();
    for (particle, [u, v]) in scene.cloth.coordinates().iter().enumerate() {
        let [x, y] = [u * cos - v * sin - 0.1, u * sin + v * cos - 0.15];
        let found = place(particle);
        assert!((found[0] - x).hypot(found[1] - y) < 1e-15, "{found:?}, not {x} {y}");
    }
    // A row at the top: all that is less than half a spacing below it.
    for (particle, held) in scene.held_particles().iter().enumerate() {
        assert_eq!(*held, place(particle)[1] > 0.145, "{:?}", place(particle));
    }
    assert!(scene.held_particles().iter().filter(|held| **held).count() > 20);
}

#[test]
fn a_disc_turns_with_its_grain() {
    let disc = |more: &str| read(&with("rectangle = [0.2, 0.3]", &format!("disc = 0.2{more}")));
    let (straight, turned) = (disc("").unwrap(), disc("\ngrain = 90").unwrap());
    assert_eq!(straight.cloth.masses(), turned.cloth.masses());
    for (a, b) in straight.start.positions.chunks(3).zip(turned.start.positions.chunks(3)) {
        assert_eq!([-a[1], a[0], a[2]], [b[0], b[1], b[2]]);
    }
}

#[test]
fn a_disc_follows_its_circle_unless_its_grid_is_given() {
    let area = |scene: &Scene| scene.cloth.masses().iter().sum::<f64>() / 0.12;
    let read_disc = |spacing: f64, more: &str| {
        let disc = format!("disc = 0.2\nspacing = {spacing}{more}");
        read(&with("rectangle = [0.2, 0.3]", &disc)).unwrap()
    };
    let circle = std::f64::consts::PI * 0.01;
    for spacing in [0.1, 0.07, 0.03, 0.01, 0.004] {
        let scene = read_disc(spacing, "");
        let radii = scene.cloth.coordinates().iter().map(|[u, v]| u.hypot(*v));
        let on_circle = radii.clone().filter(|radius| (radius - 0.1).abs() < 1e-12).count();
        assert!(radii.into_iter().all(|radius| radius < 0.1 + 1e-12), "at {spacing}");
        // A polygon with its corners on the circle.
        let angle = std::f64::consts::TAU / on_circle as f64;
        let polygon = 0.5 * on_circle as f64 * angle.sin() * 0.01;
        assert!((area(&scene) / polygon - 1.0).abs() < 1e-12, "at {spacing}");
        assert!(on_circle as f64 * spacing > 0.8 * std::f64::consts::TAU * 0.1, "at {spacing}");
        let stepped = read_disc(spacing, "\ngrid = [0, 0]");
        assert!((area(&stepped) / circle - 1.0).abs() < 1e-12, "at {spacing}");
        assert!(stepped.cloth.coordinates().contains(&[0.0, 0.0]), "at {spacing}");
    }
    let breen = format!("model = \"breen-1994\"\n{}", with("rectangle = [0.2, 0.3]", "disc = 0.2"));
    assert!((area(&read(&breen).unwrap()) / circle - 1.0).abs() < 1e-12);
}

#[test]
fn a_ring_is_held_around_its_hole() {
    let shape = "disc = 0.3\nhole = 0.1";
    let text = with("rectangle = [0.2, 0.3]", shape);
    let scene =
        read(&format!("{text}[[pin]]\npanel = \"towel\"\npoints = [[0, 0]]\nradius = 0.08\n"));
    let scene = scene.unwrap();
    let mass: f64 = scene.cloth.masses().iter().sum();
    let ring = std::f64::consts::PI * (0.15_f64.powi(2) - 0.05_f64.powi(2));
    assert!((mass / (ring * 0.12) - 1.0).abs() < 1e-12, "{mass}");
    let places = scene.cloth.coordinates().iter().map(|[u, v]| u.hypot(*v));
    for (held, radius) in scene.held_particles().iter().zip(places) {
        assert_eq!(*held, radius <= 0.08, "at {radius}");
    }
    let mistakes = read(&format!("{text}[[pin]]\npanel = \"towel\"\npoints = [[0, 0]]\n"));
    assert!(mistakes.expect_err("the hole").to_string().contains("not on panel"));
}

#[test]
fn rest_is_defined_by_its_table() {
    let settle = read(&with("", "[settle]")).unwrap().schedule.relaxation.unwrap();
    assert_eq!((settle.speed, settle.residual, settle.inertia), (0.002, 1e-3, false));
    assert!((settle.stride - 0.0025).abs() < 1e-15, "a quarter of the spacing");
    let text = with("", "[settle]\nspeed = 0.01\nresidual = 1e-2\nstride = 0.001\ninertia = true");
    let settle = read(&text).unwrap().schedule.relaxation.unwrap();
    assert_eq!((settle.speed, settle.residual, settle.stride), (0.01, 1e-2, 0.001));
    assert!(settle.inertia);
}

#[test]
fn coarser_grids_have_their_spacings_and_mistakes_their_remedies() {
    let grids = |more: &str| {
        read(&with("", more)).map(|scene| {
            scene.coarser.iter().map(|own| (1e4 * own.spacing()).round() / 10.0).collect::<Vec<_>>()
        })
    };
    let found = grids("[settle]\n[refine]\nspacings = [\"5 cm\", 0.02]");
    assert_eq!(found.expect("two grids"), [50.0, 20.0]);
    for (wrong, part, right) in [
        ("[refine]\nspacings = [0.02]", "add [settle]", "[settle]\n[refine]\nspacings = [0.02]"),
        (
            "[settle]\n[refine]\nspacings = [0.02, 0.04]",
            "the coarsest comes first",
            "[settle]\n[refine]\nspacings = [0.04, 0.02]",
        ),
        (
            "[settle]\n[refine]\nspacings = [0.0105]",
            "a grid of 10.5 mm before one of 10 mm",
            "[settle]\n[refine]\nspacings = [0.011]",
        ),
        (
            "[settle]\n[refine]\nspacings = [0.2, 0.15, 0.1, 0.08, 0.06, 0.05, 0.04, 0.03, 0.02]",
            "name 8 at most",
            "[settle]\n[refine]\nspacings = []",
        ),
        (
            "[settle]\n[refine]\nspacings = [0.3, 0.02]",
            "a grid of 300 mm",
            "[settle]\n[refine]\nspacings = [0.02]",
        ),
    ] {
        let mistakes = grids(wrong).expect_err(wrong).to_string();
        assert!(mistakes.contains(part) && mistakes.contains("refine"), "{wrong}: {mistakes}");
        assert!(grids(right).is_ok(), "{right}");
    }
}

#[test]
fn a_mistake_is_answered_at_its_line_with_its_value() {
    let cases = [
        ("step = 0.004", "step = -1", "-1", 7),
        ("end = 0.1", "end = 0.001", "0.001", 8),
        ("end = 0.1", "end = 0.1\nerror = 1.0", "1", 9),
        ("end = 0.1", "end = 0.1\nstep_max = 0.1", "one length", 9),
        ("end = 0.1", "end = 0.1\nerror = 1e-4\nstep_min = 0.1", "0.1", 10),
        ("end = 0.1", "end = 0.1\nramp = -2", "-2", 9),
        ("", "[settle]\nspeed = 0", "0", 10),
        ("", "[settle]\nresidual = 5", "5", 10),
        ("", "[settle]\nstride = -0.1", "-0.1", 10),
        ("", "[solver]\nintegrator = \"leapfrog\"", "leapfrog", 10),
        ("", "[solver]\ntolerance = 2", "2", 10),
        ("", "[contact]\nslip_speed = 9", "9", 10),
        ("", "[contact]\ntop_speed = 0", "0", 10),
        ("", "[contact]\ntop_speed = 900", "contact keeps this fabric apart up to", 10),
        ("", "[contact]\nsurfaces = false\ntop_speed = 2", "kept apart", 11),
        ("", "[contact]\nstiffness = 1e9\ntop_speed = 2", "already says", 11),
        ("", "[contact]\npinch = \"squash\"", "squash", 10),
        ("", "[contact]\nsurfaces = false\npinch = \"thin\"", "kept apart", 11),
        ("", "[output]\nevery = 0", "0", 10),
        ("", "[[pin]]\npanel = \"towl\"\nedge = \"top\"", "towl", 10),
        ("", "[[pin]]\npanel = \"towel\"\npoints = [[1, 1]]", "[1, 1]", 11),
        ("", "[[pin]]\npanel = \"towel\"\nedge = \"top\"\nrelease = -1", "-1", 12),
        ("", "[[collider.sphere]]\nradius = 1", "inside", 2),
        ("fabric = \"plain\"", "fabric = \"plane\"", "plane", 4),
        ("rectangle = [0.2, 0.3]", "rectangle = [0.2, -0.3]", "-0.3", 5),
        ("rectangle = [0.2, 0.3]", "rectangle = [0.2, 0.3]\ngrain = 200", "200", 6),
        ("rectangle = [0.2, 0.3]", "rectangle = [0.2, 0.3]\ngrain = nan", "nan is not", 6),
        (
            "rectangle = [0.2, 0.3]",
            "rectangle = [0.2, 0.3]\nnoise = { amplitude = nan }",
            "finite",
            6,
        ),
        ("[time]", "noise = { amplitude = 1e-4, length = 0 }\n[time]", "0 m is not above 0", 6),
        ("rectangle = [0.2, 0.3]", "rectangle = [0.2, 0.3]\ngrid = [0.001, 0]", "follow", 6),
        ("rectangle = [0.2, 0.3]", "rectangle = [0.2, 0.3]\nhole = 0.1", "rectangle", 6),
        ("rectangle = [0.2, 0.3]", "spacing = 0.01\ndisc = 0.3\nhole = 0.29", "0.005", 5),
        ("rectangle = [0.2, 0.3]", "disc = 0.3\nhole = -0.1", "-0.1 m is not above 0", 6),
        ("rectangle = [0.2, 0.3]", "spacing = 0.15\nrectangle = [0.2, 0.3]\ngrain = 45", "0.15", 5),
    ];
    for (old, new, value, line) in cases {
        let mistakes = read(&with(old, new)).expect_err(new);
        let text = mistakes.to_string();
        assert!(text.contains(value), "{new}: {text}");
        assert!(text.contains(&format!("towel.toml:{line}")), "{new} is in line {line}: {text}");
    }
}

#[test]
fn contact_stops_the_top_speed_that_a_scene_declares() {
    let declared = |keys: &str| read(&with("", &format!("[contact]\n{keys}")));
    let scene = declared("top_speed = 2").unwrap();
    assert_eq!(scene.contact.top_speed, Some(2.0));
    let stopped = scene.stopped_speed();
    assert!((stopped / 2.0 - 1.0).abs() < 1e-9, "{stopped} m/s");
    assert!(
        scene.source.note_lines().iter().any(|note| note.contains("2 m/s")),
        "{:?}",
        scene.source
    );
    let usual = read(LEAST).unwrap();
    assert_eq!(usual.contact.top_speed, None);
    assert!(usual.stopped_speed() < 2.0 && usual.contact_stiffness() < scene.contact_stiffness());
    // A speed that compression stops already changes nothing.
    let slow = declared("top_speed = 0.1").unwrap();
    assert_eq!(slow.contact_stiffness(), usual.contact_stiffness());
    // The remedy of a speed that is too large is taken.
    let message = declared("top_speed = 900").unwrap_err().to_string();
    let most = message.split("write ").nth(1).unwrap().split(' ').next().unwrap();
    let fastest = declared(&format!("top_speed = {most}")).unwrap();
    assert!(fastest.contact.top_speed.unwrap() <= fastest.top_speed_max());
    // A unit is read.
    let scene = declared("top_speed = \"200 cm/s\"").unwrap();
    assert!((scene.contact.top_speed.unwrap() - 2.0).abs() < 1e-12);
}

#[test]
fn schemes_for_comparison_are_no_part_of_a_scene() {
    for wrong in
        ["integrator = \"explicit\"", "method = \"textbook-mass\"", "linear = \"cholesky\""]
    {
        let error =
            read(&with("", &format!("[solver]\n{wrong}"))).expect_err("refused").to_string();
        assert!(
            error.contains("with_reference_scheme") && error.contains("leave it out"),
            "{error}"
        );
    }
}

#[test]
fn two_bodies_of_one_name_are_refused() {
    let floor = "[[collider.plane]]\ncenter = [0, -3, 0]\n";
    let ball = |name: &str| {
        format!("[[collider.sphere]]\nradius = 0.1\ncenter = [0, -1, 0]\nname = \"{name}\"\n")
    };
    let scene = |name: &str, other: &str| {
        read(&format!("{LEAST}{}{}{floor}", ball(name), ball(other).replace("-1, 0", "-2, 0")))
    };
    assert_eq!(scene("a", "b").unwrap().bodies.len(), 3);
    // A body that states no name is named by its kind and its number.
    for (name, other, two) in [("a", "a", "a"), ("a", "plane 1", "plane 1")] {
        let told = scene(name, other).unwrap_err().to_string();
        assert!(told.contains(&format!("there are two bodies \"{two}\"")), "{told}");
        assert!(told.contains("give each its own name"), "{told}");
    }
}
