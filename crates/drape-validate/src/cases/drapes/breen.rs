//! Cases `cube` and `breen`: observations of three fabrics on a cube \[BHW94, §6 and §7\], in the
//! laws of the fabrics and in Breen's particles.

use drape_fabric::Fabric;
use rayon::prelude::*;

use super::super::figure_name;
use super::cube::{CubeDrape, Model};
use crate::drapemeter::Sampling;
use crate::error::ValidationError;
use crate::findings::{Axis, Check, Findings, Graph, Layout, Source, Still};
use crate::progress::Progress;
use crate::setup::fabrics::{COTTON, LIMP_WEFT, STIFF_COTTON, WOOL, fabric};

/// Largest deviation of a symmetric billow from 45°, in degrees. The paper's 45° are read from
/// photographs. A larger deviation is an asymmetry.
const DIRECTION: f64 = 3.0;

/// Names and texts of the cloths.
const CLOTHS: [(&str, &str); 4] = [
    ("stiff cotton (stand-in)", STIFF_COTTON),
    ("cotton", COTTON),
    ("wool", WOOL),
    ("polyester/cotton (stand-in)", LIMP_WEFT),
];

/// Drapes of one cloth in one model.
struct ClothDrapes {
    model: Model,
    /// Name of the cloth.
    cloth: &'static str,
    /// Drapes from several starts.
    starts: Vec<CubeDrape>,
}

impl ClothDrapes {
    /// Simulates the cloth of `fabric` from each start of `sampling`.
    fn simulate(
        cloth: &'static str,
        fabric: &Fabric,
        model: Model,
        sampling: Sampling,
    ) -> Result<Self, ValidationError> {
        let starts: Result<Vec<_>, _> = (1..=sampling.starts)
            .into_par_iter()
            .map(|seed| CubeDrape::simulate(fabric, model, sampling.spacing, seed))
            .collect();
        Ok(Self { model, cloth, starts: starts? })
    }

    /// Returns the leans of all corners from all starts, in degrees.
    fn leans(&self) -> impl Iterator<Item = f64> {
        self.starts.iter().flat_map(CubeDrape::leans)
    }

    /// Returns the numbers of billows of all corners from all starts.
    fn billows(&self) -> impl Iterator<Item = usize> {
        self.starts.iter().flat_map(|drape| drape.billows)
    }

    /// Returns the mean reach of the corners over the starts, in m.
    fn reach(&self) -> f64 {
        self.starts.iter().map(CubeDrape::reach).sum::<f64>() / self.starts.len() as f64
    }

    /// Returns the name of `figure` of this cloth, for a check.
    fn what(&self, figure: &str) -> String {
        format!("{}, {}: {figure}", self.model.name(), self.cloth)
    }

    /// Checks that every corner has a single large billow at 45° (§6), within [`DIRECTION`].
    fn single_billow(&self) -> [Check; 2] {
        let most = self.billows().max().unwrap_or(usize::MAX);
        let off = self.leans().map(f64::abs).fold(0.0, f64::max);
        [
            Check::at_most(self.what("billows of a corner, most"), most as f64, 1.0),
            Check::at_most(self.what("direction of a corner off 45°, most, °"), off, DIRECTION),
        ]
    }
}

/// Returns the largest value of `figure` of all `drapes`, and at least zero.
fn largest(drapes: &[ClothDrapes], figure: impl Fn(&CubeDrape) -> f64) -> f64 {
    drapes.iter().flat_map(|cloth| &cloth.starts).map(figure).fold(0.0, f64::max)
}

/// Checks facts that hold for every cloth that goes slowly to rest. All `drapes` have one model.
fn invariants(drapes: &[ClothDrapes]) -> [Check; 3] {
    /// Largest rise of the energy in a step, over its whole fall. Rounding and the tolerance of a
    /// step allow this rise.
    const RISE: f64 = 1e-6;

    /// Residual at which a scene counts cloth as at rest, over g.
    const RESIDUAL: f64 = 1e-3;

    let model = drapes[0].model.name();
    let rise = "rise of the energy in a step over its fall in all, most of all cloths";
    let imbalance = "imbalance at rest over g, most of all cloths";
    let inside = "particles in the cube, most of all cloths";
    [
        Check::at_most(figure_name(model, rise), largest(drapes, CubeDrape::rise), RISE),
        Check::at_most(
            figure_name(model, imbalance),
            largest(drapes, |drape| drape.imbalance),
            RESIDUAL,
        ),
        Check::at_most(
            figure_name(model, inside),
            largest(drapes, |drape| drape.inside as f64),
            0.0,
        ),
    ]
}

/// Checks the paper's stiff cotton on a grid twice as coarse as the paper's, in each [`Model`].
pub(crate) fn coarse_cube() -> Result<Findings, ValidationError> {
    let fabric = fabric(STIFF_COTTON)?;
    let sampling = Sampling { spacing: 0.04, starts: 1 };
    let mut checks = Vec::new();
    for model in Model::ALL {
        let drapes = ClothDrapes::simulate(CLOTHS[0].0, &fabric, model, sampling)?;
        let [_, direction] = drapes.single_billow();
        checks.push(direction);
        checks.extend(invariants(&[drapes]));
    }
    Ok(checks.into())
}

/// Checks all cloths in both models. Calls `progress` after each cloth.
///
/// The paper says that the cotton has a single large billow at 45°, that the less stiff wool
/// collapses into two smaller folds, and that the polyester/cotton with its stiffer warp always has
/// an asymmetric billow. No figure of these fabrics is public. Matsudaira's wool is published and
/// limp. His cotton is published too, but is not stiff.
pub(crate) fn cubes(progress: &Progress<'_>) -> Result<Findings, ValidationError> {
    /// Spacing of the paper's 51 × 51 particles, with three starts of each cloth.
    const SAMPLING: Sampling = Sampling { spacing: 0.02, starts: 3 };

    /// Azimuth and elevation of the view of the cubes, in degrees.
    const VIEW: [f64; 2] = [30.0, 28.0];

    // All cloths in the laws of their fabrics, then all cloths in Breen's particles.
    let fabrics: Result<Vec<_>, ValidationError> =
        CLOTHS.iter().map(|(name, text)| Ok((*name, fabric(text)?))).collect();
    let fabrics = fabrics?;
    let combinations: Vec<_> = Model::ALL
        .into_iter()
        .flat_map(|model| fabrics.iter().map(move |(name, fabric)| (model, *name, fabric)))
        .collect();
    let count = combinations.len() as u64;
    let drapes: Result<Vec<ClothDrapes>, _> = combinations
        .into_par_iter()
        .map(|(model, name, fabric)| {
            let drapes = ClothDrapes::simulate(name, fabric, model, SAMPLING);
            progress(count);
            drapes
        })
        .collect();
    let drapes = drapes?;

    // The paper's observations, in each model.
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

/// Returns the graphs of `drapes` in each model: horizontal cuts of the cloths, and their energy
/// until they rest.
fn graphs(drapes: &[ClothDrapes]) -> Vec<Graph> {
    let mut graphs = Vec::new();
    for of_model in drapes.chunks(CLOTHS.len()) {
        let name = of_model[0].model.name();
        let axes =
            [Axis::new("along the weft", "mm", 1e-3), Axis::new("along the warp", "mm", 1e-3)];
        let title = format!("{name}: cloths on a cube, cut 30 cm above the floor");
        let mut cuts = Graph::new(title, axes).laid_out(Layout::ToScale);
        let axes = [Axis::new("step", "", 1.0), Axis::new("energy since the start", "J", 1.0)];
        let mut energies = Graph::new(format!("{name}: the ways to rest"), axes);

        // The first start stands for the others.
        for ClothDrapes { cloth, starts, .. } in of_model {
            let drape = &starts[0];
            let closed = drape.cut.iter().chain(drape.cut.first()).copied();
            if drape.cut.len() > 1 {
                cuts.add(Source::Traced, *cloth, closed.collect());
            }
            let steps = drape.energy.iter().enumerate();
            let points = steps.map(|(step, [_, energy])| [(step + 1) as f64, *energy]).collect();
            energies.add(Source::Traced, *cloth, points);
        }

        let half = 0.25;
        let cube = [[half, half], [-half, half], [-half, -half], [half, -half], [half, half]];
        cuts.add(Source::Reference, "cube", cube.to_vec());
        graphs.extend([cuts, energies]);
    }
    graphs
}
