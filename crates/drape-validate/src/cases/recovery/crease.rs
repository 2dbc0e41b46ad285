//! Cases `permanent-set` and `crease`: the residual curvature of a bent specimen.
//!
//! One clamp stays and the other turns until the specimen between them is an arc, holds it, turns
//! back until it bears no moment, and lets go: a slow release. One that is let go at once, even
//! without inertia, springs beyond where it would rest, and keeps 57 to 69 % of that (measured with
//! the specimens of `permanent-set`). Nothing in the model flows with time: how long the specimen
//! is held makes no difference.

use std::f64::consts::PI;

use drape_dynamics::Simulation;
use drape_fabric::{BendingLaw, Fabric};
use drape_kes::Direction;
use drape_scene::Scene;

use crate::bisection::bisect;
use crate::error::ValidationError;
use crate::findings::{Check, Findings};
use crate::instrument::{LARGEST_CURVATURE, Rows, arm, bent, laws, moment};
use crate::setup::fabrics::{COTTON, CUPRO, fabric};
use crate::setup::{ALONE, finish, scene};

type Checks = Result<Vec<Check>, ValidationError>;

/// Length of a step, in s: long against any wave, so that each ends at rest.
const STEP: f64 = 0.1;

/// Steps in which the clamp turns, and in which it turns back.
const STEPS: usize = 60;

/// Steps for which it holds the bent specimen, for which it stops before it lets go, and for which
/// the specimen is free.
const HOLDING: usize = 10;

const RESTING_STEPS: usize = 10;

const FREE_STEPS: usize = 20;

/// Cells across a specimen: it is the same all along the arc's axis, so few will do.
const ACROSS: f64 = 2.0;

/// An arc between clamps, and how it is made.
struct Arc {
    /// Length between the clamps, in m, and whole cells of it.
    length: f64,
    cells: usize,
    /// Length of the specimen to each side, in m.
    leg: f64,
    /// Curvature in the clamps, in 1/m.
    curvature: f64,
    /// Steps for which it is held.
    holding: usize,
}

impl Arc {
    fn spacing(&self) -> f64 {
        self.length / self.cells as f64
    }

    /// The specimen, whose clamp goes through curvatures, one in each step, and then lets go.
    fn scene(
        &self,
        fabric: &Fabric,
        direction: Direction,
        path: &[f64],
    ) -> Result<Scene, ValidationError> {
        let spacing = self.spacing();
        let rows = (self.leg / spacing).round().max(3.0);
        let grain = if direction == Direction::Warp { 90 } else { 0 };
        let places = path
            .iter()
            .map(|&curvature| bent(Rows { distance: spacing, cells: self.cells }, curvature));
        let list = |values: Vec<String>| values.join(", ");
        let times: Vec<f64> = (0..path.len()).map(|k| k as f64 * STEP).collect();
        let text = format!(
            "{ALONE}spacing = {spacing:e}\ngravity = [0, 0, 0]\nair.density = 0\n\
             fabric.specimen.file = \"fabric.toml\"\n[[panel]]\nname = \"specimen\"\n\
             fabric = \"specimen\"\nrectangle = [{:e}, {:e}]\ngrain = {grain}\n\
             center = [{:e}, 0, 0]\nturn = [-90, 0, 0]\n\
             [[pin]]\npanel = \"specimen\"\nedge = \"left\"\nrows = {rows}\n\
             [[pin]]\npanel = \"specimen\"\nedge = \"right\"\nrows = {rows}\nrelease = {:e}\n\
             [pin.motion]\ntimes = {times:?}\ncenter = [{:e}, 0, 0]\nshift = [{}]\nturn = [{}]\n\
             [time]\nstep = {STEP}\nend = {:e}\n[solver]\nlinear = \"cholesky\"\n\
             tolerance = 1e-5\n[output]\nenergy = false\n",
            self.length + (2.0 * rows - 3.0) * spacing,
            ACROSS * spacing,
            0.5 * self.length,
            (path.len() as f64 - 0.5) * STEP,
            self.length - 0.5 * spacing,
            list(places.clone().map(|place| format!("{:?}", place.shift)).collect()),
            list(places.map(|p| format!("[0, 0, {:e}]", p.turn.to_degrees())).collect()),
            (path.len() - 1 + FREE_STEPS) as f64 * STEP,
        );
        scene(text, fabric.to_toml())
    }

    /// Up to the curvature and through the time in which it is held.
    fn bending(&self) -> Vec<f64> {
        let up = (0..=STEPS).map(|k| self.curvature * k as f64 / STEPS as f64);
        up.chain(std::iter::repeat_n(self.curvature, self.holding)).collect()
    }

    /// The curvature at which the clamp bears no moment on its way back, in 1/m.
    fn unloaded(&self, fabric: &Fabric, direction: Direction) -> Result<f64, ValidationError> {
        let mut path = self.bending();
        let held = path.len();
        path.extend((1..=STEPS).map(|k| self.curvature * (1.0 - k as f64 / STEPS as f64)));
        let scene = self.scene(fabric, direction, &path)?;
        let arm = arm(&scene, self.length - 0.5 * self.spacing());
        let mut simulation = Simulation::new(scene)?;
        let mut before = (f64::NAN, f64::NAN);
        for (step, &curvature) in path.iter().enumerate().skip(1) {
            simulation.step()?;
            let moment = -moment(&simulation.pin_loads()[1], arm, curvature * self.length);
            if step >= held && moment <= 0.0 {
                let part = before.1 / (before.1 - moment);
                return Ok(before.0 + part * (curvature - before.0));
            }
            before = (curvature, moment);
        }
        Ok(f64::NAN)
    }

    /// Angle that the specimen keeps, in rad.
    fn kept(&self, fabric: &Fabric, direction: Direction) -> Result<f64, ValidationError> {
        let unloaded = self.unloaded(fabric, direction)?;
        let mut path = self.bending();
        let back = |k: usize| (self.curvature - unloaded) * k as f64 / STEPS as f64;
        path.extend((1..=STEPS).map(|k| self.curvature - back(k)));
        // At rest when it lets go: otherwise the leg would swing on.
        path.extend(std::iter::repeat_n(unloaded, RESTING_STEPS));
        let scene = self.scene(fabric, direction, &path)?;
        // The free leg: from the last row that was bent to the end.
        let along: Vec<f64> = scene.start.positions.chunks_exact(3).map(|place| place[0]).collect();
        let end = along.iter().copied().fold(f64::MIN, f64::max);
        let ends = [self.length - 0.5 * self.spacing(), end].map(|x| {
            let near = |place: &f64| (place - x).abs() < 0.1 * self.spacing();
            along.iter().position(near).unwrap_or_default()
        });
        let mut simulation = Simulation::new(scene)?;
        finish(&mut simulation)?;
        let positions = simulation.frame().positions;
        let [from, to] = ends.map(|row| &positions[3 * row..3 * row + 3]);
        Ok((to[1] - from[1]).atan2(to[0] - from[0]))
    }
}

/// Curvature at which no moment is left after a first bending to a curvature, both in 1/m.
///
/// A Dahl element of plateau `$F$` and length `$\ell$` has reached
/// `$f_1 = F(1 - e^{-\kappa_1/\ell})$` and goes back along
/// `$f = -F + (f_1 + F)e^{(\kappa - \kappa_1)/\ell}$`; the elastic moment is `$B\kappa$`.
fn kept_curvature(law: &BendingLaw, largest: f64) -> f64 {
    let rigidity = law.backbone.respond(0.0).tangent;
    let moment = |curvature: f64| {
        let friction = law.friction.elements.iter().map(|element| {
            let reached = element.plateau * (1.0 - (-largest / element.length).exp());
            let left = ((curvature - largest) / element.length).exp();
            (reached + element.plateau) * left - element.plateau
        });
        rigidity * curvature + friction.sum::<f64>()
    };
    bisect(0.0..largest, |curvature| moment(curvature) < 0.0).low
}

/// Two fabrics along both yarns.
fn each(mut check: impl FnMut(&str, &Fabric, Direction) -> Checks) -> Checks {
    let mut checks = Vec::new();
    for text in [CUPRO, COTTON] {
        let fabric = fabric(text)?;
        for direction in [Direction::Warp, Direction::Weft] {
            let what = format!("{}, {}", fabric.name, direction.name());
            checks.extend(check(&what, &fabric, direction)?);
        }
    }
    Ok(checks)
}

/// A centimetre bent to the largest curvature of the KES test and let go.
pub(crate) fn permanent_set() -> Result<Findings, ValidationError> {
    let checks = each(|what, fabric, direction| {
        let (length, curvature) = (0.01, LARGEST_CURVATURE);
        let arc = Arc { length, cells: 8, leg: 0.01, curvature, holding: HOLDING };
        let found = arc.kept(fabric, direction)? / length;
        let exact = kept_curvature(&laws(fabric, direction).bending, curvature);
        let what = format!("{what}: curvature kept after 2.5 cm⁻¹, 1/m");
        Ok(vec![Check::within(what, found, exact, 0.02)])
    });
    checks.map(Findings::from)
}

/// A strip of 40 mm in a fold of 180°: the middles of its halves are two thicknesses apart.
fn fold(fabric: &Fabric, holding: usize) -> Arc {
    let length = PI * fabric.thickness;
    let (curvature, leg) = (1.0 / fabric.thickness, 0.5 * (0.04 - length));
    Arc { length, cells: 3, leg, curvature, holding }
}

/// A strip of 40 mm folded in half, held and let go.
///
/// Where the fold was the strip keeps the curvature at which the friction holds what is elastic,
/// and no more: a degree or few. Fabrics keep far more in the laboratory. Their fibres, bent to the
/// radius of a yarn, yield and creep, of which a loop that was measured up to 2.5 cm⁻¹ tells
/// nothing.
pub(crate) fn crease() -> Result<Findings, ValidationError> {
    let mut checks = each(|what, fabric, direction| {
        let arc = fold(fabric, HOLDING);
        let kept = kept_curvature(&laws(fabric, direction).bending, arc.curvature) * arc.length;
        let (found, exact) = (arc.kept(fabric, direction)?.to_degrees(), kept.to_degrees());
        let of = |figure: &str| format!("{what}: {figure}");
        Ok(vec![
            Check::within(of("crease recovery angle, °"), 180.0 - found, 180.0 - exact, 0.001),
            Check::within(of("angle kept, °"), found, exact, 0.02),
        ])
    })?;
    let cotton = fabric(COTTON)?;
    let kept = |holding| fold(&cotton, holding).kept(&cotton, Direction::Warp);
    let change = (kept(30 * HOLDING)? - kept(HOLDING)?).to_degrees().abs();
    let what = format!("{}: change if it is held for 30 s, not 1 s, °", cotton.name);
    checks.push(Check::at_most(what, change, 1e-3));
    Ok(checks.into())
}
