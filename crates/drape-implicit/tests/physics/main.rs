//! The crate against mechanics: exact solutions, conservation laws, and systems made to break it.
#![allow(clippy::unwrap_used)]

mod accuracy;
mod balance;
mod chains;
mod explicit;
mod failures;
mod methods;
mod springs;
mod step_filter;
mod steps;
mod well;

#[test]
fn settings_and_reports_come_back_from_json() {
    use drape_implicit::{Integrator, Report, Settings};

    let settings = Settings { integrator: Integrator::BackwardEuler, ..Settings::default() };
    let text = serde_json::to_string(&settings).expect("it has a JSON form");
    assert!(text.contains(r#""integrator":"backward-euler""#), "{text}");
    assert_eq!(serde_json::from_str::<Settings>(&text).expect("it is right"), settings);
    let some: Settings = serde_json::from_str(r#"{"method":{"textbook":{"initial":"diagonal"}}}"#)
        .expect("the other settings have their defaults");
    assert_eq!(some.tolerance, Settings::default().tolerance);
    assert!(serde_json::from_str::<Settings>(r#"{"exactness":1}"#).is_err());

    let mut report = Report::default();
    report.energy = Some(drape_implicit::StepEnergy { work: 0.1, ..Default::default() });
    let text = serde_json::to_string(&report).expect("it has a JSON form");
    assert_eq!(serde_json::from_str::<Report>(&text).expect("it is right"), report);
}
