//! Surfaces that do not pass through each other.

use drape_dynamics::{Simulation, Status, Summary};

use crate::sheet::{FLAT, Sheet};

/// Runs to the end. After every step no surface crosses another.
fn run(sheet: &Sheet) -> Simulation {
    let mut simulation = sheet.simulation();
    loop {
        let finished = simulation.step().unwrap().finished;
        if finished {
            return simulation;
        }
    }
}

fn sound(summary: &Summary) {
    assert_eq!(summary.contact.intersections, 0);
    assert_eq!(summary.contact.intersections_found, 0);
    assert!(summary.contact.pairs_max > 0, "nothing touched");
}

fn middle(simulation: &Simulation) -> [f64; 3] {
    let positions = simulation.positions().to_vec();
    let count = positions.len() as f64 / 3.0;
    let mut sum = [0.0; 3];
    positions.chunks_exact(3).for_each(|x| (0..3).for_each(|axis| sum[axis] += x[axis] / count));
    sum
}

/// Three sheets that fall on a ball and on each other.
fn pile(threads: usize) -> Simulation {
    let scene = "[contact]\nsurfaces = true\n[[collider.sphere]]\nradius = 0.05\n\
                 center = [0, -0.052, 0]\nfriction = 0.3\n[time]\nstep = 0.005\nend = 0.15\n";
    let panel = format!(
        "{FLAT}noise = {{ amplitude = 1e-4, seed = 1 }}\n\
         stack = {{ count = 3, step = [0, 0.002, 0], turn = [0, 20, 0] }}\n"
    );
    let sheet = Sheet { side: 0.2, particles: 15, scene: scene.into(), panel, ..Sheet::default() };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| run(&sheet))
}

#[test]
fn sheets_fall_on_each_other_and_stay_apart_with_any_number_of_threads() {
    let one = pile(1);
    let summary = one.summary();
    sound(&summary);
    // Of a thickness of 0.4 mm 0.35 are always kept.
    let kept = 0.35 * 0.4e-3;
    let nearest = summary.contact.min_distance.unwrap();
    assert!(nearest >= kept && nearest < 0.4e-3, "{nearest} m");
    assert_eq!(one.state_hash(), pile(2).state_hash());
}

#[test]
fn a_belt_carries_a_sheet_without_creeping() {
    let belt = |friction: f64| {
        let scene = format!(
            "air.density = 0.0\n[contact]\nsurfaces = true\nstiffness = 2e6\n[[collider.box]]\n\
             size = [1, 0.02, 1]\ncenter = [0, -0.01, 0]\nfriction = {friction}\n[collider.box.motion]\n\
             times = [0, 0.5]\nshift = [[0, 0, 0], [0.05, 0, 0]]\n[time]\nstep = 0.002\nend = 0.7\n"
        );
        // A pressure of 2 Pa is borne by a quarter of the stiffness, 4 µm inside the activation
        // distance.
        let panel = format!("{FLAT}center = [0, 9.96e-4, 0]\n");
        run(&Sheet { side: 0.2, scene, panel, ..Sheet::default() })
    };
    let carried = belt(0.5);
    sound(&carried.summary());
    // It lags by half of 0.1 m/s for 20 ms, and at the end slides on for as long.
    let displacement = middle(&carried)[0];
    assert!((displacement - 0.05).abs() < 2e-4, "{displacement}");
    // Without friction the seam of the belt's two triangles, which both push, takes it along by a
    // micrometre.
    let still = middle(&belt(0.0))[0];
    assert!(still.abs() < 1e-5, "{still}");
}

#[test]
fn the_energy_of_surfaces_is_accounted_for() {
    let scene = "air.density = 0.0\n[contact]\nsurfaces = true\n[[collider.sphere]]\n\
                 radius = 0.05\ncenter = [0, -0.052, 0]\nfriction = 0.3\n\
                 [collider.sphere.motion]\ntimes = [0, 0.2]\n\
                 shift = [[0, 0, 0], [0.02, 0.08, 0]]\nturn = [[0, 0, 0], [0, 40, 0]]\n\
                 [time]\nstep = 0.002\nend = 0.2\n";
    let sheet = Sheet { side: 0.2, scene: scene.into(), panel: FLAT.into(), ..Sheet::default() };
    let simulation = run(&sheet);
    sound(&simulation.summary());
    let energy = simulation.energy().unwrap();
    // The ball lifts the middle of a sheet of 8 g by some centimetres.
    assert!(energy.work_in > 0.5 * energy.gravity && energy.gravity > 1e-4, "{energy:?}");
    assert!(energy.residual.abs() < 1e-6 * energy.work_in, "{energy:?}");
    assert!(energy.body_dissipated > 0.0 && energy.numerical_dissipated > 0.0, "{energy:?}");
}

#[test]
fn a_fast_sheet_does_not_pass_a_thin_plate() {
    // 60 mm in a step, through 1 mm.
    let scene = "gravity = [0, 0, 0]\nair.density = 0.0\n[contact]\nsurfaces = true\n\
                 [[collider.box]]\nsize = [1, 0.001, 1]\ncenter = [0, -0.03, 0]\n\
                 [time]\nstep = 0.005\nend = 0.02\n";
    let panel = format!("{FLAT}velocity = [0, -12, 0]\n");
    let simulation = run(&Sheet { side: 0.2, scene: scene.into(), panel, ..Sheet::default() });
    sound(&simulation.summary());
    let lowest = simulation.positions().chunks_exact(3).map(|x| x[1]).fold(1.0, f64::min);
    assert!(lowest > -0.0295, "{lowest}");
    let energy = simulation.energy().unwrap();
    let before = 0.5 * 0.2 * 0.04 * 144.0;
    assert!(energy.kinetic + energy.elastic + energy.contact <= before, "{energy:?}");
}

#[test]
fn friction_holds_on_a_slope_and_lets_go_beyond_its_limit() {
    let displacement = |friction: f64, end: f64| {
        // What bears the sheet's weight on a slope of tan 0.5 is 0.0022 mm inside the activation
        // distance of 1 mm.
        let slope = -0.5_f64.atan().to_degrees();
        let normal = [0.5_f64.atan().sin(), 0.5_f64.atan().cos()];
        let place = |height: f64| normal.map(|n| n * height);
        let weight = 0.2 * 9.81 * normal[1];
        let ([x, y], [a, b]) = (place(1e-3 - 4.0 * weight / 2e6), place(-0.01));
        let scene = format!(
            "air.density = 0.0\n[contact]\nsurfaces = true\n[[collider.box]]\nsize = [2, 0.02, 1]\n\
             center = [{a:e}, {b:e}, 0]\nturn = [0, 0, {slope:e}]\nfriction = {friction}\n\
             [solver]\nintegrator = \"backward-euler\"\n[time]\nstep = 0.005\nend = {end}\n"
        );
        let panel = format!("turn = [-90, 0, {slope:e}]\ncenter = [{x:e}, {y:e}, 0]\n");
        let simulation = run(&Sheet { side: 0.1, scene, panel, ..Sheet::default() });
        let [cx, cy, _] = middle(&simulation);
        (cx - x).hypot(cy - y)
    };
    let held = displacement(0.51, 10.0);
    assert!(held < 1e-4, "{held} m in 10 s");
    // g (sin − µ cos) t²/2.
    let slid = displacement(0.49, 1.0);
    let free = 0.5 * 9.81 * (0.5 - 0.49) * 0.5_f64.atan().cos();
    assert!((slid / free - 1.0).abs() < 0.05, "{slid} m against {free} m");
}

#[test]
fn a_start_that_crosses_is_refused() {
    let scene = "[contact]\nsurfaces = true\n[time]\nstep = 0.005\nend = 0.1\n";
    let panel = format!("{FLAT}stack = {{ count = 2, step = [0, 0, 0], turn = [10, 20, 0] }}\n");
    let sheet = Sheet { side: 0.2, scene: scene.into(), panel, ..Sheet::default() };
    let message = sheet.try_scene().unwrap_err().to_string();
    assert!(message.contains("surfaces cross at the start"), "{message}");
    let close = FLAT.to_owned() + "stack = { count = 2, step = [0, 1e-5, 0] }\n";
    let message = Sheet { panel: close, ..sheet }.try_scene().unwrap_err().to_string();
    assert!(message.contains("1.000e-5 m apart, where 1.400e-4 m is kept"), "{message}");
}

#[test]
fn a_ball_that_turns_takes_more_and_shorter_steps() {
    // Half a turn in a tenth of a second: 4.5° in a step, for which a point 50 mm from the axis
    // strays 39 µm from its chord. Allowed are 0.05 of 0.14 mm: two halvings.
    let turning = |turn: f64| {
        let scene = format!(
            "air.density = 0.0\n[[collider.sphere]]\nradius = 0.05\ncenter = [0, -0.0505, 0]\n\
             friction = 0.3\n[collider.sphere.motion]\ntimes = [0, 0.1]\n\
             turn = [[0, 0, 0], [{turn}, 0, 0]]\n[contact]\n[time]\nstep = 0.0025\nend = 0.05\n"
        );
        let sheet = Sheet { side: 0.2, scene, panel: FLAT.into(), ..Sheet::default() };
        let simulation = run(&sheet);
        sound(&simulation.summary());
        simulation.summary()
    };
    let [still, turned] = [turning(0.0), turning(180.0)];
    assert_eq!((still.steps, still.solver.sub_steps), (20, 20));
    assert!(turned.steps == 20 && turned.solver.sub_steps >= 4 * 20, "{:?}", turned.solver);
    assert!(turned.contact.min_distance.unwrap() >= 0.35 * 0.4e-3);
}

#[test]
fn a_body_that_grows_takes_the_cloth_that_starts_in_it_along() {
    // The top of the ball is 6 mm above the sheet.
    let scene = |inflate: &str| {
        let scene = format!(
            "[[collider.sphere]]\nradius = 0.05\ncenter = [0, -0.044, 0]\nfriction = 0.3\n\
             [contact]\n{inflate}\n[time]\nstep = 0.005\nend = 0.4\n"
        );
        Sheet { side: 0.2, particles: 15, scene, panel: FLAT.into(), ..Sheet::default() }
    };
    let message = scene("").try_scene().unwrap_err().to_string();
    assert!(message.contains("surfaces cross") && message.contains("contact.inflate"), "{message}");
    let message = scene("inflate.depth = 0.004").try_scene().unwrap_err().to_string();
    assert!(message.contains("surfaces cross"), "{message}");
    let simulation = run(&scene("inflate = { depth = 0.01, seconds = 0.3 }"));
    sound(&simulation.summary());
    // The ball has its size, and the sheet lies on it.
    let frame = simulation.frame();
    let highest = |x: &[[f64; 3]]| x.iter().map(|x| x[1]).fold(f64::MIN, f64::max);
    assert!((highest(&frame.bodies) - 0.006).abs() < 1e-12, "{}", highest(&frame.bodies));
    assert!((0.006..0.008).contains(&highest(&frame.cloth)), "{}", highest(&frame.cloth));
    let energy = simulation.energy().unwrap();
    assert!(energy.work_in > 0.0 && energy.residual.abs() < 1e-6 * energy.work_in, "{energy:?}");
    // Half of the depth is left after half of the time.
    let mut half = scene("inflate = { depth = 0.01, seconds = 0.3 }");
    half.scene = half.scene.replace("end = 0.4", "end = 0.15");
    let top = highest(&run(&half).frame().bodies);
    assert!((top - 0.001).abs() < 1e-5, "{top}");
    // What is wholly inside would stay there.
    let mut small = scene("inflate = { depth = 0.01, seconds = 0.3 }");
    small.side = 0.02;
    small.panel = format!("{FLAT}center = [0, -0.03, 0]\n");
    let message = small.try_scene().unwrap_err().to_string();
    assert!(message.contains("all of \"sheet\" starts inside a body"), "{message}");
}

/// Sheets so far above each other, of which all keep 0.14 mm, with more keys of their contact.
fn close(count: usize, gap: f64, more: &str) -> Sheet {
    let panel =
        format!("{FLAT}stack = {{ count = {count}, step = [0, {gap}, 0], turn = [0, 20, 0] }}\n");
    let scene = format!(
        "gravity = [0, 0, 0]\nair.density = 0.0\n[contact]\nsurfaces = true\n{more}\n\
         [time]\nstep = 0.005\nend = 0.3\n"
    );
    Sheet { side: 0.1, scene, panel, ..Sheet::default() }
}

#[test]
fn sheets_that_start_too_near_come_to_keep_their_whole_distances() {
    let message = close(3, 5e-5, "").try_scene().unwrap_err().to_string();
    assert!(message.contains("5.000e-5 m apart") && message.contains("contact.grow"), "{message}");
    let grown = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut simulation = close(3, 5e-5, "grow = 0.2").simulation();
            let mut last = simulation.frame();
            // No force acts at the start, where the nearest are 0.05 mm apart that push below 0.4.
            assert!((last.growth_fraction - 0.125).abs() < 1e-12, "{}", last.growth_fraction);
            while !simulation.step().unwrap().finished {
                let (frame, summary) = (simulation.frame(), simulation.summary());
                assert!(
                    frame.growth_fraction >= last.growth_fraction
                        && summary.contact.intersections == 0
                );
                last = frame;
            }
            simulation
        })
    };
    let simulation = grown(1);
    let summary = simulation.summary();
    sound(&summary);
    assert!(
        (summary.contact.start_growth_fraction - 0.125).abs() < 1e-12
            && summary.contact.growth_fraction == 1.0
    );
    let nearest = summary.contact.min_distance.unwrap();
    assert!(nearest > 0.125 * 0.14e-3, "{nearest}");
    // Each is now farther above the one below than they keep.
    let heights: Vec<f64> = simulation.positions().chunks_exact(3).map(|x| x[1]).collect();
    let sheets: Vec<&[f64]> = heights.chunks(heights.len() / 3).collect();
    for pair in sheets.windows(2) {
        let gap = pair[1][60] - pair[0][60];
        assert!(gap > 0.14e-3, "{gap}");
    }
    // What keeps growing works on the cloth, and the balance counts it.
    let energy = simulation.energy().unwrap();
    assert!(energy.work_in > 0.0 && energy.residual.abs() < 1e-6 * energy.work_in, "{energy:?}");
    assert_eq!(simulation.state_hash(), grown(2).state_hash());
}

#[test]
fn sheets_that_are_held_too_near_are_named() {
    let mut sheet = close(2, 5e-5, "grow = 0.1");
    for panel in ["sheet", "sheet 2"] {
        sheet.scene +=
            &format!("[[pin]]\npanel = \"{panel}\"\npoints = [[0.05, 0.05]]\nradius = 0.03\n");
    }
    let simulation = run(&sheet);
    let summary = simulation.summary();
    assert_eq!(summary.status, Status::HeldTogether);
    // They keep at most nine tenths of the 0.05 mm, of 0.14.
    let part = summary.contact.growth_fraction;
    assert!(part > 0.3 && part <= 0.9 * 0.05 / 0.14 + 1e-9, "{part}");
    assert!((summary.simulated_seconds - 0.2).abs() < 0.01, "{}", summary.simulated_seconds);
    let reason = summary.reason.unwrap();
    let fraction = format!("{:.2} % of the distances that they keep", 100.0 * part);
    for words in ["\"sheet\" and \"sheet 2\"", &fraction, "near ("] {
        assert!(reason.contains(words), "{reason}");
    }
    assert_eq!(summary.contact.intersections, 0);
}

#[test]
fn what_is_kept_grows_from_what_can_be_told_from_nothing_and_over_steps_only() {
    let refused = |gap: f64, more: &str| close(2, gap, more).try_scene().unwrap_err().to_string();
    let message = refused(1e-7, "grow = 0.2");
    assert!(message.contains("contact.grow needs 1e-6 m"), "{message}");
    let message = refused(0.0, "grow = 0.2");
    assert!(message.contains("surfaces cross"), "{message}");
    for (grow, words) in [("0.001", "between"), ("0.31", "between"), ("nan", "finite number")] {
        let message = refused(5e-5, &format!("grow = {grow}"));
        assert!(message.contains("contact.grow") && message.contains(words), "{message}");
    }
    let mut particles = close(2, 5e-5, "grow = 0.2");
    particles.scene = particles.scene.replace("surfaces = true", "surfaces = false");
    let message = particles.try_scene().unwrap_err().to_string();
    assert!(message.contains("contact.surfaces = true"), "{message}");
    // Where nothing is near it is the run without it.
    let far = |more: &str| {
        let mut sheet = close(2, 1e-3, more);
        sheet.scene = sheet.scene.replace("gravity = [0, 0, 0]\n", "");
        sheet.scene += "[[pin]]\npanel = \"sheet\"\nedge = \"top\"\n";
        run(&sheet).state_hash()
    };
    assert_eq!(far(""), far("grow = 0.2"));
}
