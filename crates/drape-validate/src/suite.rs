//! Suite: the cases of the validation with their names and titles.
//!
//! A program runs a case by its name and shows its [`Outcome`]. A long case takes many
//! minutes and runs only if a person asks for it.

use serde::{Deserialize, Serialize};

use crate::cases::{drapes, dynamics, loops, recovery, statics};
use crate::error::ValidationError;
use crate::findings::{Check, Findings, Graph, Still};
use crate::progress::Progress;

/// Case of the suite.
#[derive(Debug, Clone, Copy)]
pub struct Case {
    /// Name, by which a program runs the case.
    pub name: &'static str,
    /// Title, with the source of the reference.
    pub title: &'static str,
    run: CaseFunction,
}

/// Function that runs a case.
#[derive(Debug, Clone, Copy)]
enum CaseFunction {
    Short(fn() -> Result<Findings, ValidationError>),
    Long(fn(&Progress<'_>) -> Result<Findings, ValidationError>),
}

impl Case {
    /// Returns whether the case takes many minutes.
    #[must_use]
    pub fn is_long(&self) -> bool {
        matches!(self.run, CaseFunction::Long(_))
    }

    /// Simulates, compares and returns the findings. A long case calls `progress` after each of its
    /// simulations.
    ///
    /// # Errors
    /// A simulation cannot be run to its end.
    pub fn run(&self, progress: &Progress<'_>) -> Result<Findings, ValidationError> {
        match self.run {
            CaseFunction::Short(run) => run(),
            CaseFunction::Long(run) => run(progress),
        }
    }
}

/// Cases, in the order of the report.
pub const CASES: &[Case] = &[
    Case {
        name: "instruments",
        title: "Specimens in simulated KES instruments return the loops of the laws",
        run: CaseFunction::Short(loops::instruments),
    },
    Case {
        name: "bias-bending",
        title: "Bending specimens cut on the bias, with both yarns' loops (closed form)",
        run: CaseFunction::Short(loops::bias_bending),
    },
    Case {
        name: "bias-rim",
        title: "Bending specimens cut on the bias, with a rim of triangles (closed form)",
        run: CaseFunction::Short(loops::bias_rim),
    },
    Case {
        name: "hysteresis",
        title: "A specimen that was bent loses energy and keeps a curvature (Dahl friction, closed forms)",
        run: CaseFunction::Short(loops::hysteresis),
    },
    Case {
        name: "decrement",
        title: "A strip with friction swings less and less (Dahl friction, area of the loop)",
        run: CaseFunction::Short(dynamics::decrement),
    },
    Case {
        name: "permanent-set",
        title: "A strip that was bent in clamps and let go stays curved (Dahl friction, closed form)",
        run: CaseFunction::Short(recovery::permanent_set),
    },
    Case {
        name: "crease",
        title: "A strip that was folded and let go recovers (Dahl friction, closed form)",
        run: CaseFunction::Short(recovery::crease),
    },
    Case {
        name: "fold",
        title: "A strip that is folded at rest comes to the angle of its fold",
        run: CaseFunction::Short(recovery::fold),
    },
    Case {
        name: "heavy-cantilever",
        title: "A clamped strip bends under its own weight (heavy elastica)",
        run: CaseFunction::Short(statics::heavy_cantilever),
    },
    Case {
        name: "end-load",
        title: "A clamped strip bends under a load at its tip (Bisshopp & Drucker 1945)",
        run: CaseFunction::Short(statics::end_loaded_cantilever),
    },
    Case {
        name: "catenary",
        title: "A limp strip between two hinges (catenary)",
        run: CaseFunction::Short(statics::catenary),
    },
    Case {
        name: "self-stretch",
        title: "A hanging strip stretches under its own weight",
        run: CaseFunction::Short(statics::self_stretch),
    },
    Case {
        name: "cylinder",
        title: "A sheet on a cylinder stores the energy of its yarns' bending",
        run: CaseFunction::Short(statics::cylinder),
    },
    Case {
        name: "bias-strip",
        title: "Strips cut at an angle to the grain stretch (Kilby 1963)",
        run: CaseFunction::Short(statics::bias_strip),
    },
    Case {
        name: "column",
        title: "An upright strip bends over under its own weight (Greenhill 1881)",
        run: CaseFunction::Short(statics::column),
    },
    Case {
        name: "hanging-chain",
        title: "Modes of a limp hanging strip (Bernoulli 1732)",
        run: CaseFunction::Short(dynamics::hanging_chain),
    },
    Case {
        name: "hanging-strip",
        title: "First mode of a hanging strip with bending rigidity",
        run: CaseFunction::Short(dynamics::hanging_strip),
    },
    Case {
        name: "pendulum",
        title: "Period of a stiff strip on a hinge at large amplitudes",
        run: CaseFunction::Short(dynamics::pendulum),
    },
    Case {
        name: "free-fall",
        title: "A strip that nothing holds",
        run: CaseFunction::Short(dynamics::free_fall),
    },
    Case {
        name: "rotation",
        title: "A strip that nothing holds or pulls at turns on",
        run: CaseFunction::Short(dynamics::rotation),
    },
    Case {
        name: "vacuum",
        title: "A strip in a vacuum swings, and is thrown over (Tagawa, Hayashi & Kijima 2003)",
        run: CaseFunction::Short(dynamics::vacuum),
    },
    Case {
        name: "cube",
        title: "A stiff cloth on a cube, in the laws of its fabric and in Breen's particles; a coarse grid",
        run: CaseFunction::Short(drapes::coarse_cube),
    },
    Case {
        name: "breen",
        title: "Cloths on a cube, in the laws of their fabrics and in Breen's particles (Breen, House & Wozny 1994)",
        run: CaseFunction::Long(drapes::cubes),
    },
    Case {
        name: "drapemeter-cotton",
        title: "Drape coefficient of a stiff cotton (Matsudaira et al. 2015)",
        run: CaseFunction::Long(drapes::cotton),
    },
    Case {
        name: "drapemeter-wool",
        title: "Drape coefficient of a limp wool (Matsudaira et al. 2015)",
        run: CaseFunction::Long(drapes::wool),
    },
    Case {
        name: "grid-cotton",
        title: "Drape coefficient of the stiff cotton on a finer grid, and on a turned one",
        run: CaseFunction::Long(drapes::grid_of_cotton),
    },
    Case {
        name: "grid-wool",
        title: "Drape coefficient of the limp wool on a finer grid, and on a turned one",
        run: CaseFunction::Long(drapes::grid_of_wool),
    },
    Case {
        name: "sensitivity-cotton",
        title: "What the drape coefficient of the stiff cotton depends on",
        run: CaseFunction::Long(drapes::sensitivity_of_cotton),
    },
    Case {
        name: "sensitivity-wool",
        title: "What the drape coefficient of the limp wool depends on",
        run: CaseFunction::Long(drapes::sensitivity_of_wool),
    },
];

/// Outcome of a case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// Name of the case.
    pub name: String,
    /// Title of the case.
    pub title: String,
    /// Checks. Empty if the case could not be run.
    pub checks: Vec<Check>,
    /// Plots.
    #[serde(skip)]
    pub graphs: Vec<Graph>,
    /// Pictures.
    #[serde(skip)]
    pub stills: Vec<Still>,
    /// Reason why the case could not be run.
    pub failure: Option<String>,
    /// Wall-clock time of the case, in s.
    pub seconds: f64,
}

impl Outcome {
    /// Runs `case` and returns its outcome. A long case calls `progress` after each of its
    /// simulations.
    #[must_use]
    pub fn run(case: &Case, progress: &Progress<'_>) -> Self {
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

    /// Returns whether the case could be run and every one of `checks` passes.
    #[must_use]
    pub fn passes(&self) -> bool {
        self.failure.is_none() && self.checks.iter().all(Check::passes)
    }
}
