//! Cases `cube` and `breen`: what is said of three fabrics on a cube \[BHW94, §6 and §7\], in both
//! models.

use drape_fabric::Fabric;
use rayon::prelude::*;

use super::cube::{Draped, Model};
use crate::drapemeter::Sampling;
use crate::error::ValidationError;
use crate::findings::{Axis, Check, Findings, Graph, Layout, Source, Still};
use crate::progress::Progress;
use crate::setup::fabrics::{COTTON, LIMP_WEFT, STIFF_COTTON, WOOL, fabric};

/// Spacing of the paper's 51 × 51 particles, and of a quick look, in m.
const SPACING: f64 = 0.02;

const COARSE: f64 = 0.04;

/// Starts of each cloth.
const STARTS: u64 = 3;

/// The paper's 45° of the cotton's billow, in degrees: it is read from photographs. Less than this
/// is no asymmetry, more is.
const DIRECTION: f64 = 3.0;

/// Rise of the energy in a step that rounding and the tolerance of a step allow, over the fall in
/// all.
const RISE: f64 = 1e-6;

/// The residual at which a scene says that cloth is at rest, over g.
const RESIDUAL: f64 = 1e-3;

/// From where the cubes are seen, azimuth and elevation in degrees.
const VIEW: [f64; 2] = [30.0, 28.0];

/// The cloths, with what they are called.
const CLOTHS: [(&str, &str); 4] = [
    ("stiff cotton (stand-in)", STIFF_COTTON),
    ("cotton", COTTON),
    ("wool", WOOL),
    ("polyester/cotton (stand-in)", LIMP_WEFT),
];

/// The drapes of one cloth in one model.
struct Drapes {
    model: Model,
    cloth: &'static str,
    starts: Vec<Draped>,
}

impl Drapes {
    fn of(
        cloth: &'static str,
        fabric: &Fabric,
        model: Model,
        sampling: Sampling,
    ) -> Result<Self, ValidationError> {
        let drape = |seed: u64| Draped::of(fabric, model, sampling.spacing, seed);
        let starts: Result<Vec<_>, _> = (1..=sampling.starts).into_par_iter().map(drape).collect();
        Ok(Self { model, cloth, starts: starts? })
    }

    fn leans(&self) -> impl Iterator<Item = f64> {
        self.starts.iter().flat_map(Draped::leans)
    }

    fn billows(&self) -> impl Iterator<Item = usize> {
        self.starts.iter().flat_map(|draped| draped.billows)
    }

    fn reach(&self) -> f64 {
        self.starts.iter().map(Draped::reach).sum::<f64>() / self.starts.len() as f64
    }

    /// A figure of this cloth.
    fn what(&self, what: &str) -> String {
        format!("{}, {}: {what}", self.model.name(), self.cloth)
    }

    /// A single large billow at 45° (§6).
    fn single_billow(&self) -> [Check; 2] {
        let most = self.billows().max().unwrap_or(usize::MAX);
        let off = self.leans().map(f64::abs).fold(0.0, f64::max);
        [
            Check::at_most(self.what("billows of a corner, most"), most as f64, 1.0),
            Check::at_most(self.what("direction of a corner off 45°, most, °"), off, DIRECTION),
        ]
    }
}

/// What is true of every cloth that creeps to rest, of those in one model.
fn invariants(drapes: &[Drapes]) -> [Check; 3] {
    let all = || drapes.iter().flat_map(|drapes| &drapes.starts);
    let largest = |of: fn(&Draped) -> f64| all().map(of).fold(0.0, f64::max);
    let what = |what: &str| format!("{}: {what}", drapes[0].model.name());
    let rise = what("rise of the energy in a step over its fall in all, most of all cloths");
    let imbalance = what("imbalance at rest over g, most of all cloths");
    let inside = what("particles in the cube, most of all cloths");
    [
        Check::at_most(rise, largest(Draped::rise), RISE),
        Check::at_most(imbalance, largest(|draped| draped.imbalance), RESIDUAL),
        Check::at_most(inside, largest(|draped| draped.inside as f64), 0.0),
    ]
}

/// The paper's stiff cotton on a grid twice as coarse.
pub(crate) fn coarse_cube() -> Result<Findings, ValidationError> {
    let fabric = fabric(STIFF_COTTON)?;
    let mut checks = Vec::new();
    for model in Model::ALL {
        let drapes =
            Drapes::of(CLOTHS[0].0, &fabric, model, Sampling { spacing: COARSE, starts: 1 })?;
        let [_, direction] = drapes.single_billow();
        checks.push(direction);
        checks.extend(invariants(&[drapes]));
    }
    Ok(checks.into())
}

/// All cloths in both models.
///
/// The paper says that the cotton has a single large billow at 45°, that the wool, being less
/// stiff, collapses into two smaller folds, and that the polyester/cotton, whose warp is stiffer,
/// always has an asymmetric one. No figure of its fabrics is public. Matsudaira's wool is published
/// and limp; his cotton is published too, but not stiff.
pub(crate) fn cubes(progress: &Progress<'_>) -> Result<Findings, ValidationError> {
    let fabrics: Result<Vec<_>, ValidationError> =
        CLOTHS.iter().map(|(name, text)| Ok((*name, fabric(text)?))).collect();
    let fabrics = fabrics?;
    let wanted = Model::ALL.into_iter().flat_map(|model| fabrics.iter().map(move |f| (model, f)));
    let wanted: Vec<_> = wanted.collect();
    let count = wanted.len() as u64;
    let drape = |(model, (name, fabric)): (Model, &(&'static str, Fabric))| {
        let drapes = Drapes::of(name, fabric, model, Sampling { spacing: SPACING, starts: STARTS });
        progress(count);
        drapes
    };
    let drapes: Result<Vec<Drapes>, _> = wanted.into_par_iter().map(drape).collect();
    let drapes = drapes?;
    let mut checks = Vec::new();
    for of_model in drapes.chunks(CLOTHS.len()) {
        let [stiff, _, wool, limp_weft] = of_model else { continue };
        checks.extend(stiff.single_billow());
        let fewest = wool.billows().min().unwrap_or(0);
        checks.push(Check::at_least(wool.what("billows of a corner, fewest"), fewest as f64, 2.0));
        let ratio = wool.reach() / stiff.reach();
        let what = "reach of the corners over that of the stiff cotton";
        checks.push(Check::at_most(wool.what(what), ratio, 1.0));
        let least = limp_weft.leans().fold(f64::INFINITY, f64::min);
        let what = "lean of a corner towards the warp's sides, least, °";
        checks.push(Check::at_least(limp_weft.what(what), least, DIRECTION));
        checks.extend(invariants(of_model));
    }
    let snapshots = drapes.iter().map(|drapes| drapes.starts[0].snapshot.clone()).collect();
    let names = CLOTHS.map(|(name, _)| name).join(", ");
    let [above, below] = Model::ALL.map(Model::name);
    let still = Still {
        title: format!("{names}; above in the {above}, below in {below}"),
        snapshots,
        columns: CLOTHS.len(),
        view: VIEW,
    };
    Ok(Findings { checks, graphs: graphs(&drapes), stills: vec![still] })
}

/// The cuts and the ways to rest.
fn graphs(drapes: &[Drapes]) -> Vec<Graph> {
    let mut graphs = Vec::new();
    for of_model in drapes.chunks(CLOTHS.len()) {
        let name = of_model[0].model.name();
        let axes =
            [Axis::new("along the weft", "mm", 1e-3), Axis::new("along the warp", "mm", 1e-3)];
        let title = format!("{name}: cloths on a cube, cut 30 cm above the floor");
        let mut cuts = Graph::new(title, axes).laid_out(Layout::ToScale);
        let axes = [Axis::new("step", "", 1.0), Axis::new("energy since the start", "J", 1.0)];
        let mut ways = Graph::new(format!("{name}: the ways to rest"), axes);
        for drapes in of_model {
            let draped = &drapes.starts[0];
            let closed = draped.cut.iter().chain(draped.cut.first()).copied();
            if draped.cut.len() > 1 {
                cuts.add(Source::Traced, drapes.cloth, closed.collect());
            }
            let energy = draped.energy.iter().enumerate();
            let way = energy.map(|(step, [_, energy])| [(step + 1) as f64, *energy]).collect();
            ways.add(Source::Traced, drapes.cloth, way);
        }
        let half = 0.25;
        let cube = [[half, half], [-half, half], [-half, -half], [half, -half], [half, half]];
        cuts.add(Source::Reference, "cube", cube.to_vec());
        graphs.extend([cuts, ways]);
    }
    graphs
}
