//! Nonlinear least squares with bounds, by Levenberg and Marquardt's method.
//!
//! Finds the parameters `$p$` within their bounds that make `$\sum_i w_i r_i(p)^2$` least. It knows nothing
//! of fabrics: [`Problem`] is a few lines for any model. Parameters may be bounded, fixed, or
//! [`Linked`] to others; a [`Loss`] other than squares makes little of outliers.
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
//!
//! // With the noise of a thermometer: how well is the time constant known?
//! use drape_fit::lm::{Covariance, Loss, profile};
//! let noise = [0.1, -0.3, 0.2, 0.1, -0.1];
//! let mut measured = temperature;
//! measured.iter_mut().zip(noise).for_each(|(t, noise)| *t += noise);
//! let problem = Cooling { time: &time, temperature: &measured };
//! let report = minimise(&problem, &start, &Settings::default());
//! let covariance = Covariance::of(&problem, &start, &report, Loss::Squares);
//! let error = covariance.standard_error(2).expect("three parameters from five points");
//! let intervals = profile(&problem, &start, &report, (0.95, &Settings::default()));
//! let interval = intervals[2].as_ref().expect("three parameters from five points");
//! assert!(error > 1.0 && error < 20.0 && interval.contains(300.0), "{error}: {interval:?}");
//! ```
//!
//! [`Covariance`] tells which parameters the data do not determine, and with which others they are confused.
//! [`profile`] gives intervals that hold where the model is curved, and says where they have no end.
//! [`akaike`] chooses between models.

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
