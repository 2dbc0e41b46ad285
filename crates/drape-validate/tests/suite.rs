//! Every case of the suite that takes seconds is within its limits.

use drape_validate::{CASES, Outcome};

#[test]
fn every_case_is_within_its_limits() {
    let outcomes: Vec<Outcome> = CASES
        .iter()
        .filter(|case| !case.is_long())
        .map(|case| Outcome::run(case, &|_| ()))
        .collect();
    let beyond: Vec<&Outcome> = outcomes.iter().filter(|outcome| !outcome.passes()).collect();
    assert!(beyond.is_empty(), "{beyond:#?}");
}
