//! Any target by libFuzzer: that which the variable `TARGET` names.

#![no_main]

use std::sync::LazyLock;

use libfuzzer_sys::fuzz_target;

static TARGET: LazyLock<drape_fuzz::Target> = LazyLock::new(|| {
    let name = std::env::var("TARGET").unwrap_or_default();
    drape_fuzz::target(&name).expect("TARGET is the name of a target")
});

fuzz_target!(|bytes: &[u8]| (TARGET.run)(bytes));
