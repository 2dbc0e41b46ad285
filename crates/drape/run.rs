use std::path::PathBuf;

use drape::dynamics::{
    Contacts, Energy, PhaseName, Simulation, Snapshot, Status, Summary, prepare_folder,
};
use drape::scene::{Error, Scene};

use crate::command::RunArguments;
use crate::failure::Failure;
use crate::picture;
use crate::progress::Screen;
use crate::say::say;
use crate::strain_picture::draw_strains;

/// `drape run`.
pub(crate) fn run(arguments: &RunArguments) -> Result<(), Failure> {
    let mut scene =
        drape::read_scene(&arguments.scene).map_err(|error| refuse(error, arguments))?;
    if let Some(end) = arguments.until {
        if !(end >= scene.clock.step) {
            let step = scene.clock.step;
            return Err(Failure::Usage(format!("--until {end}: a step takes {step} s already")));
        }
        scene.clock.end = end;
    }
    let folder = folder(arguments, scene.folder.as_ref());
    let output = prepare_folder(&folder, arguments.force || arguments.output.is_none())?;
    let (view, garment) = (scene.view, scene.sewing.is_some());
    notes(&scene);
    let mut simulation = Simulation::new(scene)?;
    let recorder = output.record(simulation.topology())?;
    let mut screen = Screen::new(simulation.ticks_to_do(), recorder);
    let summary = simulation.run(&mut screen);
    screen.finish();
    let summary = summary?;
    output.summary(&summary)?;
    if let Some(frame) = &screen.last {
        let shown = Snapshot { positions: frame.positions.clone(), ..simulation.snapshot() };
        let picture = match (garment, view) {
            (true, [None, None]) => picture::draw_round(&shown)?,
            _ => picture::draw(&shown, view, picture::SIZE)?,
        };
        let stored = picture.save(output.path("picture.png"));
        stored.map_err(|error| Failure::Output(error.to_string()))?;
        if garment {
            crate::file::write(&output.path("strain.svg"), draw_strains(&shown)?)?;
        }
    }
    if arguments.json {
        let json = serde_json::to_string_pretty(&summary);
        say(json.expect("a summary always has a JSON form"))?;
    } else {
        say(describe(&summary))?;
        for warning in &summary.warnings {
            say(format_args!("warning: {warning}"))?;
        }
        say(format_args!("results in {}", folder.display()))?;
    }
    match summary.status {
        Status::Ok => Ok(()),
        Status::DidNotSettle => Err(Failure::Solver(format!(
            "the cloth did not come to rest in {} s: its fastest particle moves at {:.1} mm/s, and its \
             forces lack {:.1e} g for balance; give it more time (time.end), or ask for less \
             (settle.speed, settle.residual)",
            summary.simulated_seconds,
            1e3 * summary.speed_max,
            summary.imbalance
        ))),
        Status::SeamsOpen => Err(Failure::Solver(format!(
            "{}; something holds its sides apart, or sew.seconds is short; the last state was written",
            summary.reason.unwrap_or_default()
        ))),
        Status::FellOff => Err(Failure::Solver(format!(
            "{}; pin it, take it in, or raise the friction of the body; the last state was written",
            summary.reason.unwrap_or_default()
        ))),
        Status::HeldTogether => Err(Failure::Solver(format!(
            "{}; something holds them together, or contact.grow is short; the last state was written",
            summary.reason.unwrap_or_default()
        ))),
        Status::CertificateFailed => Err(Failure::Certificate(format!(
            "surfaces crossed in the step after {} s, however short it was made; the last good state was written",
            summary.simulated_seconds
        ))),
        Status::SolverFailed => Err(Failure::Solver(format!(
            "the step after {} s could not be solved; the last good state was written: {}",
            summary.simulated_seconds,
            summary.reason.unwrap_or_default()
        ))),
    }
}

/// What the user should know about the patterns of a scene.
#[expect(clippy::print_stderr, reason = "messages of the program go to stderr")]
fn notes(scene: &Scene) {
    scene.notes.iter().for_each(|note| eprintln!("note: {note}"));
}

/// Where the results go.
fn folder(arguments: &RunArguments, of_scene: Option<&PathBuf>) -> PathBuf {
    let given = arguments.output.as_ref().or(of_scene);
    given.cloned().unwrap_or_else(|| {
        let name = arguments.scene.file_stem().unwrap_or_default();
        PathBuf::from("out").join(name)
    })
}

/// Why a scene is refused. Triangles that cross at the start are written beside where its results would be.
fn refuse(error: Error, arguments: &RunArguments) -> Failure {
    let Error::Tangled(mut tangle) = error else { return error.into() };
    let folder = folder(arguments, tangle.folder.as_ref());
    let mut name = folder.file_name().unwrap_or_default().to_owned();
    name.push("-start.ply");
    let path = folder.with_file_name(name);
    let mut content = Vec::new();
    let written = tangle.write_ply(&mut content).map_err(|error| error.to_string());
    let written = written
        .and_then(|()| crate::file::write(&path, content).map_err(|failure| failure.to_string()));
    let told = match (written, tangle.overlaps.len()) {
        (Ok(()), count) if count < tangle.total => {
            format!(
                "the triangles of the first {count} of {} pairs are in {}",
                tangle.total,
                path.display()
            )
        }
        (Ok(()), _) => format!("the triangles are in {}", path.display()),
        (Err(reason), _) => reason,
    };
    let mut mistakes = tangle.mistakes.0.iter_mut();
    if let Some(mistake) = mistakes.find(|mistake| mistake.message.contains("surfaces")) {
        let help = mistake.help.take().unwrap_or_default();
        mistake.help = Some(format!("{help}; {told}"));
    }
    Failure::Input(tangle.mistakes)
}

fn describe(summary: &Summary) -> String {
    let Summary { energy, strain, contact, .. } = summary;
    let relaxes = summary.phases.last().is_some_and(|phase| phase.name == PhaseName::Relax);
    let rest = match (summary.settled, relaxes) {
        (true, true) => "at rest",
        (true, false) => "moving again after it was at rest",
        (false, _) => "moving",
    };
    let cpu = summary.cpu_seconds.map_or(String::new(), |cpu| format!(", {cpu:.1} s of processor"));
    let nearest = contact.min_distance.map_or("none near".into(), |d| format!("{:.3} mm", 1e3 * d));
    format!(
        "{} particles, {} steps, {:.3} s simulated in {:.1} s{cpu}\n\
         {rest}, fastest particle {:.2} mm/s\n\
         strain: largest {:.2} %, 99 of 100 below {:.2} %; shear up to {:.1}°; 99 of 100 curvatures below {:.0} 1/m\n\
         contact: nearest {nearest}, {} inside or through{}{}{}",
        summary.particles,
        summary.steps,
        summary.simulated_seconds,
        summary.wall_seconds,
        1e3 * summary.speed_max,
        100.0 * strain.traction_max,
        100.0 * strain.traction_p99,
        strain.shear_max.to_degrees(),
        strain.curvature_p99,
        contact.intersections,
        pinched(contact),
        grown(contact),
        energy.as_ref().map_or(String::new(), balance),
    )
}

/// What was not kept as far from bodies as the rest, for people.
fn pinched(contact: &Contacts) -> String {
    let thinned = match contact.thinned_max {
        0 => String::new(),
        count => format!(
            "; up to {count} particles were pinched, and kept a tenth of their distance from bodies"
        ),
    };
    match contact.released_max {
        0 => thinned,
        count => format!(
            "{thinned}; up to {count} particles were pinched, and let a body through: that cloth and bodies do not \
             intersect is not promised there"
        ),
    }
}

/// Which part of their distances surfaces kept, for people.
fn grown(contact: &Contacts) -> String {
    if contact.grown_from == 1.0 {
        return String::new();
    }
    let [from, to] = [contact.grown_from, contact.grown].map(|part| 100.0 * part);
    format!("; surfaces kept {from:.2} % of their distances at the start, and {to:.2} % at the end")
}

fn balance(energy: &Energy) -> String {
    format!(
        "\nenergy: the fall gave {:.4} J; elastic {:+.4} J, kinetic {:.1e} J; lost in the fabric {:.4} J, \
         on bodies {:.4} J, to the air {:.4} J, in the integration {:.4} J; unaccounted {:.0e} J",
        -energy.gravity,
        energy.elastic + energy.contact,
        energy.kinetic,
        energy.friction_dissipated,
        energy.body_dissipated,
        energy.air_dissipated,
        energy.numerical_dissipated + energy.turning_dissipated,
        energy.remainder,
    )
}
