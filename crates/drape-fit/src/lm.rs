//! Nonlinear least squares with bounds, by Levenberg and Marquardt's method.
//!
//! Finds the parameters `$p$` within their bounds that make `$\sum_i w_i r_i(p)^2$` least. It knows nothing
//! of fabrics: [`Problem`] is a few lines for any model.
//!
//! ```
//! use drape_fit::lm::{Parameter, Problem, Settings, minimise};
//!
//! /// Cooling towards room temperature: T = room + (start − room)·exp(−t/τ).
//! struct Cooling<'a> { time: &'a [f64], temperature: &'a [f64] }
//!
//! impl Problem for Cooling<'_> {
//!     fn residual_count(&self) -> usize { self.time.len() }
//!     fn residuals(&self, p: &[f64], out: &mut [f64]) {
//!         for ((r, t), measured) in out.iter_mut().zip(self.time).zip(self.temperature) {
//!             *r = p[0] + (p[1] - p[0]) * (-t / p[2]).exp() - measured;
//!         }
//!     }
//! }
//!
//! let time = [0.0, 60.0, 120.0, 240.0, 480.0];
//! let temperature = time.map(|t: f64| 21.0 + 64.0 * (-t / 300.0).exp());
//! let start = [
//!     Parameter::new(15.0),
//!     Parameter::new(80.0),
//!     Parameter::new(100.0).between(1.0, 1e4),
//! ];
//! let problem = Cooling { time: &time, temperature: &temperature };
//! let report = minimise(&problem, &start, &Settings::default());
//! assert!((report.parameters[2] - 300.0).abs() < 1e-6, "{report:?}");
//! ```

mod covariance;
mod criterion;
mod distribution;
mod jacobian;
mod linked;
mod loss;
mod minimise;
mod problem;
mod profile;
mod region;
mod search;

pub use covariance::{Covariance, Undetermined};
pub use criterion::akaike;
pub use distribution::student_quantile;
pub use linked::Linked;
pub use loss::Loss;
pub use minimise::{Report, Settings, Stop, minimise};
pub use problem::{Parameter, Problem};
pub use profile::{End, Interval, profile};
