//! Suite: the cases of `drape validate` with their names and titles.
//!
//! The command line asks for a case by its name, runs it, and shows its [`Outcome`]. A long case
//! takes many minutes and is left out unless it is asked for.

use serde::{Deserialize, Serialize};

use crate::cases::{drapes, dynamics, loops, recovery, statics};
use crate::error::ValidationError;
use crate::findings::{Check, Findings, Graph, Still};
use crate::progress::Progress;

/// Case of the suite.
#[derive(Debug, Clone, Copy)]
pub struct Case {
    /// Name by which it is asked for.
    pub name: &'static str,
    /// Title, with the source of the reference.
    pub title: &'static str,
    run: Run,
}

#[derive(Debug, Clone, Copy)]
enum Run {
    Short(fn() -> Result<Findings, ValidationError>),
    Long(fn(&Progress<'_>) -> Result<Findings, ValidationError>),
}

impl Case {
    /// Returns whether it takes many minutes.
    #[must_use]
    pub fn is_long(&self) -> bool {
        matches!(self.run, Run::Long(_))
    }

    /// Simulates, compares and returns the findings.
    ///
    /// # Errors
    /// A simulation that cannot be run to its end.
    pub fn run(&self, progress: &Progress<'_>) -> Result<Findings, ValidationError> {
        match self.run {
            Run::Short(run) => run(),
            Run::Long(run) => run(progress),
        }
    }
}

/// Cases, in the order of the report.
pub const CASES: &[Case] = &[
    Case {
        name: "instruments",
        title: "Specimens in simulated KES instruments return the loops of the laws",
        run: Run::Short(loops::instruments),
    },
    Case {
        name: "bias-bending",
        title: "Bending specimens cut on the bias, with both yarns' loops (closed form)",
        run: Run::Short(loops::bias_bending),
    },
    Case {
        name: "bias-rim",
        title: "Bending specimens cut on the bias, with a rim of triangles (closed form)",
        run: Run::Short(loops::bias_rim),
    },
    Case {
        name: "hysteresis",
        title: "A specimen that was bent loses energy and keeps a curvature (Dahl friction, closed forms)",
        run: Run::Short(loops::hysteresis),
    },
    Case {
        name: "decrement",
        title: "A strip with friction swings less and less (Dahl friction, area of the loop)",
        run: Run::Short(dynamics::decrement),
    },
    Case {
        name: "permanent-set",
        title: "A strip that was bent in clamps and let go stays curved (Dahl friction, closed form)",
        run: Run::Short(recovery::permanent_set),
    },
    Case {
        name: "crease",
        title: "A strip that was folded and let go recovers (Dahl friction, closed form)",
        run: Run::Short(recovery::crease),
    },
    Case {
        name: "fold",
        title: "A strip that is folded at rest comes to the angle of its fold",
        run: Run::Short(recovery::fold),
    },
    Case {
        name: "heavy-cantilever",
        title: "A clamped strip bends under its own weight (heavy elastica)",
        run: Run::Short(statics::heavy_cantilever),
    },
    Case {
        name: "end-load",
        title: "A clamped strip bends under a load at its tip (Bisshopp & Drucker 1945)",
        run: Run::Short(statics::end_loaded_cantilever),
    },
    Case {
        name: "catenary",
        title: "A limp strip between two hinges (catenary)",
        run: Run::Short(statics::catenary),
    },
    Case {
        name: "self-stretch",
        title: "A hanging strip stretches under its own weight",
        run: Run::Short(statics::self_stretch),
    },
    Case {
        name: "cylinder",
        title: "A sheet on a cylinder stores the energy of its yarns' bending",
        run: Run::Short(statics::cylinder),
    },
    Case {
        name: "bias-strip",
        title: "Strips cut at an angle to the grain stretch (Kilby 1963)",
        run: Run::Short(statics::bias_strip),
    },
    Case {
        name: "column",
        title: "An upright strip bends over under its own weight (Greenhill 1881)",
        run: Run::Short(statics::column),
    },
    Case {
        name: "hanging-chain",
        title: "Modes of a limp hanging strip (Bernoulli 1732)",
        run: Run::Short(dynamics::hanging_chain),
    },
    Case {
        name: "hanging-strip",
        title: "First mode of a hanging strip with bending rigidity",
        run: Run::Short(dynamics::hanging_strip),
    },
    Case {
        name: "pendulum",
        title: "Period of a stiff strip on a hinge at large amplitudes",
        run: Run::Short(dynamics::pendulum),
    },
    Case {
        name: "free-fall",
        title: "A strip that nothing holds",
        run: Run::Short(dynamics::free_fall),
    },
    Case {
        name: "rotation",
        title: "A strip that nothing holds or pulls at turns on",
        run: Run::Short(dynamics::rotation),
    },
    Case {
        name: "vacuum",
        title: "A strip in a vacuum swings, and is thrown over (Tagawa, Hayashi & Kijima 2003)",
        run: Run::Short(dynamics::vacuum),
    },
    Case {
        name: "cube",
        title: "A stiff cloth on a cube, in the laws of its fabric and in Breen's particles; a coarse grid",
        run: Run::Short(drapes::coarse_cube),
    },
    Case {
        name: "breen",
        title: "Cloths on a cube, in the laws of their fabrics and in Breen's particles (Breen, House & Wozny 1994)",
        run: Run::Long(drapes::cubes),
    },
    Case {
        name: "drapemeter-cotton",
        title: "Drape coefficient of a stiff cotton (Matsudaira et al. 2015)",
        run: Run::Long(drapes::cotton),
    },
    Case {
        name: "drapemeter-wool",
        title: "Drape coefficient of a limp wool (Matsudaira et al. 2015)",
        run: Run::Long(drapes::wool),
    },
    Case {
        name: "grid-cotton",
        title: "Drape coefficient of the stiff cotton on a finer grid, and on a turned one",
        run: Run::Long(drapes::grid_of_cotton),
    },
    Case {
        name: "grid-wool",
        title: "Drape coefficient of the limp wool on a finer grid, and on a turned one",
        run: Run::Long(drapes::grid_of_wool),
    },
    Case {
        name: "sensitivity-cotton",
        title: "What the drape coefficient of the stiff cotton depends on",
        run: Run::Long(drapes::sensitivity_of_cotton),
    },
    Case {
        name: "sensitivity-wool",
        title: "What the drape coefficient of the limp wool depends on",
        run: Run::Long(drapes::sensitivity_of_wool),
    },
];

/// Outcome of a case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// Name of the case.
    pub name: String,
    /// Title of the case.
    pub title: String,
    /// Checks; none where it could not be run.
    pub checks: Vec<Check>,
    /// Plots.
    #[serde(skip)]
    pub graphs: Vec<Graph>,
    /// Pictures.
    #[serde(skip)]
    pub stills: Vec<Still>,
    /// Reason why it could not be run.
    pub failure: Option<String>,
    /// Time that it took, in s.
    pub seconds: f64,
}

impl Outcome {
    /// Runs a case and returns its outcome.
    #[must_use]
    pub fn of(case: &Case, progress: &Progress<'_>) -> Self {
        let start = std::time::Instant::now();
        let (findings, failure) = match case.run(progress) {
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

    /// Returns whether it could be run and every figure is within its limit.
    #[must_use]
    pub fn passes(&self) -> bool {
        self.failure.is_none() && self.checks.iter().all(Check::passes)
    }
}
