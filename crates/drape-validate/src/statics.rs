//! Strips at rest.

use std::f64::consts::FRAC_1_SQRT_2;

use crate::reference;
use crate::shipped::{CUPRO, fabric};
use crate::stage::{ALONE, scene};
use crate::strip::{GRAVITY, Hold, Strip, finish};
use crate::{Axis, Check, Findings, Graph, Layout, Source, ValidationError};

type Found = Result<Findings, ValidationError>;

/// Across and down, over the length of a strip.
const SHAPE: [Axis; 2] = [Axis::ratio("reach over length"), Axis::ratio("height over length")];

/// How a strip goes to rest: without inertia, to a hundredth of what a scene usually asks for.
const REST: &str = "[time]\nstep = 0.002\nend = 10000\n[settle]\nresidual = 1e-5\nspeed = 1e-5\n\
                    [solver]\ntolerance = 1e-7\n[output]\nenergy = false\n";

/// Shape of a strip that bends under its own weight: across and up over its length, from the clamp on.
fn cantilever(weight: f64, cells: usize) -> Result<Vec<[f64; 2]>, ValidationError> {
    let strip = Strip { cells, ..Strip::default() }.of_weight(weight);
    let mut simulation = strip.simulation(0.0, REST)?;
    finish(&mut simulation)?;
    let line = strip.line(&simulation);
    let free = line.iter().filter(|(s, _)| *s > 0.0);
    Ok(free.map(|(_, x)| [x[0] / strip.length, x[1] / strip.length]).collect())
}

/// Drop over reach of the end of a shape.
fn slant(shape: &[[f64; 2]]) -> f64 {
    shape.last().map_or(f64::NAN, |[across, up]| -up / across)
}

/// The exact shape, drawn as the simulated ones are.
fn elastica(weight: f64, load: f64) -> Vec<[f64; 2]> {
    let shape = reference::cantilever_shape((weight, load), 100);
    shape.into_iter().map(|[across, down]| [across, -down]).collect()
}

/// The heavy elastica from stiff to limp, and how fast its error falls with the spacing.
pub fn heavy_cantilever() -> Found {
    let exact = |weight: f64| {
        let tip = reference::cantilever(weight, 0.0);
        tip.drop / tip.reach
    };
    let mut checks = Vec::new();
    let mut shapes = Graph::new("strips under their own weight", SHAPE).laid_out(Layout::ToScale);
    for weight in [0.1, 1.0, 3.0, 10.0, 30.0, 60.0, 100.0] {
        let what = format!("drop over reach for wL³/B = {weight}, 40 cells");
        let shape = cantilever(weight, 40)?;
        checks.push(Check::within(what, slant(&shape), exact(weight), 0.01));
        shapes.add(Source::Simulated, format!("wL³/B = {weight}"), shape);
        shapes.add(Source::Reference, "heavy elastica", elastica(weight, 0.0));
    }
    let error = |cells: usize| -> Result<[f64; 2], ValidationError> {
        let off = slant(&cantilever(60.0, cells)?) - exact(60.0);
        Ok([1.0 / (cells as f64 + 0.5), (off / exact(60.0)).abs()])
    };
    let errors = [error(10)?, error(20)?, error(40)?];
    let order = (errors[1][1] / errors[2][1]).log2();
    checks.push(Check::at_least("order of convergence, wL³/B = 60, 20 to 40 cells", order, 1.8));
    let axes =
        [Axis::ratio("spacing over length"), Axis::new("error of drop over reach", "%", 0.01)];
    let mut orders = Graph::new("error for wL³/B = 60", axes).laid_out(Layout::Logarithmic);
    let second =
        |[spacing, _]: [f64; 2]| [spacing, errors[2][1] * (spacing / errors[2][0]).powi(2)];
    orders.add(Source::Simulated, "strip", errors.to_vec());
    orders.add(Source::Reference, "second order", errors.map(second).to_vec());
    Ok(Findings { checks, graphs: vec![shapes, orders], ..Findings::default() })
}

/// A strip without weight whose tip a pin holds at a drop, and at the reach where it pulls straight down.
///
/// The pin's horizontal force is found to be nought by two trials: it is linear in the reach, and steep, because
/// a strip hardly stretches.
pub fn end_loaded_cantilever() -> Found {
    let strip = Strip::default();
    let hold = |drop: f64, reach: f64| -> Result<[f64; 2], ValidationError> {
        let shift = [(reach - 1.0) * strip.length, -drop * strip.length, 0.0];
        let rest = format!(
            "gravity = [0, 0, 0]\n[[pin]]\npanel = \"strip\"\nedge = \"right\"\n[pin.motion]\n\
             times = [0, 1]\nshift = [[0, 0, 0], {shift:?}]\n{REST}"
        );
        // Rest is only looked for when the pin has arrived.
        let rest = rest.replace("step = 0.002", "step = 0.002\nramp = 1.0");
        let mut simulation = strip.simulation(0.0, &rest)?;
        finish(&mut simulation)?;
        let [x, y, _] = simulation.pin_loads()[1].force;
        Ok([x, y].map(|force| force / strip.width * strip.length.powi(2) / strip.rigidity))
    };
    let mut checks = Vec::new();
    let mut found = [Vec::new(), Vec::new()];
    for ratio in [1.0, 4.0] {
        let exact = reference::cantilever(0.0, ratio);
        let trials = [exact.reach, exact.reach - 1e-4];
        let [first, second] = trials.map(|reach| hold(exact.drop, reach));
        let (first, second) = (first?, second?);
        let part = first[0] / (first[0] - second[0]);
        let load = first[1] + part * (second[1] - first[1]);
        let reach = trials[0] + part * (trials[1] - trials[0]);
        let what = format!("end load PL²/B for the drop of {ratio}");
        checks.push(Check::within(what, load, ratio, 0.01));
        let what = format!("reach over length for the drop of {ratio}");
        checks.push(Check::within(what, reach, exact.reach, 0.01));
        found[0].push([load, exact.drop]);
        found[1].push([load, reach]);
    }
    let axes = [Axis::ratio("end load PL²/B"), Axis::ratio("over the length")];
    let mut graph = Graph::new("place of the tip of a strip with a load", axes);
    let loads = (1..=50).map(|k| 0.1 * f64::from(k));
    let tips: Vec<_> = loads.map(|load| (load, reference::cantilever(0.0, load))).collect();
    for (label, found) in ["drop", "reach"].into_iter().zip(found) {
        let along = tips
            .iter()
            .map(|(load, tip)| [*load, if label == "drop" { tip.drop } else { tip.reach }]);
        graph.add(Source::Simulated, label, found);
        graph.add(Source::Reference, "end-loaded elastica", along.collect());
    }
    Ok(Findings { checks, graphs: vec![graph], ..Findings::default() })
}

/// A long limp strip between two hinges at the same height.
pub fn catenary() -> Found {
    let strip = Strip {
        length: 0.5,
        width: 0.05,
        cells: 100,
        hold: Hold::Hinge,
        rigidity: 1e-7,
        ..Strip::default()
    };
    let mut checks = Vec::new();
    let axes = [Axis::ratio("across over span"), Axis::ratio("height over span")];
    let mut graph = Graph::new("limp strips between two hinges", axes).laid_out(Layout::ToScale);
    for slack in [1.1, 1.5] {
        let span = strip.length / slack;
        let rest = format!(
            "[[pin]]\npanel = \"strip\"\nedge = \"right\"\n[pin.motion]\ntimes = [0, 1]\n\
             shift = [[0, 0, 0], [{:e}, 0, 0]]\n{REST}",
            span - strip.length
        );
        let mut simulation = strip.simulation(0.0, &rest)?;
        finish(&mut simulation)?;
        let line = strip.line(&simulation);
        let lowest = line.iter().map(|(_, x)| -x[1]).fold(0.0, f64::max);
        let shape = line.iter().map(|(_, x)| [x[0] / span, x[1] / span]).collect();
        graph.add(Source::Simulated, format!("{slack} spans long"), shape);
        graph.add(Source::Reference, "catenary", reference::catenary_shape(slack, 100));
        let what = format!("sag over span for a length of {slack} spans");
        checks.push(Check::within(what, lowest / span, reference::catenary_sag(slack), 0.01));
    }
    Ok(Findings { checks, graphs: vec![graph], ..Findings::default() })
}

/// A strip that hangs straight down stretches by `$wL^2/2k$`.
pub fn self_stretch() -> Found {
    let hold = Hold::Hinge;
    let strip = Strip { length: 1.0, width: 0.1, stiffness: 500.0, hold, ..Strip::default() };
    let mut simulation = strip.simulation(-90.0, REST)?;
    finish(&mut simulation)?;
    let found = -strip.tip(&simulation)[1] - strip.length;
    let exact = 0.5 * strip.density * GRAVITY * strip.length.powi(2) / strip.stiffness;
    Ok(vec![Check::within("stretch of a metre under its own weight, m", found, exact, 0.01)].into())
}

/// An upright strip leans the more the nearer its weight is to the critical one [Southwell 1932].
pub fn column() -> Found {
    let lean = |weight: f64| -> Result<f64, ValidationError> {
        let strip = Strip::default().of_weight(weight);
        // A slant of gravity by a part in a thousand pushes sideways in proportion to the weight.
        let rest = format!("gravity = [{:e}, -{GRAVITY}, 0]\n{REST}", 1e-3 * GRAVITY);
        let rest = rest.replace("residual = 1e-5\nspeed = 1e-5", "residual = 1e-6\nspeed = 1e-6");
        let rest = rest.replace("tolerance = 1e-7", "tolerance = 1e-6");
        let mut simulation = strip.simulation(90.0, &rest)?;
        finish(&mut simulation)?;
        Ok(strip.tip(&simulation)[0].abs() / strip.length)
    };
    // δ (λc − λ)/λ is the same for both weights.
    let [low, high] = [6.0, 7.0];
    let (first, second) = (lean(low)? / low, lean(high)? / high);
    let critical = (second * high - first * low) / (second - first);
    let what = "weight wL³/B at which an upright strip bends over";
    Ok(vec![Check::within(what, critical, reference::SELF_WEIGHT_BUCKLING, 0.02)].into())
}

/// Radius of a cylinder, and the side of the square sheet on it, in m.
const RADIUS: f64 = 0.05;
const SIDE: f64 = 0.1;

/// Energy per area of a sheet of the cupro without friction in a shape, in J/m².
fn energy(
    (spacing, grain): (f64, f64),
    shape: impl Fn([f64; 2]) -> [f64; 3],
) -> Result<f64, ValidationError> {
    let fabric = fabric(CUPRO)?.without_friction();
    let text = format!(
        "{ALONE}spacing = {spacing:e}\nfabric.sheet.file = \"fabric.toml\"\n[[panel]]\nname = \"sheet\"\n\
         fabric = \"sheet\"\nrectangle = [{SIDE}, {SIDE}]\ngrain = {grain}\n\
         [time]\nstep = 0.01\nend = 1\n"
    );
    let scene = scene(text, fabric.to_toml())?;
    let places = scene.panels[0].lattice.panel_coordinates();
    let state = scene.cloth.state(places.into_iter().flat_map(shape).collect());
    let state = state.expect("a scene's panels place every particle");
    Ok(scene.cloth.stored(&state) / (SIDE * SIDE))
}

/// Sheets wrapped on a cylinder, and one that is twisted.
///
/// On a cylinder of radius `$R$` yarns at an angle `$\vartheta$` to its axis are helices with the curvature
/// `$\sin^2\vartheta/R$`, so the energy per area is `$B/2R^2$` along the yarns and `$(B_1 + B_2)/8R^2$` at 45°. Rows of
/// particles are wrapped as a sheet that does not stretch: their chords keep their length. A saddle `$z = tuv$` along the
/// yarns twists them by `$t$` and bends none; it stretches and shears by the order of `$t^2$`, which is
/// nothing beside `$t$` where that is small: the twisting stiffness is none.
pub fn cylinder() -> Found {
    let fabric = fabric(CUPRO)?;
    let [warp, weft] =
        [fabric.warp, fabric.weft].map(|laws| laws.bending.backbone.respond(0.0).tangent);
    let mut checks = Vec::new();
    for (name, grain, rigidity) in
        [("warp", 90.0, warp), ("weft", 0.0, weft), ("45°", 45.0, 0.25 * (warp + weft))]
    {
        let exact = 0.5 * rigidity / (RADIUS * RADIUS);
        let mut errors = Vec::new();
        for spacing in [0.01, 0.005, 0.0025] {
            let row = if grain == 45.0 { spacing * FRAC_1_SQRT_2 } else { spacing };
            let turn = 2.0 * (0.5 * row / RADIUS).asin();
            let found = energy((spacing, grain), |[x, y]| {
                let (sin, cos) = (x / row * turn).sin_cos();
                [RADIUS * sin, y, RADIUS * (1.0 - cos)]
            })?;
            errors.push(found / exact - 1.0);
            if spacing == 0.005 {
                let what = format!("energy of a sheet bent along its {name}, R = 5 cm, mJ/m²");
                checks.push(Check::within(what, 1e3 * found, 1e3 * exact, 0.02));
            }
        }
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).abs().log2();
            let what = format!("order of convergence, {name}, to an error of {:.1e}", pair[1]);
            checks.push(Check::at_least(what, order, 1.8));
        }
    }
    let twist = 0.001;
    let saddle = |[x, y]: [f64; 2]| [x, y, twist * (x - 0.5 * SIDE) * (y - 0.5 * SIDE)];
    let found = energy((0.005, 0.0), saddle)?;
    let what = "energy of a twisted sheet over that of one bent as much along its weft";
    checks.push(Check::at_most(what, found / (0.5 * weft * twist * twist), 1e-3));
    Ok(checks.into())
}
