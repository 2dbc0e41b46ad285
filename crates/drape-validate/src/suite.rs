use serde::Serialize;

use crate::{
    Check, Findings, Graph, Still, ValidationError, bias, bias_rim, breen, crease, decrement,
    drapes, dynamics, fold, loops, statics, vacuum,
};

/// A case of the suite.
#[derive(Debug, Clone, Copy)]
pub struct Case {
    /// The name by which it is asked for.
    pub name: &'static str,
    /// What it shows, and where the reference is from.
    pub title: &'static str,
    /// Whether it takes minutes and is left out unless asked for.
    pub long: bool,
    run: fn() -> Result<Findings, ValidationError>,
}

impl Case {
    /// Simulates and compares.
    ///
    /// # Errors
    /// A simulation that cannot be run to its end.
    pub fn run(&self) -> Result<Findings, ValidationError> {
        (self.run)()
    }
}

/// Every case, in the order of the report.
pub const CASES: &[Case] = &[
    Case {
        name: "instruments",
        title: "Specimens in simulated KES instruments return the loops of the laws",
        long: false,
        run: loops::instruments,
    },
    Case {
        name: "bias-bending",
        title: "Bending specimens cut on the bias, with both yarns' loops (closed form)",
        long: false,
        run: loops::bias_bending,
    },
    Case {
        name: "bias-rim",
        title: "Bending specimens cut on the bias, with a rim of triangles (closed form)",
        long: false,
        run: bias_rim::bias_rim,
    },
    Case {
        name: "hysteresis",
        title: "A specimen that was bent loses energy and keeps a curvature (Dahl friction, closed forms)",
        long: false,
        run: loops::bending_hysteresis,
    },
    Case {
        name: "decrement",
        title: "A strip with friction swings less and less (Dahl friction, area of the loop)",
        long: false,
        run: decrement::decrement,
    },
    Case {
        name: "permanent-set",
        title: "A strip that was bent in clamps and let go stays curved (Dahl friction, closed form)",
        long: false,
        run: crease::permanent_set,
    },
    Case {
        name: "crease",
        title: "A strip that was folded and let go recovers (Dahl friction, closed form)",
        long: false,
        run: crease::recovery,
    },
    Case {
        name: "fold",
        title: "A strip that is folded at rest comes to the angle of its fold",
        long: false,
        run: fold::fold,
    },
    Case {
        name: "heavy-cantilever",
        title: "A clamped strip bends under its own weight (heavy elastica)",
        long: false,
        run: statics::heavy_cantilever,
    },
    Case {
        name: "end-load",
        title: "A clamped strip bends under a load at its tip (Bisshopp & Drucker 1945)",
        long: false,
        run: statics::end_loaded_cantilever,
    },
    Case {
        name: "catenary",
        title: "A limp strip between two hinges (catenary)",
        long: false,
        run: statics::catenary,
    },
    Case {
        name: "self-stretch",
        title: "A hanging strip stretches under its own weight",
        long: false,
        run: statics::self_stretch,
    },
    Case {
        name: "cylinder",
        title: "A sheet on a cylinder stores the energy of its yarns' bending",
        long: false,
        run: statics::cylinder,
    },
    Case {
        name: "bias-strip",
        title: "Strips cut at an angle to the grain stretch (Kilby 1963)",
        long: false,
        run: bias::bias_strip,
    },
    Case {
        name: "column",
        title: "An upright strip bends over under its own weight (Greenhill 1881)",
        long: false,
        run: statics::column,
    },
    Case {
        name: "hanging-chain",
        title: "Modes of a limp hanging strip (Bernoulli 1732)",
        long: false,
        run: dynamics::hanging_chain,
    },
    Case {
        name: "hanging-strip",
        title: "First mode of a hanging strip with bending rigidity",
        long: false,
        run: dynamics::hanging_strip,
    },
    Case {
        name: "pendulum",
        title: "Period of a stiff strip on a hinge at large amplitudes",
        long: false,
        run: dynamics::pendulum,
    },
    Case {
        name: "free-fall",
        title: "A strip that nothing holds",
        long: false,
        run: dynamics::free_fall,
    },
    Case {
        name: "rotation",
        title: "A strip that nothing holds or pulls at turns on",
        long: false,
        run: dynamics::rotation,
    },
    Case {
        name: "vacuum",
        title: "A strip in a vacuum swings, and is thrown over (Tagawa, Hayashi & Kijima 2003)",
        long: false,
        run: vacuum::tagawa,
    },
    Case {
        name: "cube",
        title: "A stiff cloth on a cube, in the laws of its fabric and in Breen's particles; a coarse grid",
        long: false,
        run: breen::coarse,
    },
    Case {
        name: "breen",
        title: "Cloths on a cube, in the laws of their fabrics and in Breen's particles (Breen, House & Wozny 1994)",
        long: true,
        run: breen::cloths,
    },
    Case {
        name: "drapemeter-cotton",
        title: "Drape coefficient of a stiff cotton (Matsudaira et al. 2015)",
        long: true,
        run: drapes::cotton,
    },
    Case {
        name: "drapemeter-wool",
        title: "Drape coefficient of a limp wool (Matsudaira et al. 2015)",
        long: true,
        run: drapes::wool,
    },
    Case {
        name: "sensitivity-cotton",
        title: "What the drape coefficient of the stiff cotton depends on",
        long: true,
        run: drapes::sensitivity_of_cotton,
    },
    Case {
        name: "sensitivity-wool",
        title: "What the drape coefficient of the limp wool depends on",
        long: true,
        run: drapes::sensitivity_of_wool,
    },
];

/// What came of a case.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Outcome {
    /// The case's name.
    pub name: String,
    /// Its title.
    pub title: String,
    /// Its figures; none where it could not be run.
    pub checks: Vec<Check>,
    /// Its plots.
    #[serde(skip)]
    pub graphs: Vec<Graph>,
    /// Its pictures.
    #[serde(skip)]
    pub stills: Vec<Still>,
    /// Why it could not be run.
    pub failure: Option<String>,
    /// How long it took, in s.
    pub seconds: f64,
}

impl Outcome {
    /// Runs a case.
    pub fn of(case: &Case) -> Self {
        let start = std::time::Instant::now();
        let (findings, failure) = match case.run() {
            Ok(findings) => (findings, None),
            Err(error) => (Findings::default(), Some(error.to_string())),
        };
        let Findings { checks, graphs, stills } = findings;
        Self {
            name: case.name.into(),
            title: case.title.into(),
            checks,
            graphs,
            stills,
            failure,
            seconds: start.elapsed().as_secs_f64(),
        }
    }

    /// Whether it could be run, and every figure is within its limit.
    pub fn passes(&self) -> bool {
        self.failure.is_none() && self.checks.iter().all(Check::passes)
    }
}
